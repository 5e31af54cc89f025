// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace posevote {

/// Scans with true poses, and the config for them.
struct TestSet {
  std::string name;    ///< in tables
  std::string config;  ///< a name from configs/
  std::filesystem::path dataset;
  std::size_t every = 1;  ///< one image of so many
};

/// "uwa": the replica that configs/uwa_scenes.yaml describes, made below `out` where it is not there
/// yet; "bop=DIR": a set at hand. `every`: one image of so many, 0: what suits the replica, a
/// quarter of it if `quick`. `colors`: of replicas, painted ones.
TestSet find_set(const std::string& text, std::size_t every, bool quick,
                 const std::filesystem::path& out, bool colors = false);

}  // namespace posevote
