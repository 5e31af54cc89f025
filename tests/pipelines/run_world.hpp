// SPDX-License-Identifier: BSD-3-Clause
// What the tests of `posevote run` run on.
#pragma once

#include <catch2/catch.hpp>
#include <regex>

#include "tests/support/command.hpp"

namespace posevote::test {

namespace fs = std::filesystem;

/// Two models and three scans, made once for all cases that run them.
struct World {
  TemporaryFolder folder;
  fs::path models = folder / "data/models";
  fs::path scans = folder / "data/scans";

  World() {
    const std::string spec = folder.write("spec.yaml",
                                          "seed: 5\n"
                                          "models:\n"
                                          "  - {shape: figure, seed: 3, size: 0.2}\n"
                                          "  - {shape: kettle, seed: 4, size: 0.16}\n"
                                          "scenes:\n"
                                          "  - {sensor: rgbd, objects: [1, 2], clutter: 1}\n"
                                          "  - {sensor: rgbd, objects: [1], clutter: 1}\n"
                                          "  - {sensor: rgbd, objects: [2], clutter: 1}\n");
    const CommandResult made =
        run_posevote(folder, "simulate " + spec + " --out " + (folder / "data").string());
    INFO(made.output);
    REQUIRE(made.status == 0);
  }

  CommandResult run(const std::string& out, const std::string& more) const {
    return run_posevote(folder, "run demo --models " + models.string() + " --out " +
                                    (folder / out).string() + " " + more);
  }
  std::string scans_argument() const { return "--scenes " + scans.string(); }
};

inline const World& world() {
  static const World the_world;
  return the_world;
}

inline std::string csv(const std::string& out) {
  return std::regex_replace(read_text(world().folder / (out + "/results.csv")),
                            std::regex(",[^,\n]*\n"), "\n");
}

/// Without the times of detections, which differ from run to run.
inline nlohmann::json frames(const std::string& out) {
  nlohmann::json frames = read_json(world().folder / (out + "/results.json"))["frames"];
  for (nlohmann::json& frame : frames)
    for (const char* list : {"detections", "rejected"})
      for (nlohmann::json& detection : frame[list]) detection.erase("seconds");
  return frames;
}

}  // namespace posevote::test
