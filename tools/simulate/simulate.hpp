// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "tools/simulate/spec.hpp"

namespace posevote {

/// Makes models and cluttered scans of them, with the true poses, as a BOP data set and PLY scans
/// in metres: what configs/demo_scenes.yaml describes, for example. The same file gives the same
/// bytes, at any number of threads. Throws graph::ConfigError for problems of the file,
/// std::invalid_argument where `out` is not empty and std::runtime_error where it cannot be
/// written. `step`: only every so manieth image.
void simulate_set(const std::string& spec_file, const std::filesystem::path& out,
                  std::size_t step = 1);

/// The same of a spec that a program made. Throws std::invalid_argument, too, for a mesh or a sensor
/// of the user's own that cannot be used.
void simulate_set(const Spec& spec, const std::filesystem::path& out, std::size_t step = 1);

}  // namespace posevote
