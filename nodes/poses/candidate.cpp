// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/candidate.hpp"

#include <algorithm>

namespace posevote::poses {

void sort_by_rank(Candidates::iterator begin, Candidates::iterator end) {
  std::stable_sort(begin, end,
                   [](const Candidate& a, const Candidate& b) { return a.rank > b.rank; });
}

}  // namespace posevote::poses
