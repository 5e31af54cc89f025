// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/face_samples.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "nodes/geometry/normals.hpp"
#include "nodes/geometry/weld.hpp"

namespace posevote::geometry {
namespace {

using Eigen::RowVector3d;
using Corners = std::array<RowVector3d, 3>;

RowVector3d point_of(const PointMatrix& points, const FaceMatrix& faces, Eigen::Index face,
                     int corner) {
  return points.row(faces(face, corner)).cast<double>();
}

/// Normals of twice the faces' areas.
std::vector<RowVector3d> double_areas(const PointMatrix& points, const FaceMatrix& faces) {
  std::vector<RowVector3d> normals;
  normals.reserve(static_cast<std::size_t>(faces.rows()));
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const RowVector3d a = point_of(points, faces, f, 0);
    normals.emplace_back(
        (point_of(points, faces, f, 1) - a).cross(point_of(points, faces, f, 2) - a));
  }
  return normals;
}

/// The normals at the corners of each face.
class CornerNormals {
 public:
  CornerNormals(const PointMatrix& points, const FaceMatrix& faces,
                const std::vector<RowVector3d>& areas, double crease)
      : faces_(faces), areas_(areas), least_cosine_(std::cos(crease)), smooth_(crease > 0) {
    if (!smooth_) return;
    place_ = weld(points);
    starts_.assign(static_cast<std::size_t>(points.rows()) + 1, 0);
    for (Eigen::Index i = 0; i < faces.size(); ++i) ++starts_[place_[faces.data()[i]] + 1];
    for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    around_.resize(static_cast<std::size_t>(faces.size()));
    std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
      for (int corner = 0; corner < 3; ++corner)
        around_[next[place_[faces(f, corner)]]++] = static_cast<std::uint32_t>(f);
  }

  Corners of(std::uint32_t face) const {
    const RowVector3d own = areas_[face].normalized();
    Corners normals{own, own, own};
    if (!smooth_) return normals;
    for (int corner = 0; corner < 3; ++corner) {
      RowVector3d sum = RowVector3d::Zero();
      const std::uint32_t place = place_[faces_(face, corner)];
      for (std::size_t i = starts_[place]; i < starts_[place + 1]; ++i) {
        const RowVector3d& other = areas_[around_[i]];
        if (other.dot(own) >= least_cosine_ * other.norm()) sum += other;
      }
      if (sum.dot(own) > 0) normals[static_cast<std::size_t>(corner)] = sum.normalized();
    }
    return normals;
  }

 private:
  const FaceMatrix& faces_;
  const std::vector<RowVector3d>& areas_;
  const double least_cosine_;
  const bool smooth_;
  std::vector<std::uint32_t> place_;   ///< of each point: the first one in the same place
  std::vector<std::size_t> starts_;    ///< into around_, by place
  std::vector<std::uint32_t> around_;  ///< the faces there
};

/// The i-th point of the R2 sequence, folded into a triangle: weights of its corners.
std::array<double, 3> weights_of(std::size_t i) {
  constexpr double kPlastic = 1.32471795724474602596;
  const auto part = [i](double step) {
    const double at = 0.5 + step * static_cast<double>(i + 1);
    return at - std::floor(at);
  };
  double u = part(1 / kPlastic), v = part(1 / (kPlastic * kPlastic));
  if (u + v > 1) u = 1 - u, v = 1 - v;
  return {1 - u - v, u, v};
}

std::size_t count_samples(double area, double spacing, std::size_t most) {
  const double wanted = std::ceil(area / (spacing * spacing));
  return wanted < static_cast<double>(most) ? std::max<std::size_t>(1, std::size_t(wanted)) : most;
}

}  // namespace

FaceSamples sample_faces(const PointMatrix& points, const FaceMatrix& faces, double spacing,
                         double crease, std::size_t most) {
  check_faces(points, faces);
  const std::vector<RowVector3d> areas = double_areas(points, faces);
  double total = 0;
  for (const RowVector3d& area : areas) total += 0.5 * area.norm();
  if (!(total > 0) || !std::isfinite(total))
    throw std::runtime_error("its " + std::to_string(faces.rows()) + " faces have no area");
  const CornerNormals corner_normals(points, faces, areas, crease);
  const std::size_t count = count_samples(total, spacing, most);
  FaceSamples samples{PointMatrix(count, 3), PointMatrix(count, 3), {}, PointMatrix(count, 3)};
  samples.faces.reserve(count);
  double passed = 0;
  std::size_t done = 0;
  for (std::uint32_t f = 0; f < areas.size(); ++f) {
    passed += 0.5 * areas[f].norm();
    const double due = std::floor(passed / total * static_cast<double>(count) + 0.5);
    const std::size_t until = std::min(count, static_cast<std::size_t>(due));
    if (until <= done) continue;
    const Corners normals = corner_normals.of(f);
    for (; done < until; ++done) {
      const std::array<double, 3> weights = weights_of(done);
      RowVector3d point = RowVector3d::Zero(), normal = RowVector3d::Zero();
      for (int corner = 0; corner < 3; ++corner) {
        const auto c = static_cast<std::size_t>(corner);
        point += weights[c] * point_of(points, faces, f, corner);
        normal += weights[c] * normals[c];
      }
      const auto row = static_cast<Eigen::Index>(done);
      samples.points.row(row) = point.cast<float>();
      samples.normals.row(row) = normal.normalized().cast<float>();
      samples.faces.push_back(f);
      for (int corner = 0; corner < 3; ++corner)
        samples.weights(row, corner) =
            static_cast<float>(weights[static_cast<std::size_t>(corner)]);
    }
  }
  return samples;
}

}  // namespace posevote::geometry
