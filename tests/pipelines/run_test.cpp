// SPDX-License-Identifier: BSD-3-Clause
// `posevote run` as users meet it: good and broken scans, wrong configs, caches, shards, Ctrl-C.
#include <catch2/catch.hpp>
#include <regex>

#include "tests/support/command.hpp"

using namespace posevote::test;
namespace fs = std::filesystem;

namespace {

/// Two models and three scans, made once for all cases of this file.
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

const World& world() {
  static const World the_world;
  return the_world;
}

std::string csv(const std::string& out) {
  return std::regex_replace(read_text(world().folder / (out + "/results.csv")),
                            std::regex(",[^,\n]*\n"), "\n");
}

nlohmann::json frames(const std::string& out) {
  return read_json(world().folder / (out + "/results.json"))["frames"];
}

}  // namespace

TEST_CASE("broken scans fail by name and the others are answered", "[run]") {
  const World& w = world();
  const fs::path mixed = w.folder / "mixed";
  fs::create_directories(mixed);
  for (const auto& entry : fs::directory_iterator(w.scans))
    fs::copy(entry.path(), mixed / entry.path().filename());
  const std::string good = read_text(w.scans / "000000.ply");
  const auto header = [](const std::string& count) {
    return "ply\nformat ascii 1.0\nelement vertex " + count +
           "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  };
  w.folder.write("mixed/a_truncated.ply", good.substr(0, good.size() / 2));
  w.folder.write("mixed/b_lying.ply", header("4000000000") + "0 0 1\n");
  w.folder.write("mixed/c_empty.ply", "");
  w.folder.write("mixed/d_nan.ply", header("2") + "nan nan nan\nnan nan nan\n");
  w.folder.write("mixed/e_text.ply", "Dear sir or madam\n");
  fs::create_symlink("nowhere.ply", mixed / "f_dangling.ply");

  const CommandResult run = w.run("mixed-out", "--scenes " + mixed.string());
  INFO(run.output);
  CHECK(run.status == 1);
  CHECK(frames("mixed-out").size() == 3);
  const nlohmann::json failures = read_json(w.folder / "mixed-out/failures.json");
  REQUIRE(failures.size() == 6);
  const std::vector<std::string> parts{"a_truncated", "b_lying", "c_empty",
                                       "d_nan",       "e_text",  "f_dangling"};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    INFO(failures[i].dump());
    CHECK(failures[i]["node"] == "load_scene");
    CHECK(failures[i]["file"].get<std::string>().find(parts[i]) != std::string::npos);
    CHECK(failures[i]["what"].get<std::string>().size() > 10);
  }
}

TEST_CASE("an unreadable scan keeps its number; shards and resumed runs agree with one run",
          "[run]") {
  const World& w = world();
  REQUIRE(w.run("whole", w.scans_argument()).status == 0);
  REQUIRE(frames("whole").size() == 3);
  REQUIRE(w.run("second", w.scans_argument() + " --shard 2/3").status == 0);
  REQUIRE(frames("second").size() == 1);
  CHECK(frames("second")[0]["frame"] == 1);
  CHECK(frames("second")[0]["detections"] == frames("whole")[1]["detections"]);

  REQUIRE(w.run("parts", w.scans_argument() + " --shard 1/3").status == 0);
  CHECK(w.run("parts", w.scans_argument()).status == 2);  // holds another run
  CHECK(w.run("parts", w.scans_argument() + " --resume --set segment_objects.nms=0.3").status == 2);
  CHECK(w.run("parts", w.scans_argument() + " --resume --seed 9").status == 2);
  CHECK(w.run("parts", "--scenes " + (w.scans / "000001.ply").string() + " --resume").status == 2);
  CHECK(run_posevote(w.folder, "run demo --models " + (w.models / "*1.ply").string() + " --out " +
                                   (w.folder / "parts").string() + " --resume " +
                                   w.scans_argument())
            .status == 2);
  CHECK(frames("parts").size() == 1);  // nothing of it touched
  REQUIRE(w.run("parts", w.scans_argument() + " --resume").status == 0);
  CHECK(csv("parts") == csv("whole"));
}

TEST_CASE("effective.yaml repeats the run, other node types included", "[run]") {
  const World& w = world();
  const std::string one = "--scenes " + (w.scans / "000001.ply").string();
  REQUIRE(w.run("fpfh", one + " --set describe_models.node=describe_fpfh").status == 0);
  REQUIRE(run_posevote(w.folder, "run " + (w.folder / "fpfh/effective.yaml").string() +
                                     " --models " + w.models.string() + " --out " +
                                     (w.folder / "fpfh-again").string() + " " + one)
              .status == 0);
  CHECK(csv("fpfh-again") == csv("fpfh"));
  CHECK(read_text(w.folder / "fpfh-again/effective.yaml") ==
        read_text(w.folder / "fpfh/effective.yaml"));
}

