// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/descriptors/principal_axes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "nodes/descriptors/descriptor_kernels.hpp"

namespace posevote::descriptors {
namespace {

// The length of short descriptors. Measured on laser scans and depth images, one model and six: shorter ones
// leave more rows to be compared in full than they save.
constexpr Eigen::Index kLength = 64;
static_assert(kLength % kColumnStep == 0);
constexpr double kMostRest = 0.2;       // of the variance: with more, too many rows are left
constexpr Eigen::Index kLongest = 512;  // the axes of longer ones (USC) take too long to find
constexpr Eigen::Index kSample = 2000;  // rows that show the distribution

Eigen::MatrixXd sample_of(const DescriptorMatrix& rows) {
  const Eigen::Index count = std::min(rows.rows(), kSample);
  Eigen::MatrixXd sample(count, rows.cols());
  for (Eigen::Index i = 0; i < count; ++i)
    sample.row(i) = rows.row(i * rows.rows() / count).cast<double>();
  return sample;
}

}  // namespace

PrincipalAxes::PrincipalAxes(const DescriptorMatrix& rows) {
  Eigen::MatrixXd sample = sample_of(rows);
  mean_ = sample.colwise().mean();
  if (rows.cols() < 2 * kLength || rows.cols() > kLongest) return;
  sample.rowwise() -= mean_;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(sample.transpose() * sample);
  if (solver.info() != Eigen::Success) return;
  const Eigen::VectorXd& variances = solver.eigenvalues();  // ascending
  if (variances.head(rows.cols() - kLength + 1).sum() > kMostRest * variances.sum()) return;
  axes_.setZero(rows.cols(), kLength);
  axes_.leftCols(kLength - 1) = solver.eigenvectors().rightCols(kLength - 1);
}

DescriptorMatrix PrincipalAxes::shorten(const DescriptorRows& rows, Eigen::Index first,
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

}  // namespace posevote::descriptors
