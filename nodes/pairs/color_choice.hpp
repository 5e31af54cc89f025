// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "nodes/color/color_shares.hpp"
#include "nodes/pairs/cast.hpp"

namespace posevote::pairs {

/// Where pairs of an object start from, as its colours tell: a point of the scan the rather, the more
/// of the object and the less of the scan is of about its colour. Most points lie on other things,
/// and from those no pair is right.
class ColorChoice {
 public:
  /// Colours choose one of so many.
  static constexpr std::size_t kOneOf = 5;

  /// Among `references`; `near`: how near to one its colour is seen, at most [m]. The scan has colours.
  ColorChoice(const std::vector<Reference>& references, const Cloud& scan, float near);
  /// About `most` of them, 1 each; evenly where the model has no colours, or none that the scan has.
  std::vector<char> choose(const PairTable& model, std::size_t most) const;

 private:
  PointMatrix lab_;            ///< of each
  color::ColorShares shares_;  ///< of them all
};

}  // namespace posevote::pairs