TEST_CASE("arguments that contradict each other, or no run, end with status 2", "[run]") {
  const World& w = world();
  const auto refused = [&w](const std::string& arguments, const std::string& why) {
    const CommandResult run = run_posevote(w.folder, arguments);
    INFO(run.output);
    CHECK(run.status == 2);
    CHECK(run.output.find(why) != std::string::npos);
  };
  const std::string inputs = " --models " + w.models.string() + " " + w.scans_argument() +
                             " --out " + (w.folder / "refused").string();
  refused(
      "run " + (fs::path(POSEVOTE_SOURCE_DIR) / "pipelines/train_models.yaml").string() + inputs,
      "has no `models`");
  refused("run demo --library some.library" + inputs, "one of them");
  refused("run demo --threads 100000" + inputs, "--threads");
  refused("run demo --seed -1" + inputs, "--seed");
  refused("run demo --seed 010" + inputs, "--seed");
  w.folder.write("broken/obj_000007.ply", "ply\n");
  refused("run demo --models " + (w.folder / "broken").string() + " " + w.scans_argument() +
              " --out " + (w.folder / "refused").string(),
          "obj_000007.ply");
  refused("run " + w.scans.string() + inputs, "is a folder");
  const std::string two = w.folder.write("two.yaml", "pipeline: recognize\n---\nmore: {x: 1}\n");
  refused("check " + two, "two.yaml:3:1: starts another YAML document");
  CHECK(!fs::exists(w.folder / "refused"));
}

TEST_CASE("the same bytes at any number of threads and tokens", "[run]") {
  const World& w = world();
  REQUIRE(w.run("one", w.scans_argument() + " --threads 1").status == 0);
  REQUIRE(w.run("four", w.scans_argument() + " --threads 4 --tokens 3").status == 0);
  CHECK(csv("one") == csv("four"));
  CHECK(csv("one").size() > 100);
}

TEST_CASE("the outputs of a run", "[run]") {
  const World& w = world();
  REQUIRE(w.run("outputs", w.scans_argument()).status == 0);
  for (const char* file : {"results.csv", "results.json", "failures.json", "effective.yaml",
                           "trace.json", "overlays/000000.ply", "pictures/000000.png"})
    CHECK(fs::file_size(w.folder / "outputs" / file) > 0);
  CHECK(read_json(w.folder / "outputs/trace.json")["traceEvents"].size() > 30);
  CHECK(read_json(w.folder / "outputs/results.json")["nodes"].size() > 10);
  // effective.yaml is a config that does the same again
  const CommandResult again =
      run_posevote(w.folder, "run " + (w.folder / "outputs/effective.yaml").string() +
                                 " --models " + w.models.string() + " --out " +
                                 (w.folder / "again").string() + " " + w.scans_argument());
  INFO(again.output);
  REQUIRE(again.status == 0);
  CHECK(csv("again") == csv("outputs"));
}

TEST_CASE("on-error stop writes what is done, and nothing behind the failure", "[run]") {
  const World& w = world();
  const fs::path bad = w.folder / "stop";
  fs::create_directories(bad);
  fs::copy(w.scans / "000000.ply", bad / "0.ply");
  w.folder.write("stop/1.ply", "no");
  fs::copy(w.scans / "000001.ply", bad / "2.ply");
  CHECK(w.run("stopped", "--on-error stop --scenes " + bad.string()).status == 1);
  CHECK(frames("stopped").size() == 1);
  CHECK(read_json(w.folder / "stopped/failures.json").size() == 1);
}

TEST_CASE("Ctrl-C ends with what is done written", "[run]") {
  const World& w = world();
  const fs::path many = w.folder / "many";
  fs::create_directories(many);
  for (int i = 0; i < 200; ++i)
    fs::create_symlink(w.scans / "000001.ply", many / (std::to_string(1000 + i) + ".ply"));
  const fs::path out = w.folder / "interrupted";
  const std::string command = "XDG_CACHE_HOME='" + (w.folder / "cache").string() +
                              "' timeout -s INT 4 '" + POSEVOTE_BINARY + "' run demo --models " +
                              w.models.string() + " --scenes " + many.string() + " --out " +
                              out.string() + " > /dev/null 2>&1";
  // `timeout --preserve-status` would hide 124; the command's own status is what counts
  const int status =
      std::system(("timeout() { command timeout --preserve-status \"$@\"; }; " + command).c_str());
  CHECK(WEXITSTATUS(status) == 130);
  const std::size_t done = frames("interrupted").size();
  CHECK(done < 200);
  const std::string rows = read_text(out / "results.csv");
  CHECK(rows.back() == '\n');
}

