// SPDX-License-Identifier: BSD-3-Clause
// The kernel of the pose density (Buch et al. 2017, eq. 10) and the one test of membership:
//
//   |t - t'| <= sigma_t  and  d_R <= sigma_R:  weight exp(-d_t^2 / 2 sigma_t^2 - d_R^2 / 2
//   sigma_R^2)
//
// The kernel is cut where it still weighs 0.61 per factor, so a neighbour on the edge flips with
// the last bit of the distance. Everything here is float32 in one fixed order of operations,
// without fused multiply-add, and is mirrored operation for operation by the vector code in
// scan_votes.cpp.
//
// Rotations are compared by the chord of their unit quaternions, e = |q -+ q'| = 2 sin(d_R / 4),
// with the nearer sign (q and -q are one rotation). That is the test |<q, q'>| >= cos(sigma_R / 2)
// without its loss of digits near d_R = 0: a vote is at distance exactly 0 from itself.
//
// No header of Eigen or TBB here: this file is compiled for every instruction set.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace posevote {

/// Kernel bandwidths, which are also the cut-off radii.
struct Bandwidth {
  float sigma_t = 0.01F;       ///< [m]
  float sigma_r = 0.3926991F;  ///< [rad], 22.5 deg; at most 90 deg
};

/// A pose as the kernel sees it.
struct VotePoint {
  float tx, ty, tz, qw, qx, qy, qz;
};

/// Weights are whole multiples of 2^-25, as every float in [0.25, 1] is: sums of them in integers
/// or doubles are exact and do not depend on their order.
constexpr float kWeightUnits = 33554432.0F;  // 2^25

/// A sum of weights that was made in units.
inline double density_of(std::uint64_t units) {
  return static_cast<double>(units) / static_cast<double>(kWeightUnits);
}

/// Constants of the kernel for one bandwidth.
struct Kernel {
  float max_dt2;         ///< sigma_t^2
  float max_e2;          ///< squared chord of an angle of sigma_R
  float per_dt2;         ///< 1 / 2 sigma_t^2
  float angle[5];        ///< d_R^2 / 2 sigma_R^2 = e2 (angle[0] + angle[1] e2 + ...)
  float exponential[7];  ///< 2^25 exp(-s) = exponential[0] + exponential[1] s + ...
};

inline Kernel make_kernel(Bandwidth bandwidth) {
  // d_R^2 = 16 asin^2(e / 2) = 4 e^2 f(e^2). f interpolated at Chebyshev nodes for d_R in [0, 90
  // deg] (relative error 4e-8), exp(-s) for s in [0, 1.001] (2e-7); both exact at 0.
  constexpr double kAngle[5] = {1.0, 0.08333326273794667, 0.011114953390318313,
                                0.001753564978727432, 0.0004009569025188025};
  constexpr double kExponential[7] = {1.0,
                                      -0.9999999325189974,
                                      0.499995137435067,
                                      -0.16660946280932915,
                                      0.04141810017459775,
                                      -0.007836515671237025,
                                      0.0009121699318414514};
  Kernel kernel{};
  const double sigma_t = static_cast<double>(bandwidth.sigma_t);
  const double sigma_r = static_cast<double>(bandwidth.sigma_r);
  const double chord = 2 * std::sin(sigma_r / 4);
  kernel.max_dt2 = bandwidth.sigma_t * bandwidth.sigma_t;
  kernel.max_e2 = static_cast<float>(chord * chord);
  kernel.per_dt2 = static_cast<float>(1 / (2 * sigma_t * sigma_t));
  for (int i = 0; i < 5; ++i)
    kernel.angle[i] = static_cast<float>(4 * kAngle[i] / (2 * sigma_r * sigma_r));
  for (int i = 0; i < 7; ++i)
    kernel.exponential[i] = static_cast<float>(kExponential[i]) * kWeightUnits;
  return kernel;
}

/// Squared distance of the translations.
inline float squared_distance(const VotePoint& a, const VotePoint& b) {
  const float dx = a.tx - b.tx;
  const float dy = a.ty - b.ty;
  const float dz = a.tz - b.tz;
  return (dx * dx + dy * dy) + dz * dz;
}

/// Squared chord between the quaternion of a and `sign` (1 or -1) times that of b.
inline float squared_chord(const VotePoint& a, const VotePoint& b, float sign) {
  const float dw = a.qw - sign * b.qw;
  const float dx = a.qx - sign * b.qx;
  const float dy = a.qy - sign * b.qy;
  const float dz = a.qz - sign * b.qz;
  return (dw * dw + dx * dx) + (dy * dy + dz * dz);
}

/// The weight of a neighbour, in units of 2^-25.
inline float weight_units(const Kernel& k, float dt2, float e2) {
  float s = k.angle[4];
  for (int i = 3; i >= 0; --i) s = s * e2 + k.angle[i];
  s = s * e2 + dt2 * k.per_dt2;
  float units = k.exponential[6];
  for (int i = 5; i >= 0; --i) units = units * s + k.exponential[i];
  return units;
}

/// The weight of b in the density at a, in units of 2^-25; 0 if b is not a neighbour of a.
/// Symmetric, and the same bits whatever the signs of the quaternions.
inline std::uint32_t kernel_units(const Kernel& k, const VotePoint& a, const VotePoint& b) {
  const float dt2 = squared_distance(a, b);
  const float e2 = std::min(squared_chord(a, b, 1), squared_chord(a, b, -1));
  if (!(dt2 <= k.max_dt2 && e2 <= k.max_e2)) return 0;
  return static_cast<std::uint32_t>(weight_units(k, dt2, e2));
}

/// Whether a vote can take part: everything finite, the quaternion of unit length to 1e-5, and no
/// farther out than a float can tell neighbours apart. Other votes are nobody's neighbours.
inline bool is_usable(const VotePoint& v, Bandwidth bandwidth) {
  const float norm2 = (v.qw * v.qw + v.qx * v.qx) + (v.qy * v.qy + v.qz * v.qz);
  const float farthest = std::max({std::abs(v.tx), std::abs(v.ty), std::abs(v.tz)});
  const bool finite = std::isfinite(v.tx) && std::isfinite(v.ty) && std::isfinite(v.tz);
  return finite && std::abs(norm2 - 1) <= 2e-5F && farthest <= bandwidth.sigma_t * 1e9F;
}

}  // namespace posevote
