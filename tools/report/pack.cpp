// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/pack.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <stdexcept>

#include "nodes/geometry/extent.hpp"
#include "nodes/geometry/normals.hpp"
#include "nodes/geometry/voxels.hpp"

namespace posevote::page {
namespace {

constexpr std::size_t kMostPoints = 65536;  // that 16 bits can number
constexpr float kSteps = 65535;

void put(std::string& bytes, std::uint32_t value) {
  bytes += static_cast<char>(value & 0xFFU);
  bytes += static_cast<char>(value >> 8U & 0xFFU);
}

Packed pack_places(const PointMatrix& points) {
  Packed packed;
  packed.points = static_cast<std::size_t>(points.rows());
  if (points.rows() == 0) return packed;
  packed.corner = points.colwise().minCoeff().transpose();
  const Eigen::Vector3f extent = points.colwise().maxCoeff().transpose() - packed.corner;
  packed.step = std::max(extent.maxCoeff() / kSteps, 1e-9F);
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const float place = (points(i, axis) - packed.corner(axis)) / packed.step;
      put(packed.bytes, static_cast<std::uint32_t>(std::clamp(std::round(place), 0.0F, kSteps)));
    }
  return packed;
}

PointMatrix select(const PointMatrix& points, const std::vector<std::uint32_t>& rows) {
  PointMatrix chosen(std::ssize(rows), 3);
  for (std::size_t i = 0; i < rows.size(); ++i)
    chosen.row(static_cast<Eigen::Index>(i)) = points.row(rows[i]);
  return chosen;
}

/// Of many points some, spread by chance (a multiplicative hash), in their order: no more than it
/// takes to see the shape.
std::vector<std::uint32_t> finite_rows(const PointMatrix& points, std::size_t most) {
  const double share = static_cast<double>(most) / static_cast<double>(points.rows());
  std::vector<std::uint32_t> rows;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const auto chance = static_cast<double>(static_cast<std::uint32_t>(i) * 2654435769U);
    if (points.row(i).allFinite() && chance < share * 4294967296.0)
      rows.push_back(static_cast<std::uint32_t>(i));
  }
  return rows;
}

/// The faces of a mesh whose points have been joined.
FaceMatrix join(const FaceMatrix& faces, const geometry::Voxels& groups, Eigen::Index points) {
  std::vector<std::uint32_t> group(static_cast<std::size_t>(points));
  for (std::size_t v = 0; v < groups.size(); ++v)
    for (const std::uint32_t i : groups[v]) group[i] = static_cast<std::uint32_t>(v);
  std::set<std::array<std::uint32_t, 3>> kept;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    std::array<std::uint32_t, 3> face{group[faces(f, 0)], group[faces(f, 1)], group[faces(f, 2)]};
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    kept.insert(face);
  }
  FaceMatrix joined(std::ssize(kept), 3);
  Eigen::Index row = 0;
  for (const auto& face : kept) joined.row(row++) << face[0], face[1], face[2];
  return joined;
}

}  // namespace

Packed pack_points(const PointMatrix& points, const std::vector<std::uint8_t>& values) {
  if (values.size() != static_cast<std::size_t>(points.rows()))
    throw std::invalid_argument("expected one value a point");
  Packed packed = pack_places(points);
  packed.bytes.append(values.begin(), values.end());
  return packed;
}

Packed pack_mesh(const PointMatrix& points, const FaceMatrix& faces) {
  if (points.rows() > static_cast<Eigen::Index>(kMostPoints))
    throw std::invalid_argument("expected at most 65536 points, not " +
                                std::to_string(points.rows()));
  Packed packed = pack_places(points);
  packed.faces = static_cast<std::size_t>(faces.rows());
  for (Eigen::Index f = 0; f < faces.rows(); ++f)
    for (Eigen::Index corner = 0; corner < 3; ++corner) put(packed.bytes, faces(f, corner));
  return packed;
}

Thinned thin(const PointMatrix& points, std::size_t most) {
  constexpr std::size_t kEnough = 16;  // points for each that is kept
  constexpr int kRounds = 8;
  Thinned thinned{finite_rows(points, kEnough * std::max<std::size_t>(most, 1)), 0};
  if (thinned.rows.empty() || most == 0) return {};
  const PointMatrix all = select(points, thinned.rows);
  const auto wanted = static_cast<double>(most);
  thinned.spacing = static_cast<float>(geometry::robust_diagonal(all, 0.02) /
                                       std::sqrt(std::min<double>(wanted, double(all.rows()))));
  if (thinned.rows.size() <= most || !(thinned.spacing > 0)) {
    thinned.rows.resize(std::min(thinned.rows.size(), most));
    return thinned;
  }
  geometry::Voxels cubes;
  for (int round = 0; round < kRounds; ++round) {
    cubes = geometry::group_by_voxel(all, thinned.spacing);
    const double filled = static_cast<double>(cubes.size()) / wanted;
    if (filled <= 1 && filled > 0.9) break;
    if (round + 1 < kRounds) thinned.spacing *= static_cast<float>(std::sqrt(filled / 0.95));
  }
  std::vector<std::uint32_t> rows;
  for (std::size_t v = 0; v < cubes.size(); ++v) rows.push_back(thinned.rows[cubes[v].front()]);
  for (std::size_t i = 0; i < most && rows.size() > most; ++i)
    rows[i] = rows[i * rows.size() / most];
  rows.resize(std::min(rows.size(), most));
  std::sort(rows.begin(), rows.end());
  thinned.rows = std::move(rows);
  return thinned;
}

Mesh simplify(const Mesh& mesh, std::size_t most) {
  if (mesh.faces.rows() == 0) return {select(mesh.points, thin(mesh.points, most).rows), {}, {}};
  geometry::check_faces(mesh.points, mesh.faces);
  Mesh simple{mesh.points, PointMatrix(0, 3), mesh.faces};
  const auto fits = [&] {
    return simple.faces.rows() <= static_cast<Eigen::Index>(most) &&
           simple.points.rows() <= static_cast<Eigen::Index>(kMostPoints);
  };
  const auto count = static_cast<double>(std::max<std::size_t>(most, 1));
  auto leaf = static_cast<float>(geometry::model_diagonal(mesh.points) / (2 * std::sqrt(count)));
  while (!fits()) {
    const geometry::Voxels groups = geometry::group_by_voxel(mesh.points, leaf);
    simple = {groups.centroids(mesh.points), PointMatrix(0, 3),
              join(mesh.faces, groups, mesh.points.rows())};
    leaf *= 1.2F;
  }
  return simple;
}

}  // namespace posevote::page
