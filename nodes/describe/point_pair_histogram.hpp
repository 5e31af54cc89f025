// SPDX-License-Identifier: BSD-3-Clause
// The point-pair histogram of one feature point: see describe_point_pairs.cpp for what it is.
#pragma once

#include <Eigen/Core>
#include <array>

namespace posevote {

/// Collects the pairs of one feature point with its neighbours, a block at a time so that the
/// angles are computed on vectors of pairs.
class PointPairHistogram {
 public:
  static constexpr int kAngles = 4;        ///< angles of a pair, one histogram each
  static constexpr int kDistanceBins = 6;  ///< rows of a histogram
  static constexpr int kAngleBins = 10;    ///< columns of a histogram
  static constexpr int kLength = kAngles * kDistanceBins * kAngleBins;

  PointPairHistogram(const Eigen::Vector3f& normal, float radius);

  /// A neighbour at `offset` from the feature point, not zero and not longer than the radius.
  void add(const Eigen::Vector3f& offset, const Eigen::Vector3f& normal) {
    for (int axis = 0; axis < 3; ++axis) {
      offsets_(filled_, axis) = offset[axis];
      normals_(filled_, axis) = normal[axis];
    }
    if (++filled_ == kBlock) flush();
  }

  /// The descriptor, kLength numbers. Ends the collection.
  void write(float* descriptor);

 private:
  static constexpr int kBlock = 64;
  // Linear interpolation spills half a bin over either end: into a bin of margin, folded back
  // later.
  static constexpr int kRows = kDistanceBins + 2;
  static constexpr int kColumns = kAngleBins + 2;
  using Block = Eigen::Array<float, kBlock, 1>;

  void flush();
  void scatter(const Block& distance, const std::array<Block, kAngles>& angles);

  Eigen::Vector3f normal_;
  float bins_per_metre_;
  int filled_ = 0;
  Eigen::Array<float, kBlock, 3> offsets_ = Eigen::Array<float, kBlock, 3>::Zero();
  Eigen::Array<float, kBlock, 3> normals_ = Eigen::Array<float, kBlock, 3>::Zero();
  float bins_[kRows][kAngles][kColumns] = {};
};

}  // namespace posevote
