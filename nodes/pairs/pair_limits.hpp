// SPDX-License-Identifier: BSD-3-Clause
// Numbers that pair_key.hpp, local_frame.hpp and the kernel pairs_around.cpp share. No header of
// Eigen here, as in grid_run.hpp.
#pragma once

namespace posevote::pairs {

inline constexpr double kPi = 3.14159265358979323846;

/// Angles are told by their cosines, in steps of one over so many from -1 on.
inline constexpr int kCosineSteps = 1024;

// A pair in one plane has no bin.
inline constexpr float kInPlane = 0.15F;     ///< 9 deg
inline constexpr float kSameNormal = 0.96F;  ///< 16 deg

/// Arc tangent of up to one, to 2e-4 rad (Hastings 1955): t + t (-a0 t^2 + a1 t^4 + a2 t^6)
inline constexpr float kTurnSeries[3] = {0.327622764F, 0.15931422F, -0.0464964749F};

}  // namespace posevote::pairs
