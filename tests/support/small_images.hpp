// SPDX-License-Identifier: BSD-3-Clause
// What the tests of streams and recordings share: images to record, and a run's answers.
#pragma once

#include <filesystem>
#include <regex>
#include <string>

#include "tests/support/command.hpp"

namespace posevote::test {

/// Small RGB-D images of two bodies on a table.
struct SmallImages {
  TemporaryFolder folder;
  std::filesystem::path scene = folder / "data/test/000001";

  SmallImages() {
    folder.write("small.yaml",
                 "{width: 160, height: 120, field: 40, noise: 0.0003, noise_z2: 0.0006}");
    const std::string spec =
        folder.write("spec.yaml",
                     "models:\n  - {shape: figure, size: 0.2}\n  - {shape: kettle, size: 0.16}\n"
                     "scenes:\n  - {sensor: small.yaml, count: 3, objects: [1, 2], clutter: 0}\n");
    const CommandResult made =
        run_posevote(folder, "simulate " + spec + " --out " + (folder / "data").string());
    INFO(made.output);
    REQUIRE(made.status == 0);
  }
};

/// Poses and confidences, without times.
inline std::string answers(const std::filesystem::path& out) {
  return std::regex_replace(read_text(out / "results.csv"), std::regex(",[^,\n]*\n"), "\n");
}

}  // namespace posevote::test
