// SPDX-License-Identifier: BSD-3-Clause
// What is tried: each parameter of a node switched off, halved and doubled.
#pragma once

#include <string>
#include <vector>

#include "graph/plan.hpp"

namespace posevote::ablation {

/// The nodes that are varied. Nothing before the segmentation reads what the training node makes.
inline constexpr const char* kSegmentation = "segment_objects";
inline constexpr const char* kTraining = "find_symmetries";

/// Whether a parameter of one of them is called so: param or node.param.
bool is_term(const std::string& term);

/// A node with one parameter changed.
struct Variation {
  std::string term;    ///< node.param; empty: nothing is changed
  std::string change;  ///< "off", "half", "double" or "as it is"
  std::string value;   ///< that the parameter then has
  graph::PlannedNode node;
};

/// Of each parameter: the value that takes it out of the method, where there is one, and half and
/// twice its own, as far as they are allowed and differ from it and each other. Not varied is what
/// belongs to the task (max_instances). `terms`: only these (param or node.param); empty: all.
std::vector<Variation> vary(const graph::PlannedNode& node, const std::vector<std::string>& terms);

/// The node as it is.
Variation unchanged(const graph::PlannedNode& node);

/// The value that takes a parameter out of the method; "" where none does.
std::string off_value(const std::string& param);
/// For how many there is one.
std::size_t count_off_values();

}  // namespace posevote::ablation
