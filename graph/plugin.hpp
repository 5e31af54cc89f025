// SPDX-License-Identifier: BSD-3-Clause
// Node types that come in shared libraries of their own: loading one registers its nodes, as those
// of the program itself register (graph/registry.hpp).
//
// What few runs need (the rivals, PCL's descriptors) stands in libraries in the folder `posevote`
// beside the program's own, and is loaded when a node is asked for that is not known yet: a start
// pays for what it uses.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "graph/description.hpp"

namespace posevote::graph {

/// Loads a shared library, unless it is loaded already. Throws std::invalid_argument that names the
/// file and why: missing, no library, built for another ABI of posevote, without a node, or with
/// one whose name is taken.
void load_plugin(const std::filesystem::path& file);

/// The files that were loaded so, sorted.
std::vector<std::filesystem::path> loaded_plugins();

/// The file of the program or library that this code is in.
std::filesystem::path this_library();

/// This library and all that were loaded: the code that results depend on.
std::vector<std::filesystem::path> code_files();

/// What to say of a node type that is not there: that its library is not installed or lacks another,
/// where it is one that comes with the program; else the nearest name.
std::string unknown_node(const std::string& name);

/// The library that `plugins:` names: from the folder of the file where it stands.
std::string file_of(const Wire& plugin);

namespace detail {

/// Loads the libraries that come with the program, once. One that cannot be loaded, because a
/// package that it needs is not installed, is left out; unknown_node says so.
void load_bundled();

/// Runs `load`, which loads a library. Returns the names of its nodes that others have already.
std::vector<std::string> names_taken(const std::function<void()>& load);

std::size_t count_nodes();

}  // namespace detail
}  // namespace posevote::graph
