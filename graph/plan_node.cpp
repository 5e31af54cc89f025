// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <tuple>

#include "graph/did_you_mean.hpp"
#include "graph/planner.hpp"
#include "graph/plugin.hpp"

namespace posevote::graph {
namespace {

using Named = const std::pair<const std::string, Setting>*;

const NodeSpec* find_type(const NodeDescription& node, std::vector<Problem>& problems) {
  const NodeSpec* spec = find_node(node.type);
  if (spec || !node.like.empty()) return spec;  // resolve_likes or the original reports
  problems.push_back({node.where, node.name, unknown_node(node.type)});
  return nullptr;
}

std::string unknown_parameter(const NodeSpec& spec, const std::string& key) {
  std::vector<std::string> known;
  for (const ParamSpec& param : spec.params) known.push_back(param.name);
  const std::string near = did_you_mean(key, known);
  if (!near.empty()) return "unknown parameter" + near;
  return "unknown parameter, `posevote nodes " + spec.name + "` lists what there is";
}

/// Nothing if it went well, else what is wrong.
std::optional<std::string> set(const NodeSpec& spec, void* params, const std::string& key,
                               const Setting& setting) {
  const auto param = std::find_if(spec.params.begin(), spec.params.end(),
                                  [&key](const ParamSpec& other) { return other.name == key; });
  if (param == spec.params.end()) return unknown_parameter(spec, key);
  const auto problem = setting.list && !param->is_list ? "expected " + param->type
                                                       : param->set(params, setting.text);
  if (!problem) return std::nullopt;
  return "'" + setting.text + "' is not allowed, " + *problem +
         (param->unit.empty() ? "" : " [" + param->unit + "]");
}

/// What was set over others comes later, what stands in one file in its order.
std::vector<Named> in_order(const std::map<std::string, Setting>& settings) {
  std::vector<Named> sorted;
  for (const auto& setting : settings) sorted.push_back(&setting);
  std::stable_sort(sorted.begin(), sorted.end(), [](Named a, Named b) {
    const auto rank = [](Named of) {
      const Setting& setting = of->second;
      return std::tuple(setting.layer, setting.where.line, setting.where.column);
    };
    return rank(a) < rank(b);
  });
  return sorted;
}

/// A broken rule between parameters is laid to the last value that broke it.
void check_rule(const PlannedNode& planned, const NodeDescription& node,
                std::vector<Problem>& problems) {
  const std::string wrong = planned.spec->check(planned.params.get());
  if (wrong.empty()) return;
  const std::shared_ptr<void> params = planned.spec->make_params();
  Location to_blame = node.where;
  bool sound = planned.spec->check(params.get()).empty();
  for (const Named setting : in_order(node.settings)) {
    if (set(*planned.spec, params.get(), setting->first, setting->second)) continue;
    const bool sound_before = std::exchange(sound, planned.spec->check(params.get()).empty());
    if (sound_before && !sound) to_blame = setting->second.where;
  }
  problems.push_back({to_blame, node.name, wrong});
}

}  // namespace

PlannedNode detail::plan_node(const NodeDescription& node, std::vector<Problem>& problems) {
  PlannedNode planned;
  planned.name = node.name;
  planned.where = node.where;
  planned.like = !node.like.empty();
  planned.spec = find_type(node, problems);
  if (!planned.spec) return planned;
  planned.params = planned.spec->make_params();
  for (const auto& [key, setting] : node.settings) {
    const auto wrong = set(*planned.spec, planned.params.get(), key, setting);
    if (wrong && !planned.like)  // else the original reports
      problems.push_back({setting.where, planned.name + "." + key, *wrong});
  }
  if (!planned.like) check_rule(planned, node, problems);
  return planned;
}

}  // namespace posevote::graph