TEST_CASE("a stale, a damaged and an unwritable cache", "[run]") {
  const World& w = world();
  const std::string cache = " --cache " + (w.folder / "own-cache").string();
  REQUIRE(w.run("cache1", w.scans_argument() + cache).status == 0);
  std::vector<fs::path> files(fs::directory_iterator(w.folder / "own-cache"), {});
  REQUIRE(files.size() == 1);
  REQUIRE(w.run("cache2", w.scans_argument() + cache + " --set describe_models.radius=15").status ==
          0);
  CHECK(std::distance(fs::directory_iterator(w.folder / "own-cache"), {}) == 2);
  std::string bytes = read_text(files[0]);
  bytes[bytes.size() / 2] ^= 1;
  std::ofstream(files[0], std::ios::binary) << bytes;
  const CommandResult damaged = w.run("cache3", w.scans_argument() + cache);
  CHECK(damaged.status == 0);
  CHECK(damaged.output.find("trained anew") != std::string::npos);
  CHECK(csv("cache3") == csv("cache1"));
  const CommandResult unwritable = w.run("cache4", w.scans_argument() + " --cache /proc/nowhere");
  CHECK(unwritable.status == 0);
  CHECK(unwritable.output.find("not cached") != std::string::npos);
}

TEST_CASE("what another build trained is not taken from the cache", "[run]") {
  const World& w = world();
  const fs::path other = w.folder / "other-build";
  fs::copy_file(POSEVOTE_BINARY, other);
  std::ofstream(other, std::ios::binary | std::ios::app) << '\n';
  const std::string run = "run demo --models " + w.models.string() + " " + w.scans_argument() +
                          " --cache " + (w.folder / "shared-cache").string() + " --out ";
  const auto libraries_after = [&](const std::string& out, const std::string& program) {
    REQUIRE(run_posevote(w.folder, run + (w.folder / out).string(), program).status == 0);
    return std::distance(fs::directory_iterator(w.folder / "shared-cache"), {});
  };
  CHECK(libraries_after("build1", POSEVOTE_BINARY) == 1);
  CHECK(libraries_after("build2", POSEVOTE_BINARY) == 1);
  CHECK(libraries_after("build3", other) == 2);
}

TEST_CASE("a trained library, and one that was trained otherwise", "[run]") {
  const World& w = world();
  const std::string library = (w.folder / "two.library").string();
  const CommandResult trained =
      run_posevote(w.folder, "train demo --models " + w.models.string() + " --out " + library);
  INFO(trained.output);
  REQUIRE(trained.status == 0);
  const std::string run = "run demo --library " + library + " " + w.scans_argument() + " --out ";
  REQUIRE(run_posevote(w.folder, run + (w.folder / "lib1").string()).status == 0);
  REQUIRE(w.run("lib2", w.scans_argument()).status == 0);
  CHECK(csv("lib1") == csv("lib2"));
  const CommandResult other = run_posevote(
      w.folder, run + (w.folder / "lib3").string() + " --set describe_models.radius=15");
  CHECK(other.status == 2);
  CHECK(other.output.find("two.library") != std::string::npos);
}

TEST_CASE("nothing runs, and nothing is written, when the call is wrong", "[run]") {
  const World& w = world();
  const std::string config = w.folder.write("wrong.yaml",
                                            "pipeline: recognize\n"
                                            "load_scene: {unit: miles, unti: mm}\n"
                                            "cast_votes: {rotations: 0, rotations: 60}\n"
                                            "estimate_densty: {sigma_t: 0.01}\n"
                                            "estimate_density: {sigma_t: -1, sigma_r: wide}\n"
                                            "describe_scene: {radius: 3}\n"
                                            "match_features: [1]\n");
  const std::string rest = " --models " + w.models.string() + " " + w.scans_argument() + " --out " +
                           (w.folder / "no").string();
  const CommandResult wrong = run_posevote(w.folder, "run " + config + rest);
  INFO(wrong.output);
  CHECK(wrong.status == 2);
  for (const char* line :
       {":2:20: load_scene.unit: ", ":2:33: load_scene.unti: ", ":3:25: cast_votes.rotations: ",
        ":3:28: cast_votes.rotations: ", ":4:28: estimate_densty.sigma_t: ",
        ":5:29: estimate_density.sigma_t: ", ":5:42: estimate_density.sigma_r: ",
        ":6:26: describe_scene.radius: ", ":7:1: match_features: "})
    CHECK(wrong.output.find(line) != std::string::npos);
  const std::string good = "run demo" + rest;
  for (const std::string& call :
       {"run nowhere.yaml" + rest, good + " --set nothing", good + " --set a.b=c",
        std::string("run demo --out ") + (w.folder / "no").string(), good + " --shard 5/2",
        good + " --on-error maybe", good + " --models /nowhere.ply", good + " --library x",
        std::string("fly")}) {
    const CommandResult run = run_posevote(w.folder, call);
    INFO(call << "\n" << run.output);
    CHECK(run.status == 2);
    CHECK(run.output.size() > 10);
  }
  CHECK_FALSE(fs::exists(w.folder / "no"));
}

TEST_CASE("wrong units fail the frame by name", "[run]") {
  const World& w = world();
  const CommandResult run = w.run("units", w.scans_argument() + " --set load_models.unit=m");
  INFO(run.output);
  CHECK(run.status == 1);
  const nlohmann::json failures = read_json(w.folder / "units/failures.json");
  REQUIRE(failures.size() == 3);
  CHECK(failures[0]["node"] == "check_size");
  CHECK(failures[0]["what"].get<std::string>().find("unit") != std::string::npos);
}
