// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <hwy/aligned_allocator.h>

#include <cstddef>
#include <limits>

#include "nodes/density/scan_votes.hpp"

namespace posevote::density {

/// Votes as scan_votes reads them.
class VoteTable {
 public:
  /// What is in it is lost; the memory is kept.
  void resize(std::size_t count) {
    // No multiple of a page apart: the columns are read side by side.
    stride_ = (count + kScanPadding + 255) / 256 * 256 + 16;
    if (capacity_ >= kVoteColumns * stride_) return;
    capacity_ = kVoteColumns * stride_;
    buffer_ = hwy::AllocateAligned<float>(capacity_);
  }

  float* operator[](std::size_t column) { return buffer_.get() + column * stride_; }
  std::size_t stride() const { return stride_; }
  VoteColumns columns() const { return {buffer_.get(), stride_}; }

  /// Ends a table of `count` votes: what its last block holds beyond them is nobody's neighbour.
  void close(std::size_t count) {
    for (; count % kBlock != 0; ++count)
      for (std::size_t c = 0; c < kVoteColumns; ++c)
        (*this)[c][count] = c < 3 ? std::numeric_limits<float>::infinity() : 0;
  }

  VotePoint at(std::size_t i) const {
    const float* p = buffer_.get() + i;
    const std::size_t s = stride_;
    return {p[0], p[s], p[2 * s], p[3 * s], p[4 * s], p[5 * s], p[6 * s]};
  }

 private:
  hwy::AlignedFreeUniquePtr<float[]> buffer_;
  std::size_t capacity_ = 0, stride_ = 0;
};

}  // namespace posevote::density
