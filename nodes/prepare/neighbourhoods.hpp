// SPDX-License-Identifier: BSD-3-Clause
// Nearest-neighbour search within a fixed reach, for millions of queries: one look-up instead of
// PointGrid's bisections.
//
// Space is cut into cubes of the reach's edge. Every cube that a query can find something from, an
// occupied one or one beside it, knows the occupied ones among itself and its 26 neighbours;
// elsewhere a query ends at once, which is most of them for a pose that is wrong. Memory: 16 bytes
// a point, some 240 an occupied cube. O(occupied cubes) to build after a sort.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "nodes/prepare/grid.hpp"

namespace posevote {

/// Immutable once built; safe to read from many threads. Points that are not finite are never
/// found.
class Neighbourhoods {
 public:
  /// `reach`: the farthest that `nearest` finds anything [m].
  Neighbourhoods(const PointMatrix& points, float reach);

  /// The nearest point within min(`distance`, reach) of which hidden[index] is 0; of several at one
  /// distance the one with the smallest index.
  std::optional<Neighbour> nearest(const Eigen::Vector3f& center, float distance,
                                   const std::vector<char>& hidden) const;

 private:
  struct Point {
    float x, y, z;
    std::uint32_t index;
  };
  /// Points of one occupied cube.
  struct Run {
    std::uint32_t begin = 0, end = 0;
  };
  /// A cube and its stretch of `runs_`.
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t begin = 0, end = 0;
  };

  std::array<std::int64_t, 3> cube_of(float x, float y, float z) const;
  const Slot* find(std::uint64_t key) const;
  Slot& claim(std::uint64_t key);
  void grow();
  template <class Visit>
  void for_each_neighbour(const Visit& visit) const;

  float reach_ = 0;
  double edge_ = 1;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  std::vector<Point> points_;  ///< cube by cube
  std::vector<Run> cubes_;     ///< those occupied
  std::vector<Run> runs_;      ///< those around each cube
  std::vector<Slot> slots_;    ///< open addressing, a power of two; an empty stretch is free
  std::size_t claimed_ = 0;    ///< slots that are not free
};

}  // namespace posevote
