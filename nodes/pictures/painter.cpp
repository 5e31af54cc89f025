// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pictures/painter.hpp"

#include <algorithm>
#include <cmath>

#include "nodes/color/srgb.hpp"
#include "nodes/geometry/grid.hpp"

namespace posevote::pictures {
namespace {

constexpr int kFiner = 2;  // the picture is drawn this many times larger
constexpr int kDot = 2;    // pixels to a dot of a letter
constexpr int kLine = 10 * kDot;
constexpr float kNearest = 1e-6F;  // in front of the sensor [m]

int text_width(const std::string& words) { return 6 * kDot * static_cast<int>(words.size()); }

float percentile(std::vector<float>& values, double share) {
  const auto at =
      values.begin() + static_cast<long>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Scans look along +z with y down (camera) or along -z with y up (graphics): the picture's upright
/// follows.
Eigen::Matrix3f axes_toward(Eigen::Vector3f forward) {
  if (!(forward.norm() > kNearest)) forward = Eigen::Vector3f::UnitZ();
  forward.normalize();
  const Eigen::Vector3f down(0, forward.z() >= 0 ? 1.0F : -1.0F, 0);
  Eigen::Vector3f right = down.cross(forward);
  if (!(right.norm() > 1e-3F)) right = Eigen::Vector3f::UnitX();
  right.normalize();
  Eigen::Matrix3f axes;
  axes << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  return axes;
}

/// Where points lie in the image plane.
struct Seen {
  std::vector<float> x, y;
};

Seen project(const Perspective& view, const PointMatrix& points) {
  Seen out;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Eigen::Vector3f seen = view.in_view(points.row(i));
    if (!seen.allFinite() || !(seen.z() > kNearest)) continue;
    out.x.push_back(seen.x() / seen.z());
    out.y.push_back(seen.y() / seen.z());
  }
  return out;
}

/// What to show of one axis: all values, but no more than 15 % beyond nearly all of them; and all
/// of `also`.
Eigen::Vector2f range_of(std::vector<float>& values, const std::vector<float>& also) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  Eigen::Vector2f range(*least, *most);
  const float low = percentile(values, 0.01), high = percentile(values, 0.99);
  const float beyond = 0.15F * (high - low);
  range = {std::max(range[0], low - beyond), std::min(range[1], high + beyond)};
  for (const float value : also) range = {std::min(range[0], value), std::max(range[1], value)};
  const float margin = std::max(0.03F * (range[1] - range[0]), 1e-6F);
  return {range[0] - margin, range[1] + margin};
}

/// Light from the upper left behind the sensor.
float shade(const Eigen::Vector3f& normal) {
  const Eigen::Vector3f light = Eigen::Vector3f(-0.4F, -0.6F, -1.0F).normalized();
  return 0.35F + 0.65F * std::max(0.0F, normal.dot(light));
}

Disc disc_of(const Perspective& view, const Eigen::Vector3f& seen, const Eigen::Vector3f& normal,
             float radius) {
  const Eigen::Vector2f at = view.in_picture(seen);
  Disc disc{at.x(), at.y(), seen.z(), 0, Eigen::Vector2f::Zero(), seen.z() / view.scale};
  disc.radius = radius / disc.pixel + 0.7F;
  disc.tilt = normal.head<2>() / std::max(0.2F, -normal.z());
  return disc;
}

}  // namespace

Perspective perspective_of(const Cloud& scan, const PointMatrix& also, int width) {
  Perspective view;
  view.width = view.height = width;
  view.eye = scan.view.origin;
  view.scale = static_cast<float>(width);
  if (scan.points.rows() == 0) return view;
  // Seen from the eye: far from the frame's origin the mean of the places themselves is inexact.
  const PointMatrix from_eye = scan.points.rowwise() - view.eye.transpose();
  view.axes = axes_toward(from_eye.colwise().mean().transpose());
  Seen seen = project(view, scan.points);
  if (seen.x.empty()) return view;
  const Seen more = project(view, also);
  const Eigen::Vector2f across = range_of(seen.x, more.x), along = range_of(seen.y, more.y);
  view.center = {across.mean(), along.mean()};
  // A very slender scan leaves room at its sides.
  const float wide = across[1] - across[0], high = along[1] - along[0];
  const float aspect = std::clamp(high / wide, 0.4F, 1.5F);
  view.height = static_cast<int>(aspect * static_cast<float>(width));
  view.scale = std::min(static_cast<float>(width) / wide, static_cast<float>(view.height) / high);
  return view;
}

