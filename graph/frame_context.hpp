// SPDX-License-Identifier: BSD-3-Clause
// What a node may know of its frame, and how it tells of what went wrong.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "graph/span.hpp"

namespace posevote::graph {

/// What a node measured of a frame: one number or several by a name that ends in the unit
/// (spacing_m).
using Figures = std::map<std::string, std::vector<double>>;

/// What one node of a frame took, measured and told.
struct Stage {
  std::string node;
  Span span;
  Figures figures{};
  std::vector<std::string> warnings{};  ///< each once, sorted
};

/// What a node may know about its frame beyond its inputs.
struct FrameContext {
  std::uint64_t number = 0;      ///< of the frame in this run
  std::string name;              ///< for file names: unique within a run, from the scene's path
  std::filesystem::path out;     ///< of the run's output; empty where nothing is to be written
  std::uint64_t seed = 0;        ///< the user's seed
  std::filesystem::path file{};  ///< what the frame was made from, for messages
  std::vector<Stage> stages{};   ///< the other nodes, in the plan's order; for one that runs last
  std::function<void(const std::string&)> on_warning{};  ///< empty where nobody listens
  std::function<void(const std::string&, std::vector<double>)>
      on_figure{};  ///< empty where nobody listens

  /// Tells whoever runs the frame what may be wrong with it although it is answered.
  void warn(const std::string& what) const {
    if (on_warning) on_warning(what);
  }
  /// Tells whoever runs the frame what was measured of it; the names of nodes must differ.
  void tell(const std::string& what, std::vector<double> figure) const {
    if (on_figure) on_figure(what, std::move(figure));
  }
};

/// What a node told of a frame.
struct Warning {
  std::string node;
  std::string what;
};

/// An object of a frame that failed, from 0, and why.
struct ObjectFailure {
  std::size_t object = 0;
  std::string cause;
};

/// Why a frame has no result.
struct Failure {
  std::string node;
  std::string what;
  std::vector<ObjectFailure> objects{};  ///< where it is the fault of some of them
};

/// What a node throws where it can say which objects failed.
class ObjectErrors : public std::runtime_error {
 public:
  ObjectErrors(std::vector<ObjectFailure> which, const std::string& message)
      : std::runtime_error(message), objects(std::move(which)) {}

  std::vector<ObjectFailure> objects;  ///< in ascending order; one or more
};

/// What a node throws where no other frame could do better, as for a full disk: it ends the run and
/// comes out of it.
class EndOfRun : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace posevote::graph
