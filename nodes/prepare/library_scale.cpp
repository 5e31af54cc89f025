// SPDX-License-Identifier: BSD-3-Clause
// The resolution at which a library was trained: scans are sampled alike.
//
//   library_scale: {in: library, out: scale}
#include "graph/registry.hpp"
#include "nodes/data/model.hpp"

namespace posevote::prepare {
namespace {

struct Params {};

Scale library_scale(const ModelLibrary& library, const Params&) { return library.scale; }

const auto registered = graph::register_node("library_scale", library_scale,
                                             "The resolution at which the library was trained.")
                            .input("library")
                            .output("scale");

}  // namespace
}  // namespace posevote::prepare
