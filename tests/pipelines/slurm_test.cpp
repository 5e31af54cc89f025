// SPDX-License-Identifier: BSD-3-Clause
// A batch on a real Slurm: slurmctld, slurmd and munged of one node, as root.
#include <unistd.h>

#include "tests/pipelines/run_world.hpp"

namespace posevote::slurm_test {

using namespace posevote::test;

namespace {

const std::string kSource = POSEVOTE_SOURCE_DIR;

bool has_slurm() {
  return ::geteuid() == 0 &&
         std::system("command -v slurmctld slurmd munged sbatch > /dev/null 2>&1") == 0;
}

/// Submits four shards, kills the task of the second when it has answered a frame, and waits.
std::string batch_script(const std::string& out, const std::string& run) {
  return "set -e\n" + kSource + "/tools/slurm/batch --shards 4 --out " + out + " --program " +
         POSEVOTE_BINARY + " --cpus-per-task=1 -- " + run + "\n" + "second=" + out +
         "/shards/2/results.json\n"
         "until grep -qs '{\"frame\"' $second; do sleep 0.02; done\n"
         "scancel --full --signal=KILL $(squeue --noheader --array --format=%i | grep _2)\n"
         "until [ -e " +
         out +
         "/merged/effective.yaml ] && ! squeue --noheader | grep -q .; do\n"
         "  [ $((++waits)) -lt 600 ] || exit 9\n  sleep 0.2\ndone\n";
}

}  // namespace

TEST_CASE("a Slurm array with a task killed writes what one run would have", "[run][slurm]") {
  if (!has_slurm()) {
    WARN("skipped: needs root, slurm-wlm and munge");
    return;
  }
  const TemporaryFolder folder;
  for (int i = 0; i < 48; ++i) {
    fs::create_directories(folder / "scans");
    fs::copy(world().scans / ("00000" + std::to_string(i % 3) + ".ply"),
             folder / ("scans/scan" + std::to_string(i) + ".ply"));
  }
  const std::string run = "demo --models " + world().models.string() + " --scenes " +
                          (folder / "scans").string() + " --set write_overlay.every=0";
  CHECK(run_posevote(folder, "run " + run + " --out " + (folder / "one").string()).status == 0);

  const std::string script = folder.write("batch", batch_script((folder / "out").string(), run));
  const std::string log = (folder / "cluster.log").string();
  const int status =
      std::system((kSource + "/tests/pipelines/slurm_cluster " + (folder / "cluster").string() +
                   " bash " + script + " > " + log + " 2>&1")
                      .c_str());
  INFO(read_text(log));
  REQUIRE(status == 0);
  const auto rows = [&](const std::string& file) {
    return std::regex_replace(read_text(folder / file), std::regex(",[^,\n]*\n"), "\n");
  };
  CHECK(rows("out/merged/results.csv") == rows("one/results.csv"));
  std::size_t logs = 0;
  for (const auto& entry : fs::directory_iterator(folder / "out/log"))
    logs += entry.path().filename().string().starts_with("shard-2.");
  CHECK(logs == 2);  // it was killed, and ran again
}

}  // namespace posevote::slurm_test
