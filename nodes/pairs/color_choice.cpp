// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pairs/color_choice.hpp"

#include <algorithm>

#include "nodes/color/srgb.hpp"
#include "nodes/geometry/nearest_index.hpp"
#include "nodes/pairs/pair_table.hpp"

namespace posevote::pairs {
namespace {

/// A point's weight is the object's share of its colour over the scan's, at most kMost, and a little
/// for any colour: it may be that of another light.
constexpr float kMost = 10, kUnlike = 0.2F;

}  // namespace

ColorChoice::ColorChoice(const std::vector<Reference>& references, const Cloud& scan, float near) {
  const geometry::NearestIndex index(scan.points, near);
  ColorMatrix colors = ColorMatrix::Zero(std::ssize(references), 3);
  Eigen::Index row = 0;
  for (const Reference& one : references) {
    if (const auto found = index.nearest(one.frame.point, near))
      colors.row(row) = scan.colors.row(found.index);
    ++row;
  }
  lab_ = color::lab_of(colors);
  shares_ = color::ColorShares(lab_);
}

std::vector<char> ColorChoice::choose(const PairTable& model, std::size_t most) const {
  const auto count = static_cast<std::size_t>(lab_.rows());
  std::vector<double> sums;
  double sum = 0;
  for (Eigen::Index i = 0; i < lab_.rows(); ++i) {
    const Eigen::Vector3f lab = lab_.row(i).transpose();
    sum += static_cast<double>(kUnlike +
                               std::min(kMost, model.colors().like(lab) / shares_.like(lab)));
    sums.push_back(sum);
  }
  std::vector<char> chosen(count, 0);
  for (std::size_t k = 0; k < most && count > 0; ++k) {
    const double place = sum * (static_cast<double>(k) + 0.5) / static_cast<double>(most);
    chosen[static_cast<std::size_t>(std::ranges::lower_bound(sums, place) - sums.begin())] = 1;
  }
  return chosen;
}

}  // namespace posevote::pairs
