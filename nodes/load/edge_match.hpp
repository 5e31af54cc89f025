// SPDX-License-Identifier: BSD-3-Clause
// Whether a colour image shows what a depth image measured. Where a thing ends, the depth steps, and
// mostly the colour changes: at the steps an image of the same moment and place has stronger edges
// than the same image shifted. One of another moment, or not registered to the depth, has not.
#pragma once

#include "nodes/data/files.hpp"

namespace posevote::load {

/// How the edges of an image's colours lie to the steps of its depth.
struct EdgeMatch {
  std::size_t steps = 0;  ///< pixels where the depth steps
  double here = 0;       ///< mean rank of the colour's edges there, in [0, 1]; of shifts by next to
                         ///< nothing the best
  double elsewhere = 0;  ///< of far shifts the mean
  int better = 0;        ///< far shifts that match as well or better
};

/// So many far shifts match as well by chance: none of some 190 images with colours of their own
/// had one, of such with another's nine in ten have more.
constexpr int kMostBetter = 2;

/// `color` is of the same size. Linear in the pixels: some 10 ms of 640 x 480. An image that is too small, has
/// hardly a step, or is of one colour matches: nothing can be told.
EdgeMatch match_edges(const LoadedDepth& image, const ColorImage& color);

inline bool is_of_one_view(const EdgeMatch& match) { return match.better <= kMostBetter; }

}  // namespace posevote::load
