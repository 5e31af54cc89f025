// SPDX-License-Identifier: BSD-3-Clause
// A picture of each scan with the found models in place: OUT/pictures/FRAME.png.
//
// Seen from the sensor: the scan in grey, each found instance in a colour of its own, with its name
// and score. Points are drawn as squares of about one voxel. Where there is no output folder, that
// is an error; a file that cannot be written fails the frame.
//
//   write_picture: {in: [scene_cloud, detections, library], width: 1280, every: 1}
#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "graph/registry.hpp"
#include "nodes/data/detections.hpp"
#include "nodes/data/model.hpp"
#include "nodes/write/canvas.hpp"

namespace posevote {
namespace {

struct Params {
  int width = 1280;
  int every = 1;
};

/// A pinhole view: eye, axes (right, down, forward) and the rectangle of the image plane it shows.
struct View {
  Eigen::Vector3f eye;
  Eigen::Matrix3f axes;  ///< rows: right, down, forward
  float scale = 1;       ///< [pixel]
  Eigen::Vector2f center = Eigen::Vector2f::Zero();

  Eigen::Vector3f in_view(const Eigen::Vector3f& point) const { return axes * (point - eye); }
};

float percentile(std::vector<float> values, double share) {
  const auto at =
      values.begin() + static_cast<long>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// From the sensor toward the middle of the scan. Scans look along +z with y down (camera) or along
/// -z with y up (graphics): the picture's upright follows.
View look_at(const Cloud& scan) {
  View view;
  view.eye = scan.viewpoint;
  const Eigen::Vector3f mean = scan.points.colwise().mean();
  Eigen::Vector3f forward = mean - view.eye;
  if (!(forward.norm() > 1e-6F)) forward = Eigen::Vector3f::UnitZ();
  forward.normalize();
  const Eigen::Vector3f down(0, forward.z() >= 0 ? 1.0F : -1.0F, 0);
  Eigen::Vector3f right = down.cross(forward);
  if (!(right.norm() > 1e-3F)) right = Eigen::Vector3f::UnitX();
  right.normalize();
  view.axes << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  return view;
}

/// Chooses the rectangle that shows all but the outermost points, and returns the picture's height.
int frame_scan(View& view, const Cloud& scan, int width) {
  std::vector<float> x;
  std::vector<float> y;
  for (Eigen::Index i = 0; i < scan.points.rows(); ++i) {
    const Eigen::Vector3f seen = view.in_view(scan.points.row(i));
    if (!(seen.z() > 1e-6F)) continue;
    x.push_back(seen.x() / seen.z());
    y.push_back(seen.y() / seen.z());
  }
  if (x.empty()) return width;
  const Eigen::Vector2f low(percentile(x, 0.002), percentile(y, 0.002));
  const Eigen::Vector2f high(percentile(x, 0.998), percentile(y, 0.998));
  const Eigen::Vector2f size = (high - low).cwiseMax(1e-6F) * 1.06F;
  view.center = 0.5F * (low + high);
  view.scale = static_cast<float>(width) / size.x();
  return static_cast<int>(std::clamp(view.scale * size.y(), 0.4F * static_cast<float>(width),
                                     1.5F * static_cast<float>(width)));
}

class Painter {
 public:
  Painter(const Cloud& scan, int width, float resolution)
      : view_(look_at(scan)),
        height_(frame_scan(view_, scan, width)),
        canvas_(width, height_, {0.98F, 0.98F, 0.98F}),
        resolution_(resolution) {}

  /// `nearer` [m] lets what is drawn win over what lies at the same place.
  void draw(const PointMatrix& points, const PointMatrix& normals, const Eigen::Isometry3f& pose,
            const Colour& colour, float nearer) {
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      const Eigen::Vector3f seen = view_.in_view(pose * Eigen::Vector3f(points.row(i).transpose()));
      const Eigen::Vector3f normal =
          view_.axes * (pose.linear() * Eigen::Vector3f(normals.row(i).transpose()));
      if (!(seen.z() > 1e-6F) || normal.dot(seen) > 0) continue;
      const Eigen::Vector2f at = on_canvas(seen);
      const int radius =
          static_cast<int>(std::lround(0.6F * resolution_ * view_.scale / seen.z())) + 1;
      canvas_.splat(at.x(), at.y(), seen.z() - nearer, std::min(radius, 12),
                    shade(normal) * colour);
    }
  }

  void label(const Eigen::Vector3f& where, const std::string& words, const Colour& colour) {
    const Eigen::Vector3f seen = view_.in_view(where);
    if (!(seen.z() > 1e-6F)) return;
    const Eigen::Vector2f at = on_canvas(seen);
    const int left = static_cast<int>(at.x()) - 6 * static_cast<int>(words.size());
    const int last = std::max(0, canvas_.width() - 12 * static_cast<int>(words.size()));
    canvas_.text(std::clamp(left, 2, last), std::clamp(static_cast<int>(at.y()), 2, height_ - 18),
                 2, words, colour.cwiseMax(0.45F));
  }

  void save(const std::filesystem::path& file) const { canvas_.save(file); }

 private:
  Eigen::Vector2f on_canvas(const Eigen::Vector3f& seen) const {
    return (seen.head<2>() / seen.z() - view_.center) * view_.scale +
           0.5F * Eigen::Vector2f(static_cast<float>(canvas_.width()), static_cast<float>(height_));
  }

  /// Light from the upper left behind the sensor.
  static float shade(const Eigen::Vector3f& normal) {
    const Eigen::Vector3f light = Eigen::Vector3f(-0.4F, -0.6F, -1.0F).normalized();
    return 0.35F + 0.65F * std::max(0.0F, normal.dot(light));
  }

  View view_;
  int height_;
  Canvas canvas_;
  float resolution_;
};

void write_picture(const Cloud& scan, const Detections& detections, const ModelLibrary& library,
                   const graph::FrameContext& context, const Params& params) {
  if (params.every == 0 || context.number % static_cast<std::uint64_t>(params.every) != 0) return;
  if (context.out.empty()) throw std::invalid_argument("there is no output folder to write to");
  Painter painter(scan, params.width, library.scale.resolution);
  painter.draw(scan.points, scan.normals, Eigen::Isometry3f::Identity(), {0.72F, 0.72F, 0.70F}, 0);
  for (std::size_t i = 0; i < detections.items.size(); ++i) {
    const Detection& found = detections.items[i];
    if (const Model* model = find_model(library, found.obj_id))
      painter.draw(model->cloud.points, model->cloud.normals, found.T_scene_model.cast<float>(),
                   distinct_colour(i), 3 * library.scale.resolution);
  }
  for (std::size_t i = 0; i < detections.items.size(); ++i) {
    const Detection& found = detections.items[i];
    char score[16];
    std::snprintf(score, sizeof score, " %.2f", found.score);
    if (const Model* model = find_model(library, found.obj_id))
      painter.label(found.T_scene_model.cast<float>() * model->center, found.model + score,
                    distinct_colour(i));
  }
  std::filesystem::create_directories(context.out / "pictures");
  painter.save(context.out / "pictures" / (context.name + ".png"));
}

const auto registered =
    graph::register_node("write_picture", write_picture,
                         "A picture of each scan with the found models in place.")
        .input("scan")
        .input("detections")
        .input("library")
        .param("width", &Params::width, "pixel", "Width of the picture.", graph::in_range(64, 8192))
        .param("every", &Params::every, "frames", "Only every n-th frame; 0: none.",
               graph::at_least(0));

}  // namespace
}  // namespace posevote
