// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/separation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace posevote::poses {
namespace {

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    std::uint64_t mixed = 0;
    for (const std::int64_t i : cell)
      mixed = (mixed ^ static_cast<std::uint64_t>(i)) * 0x9E3779B97F4A7C15ULL;
    return static_cast<std::size_t>(mixed ^ (mixed >> 32));
  }
};

/// Whether two rotations are an angle apart at most: the cosine of half of it.
bool is_turned_alike(const Hypothesis& a, const Hypothesis& b, float cosine_of_half) {
  return std::abs(a.rotation.dot(b.rotation)) >= cosine_of_half;
}

float cosine_of_half(const Separation& separation) { return std::cos(separation.angle / 2); }

/// Poses by where their centres lie: those within `separation.distance` of another lie in its cell
/// or, since a cell is twice as wide, on the side of it that is nearer, along each axis.
class Places {
 public:
  explicit Places(const Separation& separation)
      : separation_(separation),
        cosine_of_half_(cosine_of_half(separation)),
        edge_(std::max(2 * kMargin * static_cast<double>(separation.distance), kLeastEdge)) {}

  void add(const Hypothesis& pose) {
    const auto in = [&](Eigen::Index axis) { return cells_at(pose.center[axis]).own; };
    cells_[{in(0), in(1), in(2)}].push_back(pose);
  }

  /// Whether one that was added is like it, or as many as a place may hold lie there.
  bool suppress(const Hypothesis& pose) const {
    const Beside x = cells_at(pose.center.x()), y = cells_at(pose.center.y()),
                 z = cells_at(pose.center.z());
    int here = 0;
    for (const std::int64_t i : {x.own, x.nearest})
      for (const std::int64_t j : {y.own, y.nearest})
        for (const std::int64_t k : {z.own, z.nearest}) {
          const auto cell = cells_.find({i, j, k});
          if (cell != cells_.end() && suppressed_by(cell->second, pose, here)) return true;
        }
    return false;
  }

 private:
  static constexpr double kMargin = 1.001;    // for what rounding does at a distance of just one
  static constexpr double kLeastEdge = 1e-6;  // [m]

  /// Along an axis.
  struct Beside {
    std::int64_t own, nearest;
  };

  Beside cells_at(float x) const {
    const double in_edges = static_cast<double>(x) / edge_, own = std::floor(in_edges);
    return {static_cast<std::int64_t>(own),
            static_cast<std::int64_t>(in_edges - own < 0.5 ? own - 1 : own + 1)};
  }

  bool suppressed_by(const std::vector<Hypothesis>& others, const Hypothesis& pose,
                     int& here) const {
    return std::ranges::any_of(others, [&](const Hypothesis& other) {
      if ((pose.center - other.center).norm() > separation_.distance) return false;
      return is_turned_alike(pose, other, cosine_of_half_) || ++here == separation_.per_place;
    });
  }

  const Separation& separation_;
  float cosine_of_half_;
  double edge_;  ///< of a cell [m]
  std::unordered_map<Cell, std::vector<Hypothesis>, CellHash> cells_;
};

}  // namespace

bool is_like(const Hypothesis& a, const Hypothesis& b, const Separation& separation) {
  return (a.center - b.center).norm() <= separation.distance &&
         is_turned_alike(a, b, cosine_of_half(separation));
}

std::vector<std::size_t> separate_poses(const std::vector<Hypothesis>& poses,
                                        const Separation& separation, std::size_t count) {
  Places places(separation);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < poses.size() && kept.size() < count; ++i) {
    if (places.suppress(poses[i])) continue;
    places.add(poses[i]);
    kept.push_back(i);
  }
  return kept;
}

}  // namespace posevote::poses
