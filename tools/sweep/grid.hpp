// SPDX-License-Identifier: BSD-3-Clause
// Which settings a sweep tries.
#pragma once

#include <string>
#include <vector>

#include "graph/description.hpp"

namespace posevote::sweep {

/// A parameter and the values that it is to have.
struct Axis {
  std::string node, param;
  std::vector<std::string> values;
  std::string name() const { return node + "." + param; }
};

/// Of "node.param=a,b,c"; commas within brackets belong to a value: "node.param=[1,2],[3]". Throws
/// std::invalid_argument that names --vary, for an argument of another form, a value that is missing
/// and a parameter that is named twice.
std::vector<Axis> read_axes(const std::vector<std::string>& arguments);

/// A value for each axis.
using Values = std::vector<std::string>;

/// All combinations; the values of the last axis vary fastest. Throws std::invalid_argument for more
/// than a thousand.
std::vector<Values> combine(const std::vector<Axis>& axes);

/// Each at its place in the command line: "--vary node.param=value".
std::vector<graph::Override> overrides_of(const std::vector<Axis>& axes, const Values& values);

/// "node.param=value, ..."
std::string to_text(const std::vector<Axis>& axes, const Values& values);

}  // namespace posevote::sweep
