// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/prepare/neighbourhoods.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "nodes/prepare/cells.hpp"
#include "nodes/prepare/radix_sort.hpp"

namespace posevote {
namespace {

constexpr int kBits = 20;  // of a cube's place along each axis
constexpr double kMostCubes = 1 << (kBits - 1);

std::uint64_t key_of(const std::array<std::int64_t, 3>& cube) {
  std::uint64_t key = 0;
  // One more than the place, so that what lies before the first is not negative.
  for (const std::int64_t place : cube) key = key << kBits | static_cast<std::uint64_t>(place + 1);
  return key;
}

/// Where to look for a cube first. Four that follow one another along z share a cache line; longer
/// runs would walk into each other.
std::size_t place_of(std::uint64_t key, std::size_t mask) {
  return ((scatter(key >> 2, mask) << 2) + (key & 3)) & mask;
}

}  // namespace

Neighbourhoods::Neighbourhoods(const PointMatrix& points, float reach) : reach_(reach) {
  const std::vector<std::uint32_t> finite = finite_rows(points);
  if (finite.empty() || !(reach > 0) || !std::isfinite(reach)) return;
  const auto all = points(finite, Eigen::all);
  const Eigen::Vector3d low = all.colwise().minCoeff().transpose().cast<double>();
  const Eigen::Vector3d high = all.colwise().maxCoeff().transpose().cast<double>();
  origin_ = low;
  // A trifle more than the reach: what is within it by rounding is in a neighbour, too.
  edge_ = std::max(1.0001 * static_cast<double>(reach), (high - low).maxCoeff() / kMostCubes);

  struct Keyed {
    std::uint64_t key;
    std::uint32_t index;
  };
  std::vector<Keyed> keyed;
  keyed.reserve(finite.size());
  for (const std::uint32_t i : finite)
    keyed.push_back({key_of(cube_of(points(i, 0), points(i, 1), points(i, 2))), i});
  radix_sort(keyed, [](const Keyed& one) { return static_cast<std::uint32_t>(one.key); });
  radix_sort(keyed, [](const Keyed& one) { return static_cast<std::uint32_t>(one.key >> 32); });
  points_.reserve(keyed.size());
  for (std::uint32_t k = 0; k < keyed.size(); ++k) {
    const std::uint32_t i = keyed[k].index;
    if (k == 0 || keyed[k].key != keyed[k - 1].key) cubes_.push_back({k, k});
    cubes_.back().end = k + 1;
    points_.push_back({points(i, 0), points(i, 1), points(i, 2), i});
  }
  slots_.resize(std::bit_ceil(8 * cubes_.size()));
  for_each_neighbour([this](std::uint64_t key, const Run&) { ++claim(key).end; });
  std::uint32_t sum = 0;
  for (Slot& slot : slots_) {
    const std::uint32_t count = slot.end;
    slot.begin = sum;
    sum += count;
    slot.end = count > 0 ? sum : 0;
  }
  runs_.resize(sum);
  std::vector<std::uint32_t> filled(slots_.size(), 0);
  for_each_neighbour([&](std::uint64_t key, const Run& cube) {
    const Slot& slot = *find(key);
    runs_[slot.begin + filled[static_cast<std::size_t>(&slot - slots_.data())]++] = cube;
  });
}

std::array<std::int64_t, 3> Neighbourhoods::cube_of(float x, float y, float z) const {
  const auto place = [this](float value, double origin) {
    const double cube = std::floor((static_cast<double>(value) - origin) / edge_);
    return static_cast<std::int64_t>(std::clamp(cube, -1.0, kMostCubes + 1));
  };
  return {place(x, origin_.x()), place(y, origin_.y()), place(z, origin_.z())};
}

/// Calls visit(key, cube) for every occupied cube and every one that it neighbours.
template <class Visit>
void Neighbourhoods::for_each_neighbour(const Visit& visit) const {
  for (const Run& cube : cubes_) {
    const Point& p = points_[cube.begin];
    const auto [x, y, z] = cube_of(p.x, p.y, p.z);
    for (std::int64_t dx = -1; dx <= 1; ++dx)
      for (std::int64_t dy = -1; dy <= 1; ++dy)
        for (std::int64_t dz = -1; dz <= 1; ++dz) visit(key_of({x + dx, y + dy, z + dz}), cube);
  }
}

const Neighbourhoods::Slot* Neighbourhoods::find(std::uint64_t key) const {
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t at = place_of(key, mask); slots_[at].end != 0; at = (at + 1) & mask)
    if (slots_[at].key == key) return &slots_[at];
  return nullptr;
}

Neighbourhoods::Slot& Neighbourhoods::claim(std::uint64_t key) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = place_of(key, mask);
  while (slots_[at].end != 0 && slots_[at].key != key) at = (at + 1) & mask;
  if (slots_[at].end != 0) return slots_[at];
  if (2 * (claimed_ + 1) > slots_.size()) {
    grow();
    return claim(key);
  }
  ++claimed_;
  slots_[at].key = key;
  return slots_[at];
}

void Neighbourhoods::grow() {
  std::vector<Slot> old(2 * slots_.size());
  old.swap(slots_);
  claimed_ = 0;
  for (const Slot& slot : old)
    if (slot.end != 0) claim(slot.key).end = slot.end;
}

std::optional<Neighbour> Neighbourhoods::nearest(const Eigen::Vector3f& center, float distance,
                                                 const std::vector<char>& hidden) const {
  if (points_.empty() || !center.allFinite() || !(distance >= 0)) return std::nullopt;
  const Slot* slot = find(key_of(cube_of(center.x(), center.y(), center.z())));
  if (!slot) return std::nullopt;
  const float reach = std::min(distance, reach_);
  std::optional<Neighbour> best;
  float farthest = reach * reach;
  for (std::uint32_t r = slot->begin; r < slot->end; ++r)
    for (std::uint32_t i = runs_[r].begin; i < runs_[r].end; ++i) {
      const Point& p = points_[i];
      const float dx = p.x - center.x(), dy = p.y - center.y(), dz = p.z - center.z();
      const float squared = dx * dx + dy * dy + dz * dz;
      if (squared > farthest || hidden[p.index]) continue;
      if (best && squared == best->squared && p.index > best->index) continue;
      best = Neighbour{p.index, squared};
      farthest = squared;
    }
  return best;
}

}  // namespace posevote
