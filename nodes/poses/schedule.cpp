// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/schedule.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>

#include "graph/parallel.hpp"
#include "nodes/poses/confidence.hpp"
#include "nodes/poses/pool.hpp"
#include "nodes/poses/refinement.hpp"
#include "nodes/poses/score.hpp"

namespace posevote::poses {

namespace {

/// How many of a sorted pool, `most` at most, have so much of the best one's rank.
std::size_t count_near_best(const Candidates& pool, double share, std::size_t most) {
  const auto is_behind = [&](const Candidate& one) { return one.rank < share * pool[0].rank; };
  const auto end = std::find_if(pool.begin(), pool.end(), is_behind);
  return std::min(static_cast<std::size_t>(end - pool.begin()), most);
}

}  // namespace

void judge_part(const Sought& sought, Candidates& pool, std::size_t begin, std::size_t end,
                const Closeness& look) {
  graph::parallel_for(end - begin, 1, [&](std::size_t i) { judge(sought, pool[begin + i], look); });
  sort_by_rank(pool.begin(), pool.begin() + static_cast<std::ptrdiff_t>(end));
}

void make_shortlist(const Sought& sought, Candidates& pool, int places) {
  if (pool.size() <= static_cast<std::size_t>(places)) return;
  const Closeness glance{{sought.terms.schedule.glance_points}, sought.terms.schedule.glance_reach};
  graph::parallel_for(pool.size(), 1, [&](std::size_t i) {
    pool[i].fit = measure(sought, pool[i].T_scene_model, glance);
    grade_at_a_glance(sought, pool[i]);
  });
  sort_by_rank(pool.begin(), pool.end());
  pool.resize(count_near_best(pool, sought.terms.schedule.sketch_hopeless,
                              static_cast<std::size_t>(places)));
}

void sketch(const Sought& sought, Candidates& pool, const Improve& improve) {
  graph::parallel_for(pool.size(), 1, [&](std::size_t i) {
    propose_as(sought, improve(pool[i].proposed), pool[i]);
  });
  judge_part(sought, pool, 0, pool.size(), {{sought.terms.schedule.sketch_points}});
}

void bring_closer(const Sought& sought, Candidates& pool) {
  if (!sought.params.refine) return;
  const ScheduleTerms& terms = sought.terms.schedule;
  const std::size_t count =
      count_near_best(pool, terms.closer_hopeless, static_cast<std::size_t>(terms.promising));
  graph::parallel_for(count, 1, [&](std::size_t i) { take_first_steps(sought, pool[i]); });
  judge_part(sought, pool, 0, count, {{terms.sketch_points}});
  sort_by_rank(pool.begin(), pool.end());
}

void bring_finalists_forward(const Sought& sought, Candidates& pool) {
  const auto finalists = static_cast<std::size_t>(sought.terms.schedule.finalists);
  const std::size_t batch = 2 * finalists;
  for (std::size_t done = 0; done < pool.size();) {
    const std::size_t end = std::min(done + batch, pool.size());
    judge_part(sought, pool, done, end, {{sought.terms.schedule.look_points}});
    done = end;
    if (done < pool.size() && pool[finalists - 1].rank >= pool[done].rank) break;
  }
  std::erase_if(pool, [](const Candidate& candidate) { return candidate.quality == 0; });
}

bool may_win(const Sought& sought, const Candidate& candidate) {
  return first_log_odds(candidate, sought.terms) >= sought.terms.schedule.hopeless_odds;
}

Candidates::iterator refine_best(const Sought& sought, Candidates& sorted) {
  const ScheduleTerms& terms = sought.terms.schedule;
  const auto is_hopeless = [&](const Candidate& candidate) {
    return candidate.rank < terms.hopeless * sorted[0].rank ||
           candidate.quality < terms.hopeless * sought.params.min_score;
  };
  auto end = std::find_if(sorted.begin(), sorted.end(), is_hopeless);
  if (end == sorted.begin()) return end;
  end = std::stable_partition(std::next(sorted.begin()), end, [&](const Candidate& candidate) {
    return may_win(sought, candidate);
  });
  const auto count = std::min<std::ptrdiff_t>(end - sorted.begin(), terms.finalists);
  graph::parallel_for(static_cast<std::size_t>(count), 1,
                      [&](std::size_t i) { refine(sought, sorted[i]); });
  return sorted.begin() + count;
}

}  // namespace posevote::poses
