// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explain/explain.hpp"

#include <algorithm>
#include <stdexcept>

#include "nodes/geometry/extent.hpp"
#include "tools/explain/attempts.hpp"
#include "tools/explain/best_candidate.hpp"
#include "tools/explain/sentences.hpp"

namespace posevote::explain {
namespace {

/// The numbers of the objects that are asked for, in the library's order.
std::vector<std::size_t> wanted_objects(const ModelLibrary& library, const std::string& wanted) {
  std::vector<std::size_t> chosen;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < library.models.size(); ++i) {
    const Model& model = *library.models[i];
    names.push_back(model.name);
    if (wanted.empty() || wanted == model.name || wanted == std::to_string(model.obj_id))
      chosen.push_back(i);
  }
  if (!chosen.empty()) return chosen;
  for (const LeftOutModel& model : library.left_out)
    if (wanted == model.name || wanted == std::to_string(model.obj_id)) return {};
  const std::string near = graph::closest_name(wanted, names);
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  throw std::invalid_argument(
      "--object " + wanted + ": no such model in the run" +
      (near.empty() ? ", expected one of " + all : ", did you mean '" + near + "'?"));
}

/// Of an object that was not sought.
Explained without_search(const std::string& model, int obj_id, const Verdict& verdict) {
  Explained one;
  one.model = model;
  one.obj_id = obj_id;
  one.verdict = one.guess = verdict;
  one.sentences = sentences(one, {});
  return one;
}

class Explainer {
 public:
  Explainer(const Taps& taps, const Request& request)
      : taps_(taps),
        request_(request),
        search_(taps, taps.run.segmentation()),
        bench_(taps, search_) {}

  std::vector<Explained> object(std::size_t i) const {
    std::vector<Explained> all;
    std::vector<Eigen::Isometry3d> truth = true_poses(i);
    for (const poses::Instance& one : search_.instances().found) {
      if (one.object != i) continue;
      const Alike alike(model(i), one.candidate.T_scene_model);
      const auto same = std::find_if(truth.begin(), truth.end(),
                                     [&](const auto& pose) { return alike.is_near(pose); });
      if (!request_.is_of_misses)
        all.push_back(
            found(i, one.candidate.T_scene_model, same == truth.end() ? nullptr : &*same));
      if (same != truth.end()) truth.erase(same);
    }
    // Where some were found, others are looked for if the object is asked for by name.
    const bool may_be_more = request_.truth.empty() && !request_.object.empty();
    if (!truth.empty() || (!request_.is_of_misses && (all.empty() || may_be_more)))
      add_missed(i, truth, all);
    for (Explained& one : all) conclude(i, one);
    return all;
  }

 private:
  const Model& model(std::size_t i) const { return *taps_.votes[i].model; }

  std::vector<Eigen::Isometry3d> true_poses(std::size_t i) const {
    const auto at = request_.truth.find(model(i).obj_id);
    return at == request_.truth.end() ? std::vector<Eigen::Isometry3d>{} : at->second;
  }

  Explained named(std::size_t i) const {
    Explained one;
    one.model = model(i).name;
    one.obj_id = model(i).obj_id;
    return one;
  }

  Explained found(std::size_t i, const Eigen::Isometry3d& pose,
                  const Eigen::Isometry3d* truth) const {
    Explained one = named(i);
    one.is_found = true;
    one.best = bench_.stand(i, pose);
    one.best_is_true = truth != nullptr;
    if (truth) one.truth = bench_.stand(i, *truth);
    return one;
  }

  /// Those that the true poses tell, each with the candidate that is it, or else the likeliest that
  /// is none of the others; and, where nothing tells how many there are, those that may be.
  void add_missed(std::size_t i, const std::vector<Eigen::Isometry3d>& truth,
                  std::vector<Explained>& all) const {
    std::vector<Eigen::Isometry3d> candidates = best_candidates(bench_, i);
    std::vector<std::optional<Eigen::Isometry3d>> best(truth.size());
    for (std::size_t t = 0; t < truth.size(); ++t) {
      const Alike alike(model(i), truth[t]);
      const auto same = std::find_if(candidates.begin(), candidates.end(),
                                     [&](const auto& pose) { return alike.is_near(pose); });
      if (same == candidates.end()) continue;
      best[t] = *same;
      candidates.erase(same);
    }
    for (std::size_t t = 0; t < truth.size(); ++t) {
      if (!best[t] && !candidates.empty()) {
        best[t] = candidates.front();
        candidates.erase(candidates.begin());
      }
      all.push_back(missed(i, best[t], &truth[t]));
    }
    if (!truth.empty()) return;
    if (candidates.empty() && all.empty()) all.push_back(missed(i, std::nullopt, nullptr));
    for (const Eigen::Isometry3d& pose : candidates) {
      const bool is_one_more = !all.empty();
      all.push_back(missed(i, pose, nullptr));
      all.back().is_one_more = is_one_more;
    }
  }

