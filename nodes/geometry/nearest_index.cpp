// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/nearest_index.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "nodes/geometry/cells.hpp"

namespace posevote::geometry {
namespace {

constexpr int kBits = 21;           // of a block's place along each axis
constexpr double kFarthest = 1e18;  // cubes from the origin: farther ones are this far
constexpr int kShift = 3;           // cubes along a block's side, as a power of two
constexpr std::int64_t kSide = 1 << kShift;
constexpr std::uint32_t kCubesPerBlock = kSide * kSide * kSide;
constexpr std::size_t kFewestSlots = 64;
constexpr std::size_t kPointsPerBlock = 8;  // at least, on average: more memory serves nobody
constexpr std::size_t kFreeBlocks = 128;    // of which that is not asked

/// The key of a block's place. Blocks so far apart that their places wrap share a key, which costs looks
/// at points that are too far, no more.
std::uint64_t key_of(std::int64_t x, std::int64_t y, std::int64_t z) {
  std::uint64_t key = 0;
  for (const std::int64_t place : {x, y, z})
    key = key << kBits | (static_cast<std::uint64_t>(place) & ((std::uint64_t{1} << kBits) - 1));
  return key;
}

/// std::floor, which is a call where the machine is not known to have it as an instruction.
std::int64_t floor_of(double value) {
  const auto whole = static_cast<std::int64_t>(value);
  return whole - static_cast<std::int64_t>(value < static_cast<double>(whole));
}

/// The cube that holds a place, by its coordinates in edges.
inline std::array<std::int64_t, 3> cube_of(const Eigen::Vector3d& in_edges) {
  const auto place = [&in_edges](Eigen::Index axis) {
    return floor_of(std::clamp(in_edges[axis], -kFarthest, kFarthest));
  };
  return {place(0), place(1), place(2)};
}

/// The number of a cube in its block; those along z follow one another.
std::uint32_t place_in_block(std::int64_t x, std::int64_t y, std::int64_t z) {
  const auto in_block = [](std::int64_t place) { return place & (kSide - 1); };
  return static_cast<std::uint32_t>((in_block(x) * kSide + in_block(y)) * kSide + in_block(z));
}

}  // namespace

NearestIndex::NearestIndex(const PointMatrix& points, float edge) {
  const std::vector<std::uint32_t> rows = finite_rows(points);
  if (rows.empty() || !(edge > 0) || !std::isfinite(edge)) return;
  // A trifle more, so that a search for one edge seldom meets more than three cubes an axis.
  per_edge_ = 1 / (1.0001 * static_cast<double>(edge));
  std::vector<std::size_t> cubes = number_cubes(points, rows);
  for (; blocks_ > kFreeBlocks + rows.size() / kPointsPerBlock; cubes = number_cubes(points, rows))
    per_edge_ /= 2;
  begin_.assign(std::size_t{blocks_} * kCubesPerBlock, 0);
  for (const std::size_t cube : cubes) ++begin_[cube];
  std::uint32_t sum = 0;
  for (std::uint32_t& count : begin_) count = std::exchange(sum, sum + count);
  begin_.push_back(sum);
  std::vector<std::uint32_t> next = begin_;
  points_.resize(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::uint32_t i = rows[k];
    points_[next[cubes[k]]++] = {points(i, 0), points(i, 1), points(i, 2), i};
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
    const auto [x, y, z] = cube_of(per_edge_ * points.row(i).transpose().cast<double>());
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

/// The search for the point nearest to one place.
class NearestIndex::Search {
 public:
  Search(const NearestIndex& index, const Eigen::Vector3f& center, float distance,
         const std::vector<char>& hidden)
      : index_(index),
        hidden_(hidden),
        center_(center),
        in_edges_(index.per_edge_ * center.cast<double>()),
        farthest_(distance * distance) {
    bound(static_cast<double>(distance));
  }

  std::optional<Neighbour> run() {
    double blocks = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
      blocks *= static_cast<double>((high_[axis] >> kShift) - (low_[axis] >> kShift) + 1);
    if (blocks > static_cast<double>(index_.blocks_) + 8) {  // fewer than places to look for them
      look(0, index_.points_.size());
      return best_;
    }
    look_around_center();
    if (best_ && low_ == high_) return best_;  // in that cube alone
    for (std::int64_t x = low_[0] >> kShift; x <= high_[0] >> kShift; ++x)
      for (std::int64_t y = low_[1] >> kShift; y <= high_[1] >> kShift; ++y)
        for (std::int64_t z = low_[2] >> kShift; z <= high_[2] >> kShift; ++z) look_in(x, y, z);
    return best_;
  }

 private:
  /// To the cubes that the ball meets, and a trifle more: only the distance decides who is in.
  void bound(double distance) {
    const double reach = 1.000001 * distance * index_.per_edge_;
    low_ = cube_of(in_edges_ - Eigen::Vector3d::Constant(reach));
    high_ = cube_of(in_edges_ + Eigen::Vector3d::Constant(reach));
  }

  /// What is in the cube of the place itself spares most of those around.
  void look_around_center() {
    const auto [x, y, z] = cube_of(in_edges_);
    const std::uint32_t block = index_.find(key_of(x >> kShift, y >> kShift, z >> kShift));
    if (block == kNone) return;
    const std::uint32_t* begin =
        &index_.begin_[std::size_t{block} * kCubesPerBlock + place_in_block(x, y, z)];
    look(begin[0], begin[1]);
    if (best_) bound(std::sqrt(static_cast<double>(best_->squared)));
  }

  void look_in(std::int64_t block_x, std::int64_t block_y, std::int64_t block_z) {
    const std::uint32_t block = index_.find(key_of(block_x, block_y, block_z));
    if (block == kNone) return;
    const std::uint32_t* begin = &index_.begin_[std::size_t{block} * kCubesPerBlock];
    const Cube first{std::max(low_[0], kSide * block_x), std::max(low_[1], kSide * block_y),
                     std::max(low_[2], kSide * block_z)};
    const Cube last{std::min(high_[0], kSide * block_x + kSide - 1),
                    std::min(high_[1], kSide * block_y + kSide - 1),
                    std::min(high_[2], kSide * block_z + kSide - 1)};
    for (std::int64_t x = first[0]; x <= last[0]; ++x)
      for (std::int64_t y = first[1]; y <= last[1]; ++y)
        look(begin[place_in_block(x, y, first[2])], begin[place_in_block(x, y, last[2]) + 1]);
  }

  void look(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Point& p = index_.points_[i];
      const float dx = p.x - center_.x(), dy = p.y - center_.y(), dz = p.z - center_.z();
      const float squared = dx * dx + dy * dy + dz * dz;
      if (squared > farthest_ || hidden_[p.index]) continue;
      if (best_ && squared == best_->squared && p.index > best_->index) continue;
      best_ = Neighbour{p.index, squared};
      farthest_ = squared;
    }
  }

  const NearestIndex& index_;
  const std::vector<char>& hidden_;
  Eigen::Vector3f center_;
  Eigen::Vector3d in_edges_;
  Cube low_, high_;
  std::optional<Neighbour> best_;
  float farthest_;  ///< squared distance of what is still looked for
};

std::optional<Neighbour> NearestIndex::nearest(const Eigen::Vector3f& center, float distance,
                                               const std::vector<char>& hidden) const {
  if (points_.empty() || !center.allFinite() || !(distance >= 0)) return std::nullopt;
  return Search(*this, center, distance, hidden).run();
}

}  // namespace posevote::geometry
