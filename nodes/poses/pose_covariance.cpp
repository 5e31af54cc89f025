// SPDX-License-Identifier: BSD-3-Clause
// Least squares say: covariance = variance of a residual / information, where the information sums
// w j j' over ICP's pairs, j being what a pair's distance to the plane changes by. Three things are
// mended. (1) Normals err, and what errs at random seems to hold what slides: so one j takes the
// model's normal, the other the scan's, whose errors have nothing to do with each other. (2) A model
// point takes the nearest of the scan's points, which where noise is thicker than they are apart is
// one that errs little: so the noise is measured from the scan's points, too, each of them. (3) The
// residuals are not independent: several model points share a point of the scan, normals are made
// of neighbours, some sensors err alike over whole patches. How many of them count for one the
// residuals tell themselves: summed by patches (cluster-robust variance: Liang, Zeger, Biometrika
// 1986), they would cancel if they were independent. What patches cannot tell is one factor, and
// what does not average out at all one floor, both fitted on simulated scans.
#include "nodes/poses/pose_covariance.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "nodes/geometry/icp_pairs.hpp"
#include "nodes/geometry/nearest_index.hpp"
#include "nodes/geometry/plane_fit.hpp"
#include "nodes/geometry/rows_that.hpp"

namespace posevote::poses {
namespace {

using geometry::Matrix6d;
using geometry::Vector6d;

constexpr double kExact = 1e-3;  // x resolution: no scan errs less, so that none has no covariance

/// A pair, seen from the model's centre, with turns in units of the lever.
struct Row {
  Eigen::Vector3d place;  ///< from the centre [m]
  Vector6d j;             ///< by (lever x turn, shift), along the model's normal
  Vector6d k;             ///< along the scan's
  double residual = 0;    ///< [m]
  double weight = 0;
};

std::vector<Row> rows_of(const std::vector<geometry::IcpPair>& pairs, const Model& model,
                         const Eigen::Matrix3d& R_scene_model, double lever) {
  std::vector<Row> rows;
  for (const geometry::IcpPair& pair : pairs) {
    Row row;
    row.place = (model.cloud.points.row(pair.row).transpose() - model.center).cast<double>();
    const Eigen::Vector3d of_model = model.cloud.normals.row(pair.row).transpose().cast<double>();
    const Eigen::Vector3d of_scan = R_scene_model.transpose() * pair.normal;
    row.j << row.place.cross(of_model) / lever, of_model;
    row.k << row.place.cross(of_scan) / lever, of_scan;
    row.residual = pair.residual;
    row.weight = pair.weight;
    rows.push_back(row);
  }
  return rows;
}

Matrix6d information_of(const std::vector<Row>& rows) {
  Matrix6d sum = Matrix6d::Zero();
  for (const Row& row : rows) sum += row.weight * row.j * row.k.transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver((sum + sum.transpose()) / 2);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).asDiagonal() *
         solver.eigenvectors().transpose();
}

/// The normal equations, with what they hold least held a little.
Eigen::LDLT<Matrix6d> normal_equations(const std::vector<Row>& rows) {
  constexpr double kLittle = 1e-4;  // of the weight
  Matrix6d sum = Matrix6d::Zero();
  for (const Row& row : rows)
    sum += row.weight * (row.j * row.j.transpose() + kLittle * Matrix6d::Identity());
  return Eigen::LDLT<Matrix6d>(sum);
}

/// Of a residual [m^2], as their sums over cubes of that edge [m] vary: more than variance_of, where
/// neighbours err alike.
double patch_variance(const std::vector<Row>& rows, const Eigen::LDLT<Matrix6d>& equations,
                      double edge, double offset) {
  std::map<std::tuple<int, int, int>, Vector6d> sums;  // ordered: the same bytes each time
  for (const Row& row : rows) {
    const Eigen::Vector3d cell = (row.place / edge).array() + offset;
    const auto [sum, is_new] = sums.try_emplace(
        {static_cast<int>(std::floor(cell.x())), static_cast<int>(std::floor(cell.y())),
         static_cast<int>(std::floor(cell.z()))},
        Vector6d::Zero());
    sum->second += row.weight * row.residual * row.j;
  }
  double squares = 0;
  for (const auto& [cell, sum] : sums) squares += sum.dot(equations.solve(sum));
  return squares / 6;
}

/// How far the scan's points lie off the posed model: a standard deviation, by the median, which a
/// neighbour's points do not move [m]. Those count that lie above or below a paired model point.
double noise_of(const Sought& sought, const std::vector<geometry::IcpPair>& pairs,
                const Eigen::Isometry3d& T_scene_model) {
  const Model& model = sought.model;
  PointMatrix points(static_cast<Eigen::Index>(pairs.size()), 3);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    points.row(static_cast<Eigen::Index>(i)) = pairs[i].point.cast<float>().transpose();
  const float reach = sought.params.tolerance;
  const geometry::NearestIndex index(points, reach);
  const Eigen::Vector3f center = (T_scene_model * model.center.cast<double>()).cast<float>();
  const float radius = model.diagonal / 2 + reach;
  const Eigen::Matrix3d R_scene_model = T_scene_model.linear();
  const auto height_of = [&](const Eigen::Vector3f& point) -> std::optional<double> {
    if (!((point - center).squaredNorm() < radius * radius)) return std::nullopt;
    const geometry::NearestPoint nearest = index.nearest(point, reach);
    if (!nearest) return std::nullopt;
    const geometry::IcpPair& pair = pairs[nearest.index];
    const Eigen::Vector3d normal =
        R_scene_model * model.cloud.normals.row(pair.row).transpose().cast<double>();
    const Eigen::Vector3d offset = point.cast<double>() - pair.point;
    const double height = offset.dot(normal);
    if (!((offset - height * normal).norm() < static_cast<double>(model.resolution)))
      return std::nullopt;
    return std::abs(height);
  };
  const PointMatrix& scan = sought.scan.cloud.points;
  const auto of_range = [&](std::size_t begin, std::size_t end) {
    std::vector<double> heights;
    for (std::size_t i = begin; i < end; ++i)
      if (const auto height = height_of(scan.row(static_cast<Eigen::Index>(i)).transpose()))
        heights.push_back(*height);
    return heights;
  };
  std::vector<double> off =
      geometry::joined_ranges(static_cast<std::size_t>(scan.rows()), of_range, 1024);
  if (off.empty()) return 0;
  const auto middle = off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2);
  std::nth_element(off.begin(), middle, off.end());
  return geometry::kDeviationOfMedian * *middle;
}

