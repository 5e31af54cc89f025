// SPDX-License-Identifier: BSD-3-Clause
// Puts the features of all octaves of a scan together, so that all of them vote, and passes on the
// finest cloud, by which poses are judged. Fails where no octave has a feature, unless there may be none.
//
//   join_octaves: {in: [scene_clouds, octave_features, octaves], out: [scene_cloud, scene_features]}
#include <memory>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "graph/registry.hpp"
#include "nodes/descriptors/octaves.hpp"

namespace posevote::describe {
namespace {

struct Params {
  bool may_be_none = false;
};

std::tuple<std::shared_ptr<const Cloud>, FeatureSet> join_octaves(
    const PerObject<Cloud>& clouds, const PerObject<FeatureSet>& features,
    const PerObject<Scale>& octaves, const Params& params) {
  if (clouds.slots.empty()) throw std::runtime_error("there are no octaves");
  std::vector<Scale> scales;
  for (const auto& slot : octaves.slots) scales.push_back(*slot);
  FeatureSet all = descriptors::stack_octaves(features.slots, scales);
  if (all.points.rows() == 0 && !params.may_be_none)
    throw std::runtime_error(
        "no feature point of the scan has enough neighbours and a normal to be described");
  return {clouds.slots[0], std::move(all)};
}

const auto registered =
    graph::register_node("join_octaves", join_octaves,
                         "The features of all octaves of a scan, and its finest cloud.")
        .input("scene_clouds")
        .input("octave_features")
        .input("octaves")
        .output("scene_cloud")
        .output("scene_features")
        .param("may_be_none", &Params::may_be_none, "",
               "Whether a scan without a feature passes: of a stream, in which nothing may be left "
               "to search.");

}  // namespace
}  // namespace posevote::describe
