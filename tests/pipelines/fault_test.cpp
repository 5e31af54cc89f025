// SPDX-License-Identifier: BSD-3-Clause
// What a batch does when a system call by which it writes goes wrong: some of the calls, in turn with
// each fault. fault_batch.py by itself takes all of them, which takes half an hour.
#include <catch2/catch.hpp>

#include "tests/support/command.hpp"

namespace posevote::fault_test {

using namespace posevote::test;

#ifdef POSEVOTE_FAULTS
TEST_CASE("a batch outlasts kills, full disks, interrupts and short writes", "[faults]") {
  const TemporaryFolder folder;
  const std::string sensor =
      folder.write("sensor.yaml", "{width: 160, height: 120, field: 59, noise_z2: 0.001}\n");
  const std::string spec = folder.write("spec.yaml",
                                        "seed: 5\n"
                                        "models: [{shape: figure, seed: 3, size: 0.2}]\n"
                                        "scenes: [{sensor: " +
                                            sensor + ", objects: [1]}]\n");
  const std::string data = (folder / "data").string();
  const CommandResult made = run_posevote(folder, "simulate " + spec + " --out " + data);
  INFO(made.output);
  REQUIRE(made.status == 0);
  const CommandResult tried = run_posevote(
      folder,
      POSEVOTE_SOURCE_DIR "/tests/pipelines/fault_batch.py " POSEVOTE_BINARY
                          " --faults " POSEVOTE_FAULTS " --every 50 --stages run resume --models " +
          data + "/models --scans " + data + "/scans/000000.ply --work " +
          (folder / "work").string(),
      POSEVOTE_PYTHON);
  INFO(tried.output);
  CHECK(tried.status == 0);
  CHECK_THAT(tried.output, Catch::Contains(" 0 of them wrong"));
}
#endif

}  // namespace posevote::fault_test
