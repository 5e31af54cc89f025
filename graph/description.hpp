// SPDX-License-Identifier: BSD-3-Clause
// A pipeline as it was written, before anything was checked. The YAML reader makes these; a test or
// a program may make them in C++.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "graph/problem.hpp"

namespace posevote::graph {

/// The text of a parameter's value, and where it stands.
struct Setting {
  std::string text;
  Location where;
  bool list = false;  ///< written as a YAML list
  int layer = 0;      ///< what was set over others has a higher one
};

/// One end of a stream at a node.
struct Wire {
  std::string port;  ///< empty: by position
  std::string stream;
  Location where;
};

/// One node of a pipeline.
struct NodeDescription {
  std::string name;  ///< unique in its pipeline
  std::string type;  ///< registered node type
  std::string like;  ///< takes type and parameters of that node; "" for a node of its own
  Location where;
  std::vector<Wire> inputs;
  std::vector<Wire> outputs;
  std::map<std::string, Setting> settings;
};

/// One pipeline: nodes linked by the names of streams.
struct PipelineDescription {
  std::string name;
  Location where;
  std::string models;  ///< pipeline whose result is a constant stream here; may be empty
  Location models_where;
  std::vector<Wire> inputs;  ///< streams that come with each frame
  Location inputs_where;
  Wire result;                ///< the stream that a frame leaves with
  std::vector<Wire> plugins;  ///< libraries with nodes of it (graph/plugin.hpp)
  std::vector<NodeDescription> nodes;
};

/// One value that a config or the command line gives to a node.
struct Override {
  std::string node;
  std::string key;  ///< a parameter, or "node" to put another node type in that place
  Setting setting;
};

/// A config: a pipeline's name and the values that differ from its defaults.
struct ConfigDescription {
  std::string pipeline;
  Location where;             ///< of the pipeline's name
  std::vector<Wire> plugins;  ///< libraries with nodes of it (graph/plugin.hpp)
  std::vector<Override> overrides;
};

/// Gives every node that is `like` another one that node's type and settings; the other one may
/// stand in `models`, the pipeline that makes the models (null if there is none). Settings of its
/// own are a problem: the point of `like` is that the two cannot differ.
void resolve_likes(PipelineDescription& pipeline, const PipelineDescription* models,
                   std::vector<Problem>& problems);

}  // namespace posevote::graph
