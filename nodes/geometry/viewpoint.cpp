// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/viewpoint.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "nodes/geometry/normals.hpp"
#include "nodes/geometry/range_view.hpp"

namespace posevote::geometry {
namespace {

/// All rows of n, or `most` of them in no order that a scan's rows and columns could share.
std::vector<Eigen::Index> some_rows(Eigen::Index n, Eigen::Index most) {
  constexpr Eigen::Index kScatter = 2654435761;  // a prime: multiples modulo n leave no pattern
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < std::min(n, most); ++i)
    rows.push_back(n <= most ? i : i * kScatter % n);
  return rows;
}

float radius_of(const PointMatrix& points, const Eigen::Vector3f& middle) {
  return std::sqrt((points.rowwise() - middle.transpose()).rowwise().squaredNorm().mean());
}

/// Some of the points that have a normal.
struct Oriented {
  PointMatrix points, normals;

  Oriented(const Mesh& scan, Eigen::Index most) {
    std::vector<Eigen::Index> rows;
    if (scan.normals.rows() == scan.points.rows()) rows = some_rows(scan.points.rows(), most);
    const std::size_t asked = rows.size();
    std::erase_if(rows, [&scan](Eigen::Index i) { return scan.normals.row(i).isZero(); });
    if (2 * rows.size() < asked) rows.clear();
    points = scan.points(rows, Eigen::all);
    normals = scan.normals(rows, Eigen::all);
  }
  double share_facing(const Eigen::Vector3f& place) const {
    Eigen::Index facing = 0;
    for (Eigen::Index i = 0; i < points.rows(); ++i)
      if (normals.row(i).dot(place.transpose() - points.row(i)) > 0) ++facing;
    return static_cast<double>(facing) / static_cast<double>(points.rows());
  }
};

/// Direction i of n, evenly over the sphere.
Eigen::Vector3f direction(int i, int n) {
  const double z = 1 - (2.0 * i + 1) / n, around = 2.399963 * i;  // the golden angle
  const double r = std::sqrt(1 - z * z);
  return Eigen::Vector3d(r * std::cos(around), r * std::sin(around), z).cast<float>();
}

/// A place that was tried: its direction from the middle of the scan, how far, and what faces it.
struct Trial {
  Eigen::Vector3f towards;
  float distance;  ///< x radius of the scan
  double share;
};

std::vector<Trial> try_places(const Oriented& scan, const Eigen::Vector3f& middle, float radius) {
  constexpr int kDirections = 1000;
  std::vector<Trial> trials;
  for (int i = 0; i < kDirections; ++i)
    for (const float distance : {1.5F, 2.5F, 4.0F, 7.0F, 12.0F}) {
      const Eigen::Vector3f towards = direction(i, kDirections);
      trials.push_back(
          {towards, distance, scan.share_facing(middle + distance * radius * towards)});
    }
  return trials;
}

}  // namespace

std::optional<double> share_facing(const Mesh& scan, const Eigen::Vector3f& place) {
  const Oriented oriented(scan, 20000);
  if (oriented.points.rows() == 0) return std::nullopt;
  return oriented.share_facing(place);
}

bool lies_before(const PointMatrix& points, const Eigen::Vector3f& place) {
  constexpr double kLeastMeanCosine = 0.5;  // of the rays to their mean; as ViewTerms
  constexpr double kStrays = 0.01;          // at either end of each axis
  const PointMatrix some = points(some_rows(points.rows(), 10000), Eigen::all);
  bool is_inside = true;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<float> at(some.col(axis).begin(), some.col(axis).end());
    std::sort(at.begin(), at.end());
    const auto out = static_cast<std::size_t>(kStrays * static_cast<double>(at.size()));
    is_inside = is_inside && place[axis] > at[out] && place[axis] < at[at.size() - 1 - out];
  }
  Eigen::Vector3d rays = Eigen::Vector3d::Zero();
  for (const auto& point : some.rowwise())
    rays += (point.transpose() - place).normalized().cast<double>();  // 0 where the point is
  return !is_inside && rays.norm() >= kLeastMeanCosine * static_cast<double>(some.rows());
}

double share_hidden(const Mesh& scan, const Eigen::Vector3f& place) {
  constexpr float kBehind = 10;  // x spacing; less is the slope of one surface, or an edge
  Cloud cloud{scan.points, scan.normals, {}};
  cloud.view.origin = place;
  turn_toward(place, cloud.points, cloud.normals);
  const Eigen::Vector3f middle = scan.points.colwise().mean().transpose();
  const float spacing =
      2.5F * radius_of(scan.points, middle) /
      std::sqrt(static_cast<float>(std::max<Eigen::Index>(1, scan.points.rows())));
  const RangeView view(cloud, spacing);
  if (!view.usable()) return 1;
  Eigen::Index hidden = 0;
  for (Eigen::Index i = 0; i < scan.points.rows(); ++i) {
    const float before = view.measured_range(scan.points.row(i));
    const float range = (scan.points.row(i).transpose() - place).norm();
    if (before > 0 && range > before + kBehind * spacing) ++hidden;
  }
  return static_cast<double>(hidden) / static_cast<double>(scan.points.rows());
}

Eigen::Vector3f estimate_viewpoint(const Mesh& scan) {
  constexpr double kAsGood = 0.01;  // shares that differ by less do not tell places apart
  const Oriented oriented(scan, 1000);
  const Eigen::Vector3f middle = oriented.points.colwise().mean().transpose();
  const float radius =
      std::sqrt((oriented.points.rowwise() - middle.transpose()).rowwise().squaredNorm().mean());
  const std::vector<Trial> trials = try_places(oriented, middle, radius);
  const auto best =
      std::max_element(trials.begin(), trials.end(),
                       [](const Trial& a, const Trial& b) { return a.share < b.share; });
  Eigen::Vector3f towards = Eigen::Vector3f::Zero();
  float log_distance = 0, count = 0;
  for (const Trial& trial : trials) {
    if (trial.share < best->share - kAsGood) continue;
    towards += trial.towards;
    log_distance += std::log(trial.distance);
    ++count;
  }
  const Eigen::Vector3f between =
      middle + std::exp(log_distance / count) * radius * towards.normalized();
  const bool is_good = oriented.share_facing(between) >= best->share - 2 * kAsGood;
  return is_good ? between : middle + best->distance * radius * best->towards;
}

}  // namespace posevote::geometry
