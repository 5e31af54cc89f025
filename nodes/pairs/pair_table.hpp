// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "nodes/color/color_shares.hpp"
#include "nodes/data/model.hpp"
#include "nodes/pairs/count_turned.hpp"
#include "nodes/pairs/local_frame.hpp"
#include "nodes/pairs/pair_end.hpp"

namespace posevote::pairs {

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
  /// Of the points; of nothing where they have no colours.
  const color::ColorShares& colors() const { return colors_; }
  std::size_t bins() const { return starts_.size() - 1; }
  /// The pairs of a bin, by their turns.
  std::span<const PairEnd> operator[](std::uint32_t bin) const {
    return std::span(ends_).subspan(starts_[bin], starts_[bin + 1] - starts_[bin]);
  }
  /// Has the memory fetch what operator[] reads of a bin, and then, what lies there.
  void fetch_start(std::uint32_t bin) const { __builtin_prefetch(&starts_[bin]); }
  void fetch_pairs(std::uint32_t bin) const { __builtin_prefetch(ends_.data() + starts_[bin]); }

  /// Adds the run of a bin's ends for count_turns.
  void add_all(std::uint32_t bin, std::uint8_t turn, std::vector<TurnedRun>& runs) const {
    if (starts_[bin] < starts_[bin + 1]) runs.push_back({starts_[bin], starts_[bin + 1], turn});
  }
  /// Adds runs of a bin's ends for count_turned, among them all whose turn is at most `most` off
  /// `turn`, of 256 in a circle, each once; `most` < 128.
  void add_turned(std::uint32_t bin, int turn, int most, std::vector<TurnedRun>& runs) const;
  /// Of all bins, kEndPadding more behind the last: what the runs point into.
  const PairEnd* ends() const { return ends_.data(); }

 private:
  PairTable(const Cloud& thin, float step, float reach, int);

  float step_ = 0, reach_ = 0;
  bool has_colors_ = false;
  color::ColorShares colors_;
  std::vector<LocalFrame> points_;
  std::vector<std::uint32_t> starts_;  ///< per bin, and the end
  std::vector<PairEnd> ends_;          ///< padded
};

/// Of the coarsest of a model's octaves: thinned, it is the smoothest. `step` [m].
std::shared_ptr<const PairTable> index_pairs(const Model& model, float step);

/// Of the ends of its faces (rims.hpp), as the finest octave has them. `step` [m].
std::shared_ptr<const PairTable> index_rims(const Model& model, float step);

}  // namespace posevote::pairs
