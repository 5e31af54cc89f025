// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/random.hpp"

#include <cmath>

namespace posevote {

Eigen::Vector3d Random::direction() {
  Eigen::Vector3d v;
  do {
    for (int axis = 0; axis < 3; ++axis) v[axis] = uniform(-1, 1);
  } while (v.squaredNorm() > 1 || v.squaredNorm() < 1e-4);
  return v.normalized();
}

Eigen::Quaterniond Random::rotation() {
  Eigen::Vector4d v;  // uniform in the 4-ball
  do {
    for (int axis = 0; axis < 4; ++axis) v[axis] = uniform(-1, 1);
  } while (v.squaredNorm() > 1 || v.squaredNorm() < 1e-4);
  return Eigen::Quaterniond(v.normalized());
}

}  // namespace posevote
