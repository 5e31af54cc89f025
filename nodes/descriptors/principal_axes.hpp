// SPDX-License-Identifier: BSD-3-Clause
// Descriptors made short, such that their distances can only shrink.
//
// A descriptor less the mean is a part along the leading principal axes and a rest. Kept are the
// coordinates of the first and the length of the second: the lengths of two rests differ by no more
// than their distance, so no pair comes to lie farther apart than it was.
#pragma once

#include <Eigen/Core>

#include "nodes/data/features.hpp"

namespace posevote::descriptors {

class PrincipalAxes {
 public:
  /// The axes of the rows' distribution; at least one row. Where few axes do not hold most of it or take too
  /// long to find, and where descriptors are short already, only the mean is taken off.
  explicit PrincipalAxes(const DescriptorMatrix& rows);

  /// Numbers of a short descriptor.
  Eigen::Index length() const { return axes_.rows() == 0 ? mean_.size() : axes_.cols(); }

  /// The rows [first, first + count) made short. A row moves by at most kMoves of its own length
  /// by rounding.
  DescriptorMatrix shorten(const DescriptorRows& rows, Eigen::Index first,
                           Eigen::Index count) const;

  /// The root of what 512 sums in double may be off where the rest is small, and a float's
  /// rounding.
  static constexpr float kMoves = 1e-6F;

 private:
  Eigen::RowVectorXd mean_;
  /// dimension x length, one axis a column; the last is zero and makes room for the rest. Empty:
  /// not shorter.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> axes_;
};

}  // namespace posevote::descriptors
