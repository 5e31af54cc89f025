// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/match/principal_axes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "nodes/match/descriptor_kernels.hpp"

namespace posevote {
namespace {

constexpr double kRest = 0.04;  // of the variance, that the kept axes may leave
// Their axes take too long to find, and point nowhere in particular (USC, 3DSC).
constexpr Eigen::Index kLongest = 512;
constexpr Eigen::Index kSample = 2000;  // rows that show the distribution

Eigen::MatrixXd sample_of(const DescriptorMatrix& rows) {
  const Eigen::Index count = std::min(rows.rows(), kSample);
  Eigen::MatrixXd sample(count, rows.cols());
  for (Eigen::Index i = 0; i < count; ++i)
    sample.row(i) = rows.row(i * rows.rows() / count).cast<double>();
  return sample;
}

/// How many of the axes, whose variances ascend, are to be kept.
Eigen::Index kept(const Eigen::VectorXd& variances) {
  double rest = variances.sum();
  const double most = kRest * rest;
  Eigen::Index count = 0;
  while (rest > most && count < variances.size()) rest -= variances[variances.size() - 1 - count++];
  return count;
}

}  // namespace

PrincipalAxes::PrincipalAxes(const DescriptorMatrix& rows) {
  Eigen::MatrixXd sample = sample_of(rows);
  mean_ = sample.colwise().mean();
  if (rows.cols() > kLongest) return;
  sample.rowwise() -= mean_;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(sample.transpose() * sample);
  if (solver.info() != Eigen::Success) return;
  constexpr Eigen::Index kStep = kColumnStep;
  const Eigen::Index length = (kept(solver.eigenvalues()) + kStep) / kStep * kStep;
  if (length > rows.cols() / 2) return;
  axes_.setZero(rows.cols(), length);
  axes_.leftCols(length - 1) = solver.eigenvectors().rightCols(length - 1);
}

DescriptorMatrix PrincipalAxes::shorten(const DescriptorMatrix& rows, Eigen::Index first,
                                        Eigen::Index count) const {
  const auto of_interest = rows.middleRows(first, count);
  if (axes_.rows() == 0) return (of_interest.cast<double>().rowwise() - mean_).cast<float>();
  constexpr Eigen::Index kTile = kTileVectors;
  DescriptorMatrix shortened(count, length());
  Eigen::MatrixXd tile(kTile, rows.cols());
  Eigen::MatrixXd along(length(), kTile);
  for (Eigen::Index i = 0; i < count; i += kTile) {
    const Eigen::Index here = std::min(kTile, count - i);
    tile.setZero();
    tile.topRows(here) = of_interest.middleRows(i, here).cast<double>().rowwise() - mean_;
    multiply(tile.data(), axes_.data(), static_cast<std::size_t>(rows.cols()),
             static_cast<std::size_t>(length()), along.data());
    along.row(length() - 1) =
        (tile.rowwise().squaredNorm().transpose() - along.colwise().squaredNorm())
            .cwiseMax(0)
            .cwiseSqrt();
    shortened.middleRows(i, here) = along.leftCols(here).transpose().cast<float>();
  }
  return shortened;
}

}  // namespace posevote
