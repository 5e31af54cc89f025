// SPDX-License-Identifier: BSD-3-Clause
// posevote in a program of one's own: models are prepared once, scans come from memory, poses of
// the objects in them come back. C++17; needs nothing but the standard library.
//
//   #include <posevote/recognizer.hpp>
//
//   posevote::Recognizer recognizer({posevote::ObjectModel::from_file("part.stl")});
//   posevote::PointCloud cloud{xyz.data(), xyz.size() / 3};
//   for (const posevote::FoundObject& found : recognizer.recognize(cloud).found)
//     if (found.confidence > 0.5) pick(found.T_scene_model);
//
// In CMake: find_package(posevote), target_link_libraries(... posevote::posevote).
//
// Lengths that come out are metres; matrices are 4 x 4, row by row, and T_scene_model takes a point
// of the model's file to the scan's frame. In depth images that is the camera's: x right, y down,
// z forward.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace posevote {

using Matrix4 = std::array<double, 16>;

/// An object to look for: a file (PLY, STL, OBJ, OFF, PCD), or a mesh or cloud from memory.
struct ObjectModel {
  std::string file;
  std::string name;            ///< empty: the file's, without folder and ending
  int obj_id = 0;              ///< 0: from the file's name, where it ends in a number, or by order
  std::vector<float> points;   ///< n x 3, in RecognizerOptions::model_unit; empty for a file
  std::vector<float> normals;  ///< n x 3, or empty
  std::vector<std::uint32_t> faces;  ///< m x 3 indices of points, or empty: a raw cloud

  static ObjectModel from_file(std::string file) {
    ObjectModel model;
    model.file = std::move(file);
    return model;
  }
};

/// What `posevote run` takes on its command line, by the same names.
struct RecognizerOptions {
  std::string config = "default";  ///< a file, or one of those that come with posevote
  std::vector<std::string> set;    ///< "node.param=value", over the config
  std::string model_unit;          ///< "mm", "cm", "m", "in" or "auto"; empty: as the config says
  std::string scene_unit;          ///< of point clouds, the same
  std::string cache;               ///< folder of trained libraries; empty: ~/.cache/posevote
  std::size_t threads = 0;         ///< 0: all cores; shared by all that call
  std::uint64_t seed = 0;
};

/// A scan that lies in the caller's memory while recognize() runs. Rows with NaN or infinity are
/// left out, so that an organised cloud can come as it is.
struct PointCloud {
  const float* points = nullptr;   ///< n x 3, row by row, in RecognizerOptions::scene_unit
  std::size_t count = 0;           ///< n
  const float* normals = nullptr;  ///< n x 3, or null: they are estimated
  /// Where the sensor stood, in the cloud's frame and unit; null: found out from the normals, or
  /// the frame's origin.
  const double* sensor = nullptr;
};

/// Pinhole camera [pixel]; whole numbers are pixel centres.
struct PinholeCamera {
  double fx = 0, fy = 0, cx = 0, cy = 0;
};

/// A depth image in the caller's memory, row by row: one of the two, 0 or NaN is no measurement.
struct DepthView {
  const float* metres = nullptr;
  const std::uint16_t* raw = nullptr;
  double millimetres_per_unit = 1;  ///< of raw
  std::size_t width = 0, height = 0;
  PinholeCamera camera;
};

/// Another pose that the scan does not tell from the one found, for what differs between them is small,
/// and hidden or lost in noise.
struct LookAlikePose {
  Matrix4 T_scene_model{};  ///< [m]
  double probability = 0;   ///< that it is the right one, given that the object lies there
};

/// One found instance of one object.
struct FoundObject {
  std::string name;
  int obj_id = 0;
  /// In [0, 1]: the probability that it is right, one of its look_alikes counted as right.
  double confidence = 0;
  /// The same, its look_alikes counted as wrong, and times the probability that it is no other
  /// object that fits there.
  double pose_confidence = 0;
  Matrix4 T_scene_model{};  ///< [m]
  /// 6 x 6, row by row, of the pose error xi: T_true = T_scene_model exp(xi), where xi is a twist in
  /// the model's frame, about its origin: a translation [m], then a rotation vector [rad]. What
  /// nothing holds, as the turn of a can, has a large variance. Empty where the pose was not refined.
  std::optional<std::array<double, 36>> covariance;
  /// Turns about the model's own frame after which it looks the same; the pose times any of them
  /// is as good. The identity is first.
  std::vector<Matrix4> symmetries;
  /// Axes of continuous symmetry, unit vectors in the model's frame; they go through axis_point.
  std::vector<std::array<double, 3>> axes;
  std::array<double, 3> axis_point{};      ///< [m]
  std::vector<LookAlikePose> look_alikes;  ///< the likeliest first
  double inlier_share = 0;  ///< of the model points that face the sensor, those on scene points
  double rms = 0;           ///< of the inliers' distance to the scan's surface [m]
  double seconds = 0;       ///< spent on the search for it, since the object's instance before
};

/// The answer to one scan.
struct Recognition {
  std::vector<FoundObject> found;     ///< in descending order of confidence
  std::vector<std::string> warnings;  ///< what may be wrong with the scan although it is answered
  double seconds = 0;
};

/// Models, prepared, and the pipeline that finds them. Any number of threads may call recognize() of
/// one at once; the same input, options and seed give the same answer.
class Recognizer {
 public:
  /// Trains the models, or takes them from the cache. Throws std::invalid_argument for what is wrong
  /// with the options (every problem of the config at once) and std::runtime_error for a model that
  /// cannot be used, in the words of `posevote run`.
  explicit Recognizer(const std::vector<ObjectModel>& models,
                      const RecognizerOptions& options = {});
  ~Recognizer();
  Recognizer(Recognizer&&) noexcept;
  Recognizer& operator=(Recognizer&&) noexcept;

  /// Throws std::runtime_error "node: why" for a scan that cannot be answered, as one that is empty
  /// or of another unit than said.
  Recognition recognize(const PointCloud& cloud) const;
  Recognition recognize(const DepthView& image) const;
  /// A scan from a file; a depth image needs its camera in the options (load_scene.fx=...).
  Recognition recognize_file(const std::string& file) const;

  /// In ascending order of obj_id.
  std::vector<std::string> model_names() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// "0.1.0", of the library that is linked.
std::string version();

}  // namespace posevote
