// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/density/vote_section.hpp"

#include <algorithm>

namespace posevote::density {

void add_blocks(IndexRange votes, std::vector<IndexRange>& blocks) {
  if (votes.begin >= votes.end) return;
  IndexRange added{votes.begin / kBlock, (votes.end + kBlock - 1) / kBlock};
  if (!blocks.empty()) added.begin = std::max(added.begin, blocks.back().end);
  if (added.begin >= added.end) return;
  if (!blocks.empty() && added.begin == blocks.back().end)
    blocks.back().end = added.end;
  else
    blocks.push_back(added);
}

void VoteSection::sort(const std::vector<RotationCode>& codes, std::uint32_t per_axis,
                       std::vector<std::uint32_t>& places) {
  per_axis_ = per_axis;
  // Counting sort; begin is kept one cell ahead, so that filling leaves it where it belongs.
  begin_.assign(kCharts * per_axis * per_axis * per_axis + 2, 0);
  places.resize(codes.size());
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const RotationCode code = codes[i];
    places[i] = cell(chart_of(code), coarse((code >> 16U) & 255U), coarse((code >> 8U) & 255U),
                     coarse(code & 255U));
    ++begin_[places[i] + 2];
  }
  begin_[0] = begin_[1] = votes_.begin;
  for (std::size_t c = 2; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
  for (std::uint32_t& place : places) place = begin_[place + 1]++;
  begin_.pop_back();
}

void VoteSection::add_rows(const RotationBox& box, std::uint32_t from,
                           std::vector<IndexRange>& blocks) const {
  const std::uint32_t a_end = coarse(box.high[0]) + 1, b_end = coarse(box.high[1]) + 1;
  const std::uint32_t b_begin = coarse(box.low[1]), c_begin = coarse(box.low[2]);
  const std::uint32_t length = coarse(box.high[2]) + 1 - c_begin;
  for (std::uint32_t a = coarse(box.low[0]); a < a_end; ++a) {
    const std::uint32_t* row = &begin_[cell(box.chart, a, b_begin, c_begin)];
    for (std::uint32_t b = b_begin; b < b_end; ++b, row += per_axis_) {
      const std::uint32_t begin = std::max(row[0], from);
      if (begin < row[length]) add_blocks({begin, row[length]}, blocks);
    }
  }
}

}  // namespace posevote::density
