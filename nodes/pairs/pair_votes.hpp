// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "nodes/data/cloud.hpp"
#include "nodes/geometry/grid_normals.hpp"
#include "nodes/pairs/pair_table.hpp"
#include "nodes/pairs/pairs_around.hpp"
#include "nodes/pairs/thin_surface.hpp"

namespace posevote::pairs {

/// A scan's surface, thin, to pair its points with.
class PairScene {
 public:
  /// `edge`: of thin_surface [m].
  PairScene(const Cloud& scan, float edge) : PairScene(of_thin(thin_surface(scan, edge), edge)) {}
  /// Of points that are thin already, `edge` [m] apart.
  static PairScene of_thin(const Cloud& thin, float edge) { return {thin, 4 * edge, 0}; }

  /// Sets `runs` to runs of points that hold all those within `reach` [m], and some others.
  void find_runs(const Eigen::Vector3f& center, float reach,
                 std::vector<geometry::GridRun>& runs) const {
    grid_.find_runs(center, center, reach, runs);
  }
  /// The points, in their order.
  geometry::OrientedColumns columns() const { return geometry::columns_of(grid_, normals_); }
  bool has_colors() const { return lab_.rows() > 0; }
  /// CIELAB of each of the points, if has_colors().
  const PointMatrix& lab() const { return lab_; }

 private:
  PairScene(const Cloud& thin, float cell, int);

  geometry::PointGrid grid_;
  PointMatrix normals_, lab_;  ///< in the grid's order; normals are padded
};

/// What find_pairs starts from.
PairStart start_at(const LocalFrame& at, float reach, bool keeps_all);

/// A pose under which many pairs agree: the model's point lies in the scan's, normal on normal, and
/// the model is turned about it.
struct PairPeak {
  std::uint16_t point = 0;  ///< of the PairTable
  float turn = 0;           ///< [rad]
  std::uint32_t pairs = 0;  ///< how many agree, those of like colours several times
};

/// What of a pose a point with its frame leaves open: the turn about its normal, or nothing.
enum class Turn { kOpen, kKnown };

struct PeakOptions {
  std::size_t poses = 1;   ///< of a point, at most
  double least_ratio = 1;  ///< one with less than this share of the best one's pairs is none
  Turn turn = Turn::kOpen;
  /// Times that a pair counts whose colours change as the model's do (color_step.hpp), where table
  /// and scene have colours; of open turns alone.
  std::uint16_t like_color = 1;
};

/// Counts the pairs that one scan point makes with those around it, by the model's point that it
/// would be and by the turn (Drost et al., CVPR 2010, section 3.3). Keeps its memory for the next
/// point.
class PairVotes {
 public:
  /// Goes to a point, whose pairs with what is within `reach` [m] are those that any table of less
  /// reach asks for.
  void go_to(const LocalFrame& at, const PairScene& scene, float reach);
  /// The best there, in descending order.
  std::vector<PairPeak> peaks(const PairTable& table, const PeakOptions& options);

 private:
  /// Calls visit(bin, turn, color) for each kind of pair that the scan has about the point, the turn
  /// about it at which it has it, and, where it knows the point's own colour, the color_step.
  template <class Visit>
  void for_each_pair(const PairTable& table, const Visit& visit);
  /// Fills counts_, per point of the table, and turn if it is open.
  void count(const PairTable& table, const PeakOptions& options);
  void count_by_color(const PairTable& table, std::uint16_t like_color);
  std::vector<PairPeak> peaks_of_turns(std::size_t points, double ratio);
  std::vector<PairPeak> peaks_of_points(double ratio) const;
  PairPeak peak_of(std::size_t point) const;

  /// Of the scan's points about the point: what of a pair is the same for all tables.
  struct Other {
    float length = 0;  ///< [m]
    std::uint16_t angles = 0;
    std::uint8_t turn = 0;
    std::uint8_t color = 0;  ///< color_step, where the scene has colours
  };
  struct Pair {
    std::uint32_t bin = 0;
    std::uint8_t turn = 0;
    std::uint8_t color = 0;
  };

  std::vector<geometry::GridRun> runs_;  ///< of the scene's points, around the point
  std::vector<float> lengths_;           ///< of the pairs found there, as PairColumns
  std::vector<std::int32_t> numbers_;    ///< the other PairColumns
  std::vector<Other> others_;
  float color_from_ = 0;                ///< how far away the point's own colour was seen [m]
  std::vector<Pair> pairs_;             ///< of the table, about the point
  std::vector<std::uint16_t> counts_;   ///< per point of the model, and turn if it is open
  std::vector<std::uint16_t> most_;     ///< per point: of its turns
  std::vector<std::uint32_t> seen_;     ///< per bin: the turns at which the scan had it
  std::vector<std::uint32_t> touched_;  ///< bins
  std::vector<TurnedRun> turned_;       ///< of the table, that hold the ends of like turns
};

}  // namespace posevote::pairs
