// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/nearest_index.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "nodes/geometry/box_around.hpp"
#include "nodes/geometry/cells.hpp"

namespace posevote::geometry {
namespace {

constexpr int kBits = 21;           // of a block's place along each axis
constexpr double kFarthest = 1e18;  // cubes from the lowest: farther ones are this far
constexpr float kLowest = -1e6F;    // [m]; by a lower one the places of all others would be rounded
constexpr int kShift = 3;           // cubes along a block's side, as a power of two
constexpr std::int64_t kSide = 1 << kShift;
constexpr std::uint32_t kCubesPerBlock = kSide * kSide * kSide;
constexpr std::size_t kFewestSlots = 64;
constexpr std::size_t kPointsPerBlock = 8;  // at least, on average: more memory serves nobody
constexpr float kNowhere = std::numeric_limits<float>::infinity();  // farther than any distance
constexpr std::size_t kFreeBlocks = 128;                            // of which that is not asked

/// The key of a block's place. Blocks so far apart that their places wrap share a key, which costs looks
/// at points that are too far, no more.
std::uint64_t key_of(std::int64_t x, std::int64_t y, std::int64_t z) {
  std::uint64_t key = 0;
  for (const std::int64_t place : {x, y, z})
    key = key << kBits | (static_cast<std::uint64_t>(place) & ((std::uint64_t{1} << kBits) - 1));
  return key;
}

/// Of the cube that holds a point, along one axis.
std::int64_t place_of(double in_edges) {
  return static_cast<std::int64_t>(std::clamp(in_edges, 0.0, kFarthest));
}

/// The number of a cube in its block; those along z follow one another.
std::uint32_t place_in_block(std::int64_t x, std::int64_t y, std::int64_t z) {
  const auto in_block = [](std::int64_t place) { return place & (kSide - 1); };
  return static_cast<std::uint32_t>((in_block(x) * kSide + in_block(y)) * kSide + in_block(z));
}

}  // namespace

NearestIndex::NearestIndex(const PointMatrix& points, float distance) {
  const std::vector<std::uint32_t> rows = finite_rows(points);
  if (rows.empty() || !(distance > 0) || !std::isfinite(distance)) return;
  low_ = box_around(points, rows).min().cwiseMax(kLowest);
  // A trifle more, so that a search for that distance seldom meets a third cube along an axis.
  per_edge_ = 1 / (2.0002 * static_cast<double>(distance));
  std::vector<std::size_t> cubes = number_cubes(points, rows);
  for (; blocks_ > kFreeBlocks + rows.size() / kPointsPerBlock; cubes = number_cubes(points, rows))
    per_edge_ /= 2;
  begin_.assign(std::size_t{blocks_} * kCubesPerBlock, 0);
  for (const std::size_t cube : cubes) ++begin_[cube];
  std::uint32_t sum = 0;
  for (std::uint32_t& count : begin_) count = std::exchange(sum, sum + count);
  begin_.push_back(sum);
  std::vector<std::uint32_t> next = begin_;
  PointGroup none;
  std::ranges::fill(none.x, kNowhere), std::ranges::fill(none.y, kNowhere);
  std::ranges::fill(none.z, kNowhere), std::ranges::fill(none.index, kNone);
  groups_.assign((rows.size() + kGroup - 1) / kGroup, none);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::uint32_t i = rows[k], at = next[cubes[k]]++;
    PointGroup& group = groups_[at / kGroup];
    group.x[at % kGroup] = points(i, 0);
    group.y[at % kGroup] = points(i, 1);
    group.z[at % kGroup] = points(i, 2);
    group.index[at % kGroup] = i;
  }
}

/// Claims the blocks that hold points; the number of each one's cube.
std::vector<std::size_t> NearestIndex::number_cubes(const PointMatrix& points,
                                                    const std::vector<std::uint32_t>& rows) {
  blocks_ = 0;
  slots_.assign(kFewestSlots, {});
  std::vector<std::size_t> cubes;
  cubes.reserve(rows.size());
  for (const std::uint32_t i : rows) {
    const auto along = [&](Eigen::Index axis) {
      return place_of(edges_from_low(points(i, axis), axis));
    };
    const std::int64_t x = along(0), y = along(1), z = along(2);
    const std::uint32_t block = claim(key_of(x >> kShift, y >> kShift, z >> kShift));
    cubes.push_back(std::size_t{block} * kCubesPerBlock + place_in_block(x, y, z));
  }
  return cubes;
}

/// That of a block, or the free one where it belongs.
std::size_t NearestIndex::slot_of(std::uint64_t key) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = scatter(key, mask);
  while (slots_[at].block != kNone && slots_[at].key != key) at = (at + 1) & mask;
  return at;
}

std::uint32_t NearestIndex::find(std::uint64_t key) const { return slots_[slot_of(key)].block; }

