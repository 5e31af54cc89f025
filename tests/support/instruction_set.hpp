// SPDX-License-Identifier: BSD-3-Clause
// Runs Highway's kernels on one instruction set, until it goes out of scope.
#pragma once

#include <hwy/targets.h>

#include <cstdint>
#include <vector>

namespace posevote::test {

inline std::vector<std::int64_t> instruction_sets() {
  return {HWY_AVX3, HWY_AVX2, HWY_SSE4, HWY_SSSE3};
}

class OnInstructionSet {
 public:
  /// Falsy where the processor lacks it.
  explicit OnInstructionSet(std::int64_t target) : there_((hwy::SupportedTargets() & target) != 0) {
    if (there_) use(target);
  }
  ~OnInstructionSet() { use(0); }
  OnInstructionSet(const OnInstructionSet&) = delete;
  OnInstructionSet& operator=(const OnInstructionSet&) = delete;

  explicit operator bool() const { return there_; }

 private:
  static void use(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  bool there_;
};

}  // namespace posevote::test