  Explained missed(std::size_t i, const std::optional<Eigen::Isometry3d>& best,
                   const Eigen::Isometry3d* truth) const {
    Explained one = named(i);
    if (best) one.best = bench_.stand(i, *best);
    if (!truth) return one;
    one.truth = bench_.stand(i, *truth);
    if (one.best) one.best_is_true = Alike(model(i), *truth).is_near(one.best->T_scene_model);
    return one;
  }

  /// Median of the other objects' diagonals [m]; 0 where there are none.
  double usual_size(std::size_t i) const {
    std::vector<double> others;
    for (std::size_t j = 0; j < taps_.votes.size(); ++j)
      if (j != i) others.push_back(static_cast<double>(model(j).diagonal));
    if (others.empty()) return 0;
    std::nth_element(others.begin(),
                     others.begin() + static_cast<std::ptrdiff_t>(others.size() / 2), others.end());
    return others[others.size() / 2];
  }

  void conclude(std::size_t i, Explained& one) const {
    Case of;
    of.is_found = one.is_found;
    of.diagonal = static_cast<double>(model(i).diagonal);
    of.scan_size = geometry::robust_diagonal(taps_.cloud->points, 0.02);
    of.usual_size = usual_size(i);
    of.resolution = static_cast<double>(taps_.scale.resolution);
    of.matches = taps_.correspondences[i].scene_feature.size();
    of.min_confidence = bench_.params.min_confidence;
    of.min_score = bench_.params.min_score;
    of.overlap = bench_.params.overlap;
    of.nms_radius = bench_.params.nms * of.diagonal;
    of.pose = one.best;
    one.guess = judge_case(of);
    if (one.truth) {
      // Of two starts for ICP at the true place, the one that ends better.
      if (!one.best_is_true || one.truth->sureness() > one.best->sureness()) of.pose = one.truth;
      of.is_true = true;
    }
    of.is_absent = !one.is_found && !one.truth && !request_.truth.empty();
    one.verdict = judge_case(of);
    if (request_.attempt && !one.is_found) one.attempts = attempt(one, taps_);
    one.sentences = sentences(one, of);
  }

  const Taps& taps_;
  const Request& request_;
  const SearchWatch search_;
  const Bench bench_;
};

}  // namespace

Explanation explain(const Run& run, const std::string& scene, const Request& request) {
  Explanation explanation;
  explanation.frame = find_frame(run.frames, scene, run.out);
  const std::vector<std::size_t> wanted = wanted_objects(*run.library, request.object);
  if (explanation.frame.failure.empty()) {
    const auto taps = std::make_shared<const Taps>(run, explanation.frame);
    explanation.taps = taps;
    explanation.sentences = scan_sentences(taps->figures, taps->warnings);
    const Explainer explainer(*taps, request);
    for (const std::size_t i : wanted)
      for (Explained& one : explainer.object(i)) explanation.objects.push_back(std::move(one));
  } else {
    explanation.sentences = {"The scan failed in " + explanation.frame.failed_node + ": " +
                             explanation.frame.failure + "."};
    for (const std::size_t i : wanted)
      explanation.objects.push_back(without_search(
          run.library->models[i]->name, run.library->models[i]->obj_id,
          {Cause::kScanFailed, explanation.frame.failed_node, explanation.frame.failure}));
  }
  for (const LeftOutModel& model : run.library->left_out)
    if (request.object.empty() || request.object == model.name ||
        request.object == std::to_string(model.obj_id))
      explanation.objects.push_back(
          without_search(model.name, model.obj_id, {Cause::kLeftOut, "", model.why}));
  return explanation;
}

}  // namespace posevote::explain