std::uint32_t NearestIndex::claim(std::uint64_t key) {
  Slot& slot = slots_[slot_of(key)];
  if (slot.block != kNone) return slot.block;
  slot = {key, blocks_++};
  if (4 * std::size_t{blocks_} > slots_.size()) {
    std::vector<Slot> old(2 * slots_.size());
    old.swap(slots_);
    for (const Slot& moved : old)
      if (moved.block != kNone) slots_[slot_of(moved.key)] = moved;
  }
  return blocks_ - 1;
}

void NearestIndex::hide(const std::vector<char>& hidden) {
  for (PointGroup& group : groups_)
    for (std::size_t at = 0; at < kGroup; ++at)
      if (group.index[at] != kNone && hidden[group.index[at]] != 0) group.x[at] = kNowhere;
}

namespace {

/// Cubes, or blocks, along one axis.
struct Span {
  std::int64_t first, last;
};

/// The cubes that a ball meets along an axis.
inline Span cubes_around(double in_edges, double reach) {
  return {place_of(in_edges - reach), place_of(in_edges + reach)};
}
inline Span blocks_of(const Span& cubes) { return {cubes.first >> kShift, cubes.last >> kShift}; }
inline Span in_block(const Span& cubes, std::int64_t block) {
  return {std::max(cubes.first - kSide * block, std::int64_t{0}),
          std::min(cubes.last - kSide * block, kSide - 1)};
}
inline double size_of(const Span& span) {
  return static_cast<double>(span.last) - static_cast<double>(span.first) + 1;
}

}  // namespace

/// The search for the point nearest to one place.
class NearestIndex::Search {
 public:
  Search(const NearestIndex& index, const Eigen::Vector3f& center, float distance)
      : index_(index),
        center_(center.data()),
        farthest_(std::min(distance * distance, std::numeric_limits<float>::max())) {}

  void look(std::uint32_t begin, std::uint32_t end) {
    if (count_ == kRuns) look_up();
    runs_[count_] = {begin, end};
    count_ += begin < end;
  }

  void look_in(std::uint32_t block, const Span& x, const Span& y, const Span& z) {
    const std::uint32_t* begin = &index_.begin_[std::size_t{block} * kCubesPerBlock];
    for (std::int64_t i = x.first; i <= x.last; ++i)
      for (std::int64_t j = y.first; j <= y.last; ++j) {
        const std::uint32_t* row = begin + (i * kSide + j) * kSide;
        look(row[z.first], row[z.last + 1]);
      }
  }

  NearestPoint result() {
    look_up();
    return best_;
  }

 private:
  static constexpr std::size_t kRuns = 16;  // that are looked at together

  void look_up() {
    if (count_ == 0) return;
    const NearestPoint found =
        nearest_in_runs(index_.groups_.data(), runs_.data(), count_, center_, farthest_);
    count_ = 0;
    const bool ties = best_ && found.squared == best_.squared;
    if (!found || (ties && found.index > best_.index)) return;
    best_ = found;
    farthest_ = found.squared;
  }

  const NearestIndex& index_;
  const float* center_;
  float farthest_;  ///< squared distance of what is still looked for
  NearestPoint best_;
  std::size_t count_ = 0;            ///< of runs_
  std::array<GridRun, kRuns> runs_;  // without values: to write them costs as much as a search
};

NearestPoint NearestIndex::nearest(const Eigen::Vector3f& center, float distance) const {
  if (groups_.empty() || !center.allFinite() || !(distance >= 0)) return {};
  // A trifle more: only the distance decides who is in.
  const double reach = 1.000001 * static_cast<double>(distance) * per_edge_;
  const Span x = cubes_around(edges_from_low(center.x(), 0), reach);
  const Span y = cubes_around(edges_from_low(center.y(), 1), reach);
  const Span z = cubes_around(edges_from_low(center.z(), 2), reach);
  const Span blocks_x = blocks_of(x), blocks_y = blocks_of(y), blocks_z = blocks_of(z);
  Search search(*this, center, distance);
  // A ball of half a block meets eight at most, which are quickly asked for.
  if (reach > kSide / 2 && size_of(blocks_x) * size_of(blocks_y) * size_of(blocks_z) >
                               static_cast<double>(blocks_) + 8) {
    search.look(0, begin_.back());  // all: fewer than places to look for them
    return search.result();
  }
  for (std::int64_t i = blocks_x.first; i <= blocks_x.last; ++i)
    for (std::int64_t j = blocks_y.first; j <= blocks_y.last; ++j)
      for (std::int64_t k = blocks_z.first; k <= blocks_z.last; ++k) {
        const std::uint32_t block = find(key_of(i, j, k));
        if (block != kNone) search.look_in(block, in_block(x, i), in_block(y, j), in_block(z, k));
      }
  return search.result();
}

}  // namespace posevote::geometry
