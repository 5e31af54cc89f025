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
#include <bit>
#include <cmath>
#include <cstdint>

namespace posevote::density {

/// Kernel bandwidths, which are also the cut-off radii.
struct Bandwidth {
  float sigma_t = 0.01F;       ///< [m]
  float sigma_r = 0.3926991F;  ///< [rad], 22.5 deg; at most 90 deg
};

/// A pose as the kernel sees it.
struct VotePoint {
  float tx, ty, tz, qw, qx, qy, qz;
};

/// Weights are whole multiples of 2^-22: sums of them in integers or doubles are exact and do not
/// depend on their order.
constexpr std::uint32_t kWeightUnits = 1U << 22U;

constexpr std::uint32_t kMantissa = (1U << 23U) - 1;  // of a float's bits

/// A sum of weights that was made in units.
inline double density_of(std::uint64_t units) { return static_cast<double>(units) / kWeightUnits; }

/// Constants of the kernel for one bandwidth.
struct Kernel {
  float max_dt2;         ///< sigma_t^2
  float max_e2;          ///< squared chord of an angle of sigma_R
  float min_cosine;      ///< between quaternions that may be that near; a trifle less
  float per_dt2;         ///< 1 / sigma_t^2
  float translation[5];  ///< 2^22 exp(-d_t^2 / 2 sigma_t^2) as a polynomial in (d_t / sigma_t)^2
  float rotation[5];     ///< exp(-d_R^2 / 2 sigma_R^2) as one in the squared chord
};

Kernel make_kernel(Bandwidth bandwidth);

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

/// a[0] + a[1] x + ... + a[4] x^4
inline float polynomial(const float (&a)[5], float x) {
  const float x2 = x * x;
  return (a[0] + a[1] * x) + ((a[2] + a[3] * x) + a[4] * x2) * x2;
}

constexpr float kWholeNumbers = 1U << 23U;  // from here to twice that, floats are whole numbers

/// The weight of a neighbour, in units: the mantissa of a float that is a whole number.
inline std::uint32_t weight_units(const Kernel& k, float dt2, float e2) {
  const float units = polynomial(k.translation, dt2 * k.per_dt2) * polynomial(k.rotation, e2);
  return std::bit_cast<std::uint32_t>(units + kWholeNumbers) & kMantissa;
}

/// The weight of b in the density at a, in units; 0 if b is not a neighbour of a. Symmetric, and
/// the same bits whatever the signs of the quaternions.
inline std::uint32_t kernel_units(const Kernel& k, const VotePoint& a, const VotePoint& b) {
  const float dt2 = squared_distance(a, b);
  const float e2 = std::min(squared_chord(a, b, 1), squared_chord(a, b, -1));
  if (!(dt2 <= k.max_dt2 && e2 <= k.max_e2)) return 0;
  return weight_units(k, dt2, e2);
}

/// Whether a vote can take part: everything finite, the quaternion of unit length to 1e-5, and no
/// farther out than a float can tell neighbours apart. Other votes are nobody's neighbours.
inline bool is_usable(const VotePoint& v, Bandwidth bandwidth) {
  const float norm2 = (v.qw * v.qw + v.qx * v.qx) + (v.qy * v.qy + v.qz * v.qz);
  const float farthest = std::max({std::abs(v.tx), std::abs(v.ty), std::abs(v.tz)});
  const bool finite = std::isfinite(v.tx) && std::isfinite(v.ty) && std::isfinite(v.tz);
  return finite && std::abs(norm2 - 1) <= 2e-5F && farthest <= bandwidth.sigma_t * 1e9F;
}

}  // namespace posevote::density
