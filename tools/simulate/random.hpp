// SPDX-License-Identifier: BSD-3-Clause
// Random numbers that are the same on every machine and in every order of work. The standard
// library's distributions are not: each implementation has its own.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>

namespace posevote {

/// splitmix64 (Steele, Lea, Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// A stream of its own for part `part` (a pixel, a body) of what `seed` stands for.
  Random(std::uint64_t seed, std::uint64_t part) : state_(Random(seed).next() ^ part) {
    state_ = next();
  }

  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15U;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31U);
  }
  /// In [0, 1).
  double uniform() { return static_cast<double>(next() >> 11U) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Mean 0, deviation 1: the sum of twelve uniforms. Additions only, so the bits do not depend on
  /// a mathematics library; the tails end at 6 deviations.
  double normal() {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += uniform();
    return sum;
  }
  /// Uniform over the unit sphere.
  Eigen::Vector3d direction();
  /// Uniform over all rotations.
  Eigen::Quaterniond rotation();

 private:
  std::uint64_t state_;
};

}  // namespace posevote
