// SPDX-License-Identifier: BSD-3-Clause
// The inner loop of exact matching: dot products of a few queries with a panel of descriptors, with
// the widest vector instructions of the processor it runs on. How the sums round depends on that
// processor, so callers may only use the products to find candidates, within an error bound.
#pragma once

#include <cstddef>

namespace posevote {

/// Rows of a panel and queries of a tile: what the registers of the kernel hold.
inline constexpr std::size_t kPanelRows = 32;
inline constexpr std::size_t kTileQueries = 6;

/// products[q * stride + r] = sum over k of queries[k * kTileQueries + q] * panel[k * kPanelRows +
/// r] for all q < kTileQueries, r < kPanelRows. `panel` is aligned to 64 bytes.
void multiply_panel(const float* queries, const float* panel, std::size_t dimension,
                    float* products, std::size_t stride);

}  // namespace posevote
