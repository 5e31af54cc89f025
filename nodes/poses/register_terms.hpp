// SPDX-License-Identifier: BSD-3-Clause
// What the files that say what each term is share.
#pragma once

#include <utility>

#include "nodes/poses/segment_params.hpp"

namespace posevote::poses {

using Node = graph::Registration<SegmentParams>;

/// Registers members of one group of terms.
template <class Group>
struct Register {
  Node& node;
  Group Terms::*group;

  template <class T>
  void operator()(const char* name, T Group::*member, const char* unit, const char* doc,
                  graph::Constraint constraint) const {
    const auto access = [group = group, member](SegmentParams& params) -> T& {
      return params.terms.*group.*member;
    };
    node.expert_param(name, access, unit, doc, std::move(constraint));
  }
};

/// Those of colours (color_params.cpp).
void add_color_terms(Node& node);

/// How many poses get how much attention (schedule_params.cpp).
void add_schedule_terms(Node& node);

}  // namespace posevote::poses
