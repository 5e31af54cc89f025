// SPDX-License-Identifier: BSD-3-Clause
// The inner loops of exact matching, with the widest vector instructions of the processor they run
// on.
#pragma once

#include <cstddef>
#include <cstdint>

namespace posevote::descriptors {

/// Rows of a panel and queries of a tile: what the registers of score_panel hold.
inline constexpr std::size_t kPanelRows = 32;
inline constexpr std::size_t kTileQueries = 4;

/// Two neighbouring numbers of a descriptor, as whole multiples of a step.
struct Pair {
  std::int16_t first = 0, second = 0;
};

/// scores[q * stride + r] = half_norms[r] - factors[q] * sum over k of the inner products of
/// queries[k * kTileQueries + q] and panel[k * kPanelRows + r] for all q < kTileQueries, r <
/// kPanelRows. Whole numbers take half the time of floats; no sum may leave 32 bits. `panel` is
/// aligned to 64 bytes. How a score rounds depends on the processor: to be used within an error
/// bound only.
void score_panel(const Pair* queries, const float* factors, const Pair* panel, std::size_t pairs,
                 const float* half_norms, float* scores, std::size_t stride);

/// What may be read behind the last of the scores, and written behind what is found.
inline constexpr std::size_t kKernelPadding = 16;

/// The second lowest of the scores (of two equal ones, both); infinity if there is but one. Not a
/// number if any is not.
float second_lowest(const float* scores, std::size_t count);

/// Writes the places of the scores that are not above the limit (so that what is not a number
/// counts too), in ascending order, and returns how many they are. `places` has room for `count`
/// and kKernelPadding.
std::size_t find_low(const float* scores, std::size_t count, float limit, std::uint32_t* places);

/// What multiply() takes at a time: vectors, and columns.
inline constexpr std::size_t kTileVectors = 4;
inline constexpr std::size_t kColumnStep = 8;

/// products[v * columns + j] = sum over k of vectors[k * kTileVectors + v] * matrix[k * columns +
/// j] for all v < kTileVectors; `columns` is a multiple of kColumnStep. Rounds as the processor
/// does it.
void multiply(const double* vectors, const double* matrix, std::size_t dimension,
              std::size_t columns, double* products);

/// |a - b|^2 in double: sixteen sums, over every sixteenth column, and their sum. The same bits on
/// every processor.
double squared_distance(const float* a, const float* b, std::size_t dimension);

}  // namespace posevote::descriptors
