// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "tools/sweep/sweep.hpp"

namespace posevote::sweep {
namespace {

/// The counts of each image, in the order of their keys.
std::vector<Counts> split_by_image(const Evaluation& evaluation, std::size_t rule,
                                   const std::vector<FoundInstance>& found,
                                   const std::set<layouts::ImageKey>& images) {
  std::map<layouts::ImageKey, Counts> counts;
  for (const layouts::ImageKey& key : images) counts[key];
  for (const InstanceResult& instance : evaluation.instances) {
    if (!instance.counted || std::isnan(instance.met[rule])) continue;
    Counts& image = counts.at({instance.scene_id, instance.im_id});
    ++image.instances;
    image.correct += instance.met[rule];
  }
  for (const Verdict& verdict : evaluation.all[rule].verdicts) {
    const FoundInstance& one = found.at(static_cast<std::size_t>(verdict.line - 1));
    counts.at({one.scene_id, one.im_id}).detections +=
        verdict.score >= evaluation.options.min_score;
  }
  std::vector<Counts> list;
  for (const auto& [key, image] : counts) list.push_back(image);
  return list;
}

}  // namespace

std::vector<Judged> judge(const layouts::GroundTruth& truth, const EvaluateOptions& options,
                          const std::vector<Setting>& settings,
                          const std::set<layouts::ImageKey>& images, std::uint64_t seed) {
  const std::vector<Rule> rules = choose_rules(options.rules);
  std::vector<std::vector<std::vector<Counts>>> counts(rules.size());  // by setting, image
  for (const Setting& setting : settings) {
    const Evaluation evaluation = evaluate(truth, setting.found, options);
    for (std::size_t r = 0; r < rules.size(); ++r)
      counts[r].push_back(split_by_image(evaluation, r, setting.found, images));
  }
  std::vector<Judged> judged;
  for (std::size_t r = 0; r < rules.size(); ++r) {
    Judged& rule = judged.emplace_back(Judged{rules[r], {}, {}, 0});
    const Figure figure = figure_of(rules[r]);
    for (const auto& of_images : counts[r]) rule.counts.push_back(total_of(of_images));
    const auto best = std::max_element(
        rule.counts.begin(), rule.counts.end(),
        [&](const Counts& a, const Counts& b) { return (a.*figure)() < (b.*figure)(); });
    rule.best = static_cast<std::size_t>(best - rule.counts.begin());
    rule.certainty = bootstrap(counts[r], rule.best, figure, seed);
  }
  return judged;
}

}  // namespace posevote::sweep
