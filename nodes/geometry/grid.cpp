// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/grid.hpp"

#include <bit>

#include "graph/parallel.hpp"
#include "nodes/geometry/box_around.hpp"
#include "nodes/geometry/cells.hpp"
#include "nodes/geometry/radix_sort.hpp"

namespace posevote::geometry {
namespace {

struct Entry {
  std::uint64_t key;
  float x;
  std::uint32_t index;
};

}  // namespace

PointGrid::PointGrid(const PointMatrix& points, float cell) {
  const std::vector<std::uint32_t> finite = finite_rows(points);
  if (finite.empty()) return;

  const Eigen::AlignedBox3f box = box_around(points, finite);
  const Eigen::Vector3f low = box.min();
  origin_ = low;
  const double extent = (box.max().cast<double>() - low.cast<double>()).maxCoeff();
  // Two row numbers fill 60 bits of a key: a cell may not be finer than that (nor NaN, nor infinite).
  cell_ = std::max(
      {1e-9F, static_cast<float>(extent / 1e9), std::min(cell, static_cast<float>(extent))});
  last_row_ = std::floor(extent / cell_) + 1;
  rows_ = static_cast<std::uint64_t>(last_row_) + 2;

  std::vector<Entry> entries(finite.size());
  graph::parallel_for(finite.size(), 8192, [&](std::size_t k) {
    const std::uint32_t i = finite[k];
    entries[k] = {key_of(row(points(i, 1), low.y()), row(points(i, 2), low.z())), points(i, 0), i};
  });
  radix_sort(entries, [](const Entry& one) { return ordered_bits(one.x); });
  radix_sort(entries, [](const Entry& one) { return one.key; });

  std::size_t rods = 0;
  for (std::size_t i = 0; i < entries.size(); ++i)
    rods += i == 0 || entries[i].key != entries[i - 1].key ? 1 : 0;
  slots_.resize(std::bit_ceil(2 * rods));
  for (auto* column : {&x_, &y_, &z_}) column->assign(entries.size() + kGridPadding, 0);
  index_.resize(entries.size());
  graph::parallel_for(entries.size(), 8192, [&](std::size_t at) {
    const std::uint32_t i = entries[at].index;
    x_[at] = points(i, 0), y_[at] = points(i, 1), z_[at] = points(i, 2);
    index_[at] = i;
  });
  for (std::size_t begin = 0; begin < entries.size();) {
    std::size_t end = begin;
    while (end < entries.size() && entries[end].key == entries[begin].key) ++end;
    std::size_t at = scatter(entries[begin].key, slots_.size() - 1);
    while (slots_[at].rod.end != 0) at = (at + 1) & (slots_.size() - 1);
    slots_[at] = {entries[begin].key,
                  {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)}};
    begin = end;
  }
}

std::vector<GridRun> PointGrid::pieces(float length) const {
  std::vector<GridRun> pieces;
  for (const Slot& slot : slots_)
    for (std::uint32_t begin = slot.rod.begin, end = begin; begin < slot.rod.end; begin = end) {
      do ++end;
      while (end < slot.rod.end && x_[end] - x_[begin] <= length);
      pieces.push_back({begin, end});
    }
  return pieces;
}

GridRun PointGrid::find(std::int64_t y, std::int64_t z) const {
  if (y < 0 || z < 0) return {};
  const std::uint64_t key = key_of(y, z);
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t at = scatter(key, mask); slots_[at].rod.end != 0; at = (at + 1) & mask)
    if (slots_[at].key == key) return slots_[at].rod;
  return {};
}

}  // namespace posevote::geometry
