// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/raw_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

#include "nodes/color/srgb.hpp"

namespace posevote::formats {
namespace {

constexpr std::uint32_t kGone = std::numeric_limits<std::uint32_t>::max();

/// To float; what a float cannot hold becomes infinite.
Eigen::RowVector3f scaled(const Triple& v, double scale) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  Eigen::RowVector3f out;
  for (int i = 0; i < 3; ++i) {
    const double value = v[static_cast<std::size_t>(i)] * scale;
    out[i] = std::abs(value) > kLargest ? std::numeric_limits<float>::infinity()
                                        : static_cast<float>(value);
  }
  return out;
}

/// Normals of real files may have any length (areas of faces, say): only the direction counts.
Eigen::RowVector3f direction(const Triple& v) {
  constexpr double kNoDirection = 1e-12;
  const Eigen::RowVector3d normal(v[0], v[1], v[2]);
  const double length = normal.norm();
  if (!std::isfinite(length) || length < kNoDirection) return Eigen::RowVector3f::Zero();
  return (normal / length).cast<float>();
}

/// New index of every point, kGone where it is not finite; compacts the points.
std::vector<std::uint32_t> keep_finite(PointMatrix& points) {
  std::vector<std::uint32_t> new_index(static_cast<std::size_t>(points.rows()), kGone);
  Eigen::Index kept = 0;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    if (!points.row(i).allFinite()) continue;
    points.row(kept) = points.row(i).eval();
    new_index[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(kept++);
  }
  points.conservativeResize(kept, 3);
  return new_index;
}

FaceMatrix keep_faces(const RawMesh& mesh, const std::vector<std::uint32_t>& new_index) {
  FaceMatrix faces(static_cast<Eigen::Index>(mesh.faces.size()), 3);
  Eigen::Index kept = 0;
  for (const auto& face : mesh.faces) {
    const Eigen::Matrix<std::uint32_t, 1, 3> corners(new_index[face[0]], new_index[face[1]],
                                                     new_index[face[2]]);
    if ((corners.array() != kGone).all()) faces.row(kept++) = corners;
  }
  faces.conservativeResize(kept, 3);
  return faces;
}

/// Colours and texture of the points that are left.
void keep_colors(const RawMesh& mesh, const std::vector<std::uint32_t>& new_index, Scan& scan) {
  if (!mesh.texture.images.empty()) {
    Texture texture{mesh.texture.images, {}, std::vector<std::uint32_t>(scan.points.rows())};
    texture.places.resize(scan.points.rows(), 2);
    for (std::size_t i = 0; i < new_index.size(); ++i) {
      if (new_index[i] == kGone) continue;
      texture.places.row(new_index[i]) = mesh.texture.places.row(static_cast<Eigen::Index>(i));
      texture.image_of[new_index[i]] = mesh.texture.image_of[i];
    }
    scan.texture = std::make_shared<const Texture>(std::move(texture));
    return;
  }
  if (mesh.colors.empty()) return;
  scan.colors.resize(scan.points.rows(), 3);
  for (std::size_t i = 0; i < mesh.colors.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (new_index[i] != kGone)
        scan.colors(new_index[i], static_cast<Eigen::Index>(k)) =
            color::linear_of(mesh.colors[i][k]);
}

}  // namespace

void RawMesh::add_polygon(std::span<const std::uint32_t> corners) {
  if (corners.size() > 3) fans.push_back({faces.size(), corners.size() - 2});
  for (std::size_t i = 2; i < corners.size(); ++i)
    faces.push_back({corners[0], corners[i - 1], corners[i]});
}

void RawMesh::add_polygon(std::span<const std::uint32_t> corners,
                          std::span<const std::uint32_t> places, std::uint32_t material) {
  add_polygon(corners);
  for (std::size_t i = 2; i < corners.size(); ++i) {
    paint.corners.push_back({places[0], places[i - 1], places[i]});
    paint.material_of.push_back(material);
  }
}

void RawMesh::settle_colors() {
  if (colors.empty()) return;
  if (colors.size() != points.size()) {
    color_doubt = std::to_string(colors.size()) + " of " + std::to_string(points.size()) +
                  " points have a colour";
    colors.clear();
  }
  const bool are_bytes = std::any_of(colors.begin(), colors.end(), [](const Triple& color) {
    return std::any_of(color.begin(), color.end(), [](double value) { return value > 1; });
  });
  if (!are_bytes) return;
  for (Triple& color : colors)
    for (double& value : color) value /= 255;
}

Scan to_scan(const RawMesh& mesh, double metres_per_unit) {
  const std::size_t count = mesh.points.size();
  if (count == 0) throw std::runtime_error("there are no points in the file");
  Scan scan;
  scan.points.resize(static_cast<Eigen::Index>(count), 3);
  for (std::size_t i = 0; i < count; ++i)
    scan.points.row(static_cast<Eigen::Index>(i)) = scaled(mesh.points[i], metres_per_unit);
  const std::vector<std::uint32_t> new_index = keep_finite(scan.points);
  if (scan.points.rows() == 0)
    throw std::runtime_error("all " + std::to_string(count) + " points are NaN or infinite");
  if (!mesh.normals.empty()) scan.normals.resize(scan.points.rows(), 3);
  for (std::size_t i = 0; i < mesh.normals.size(); ++i)
    if (new_index[i] != kGone) scan.normals.row(new_index[i]) = direction(mesh.normals[i]);
  keep_colors(mesh, new_index, scan);
  scan.faces = keep_faces(mesh, new_index);
  scan.view.origin = scaled(mesh.viewpoint, metres_per_unit).transpose();
  if (!scan.view.origin.allFinite()) throw std::runtime_error("the viewpoint is NaN or infinite");
  return scan;
}

void check_room(std::uint64_t count, const std::string& what, std::uint64_t size,
                std::uint64_t room) {
  if (size == 0 || count <= room / size) return;
  throw std::runtime_error("claims " + std::to_string(count) + " " + what +
                           ", the file has room for at most " + std::to_string(room / size));
}

std::string index_problem(double index, std::uint64_t vertices) {
  const bool whole = index == std::floor(index) && std::abs(index) < 1e15;
  if (whole && index >= 0 && index < static_cast<double>(vertices)) return "";
  return "a face refers to vertex " +
         (whole ? std::to_string(static_cast<std::int64_t>(index)) : std::to_string(index)) +
         ", expected 0 to " + std::to_string(vertices) + " exclusive";
}

}  // namespace posevote::formats
