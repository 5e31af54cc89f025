// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "nodes/data/model.hpp"
#include "nodes/pairs/local_frame.hpp"

namespace posevote::pairs {

/// One end of a pair of a model's points, and the turn about it at which the other end lies.
struct PairEnd {
  std::uint16_t point = 0;  ///< its number among the table's points
  std::uint8_t turn = 0;    ///< of LocalFrame
  std::uint8_t color = 0;   ///< color_step to the other end, where the table has colours
};

/// All pairs of points of a model, by their pair_bin. Immutable.
class PairTable {
 public:
  /// Of a model's cloud, thinned to one point a step. `reach` [m]: no two of the points
  /// are farther apart; `step` [m]: from a hundredth of it to all of it. Throws std::runtime_error where the cloud has over 65535 steps of
  /// surface, or no normals. Time and memory grow with the square of its points: at a step of a
  /// fifteenth of the size some 400 points and 150 thousand pairs, in 10 ms.
  PairTable(const Cloud& cloud, float step, float reach);
  /// Of points that are thin already; there may be none.
  PairTable(std::vector<LocalFrame> points, float step, float reach,
            const ColorMatrix& colors = {});

  float step() const { return step_; }
  float reach() const { return reach_; }
  const std::vector<LocalFrame>& points() const { return points_; }
  bool has_colors() const { return has_colors_; }
  std::size_t bins() const { return starts_.size() - 1; }
  /// The pairs of a bin, by their turns.
  std::span<const PairEnd> operator[](std::uint32_t bin) const {
    return std::span(ends_).subspan(starts_[bin], starts_[bin + 1] - starts_[bin]);
  }
  /// Has the memory fetch what operator[] reads of a bin, and then, what lies there.
  void fetch_start(std::uint32_t bin) const { __builtin_prefetch(&starts_[bin]); }
  void fetch_pairs(std::uint32_t bin) const { __builtin_prefetch(ends_.data() + starts_[bin]); }

  /// Calls visit(end) for each of a bin whose turn is at most `most` off, of 256 in a circle;
  /// `most` < 128.
  template <class Visit>
  void for_each_turned(std::uint32_t bin, int turn, int most, const Visit& visit) const {
    const std::span<const PairEnd> ends = (*this)[bin];
    if (ends.size() <= kFew) {  // to look at them all is quicker than to search
      for (const PairEnd& end : ends)
        if (static_cast<std::uint8_t>(end.turn - turn + most) <= 2 * most) visit(end);
      return;
    }
    for (const int around : {-256, 0, 256}) {
      const int low = turn - most + around, high = turn + most + around;
      if (high < 0 || low > 255) continue;
      auto end = std::ranges::lower_bound(ends, low, {}, &PairEnd::turn);
      for (; end != ends.end() && end->turn <= high; ++end) visit(*end);
    }
  }

 private:
  static constexpr std::size_t kFew = 32;

  PairTable(const Cloud& thin, float step, float reach, int);

  float step_ = 0, reach_ = 0;
  bool has_colors_ = false;
  std::vector<LocalFrame> points_;
  std::vector<std::uint32_t> starts_;  ///< per bin, and the end
  std::vector<PairEnd> ends_;
};

/// Of the coarsest of a model's octaves: thinned, it is the smoothest. `step` [m].
std::shared_ptr<const PairTable> index_pairs(const Model& model, float step);

/// Of the ends of its faces (rims.hpp), as the finest octave has them. `step` [m].
std::shared_ptr<const PairTable> index_rims(const Model& model, float step);

}  // namespace posevote::pairs