/// From (lever x turn, shift) of the centre to (shift, turn in rad) of the model's origin.
Matrix6d about_origin(const Matrix6d& covariance, const Eigen::Vector3d& center, double lever) {
  Matrix6d A = Matrix6d::Zero();
  A.bottomLeftCorner<3, 3>() = Eigen::Matrix3d::Identity() / lever;
  A.topRightCorner<3, 3>().setIdentity();
  for (int i = 0; i < 3; ++i)  // shift of the origin = shift of the centre - turn x centre
    A.block<3, 1>(0, i) = -Eigen::Vector3d::Unit(i).cross(center) / lever;
  const Matrix6d moved = A * covariance * A.transpose();
  return (moved + moved.transpose()) / 2;
}

}  // namespace

std::optional<Matrix6d> pose_covariance(const Sought& sought,
                                        const Eigen::Isometry3d& T_scene_model) {
  const CovarianceTerms& terms = sought.terms.covariance;
  const Model& model = sought.model;
  const auto diagonal = static_cast<double>(model.diagonal);
  const double lever = diagonal / 4;
  if (!sought.params.refine || !(lever > 0)) return std::nullopt;
  const std::vector<geometry::IcpPair> pairs =
      geometry::find_icp_pairs(model.cloud, sought.scan.surface, T_scene_model.cast<float>(),
                               sought.params.tolerance, sought.terms.refinement.polish_points);
  const std::vector<Row> rows = rows_of(pairs, model, T_scene_model.linear(), lever);
  if (rows.size() < static_cast<std::size_t>(sought.terms.icp.fewest_pairs)) return std::nullopt;
  const Eigen::LDLT<Matrix6d> equations = normal_equations(rows);
  const double edge = terms.patch * diagonal;
  const double plain = geometry::variance_of(rows);
  const double patches =
      (patch_variance(rows, equations, edge, 0) + patch_variance(rows, equations, edge, 0.5)) / 2;
  const double noise = noise_of(sought, pairs, T_scene_model);
  const double exact = kExact * static_cast<double>(model.resolution);
  const double point = std::max({plain, noise * noise, exact * exact});  // variance of one
  const double alike = plain > 0 ? std::max(1.0, patches / plain) : 1;   // count for one
  const double variance = terms.inflation * point * alike;
  if (!(variance > 0) || !std::isfinite(variance)) return std::nullopt;
  Matrix6d all = information_of(rows) / variance;
  all.diagonal().head<3>().array() += 1 / (terms.any_turn * lever * terms.any_turn * lever);
  all.diagonal().tail<3>().array() += 1 / (terms.any_shift * diagonal * terms.any_shift * diagonal);
  Matrix6d covariance = all.ldlt().solve(Matrix6d::Identity());
  covariance.diagonal().array() += terms.floor * terms.floor * point;
  if (!covariance.allFinite()) return std::nullopt;
  return about_origin(covariance, model.center.cast<double>(), lever);
}

}  // namespace posevote::poses
