// SPDX-License-Identifier: BSD-3-Clause
// The scales at which a scan is prepared: the octaves of all models that its sensor can tell.
//
//   scan_octaves: {in: [scan, library], out: [scale, octaves]}
#include <memory>
#include <stdexcept>
#include <tuple>

#include "graph/registry.hpp"
#include "nodes/data/model.hpp"

namespace posevote::prepare {
namespace {

struct Params {
  double finest = 0;
};

std::tuple<Scale, PerObject<Scale>> scan_octaves(const Scan&, const ModelLibrary& library,
                                                 const Params& params) {
  if (library.octaves.empty()) throw std::runtime_error("the model library has no index");
  PerObject<Scale> octaves;
  for (const LibraryOctave& octave : library.octaves)
    if (octave.resolution > 0.99 * params.finest)
      octaves.slots.push_back(std::make_shared<const Scale>(Scale{octave.resolution}));
  if (octaves.slots.empty())
    octaves.slots.push_back(
        std::make_shared<const Scale>(Scale{library.octaves.back().resolution}));
  const Scale finest = octaves[0];
  return {finest, std::move(octaves)};
}

const auto registered =
    graph::register_node("scan_octaves", scan_octaves,
                         "The scales at which a scan is prepared, and the finest of them.")
        .input("scan")
        .input("library")
        .output("scale")
        .output("octaves")
        .param("finest", &Params::finest, "m", "No octave of the scan is finer than this.",
               graph::at_least(0));

}  // namespace
}  // namespace posevote::prepare
