// SPDX-License-Identifier: BSD-3-Clause
#include "tools/ablation/variations.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace posevote::ablation {
namespace {

const std::set<std::string> kTask = {"max_instances"};

const std::map<std::string, std::string> kOff = {{"candidates", "1"},
                                                 {"min_confidence", "0"},
                                                 {"min_score", "0"},
                                                 {"doubtful", "1"},
                                                 {"confidence_agreement", "0"},
                                                 {"confidence_relief", "0"},
                                                 {"confidence_outline", "0"},
                                                 {"confidence_overhang", "0"},
                                                 {"confidence_votes", "0"},
                                                 {"confidence_lead", "0"},
                                                 {"confidence_exactness", "0"},
                                                 {"confidence_support", "0"},
                                                 {"confidence_gaps", "0"},
                                                 {"confidence_filled", "0"},
                                                 {"confidence_sunk", "0"},
                                                 {"confidence_outside", "0"},
                                                 {"confidence_visible", "0"},
                                                 {"confidence_strangers", "0"},
                                                 {"confidence_company", "0"},
                                                 {"confidence_color_likeness", "0"},
                                                 {"confidence_color_tint", "0"},
                                                 {"refine", "false"},
                                                 {"max_residual", "0"},
                                                 {"shortlist", "10000"},  // all are improved
                                                 {"shortlist_again", "0"},
                                                 {"glances", "10000"},
                                                 {"promising", "0"},
                                                 {"finalists", "1"},
                                                 {"sketch_hopeless", "0"},
                                                 {"closer_hopeless", "0"},
                                                 {"hopeless", "0"},
                                                 {"sure", "1"},
                                                 {"proposed_fineness", "1"},
                                                 {"proposed_per_place", "1"},
                                                 {"judged_per_place", "1"},
                                                 {"clear_distance", "0"},
                                                 {"mismatch_weight", "0"},
                                                 {"bends_forgiven", "0"},
                                                 {"convincing", "1e-9"},  // everything is
                                                 {"outline_weight", "0"},
                                                 {"few_ends", "1e-9"},
                                                 {"sampled_residual", "0"},
                                                 {"least_exactness", "0"},
                                                 {"trust_in_support", "0"},
                                                 {"trust_in_consensus", "0"},
                                                 {"coarse_steps", "0"},
                                                 {"full_still", "0"},
                                                 {"polish_still", "0"},
                                                 {"telling", "1e9"},  // nothing is
                                                 {"lead_odds", "0"},
                                                 {"err_alike", "1e9"},
                                                 {"least_difference", "0.01"},
                                                 {"most_shifts", "0"},
                                                 {"least_facing_cosine", "0"},
                                                 {"least_normal_cosine", "-1"},
                                                 {"icp_shrink", "1"},
                                                 {"icp_damping", "0"},
                                                 {"icp_final_damping", "0"},
                                                 {"view_trusted", "0"},
                                                 {"view_least_mean_cosine", "0"},
                                                 {"view_least_axis_cosine", "0.01"},
                                                 {"view_footprint", "0"},
                                                 {"view_most_half_cells", "0"},
                                                 {"most", "0"},
                                                 {"round", "1"},
                                                 {"symmetric", "1"},
                                                 {"same_motion", "0"}};

std::optional<graph::PlannedNode> changed(const graph::PlannedNode& node, const std::string& param,
                                          const std::string& value) {
  graph::PlannedNode other = node;
  other.params = node.spec->make_params();
  for (const graph::ParamSpec& spec : node.spec->params) {
    const std::string text = spec.name == param ? value : spec.get(node.params.get());
    if (spec.set(other.params.get(), text)) return std::nullopt;  // out of range
  }
  return other;
}

/// A number times a factor, in the parameter's own type; "" for what is no number.
std::string times(const graph::ParamSpec& param, const std::string& value, double factor) {
  if (const auto whole = graph::Scalar<int>::parse(value); whole && param.type == "int")
    return graph::Scalar<int>::print(static_cast<int>(std::lround(*whole * factor)));
  if (param.type != "number") return "";
  const auto number = graph::Scalar<double>::parse(value);
  return number ? graph::Scalar<double>::print(*number * factor) : "";
}

bool is_wanted(const std::string& node, const std::string& param,
               const std::vector<std::string>& terms) {
  return terms.empty() || std::any_of(terms.begin(), terms.end(), [&](const std::string& term) {
           return term == param || term == node + "." + param;
         });
}

}  // namespace

std::string off_value(const std::string& param) {
  const auto found = kOff.find(param);
  return found == kOff.end() ? "" : found->second;
}

bool is_term(const std::string& term) {
  for (const char* name : {kSegmentation, kTraining}) {
    const graph::NodeSpec* spec = graph::find_node(name);
    for (const graph::ParamSpec& param : spec ? spec->params : std::vector<graph::ParamSpec>{})
      if (is_wanted(name, param.name, {term})) return true;
  }
  return false;
}

std::size_t count_off_values() { return kOff.size(); }

std::vector<Variation> vary(const graph::PlannedNode& node, const std::vector<std::string>& terms) {
  std::vector<Variation> variations;
  for (const graph::ParamSpec& param : node.spec->params) {
    if (kTask.contains(param.name) || !is_wanted(node.name, param.name, terms)) continue;
    const std::string value = param.get(node.params.get());
    std::set<std::string> tried{value, ""};
    const auto attempt = [&](const char* change, const std::string& other) {
      if (!tried.insert(other).second) return;
      if (auto planned = changed(node, param.name, other))
        variations.push_back({node.name + "." + param.name, change, other, std::move(*planned)});
    };
    attempt("off", off_value(param.name));
    attempt("half", times(param, value, 0.5));
    attempt("double", times(param, value, 2));
  }
  return variations;
}

Variation unchanged(const graph::PlannedNode& node) { return {"", "as it is", "", node}; }

}  // namespace posevote::ablation
