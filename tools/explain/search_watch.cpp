// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explain/search_watch.hpp"

#include <algorithm>

namespace posevote::explain {
namespace {

Place place_in(const Step& step, const Alike& pose) {
  Place place{step.name, 0, step.candidates.size()};
  for (std::size_t i = 0; i < step.candidates.size(); ++i)
    if (pose.is_near(step.candidates[i].T_scene_model)) {
      place.place = i + 1;
      break;
    }
  return place;
}

}  // namespace

SearchWatch::SearchWatch(const Taps& taps, const poses::SegmentParams& params,
                         std::optional<std::size_t> only, const Prepare& prepare)
    : steps_(taps.votes.size()) {
  poses::ScanState scan(*taps.cloud, *taps.features, taps.scale.resolution, params.terms,
                        taps.votes.size());
  if (prepare) prepare(scan);
  std::vector<segment::LiveVotes> objects;
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < taps.votes.size(); ++i) {
    if (only && *only != i) continue;
    objects.push_back(segment::all_votes(taps.votes[i], taps.densities[i]));
    numbers.push_back(i);
  }
  std::vector<poses::ObjectSearch> searches;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    poses::Sought sought = segment::sought_for(objects[i], scan, params);
    sought.watch = [&steps = steps_[numbers[i]]](const char* step,
                                                 const poses::Candidates& candidates) {
      steps.push_back({step, candidates});
    };
    searches.emplace_back(sought, segment::propose_from(objects[i], scan, params.terms));
  }
  instances_ = poses::find_instances(searches, scan);
  for (auto* list : {&instances_.found, &instances_.rejected})
    for (poses::Instance& one : *list) one.object = numbers[one.object];
}

std::vector<Place> way_of(const std::vector<Step>& steps, const Alike& pose) {
  std::vector<Place> farthest, way;
  const auto keep_farther = [&] {
    const auto reached = [](const std::vector<Place>& places) {
      return places.size() - (!places.empty() && places.back().place == 0 ? 1 : 0);
    };
    if (farthest.empty() || reached(way) > reached(farthest)) farthest = way;
  };
  // A search goes on from an earlier step: with other finalists, or another look, or anew.
  const auto go_back_to = [&](const std::string& step) {
    const auto again = std::find_if(way.begin(), way.end(),
                                    [&](const Place& place) { return place.step == step; });
    if (again == way.end()) return;
    keep_farther();
    way.erase(again, way.end());
  };
  for (const Step& step : steps) {
    go_back_to(step.name);
    if (way.empty() || way.back().place > 0) way.push_back(place_in(step, pose));
  }
  keep_farther();
  return farthest;
}

}  // namespace posevote::explain
