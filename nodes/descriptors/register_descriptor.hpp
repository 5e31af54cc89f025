// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "graph/registry.hpp"
#include "nodes/data/features.hpp"

namespace posevote::descriptors {

/// Registers a descriptor, with the ports and the two parameters that all have in common.
template <class Params>
graph::Registration<Params> register_descriptor(
    std::string name,
    FeatureSet (*function)(const Cloud&, const FeaturePoints&, const Scale&, const Params&),
    std::string doc, int least_neighbours, const char* source = __builtin_FILE()) {
  auto registration = graph::register_node(std::move(name), function, std::move(doc), source);
  registration.input("cloud").input("points").input("scale").output("features");
  registration.param("radius", &Params::radius, "x resolution",
                     "Neighbours within this are described.", graph::in_range(0.1, 200));
  registration.param("min_neighbours", &Params::min_neighbours, "",
                     "A feature point with fewer is left out.", graph::at_least(least_neighbours));
  return registration;
}

}  // namespace posevote::descriptors
