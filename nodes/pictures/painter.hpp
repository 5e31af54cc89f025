// SPDX-License-Identifier: BSD-3-Clause
// Draws clouds as shaded surfaces, seen from a scan's sensor.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

#include "nodes/data/cloud.hpp"
#include "nodes/pictures/canvas.hpp"

namespace posevote::pictures {

/// A pinhole camera: eye, axes, and the rectangle of the image plane that is shown.
struct Perspective {
  Eigen::Vector3f eye = Eigen::Vector3f::Zero();
  Eigen::Matrix3f axes = Eigen::Matrix3f::Identity();  ///< rows: right, down, forward
  float scale = 1;                                     ///< pixels per unit of x / z
  Eigen::Vector2f center = Eigen::Vector2f::Zero();    ///< shown in the middle, x / z and y / z
  int width = 1, height = 1;                           ///< of the picture [pixel]

  Eigen::Vector3f in_view(const Eigen::Vector3f& point) const { return axes * (point - eye); }
  /// Where a point of the view's frame lies in the picture [pixel].
  Eigen::Vector2f in_picture(const Eigen::Vector3f& seen) const {
    return (seen.head<2>() / seen.z() - center) * scale +
           0.5F * Eigen::Vector2f(static_cast<float>(width), static_cast<float>(height));
  }
};

/// From the scan's sensor toward the middle of the scan: all of it but outliers in the picture, and
/// all of `also` (points in the scan's frame).
Perspective perspective_of(const Cloud& scan, const PointMatrix& also, int width);

/// Distance between neighbouring points: of a sample of the points, the upper quartile of the
/// distance to the fourth neighbour [m]. `resolution`: about what to expect.
float spacing_of(const PointMatrix& points, float resolution);

class Painter {
 public:
  /// Frames the scan and the points `also`. The picture is drawn at twice its size, then halved.
  Painter(const Cloud& scan, const PointMatrix& also, int width, float resolution);

  /// Draws each point that faces the sensor as a disc large enough to close the surface. `nearer`
  /// [m] lets the cloud win over what lies at the same place.
  void draw(const Cloud& cloud, const Eigen::Isometry3f& pose, const Colour& colour, float nearer);
  /// The same of a cloud that has colours, each point in its own, as the camera saw it.
  void draw_in_colors(const Cloud& cloud);
  /// Draws the edge of what `draw` would cover, in front of all.
  void outline(const Cloud& cloud, const Eigen::Isometry3f& pose, const Colour& colour);

  /// Draws a dot of `radius` [pixel] at each point, in front of all; later ones over earlier ones.
  void dots(const PointMatrix& points, const std::vector<Colour>& colours, float radius);

  /// Notes words to stand at a place, or below it where others stand already: first come, first
  /// served.
  void label(const Eigen::Vector3f& where, const std::string& words, const Colour& colour);

  /// Throws std::runtime_error naming the file if it cannot be written.
  void save(const std::filesystem::path& png) const;

 private:
  /// `draw`(row, disc, normal in the view) of each point that faces the sensor.
  template <class Draw>
  void for_each_disc(const Cloud& cloud, const Eigen::Isometry3f& pose, const Draw& draw) const;

  struct Label {
    int x, y;
    std::string words;
    Colour colour;
  };

  Perspective view_;
  Canvas canvas_;
  float resolution_;
  std::vector<Label> labels_;
};

}  // namespace posevote::pictures
