// SPDX-License-Identifier: BSD-3-Clause
// `posevote run` as users meet it: good and broken scans, shards, outputs, Ctrl-C.
#include "tests/pipelines/run_world.hpp"

namespace posevote::run_test {

using namespace posevote::test;

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

TEST_CASE("a scan in which nothing is found says what to type to learn why", "[run]") {
  const World& w = world();
  const CommandResult run = w.run("none", "--scenes " + (w.scans / "000001.ply").string() +
                                              " --set segment_objects.min_confidence=1");
  const std::string explain = "explain " + (w.folder / "none").string() + " --scene 000001";
  CHECK_THAT(run.output,
             Catch::Contains("the best candidate") && Catch::Contains("why: posevote " + explain));
  CHECK(run_posevote(w.folder, explain).status == 0);
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

TEST_CASE("the same bytes at any number of threads and tokens", "[run]") {
  const World& w = world();
  REQUIRE(w.run("one", w.scans_argument() + " --threads 1").status == 0);
  REQUIRE(w.run("four", w.scans_argument() + " --threads 4 --tokens 3").status == 0);
  CHECK(csv("one") == csv("four"));
  CHECK(read_text(w.folder / "one/detections.csv") == read_text(w.folder / "four/detections.csv"));
  for (std::size_t i = 0; i < frames("one").size(); ++i)  // covariances, too
    CHECK(frames("one")[i]["detections"] == frames("four")[i]["detections"]);
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

TEST_CASE("without a config: units by size, instances unasked", "[run]") {
  const auto run = [](const std::string& out, const std::string& models, const std::string& more) {
    return run_posevote(world().folder, "run --models " + models + " --out " +
                                            (world().folder / out).string() + " " + more);
  };
  // Models in mm, as the simulator writes them, and scans in m.
  const CommandResult plain = run("plain", world().models.string(), world().scans_argument());
  INFO(plain.output);
  REQUIRE(plain.status == 0);
  CHECK_THAT(plain.output, !Catch::Contains("warning"));
  // The same said.
  const CommandResult said = run("said", world().models.string(),
                                 world().scans_argument() + " --model-unit mm --scene-unit m");
  REQUIRE(said.status == 0);
  CHECK(csv("plain") == csv("said"));
  const std::size_t found = frames("plain")[0]["detections"].size();
  CHECK(found == 2);
  // A thing of 4.2 "units" might be either.
  const std::string odd = world().folder.write(
      "odd.off", "OFF\n4 4 0\n0 0 0\n3 0 0\n0 3 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  CHECK_THAT(run("odd", odd, world().scans_argument()).output,
             Catch::Contains("4.359 could be mm or m: read as m; say --model-unit"));
}

TEST_CASE("overwrite takes away an earlier run, and nothing else", "[run]") {
  const World& w = world();
  const std::string one = "--scenes " + (w.scans / "000001.ply").string();
  REQUIRE(w.run("over", w.scans_argument()).status == 0);
  w.folder.write("over/of_mine.txt", "kept");
  CHECK(w.run("over", one + " --overwrite --resume").status == 2);
  CHECK(frames("over").size() == 3);
  CHECK(w.run("over", one + " --overwrite").status == 0);
  CHECK(frames("over").size() == 1);
  CHECK(fs::exists(w.folder / "over/of_mine.txt"));
}

}  // namespace posevote::run_test
