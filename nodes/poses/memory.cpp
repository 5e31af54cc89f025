// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/memory.hpp"

#include <bit>

#include "nodes/data/splitmix64.hpp"

namespace posevote::poses {

std::size_t QuestionHash::operator()(const Question& question) const {
  std::uint64_t mixed = static_cast<std::uint64_t>(question.how);
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index k = 0; k < 4; ++k) {
      const double number = question.T_scene_model(i, k) + 0.0;  // -0 equals 0
      mixed = splitmix64(mixed ^ std::bit_cast<std::uint64_t>(number));
    }
  return static_cast<std::size_t>(mixed);
}

}  // namespace posevote::poses