float spacing_of(const PointMatrix& points, float resolution) {
  constexpr Eigen::Index kSample = 1000;
  constexpr std::size_t kNeighbour = 4;  // the point itself is number 0
  const float expected = std::max(1e-5F, resolution);
  const geometry::PointGrid grid(points, 2 * expected);
  std::vector<float> distances, near;
  const Eigen::Index count = std::min(points.rows(), kSample);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Vector3f point = points.row(i * points.rows() / count);
    near.clear();
    grid.for_each_within(point, 5 * expected,
                         [&](std::uint32_t, float squared) { near.push_back(squared); });
    if (near.size() <= kNeighbour) continue;
    std::nth_element(near.begin(), near.begin() + kNeighbour, near.end());
    distances.push_back(std::sqrt(near[kNeighbour]));
  }
  return distances.empty() ? expected : percentile(distances, 0.75);
}

Painter::Painter(const Cloud& scan, const PointMatrix& also, int width, float resolution)
    : view_(perspective_of(scan, also, kFiner * width)),
      canvas_(view_.width, view_.height, {0.98F, 0.98F, 0.98F}),
      resolution_(resolution) {}

template <class Draw>
void Painter::for_each_disc(const Cloud& cloud, const Eigen::Isometry3f& pose,
                            const Draw& draw) const {
  const float radius = 0.85F * spacing_of(cloud.points, resolution_);
  const bool has_normals = cloud.normals.rows() == cloud.points.rows();
  const Eigen::Matrix3f R_view_cloud = view_.axes * pose.linear();
  for (Eigen::Index i = 0; i < cloud.points.rows(); ++i) {
    const Eigen::Vector3f seen =
        view_.in_view(pose * Eigen::Vector3f(cloud.points.row(i).transpose()));
    if (!seen.allFinite() || !(seen.z() > kNearest)) continue;
    Eigen::Vector3f normal = -seen.normalized();  // where there is none
    if (has_normals && !cloud.normals.row(i).isZero())
      normal = R_view_cloud * cloud.normals.row(i).transpose();
    if (!(normal.dot(seen) <= 0)) continue;
    draw(i, disc_of(view_, seen, normal, radius), normal);
  }
}

void Painter::draw(const Cloud& cloud, const Eigen::Isometry3f& pose, const Colour& colour,
                   float nearer) {
  for_each_disc(cloud, pose, [&](Eigen::Index, Disc disc, const Eigen::Vector3f& normal) {
    disc.depth -= nearer;
    canvas_.draw(disc, shade(normal) * colour);
  });
}

void Painter::draw_in_colors(const Cloud& cloud) {
  for_each_disc(cloud, Eigen::Isometry3f::Identity(),
                [&](Eigen::Index i, const Disc& disc, const Eigen::Vector3f&) {
                  Colour colour;
                  for (int k = 0; k < 3; ++k)
                    colour[k] = static_cast<float>(color::byte_of(cloud.colors(i, k))) / 255;
                  canvas_.draw(disc, colour);
                });
}

void Painter::outline(const Cloud& cloud, const Eigen::Isometry3f& pose, const Colour& colour) {
  Canvas shape(view_.width, view_.height, Colour::Zero());
  for_each_disc(cloud, pose, [&](Eigen::Index, const Disc& disc, const Eigen::Vector3f&) {
    shape.draw(disc, Colour::Ones());
  });
  canvas_.outline(shape, 2 * kFiner, colour);
}

void Painter::dots(const PointMatrix& points, const std::vector<Colour>& colours, float radius) {
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Eigen::Vector3f seen = view_.in_view(points.row(i).transpose());
    if (!seen.allFinite() || !(seen.z() > kNearest)) continue;
    const Eigen::Vector2f at = view_.in_picture(seen);
    Disc dot{at.x(), at.y(), -static_cast<float>(i), kFiner * radius};
    canvas_.draw(dot, colours[static_cast<std::size_t>(i)]);
  }
}

void Painter::label(const Eigen::Vector3f& where, const std::string& words, const Colour& colour) {
  const Eigen::Vector3f seen = view_.in_view(where);
  if (!(seen.z() > kNearest)) return;
  const Eigen::Vector2f at = view_.in_picture(seen) / kFiner;
  if (!(at.cwiseAbs().maxCoeff() < 1e6F)) return;
  const int last_x = std::max(kDot, view_.width / kFiner - text_width(words));
  const int last_y = std::max(kDot, view_.height / kFiner - kLine);
  Label label{static_cast<int>(at.x()) - text_width(words) / 2, static_cast<int>(at.y()), words,
              colour.cwiseMax(0.45F)};
  label.x = std::clamp(label.x, kDot, last_x);
  label.y = std::clamp(label.y, kDot, last_y);
  const auto covered = [&](const Label& other) {
    return std::abs(other.y - label.y) < kLine && label.x < other.x + text_width(other.words) &&
           other.x < label.x + text_width(words);
  };
  while (label.y + kLine <= last_y && std::any_of(labels_.begin(), labels_.end(), covered))
    label.y += kLine / 2;
  labels_.push_back(std::move(label));
}

void Painter::save(const std::filesystem::path& png) const {
  Canvas picture = canvas_.halved();
  for (const Label& label : labels_)
    picture.text(label.x, label.y, kDot, label.words, label.colour);
  picture.save(png);
}

}  // namespace posevote::pictures
