// SPDX-License-Identifier: BSD-3-Clause
// Nearest-neighbour search for millions of queries, most of which ask for one distance or less.
//
// Space is cut into cubes with twice that distance as their edge, cubes come in blocks of 8 x 8 x 8,
// and only blocks that hold points exist, in a hash table. A query meets one or two cubes along each
// axis, whose points lie in up to four runs that a vector kernel looks at together; where nothing is
// near, which is most of the space around a pose that is wrong, it ends after the look-ups. Memory:
// 16 bytes a point, 2 KB a block; where points are so sparse that few share a block, cubes are
// larger. O(points) to build.
#pragma once

#include <cstdint>
#include <vector>

#include "nodes/geometry/grid.hpp"
#include "nodes/geometry/nearest_kernel.hpp"

namespace posevote::geometry {

/// Safe to read from many threads. Points that are not finite are never found.
class NearestIndex {
 public:
  /// Of no points.
  NearestIndex() = default;
  /// `distance`: that is asked for most [m]; larger ones are answered, more slowly. Finds nothing if
  /// it is not above 0 or not finite.
  NearestIndex(const PointMatrix& points, float distance);

  /// From now on, points with hidden[index] are not found. Not while others read.
  void hide(const std::vector<char>& hidden);

  /// The nearest point within `distance`; of several at one distance the one with the smallest index.
  NearestPoint nearest(const Eigen::Vector3f& center, float distance) const;

 private:
  static constexpr std::uint32_t kNone = NearestPoint::kNone;
  class Search;
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t block = kNone;
  };

  std::vector<std::size_t> number_cubes(const PointMatrix& points,
                                        const std::vector<std::uint32_t>& rows);
  std::size_t slot_of(std::uint64_t block_key) const;
  std::uint32_t claim(std::uint64_t block_key);
  std::uint32_t find(std::uint64_t block_key) const;

  double edges_from_low(float at, Eigen::Index axis) const {
    return per_edge_ * (static_cast<double>(at) - static_cast<double>(low_[axis]));
  }

  Eigen::Vector3f low_ = Eigen::Vector3f::Zero();  ///< of all points, but strays; lower is cube 0
  double per_edge_ = 1;                            ///< cubes in a metre
  std::vector<PointGroup> groups_;                 ///< of the points, cube by cube, block by block
  std::vector<std::uint32_t> begin_;  ///< of each cube's points; behind the last the end of all
  std::vector<Slot> slots_;           ///< blocks; open addressing, a power of two
  std::uint32_t blocks_ = 0;
};

}  // namespace posevote::geometry
