// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/describe/point_pair_histogram.hpp"

#include <algorithm>
#include <cmath>

namespace posevote {
namespace {

/// Not Eigen's own, which starts from the processor's estimate and so differs between makes.
template <class Values>
auto root(const Values& values) {
  return values.unaryExpr([](float value) { return std::sqrt(value); });
}

/// The angle of a cosine, over pi: Abramowitz and Stegun 4.4.45, at most 7e-5 rad off. The cosine
/// may have rounded beyond one.
template <class Block>
Block angle_over_pi(const Block& cosine) {
  const Block c = cosine.abs().min(1.0F);
  const Block acute =
      root(1.0F - c) * (1.5707288F + c * (-0.2121144F + c * (0.0742610F - c * 0.0187293F)));
  constexpr float kOverPi = 0.318309886F;
  return (cosine < 0.0F).select(1.0F - kOverPi * acute, kOverPi * acute);
}

}  // namespace

PointPairHistogram::PointPairHistogram(const Eigen::Vector3f& normal, float radius)
    : normal_(normal), bins_per_metre_(static_cast<float>(kDistanceBins) / radius) {}

void PointPairHistogram::flush() {
  const auto x = offsets_.col(0), y = offsets_.col(1), z = offsets_.col(2);
  const auto nx = normals_.col(0), ny = normals_.col(1), nz = normals_.col(2);
  const Block distance = root(x * x + y * y + z * z).max(1e-20F);
  const Block cos_first = (x * normal_[0] + y * normal_[1] + z * normal_[2]) / distance;
  const Block cos_second = (x * nx + y * ny + z * nz) / distance;
  const Block cos_normals = nx * normal_[0] + ny * normal_[1] + nz * normal_[2];
  // The second normal against (d x n) / |d x n|, the direction around the first normal.
  const Block triple = (y * normal_[2] - z * normal_[1]) * nx +
                       (z * normal_[0] - x * normal_[2]) * ny +
                       (x * normal_[1] - y * normal_[0]) * nz;
  const Block sine = root((1.0F - cos_first * cos_first).max(1e-12F));
  scatter(distance * bins_per_metre_,
          {angle_over_pi(cos_first), angle_over_pi(cos_second), angle_over_pi(cos_normals),
           angle_over_pi<Block>(triple / (distance * sine))});
  filled_ = 0;
}

void PointPairHistogram::scatter(const Block& distance, const std::array<Block, kAngles>& angles) {
  for (int i = 0; i < filled_; ++i) {
    // Bin centres lie at half numbers; with the margin, the lower of two bins is the whole part.
    const float row_position = distance[i] + 0.5F;
    const int row = std::min(static_cast<int>(row_position), kDistanceBins);
    const float far = row_position - static_cast<float>(row);
    for (std::size_t a = 0; a < kAngles; ++a) {
      const float position = angles[a][i] * static_cast<float>(kAngleBins) + 0.5F;
      const int column = std::min(static_cast<int>(position), kAngleBins);
      const float up = position - static_cast<float>(column);
      float* near_bin = &bins_[row][a][column];
      float* far_bin = &bins_[row + 1][a][column];
      near_bin[0] += (1 - far) * (1 - up);
      near_bin[1] += (1 - far) * up;
      far_bin[0] += far * (1 - up);
      far_bin[1] += far * up;
    }
  }
}

void PointPairHistogram::write(float* descriptor) {
  flush();
  for (std::size_t a = 0; a < kAngles; ++a) {
    for (int column = 0; column < kColumns; ++column) {
      bins_[1][a][column] += bins_[0][a][column];
      bins_[kDistanceBins][a][column] += bins_[kDistanceBins + 1][a][column];
    }
    for (int row = 0; row < kDistanceBins; ++row) {
      Eigen::Map<Eigen::Array<float, kAngleBins, 1>> out(descriptor);
      float* bins = bins_[row + 1][a];
      bins[1] += bins[0];
      bins[kAngleBins] += bins[kAngleBins + 1];
      out = Eigen::Map<const Eigen::Array<float, kAngleBins, 1>>(bins + 1);
      // An annulus of a plane holds points in proportion to its radius: so much its row may weigh.
      const float weight = (static_cast<float>(row) + 0.5F) / static_cast<float>(kDistanceBins);
      // One pair more than there is keeps a row that a pair hardly touches from counting in full.
      out = root(out * (weight / (out.sum() + 1)));
      descriptor += kAngleBins;
    }
  }
}

}  // namespace posevote
