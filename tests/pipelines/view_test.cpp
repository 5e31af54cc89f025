// SPDX-License-Identifier: BSD-3-Clause
// `posevote view` of a real run: scans, models, true poses and votes on the page, and the page in a
// browser.
#include "tests/pipelines/run_world.hpp"

namespace posevote::view_test {

using namespace posevote::test;
using Catch::Contains;

namespace {

/// The data set of the world, of which the third image is broken, and a run on it.
struct ViewedRun {
  TemporaryFolder folder;
  fs::path dataset = folder / "set", out = folder / "out";

  ViewedRun() {
    fs::copy(world().folder / "data", dataset, fs::copy_options::recursive);
    folder.write("set/test/000001/depth/000002.png", "broken");
    const CommandResult run = run_posevote(
        folder, "run demo --dataset " + dataset.string() + " --out " + out.string() +
                    " --set write_picture.every=0 --set write_overlay.every=0"
                    " --set pick_scene_features.spacing=2.5");  // more votes than shown
    INFO(run.output);
    REQUIRE(run.status == 1);
  }

  CommandResult view(const std::string& more) const {
    return run_posevote(folder, "view " + out.string() + " " + more);
  }

  nlohmann::json page() const {
    const std::string text = read_text(out / "report.html");
    const std::string begin = "<script type=\"application/json\" id=\"run0\">";
    const std::size_t at = text.find(begin) + begin.size();
    return nlohmann::json::parse(text.substr(at, text.find("</script>", at) - at));
  }
};

const ViewedRun& viewed() {
  static const ViewedRun run;
  return run;
}

bool has(const std::string& program) {
  return std::system(("command -v " + program + " > /dev/null 2>&1").c_str()) == 0;
}

CommandResult browse(const std::string& more) {
  const fs::path log = viewed().folder / "browser.txt";
  const std::string command =
      "python3 '" POSEVOTE_SOURCE_DIR "/tests/pipelines/view_in_browser.py' '" +
      (viewed().out / "report.html").string() + "' '" +
      (fs::path(POSEVOTE_BINARY).parent_path() / "tests/pictures").string() + "' " + more + " > '" +
      log.string() + "' 2>&1";
  return {std::system(command.c_str()), read_text(log)};
}

}  // namespace

TEST_CASE("a run's page holds scans, models, true poses, votes and the command line", "[view]") {
  const CommandResult made = viewed().view("--votes obj_000001");
  INFO(made.output);
  REQUIRE(made.status == 0);
  const nlohmann::json page = viewed().page();
  REQUIRE(page["scans"].size() == 3);
  const nlohmann::json& first = page["scans"][0];
  CHECK(first["scan"]["points"].get<int>() <= 40000);
  CHECK(first["scan"]["points"].get<int>() > 10000);
  CHECK(first["scan"]["true_points"] > first["scan"]["points"]);
  CHECK(first["truth"].size() == 2);
  CHECK(first["found"].size() == 2);
  CHECK(first["votes"]["obj_id"] == 1);
  CHECK(first["votes"]["points"].get<int>() > 10000);
  CHECK(first["votes"]["true_points"] > first["votes"]["points"]);
  CHECK(first["votes"]["largest"] > 100);
  CHECK(page["models"].size() == 2);
  CHECK(page["models"][1]["surface"]["faces"].get<int>() <= 4000);
  CHECK_THAT(page["scans"][2]["failure"]["what"].get<std::string>(), Contains("PNG"));
  CHECK_THAT(page["scans"][2]["note"].get<std::string>(), Contains("000002.png"));
  const std::string text = read_text(viewed().out / "report.html");
  CHECK_THAT(text, Contains("run demo --dataset " + viewed().dataset.string()));
}

TEST_CASE("a page says why each object was found or not, where it is asked to", "[view]") {
  const CommandResult made = viewed().view("--explain");
  INFO(made.output);
  REQUIRE(made.status == 0);
  const nlohmann::json page = viewed().page();
  for (const int scan : {0, 1}) {
    const nlohmann::json& objects = page["scans"][scan]["explained"]["objects"];
    REQUIRE(objects.size() >= page["scans"][scan]["found"].size());
    CHECK(objects[0]["cause"] == "found");
    CHECK_FALSE(objects[0]["says"].empty());
  }
  CHECK_THAT(page["scans"][2]["explained"].dump(), Contains("PNG"));
}

TEST_CASE("a page says which models were never found", "[view]") {
  const CommandResult made = viewed().view("--scans 000001_000001");
  INFO(made.output);
  REQUIRE(made.status == 0);
  CHECK(viewed().page()["scans"].size() == 1);
  const ViewedRun& run = viewed();
  TemporaryFolder folder;
  fs::copy(run.out, folder / "out", fs::copy_options::recursive);
  // As of a run of that scan alone.
  std::string results = read_text(folder / "out/results.json");
  const std::size_t first = results.find("{\"frame\":0"), second = results.find("{\"frame\":1");
  REQUIRE(second < results.size());
  folder.write("out/results.json", results.erase(first, second - first));
  REQUIRE(run_posevote(folder, "view " + (folder / "out").string()).status == 0);
  CHECK_THAT(read_text(folder / "out/report.html"),
             Contains("<td>obj_000002</td><td class=\"number\">0</td>") && Contains("never found"));
}

TEST_CASE("the page keeps to its size, and says what is not shown", "[view]") {
  REQUIRE(viewed().view("--size 2").status == 0);
  CHECK(fs::file_size(viewed().out / "report.html") < 2'000'000);
  CHECK(viewed().page()["scans"][0]["scan"]["points"].get<int>() > 5000);
  REQUIRE(viewed().view("--size 1").status == 0);
  CHECK(fs::file_size(viewed().out / "report.html") < 1'200'000);

  const CommandResult unknown = viewed().view("--votes teapot");
  CHECK(unknown.status == 2);
  CHECK_THAT(unknown.output, Contains("no such object") && Contains("obj_000001, obj_000002"));
  const CommandResult nowhere = viewed().view("--dataset " + (viewed().folder / "no").string());
  CHECK(nowhere.status == 2);
  CHECK_THAT(nowhere.output, Contains("no such folder"));
}

TEST_CASE("a run is resumed with each start on record", "[view]") {
  TemporaryFolder folder;
  const std::string run = "run demo --models " + world().models.string() + " --scenes " +
                          (world().scans / "000001.ply").string() + " --out " +
                          (folder / "out").string() + " --quiet";
  REQUIRE(run_posevote(folder, run).status == 0);
  REQUIRE(run_posevote(folder, run + " --resume").status == 0);
  const nlohmann::json record = read_json(folder / "out/run.json");
  REQUIRE(record["starts"].size() == 2);
  CHECK(record["starts"][1]["command"].back() == "--resume");
  CHECK(record["models"].size() == 2);
  REQUIRE(run_posevote(folder, run + " --overwrite").status == 0);
  CHECK(read_json(folder / "out/run.json")["starts"].size() == 1);
}

TEST_CASE("the page in a browser: turning, ticks, filters, details", "[view]") {
  if (!has("chromedriver") || !has("chromium") || !has("python3")) {
    WARN("skipped: needs chromium, chromium-driver and python3 (tools/packages.txt)");
    return;
  }
  REQUIRE(viewed().view("--votes obj_000001").status == 0);
  const CommandResult used = browse("");
  INFO(used.output);
  CHECK(used.status == 0);
  const CommandResult without = browse("--without-webgl");
  INFO(without.output);
  CHECK(without.status == 0);
}

}  // namespace posevote::view_test
