// SPDX-License-Identifier: BSD-3-Clause
// `posevote report`: one page of what runs, evaluations and experiments leave, whole or broken.
#include "tools/report/report.hpp"

#include <catch2/catch.hpp>
#include <regex>

#include "nodes/formats/results_files.hpp"
#include "tests/support/command.hpp"
#include "tools/evaluate/write_evaluation.hpp"
#include "tools/experiment/experiment.hpp"
#include "tools/report/html.hpp"
#include "tools/text.hpp"

namespace posevote::report_test {

using namespace posevote::test;
using Catch::Contains;

namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

/// The page without what stands in its scripts.
std::string without_scripts(const std::string& page) {
  std::string text;
  std::size_t at = 0;
  for (std::size_t begin = page.find("<script"); begin != std::string::npos;
       begin = page.find("<script", at)) {
    const std::size_t end = page.find('>', begin) + 1;
    text += page.substr(at, end - at);
    at = page.find("</script>", end);
  }
  return text + page.substr(at);
}

/// What is wrong with the nesting of a page's tags, its entities, or its references to other files;
/// "" where nothing is.
std::string flaw(const std::string& page) {
  std::vector<std::string> open;
  const std::regex tag(
      "<(/?)([a-zA-Z0-9]+)((?: [a-zA-Z-]+=\"[^\"<]*\")*)(/?)>|<!DOCTYPE html>|[<>]");
  const std::size_t style = page.find("<style>"), styled = page.find("</style>");
  const std::string text = page.substr(0, style + 7) + page.substr(styled);
  for (std::sregex_iterator i(text.begin(), text.end(), tag), end; i != end; ++i) {
    const std::string name = (*i)[2], attributes = (*i)[3];
    if (i->str() == "<!DOCTYPE html>" || (*i)[4] == "/") continue;
    if (name.empty()) return "stray bracket: " + text.substr(std::size_t(i->position()), 80);
    if ((*i)[1] != "/")
      open.push_back(name);
    else if (open.empty() || open.back() != name)
      return "</" + name + "> closes no such tag";
    else
      open.pop_back();
    if (attributes.find("href=\"") != attributes.find("href=\"#")) return "link: " + attributes;
  }
  if (!open.empty()) return "<" + open.back() + "> is not closed";
  if (std::regex_search(text, std::regex("&(?!(amp|lt|gt|quot);)"))) return "bare &";
  if (count(text, " src=\"") != count(text, " src=\"data:image/")) return "file elsewhere";
  return mend_utf8(page) == page ? "" : "not UTF-8";
}

std::string page_of(const std::filesystem::path& folder) {
  ReportCommand command;
  command.folder = folder.string();
  return report_page(command);
}

std::string whole_page(const TemporaryFolder& folder) {
  std::string page = page_of(folder.path());
  // The checker's expressions recurse letter by letter.
  const std::string checked = std::regex_replace(
      without_scripts(page), std::regex("base64,[A-Za-z0-9+/]{200}[^\"]*"), "base64,");
  CHECK(flaw(checked) == "");
  return page;
}

/// What the viewer is given of the run.
nlohmann::json data_of(const std::string& page, const std::string& id = "run0") {
  const std::string begin = "<script type=\"application/json\" id=\"" + id + "\">";
  const std::size_t at = page.find(begin) + begin.size();
  return nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
}

Detection found(const std::string& model, double confidence) {
  Detection found;
  found.obj_id = model == "chicken" ? 2 : 1;
  found.model = model;
  found.confidence = confidence;
  found.density = 1234;
  found.runner_up_density = 56;
  found.inlier_fraction = 0.78;
  found.rmse = 0.00125;
  return found;
}

formats::FrameReport frame(std::size_t number, const std::string& name) {
  return {number,
          {"scans/" + name + ".ply", 0, static_cast<int>(number), {}},
          1.0 + static_cast<double>(number),
          {{"load_scene", 0.25}, {"match_features", 0.75}},
          name,
          {{"latency_s", {0.5 * static_cast<double>(number + 1)}}}};
}

/// A run of three frames and a failure, the scans of which are gone.
void write_run(const std::filesystem::path& folder) {
  formats::begin_results(folder);
  formats::ResultsWriter writer(folder);
  writer.write(frame(0, "one"), {{found("chef", 0.91), found("chicken", 0.42)}}, {});
  writer.write(frame(1, "two"), {{found("chef", 0.93)}}, {});
  writer.write(frame(2, "three"), {}, {});
  writer.write(formats::FailureReport{3, "scans/bad.ply", "load_scene", "holds 3 of 9 vertices"});
  std::ofstream(folder / "effective.yaml") << "match_features: {max_ratio: 1}  # a < b\n";
}

Evaluation small_evaluation() {
  Evaluation evaluation;
  evaluation.rules = choose_rules("pose");
  evaluation.objects[1].resize(1);
  evaluation.names[1] = "chef & co";
  evaluation.all.resize(1);
  evaluation.all[0].counts = {3, 4, 3};
  evaluation.all[0].verdicts = {{0.7, true, 5}, {0.2, false, 6}};
  evaluation.notes = {"image 7 was not judged"};
  InstanceResult instance;
  instance.met = {1};
  evaluation.instances = {instance};
  return evaluation;
}

}  // namespace

TEST_CASE("a run: scans, models, times, failures, parameters", "[report]") {
  const TemporaryFolder folder;
  write_run(folder.path());
  const std::string page = whole_page(folder);
  CHECK_THAT(page, Contains("<dt>frames answered</dt><dd>3</dd>") &&
                       Contains("<dt>frames failed</dt><dd>1</dd>") &&
                       Contains("<dt>detections</dt><dd>3</dd>") &&
                       Contains("<dt>median time of a frame</dt><dd>2.00 s</dd>") &&
                       Contains("<dt>longest</dt><dd>3.00 s</dd>") &&
                       Contains("<dt>latency of a frame</dt>"
                                "<dd>1 s median, 1.5 s 95 %, 1.5 s 99 %</dd>"));
  // chef: two detections in two frames, their confidences in one bar.
  CHECK_THAT(page,
             Contains("<tr><td>chef</td><td class=\"number\">2</td><td class=\"number\">2</td>"
                      "<td class=\"number\">0.920</td>") &&
                 Contains("<title>0.90 to 0.95: 2</title>"));
  CHECK_THAT(page, Contains("<td>match_features</td><td class=\"number\">2.25</td>"
                            "<td class=\"number\">750.0</td><td class=\"number\">750.0</td>"
                            "<td class=\"number\">75.0</td>"));
  CHECK_THAT(page, Contains("holds 3 of 9 vertices") && Contains("1 in load_scene") &&
                       Contains("# a &lt; b"));
  const nlohmann::json data = data_of(page);
  REQUIRE(data["scans"].size() == 4);
  const nlohmann::json& chicken = data["scans"][0]["found"][1];
  CHECK(data["models"][chicken["model"].get<std::size_t>()]["name"] == "chicken");
  CHECK(chicken["confidence"] == 0.42);
  CHECK(chicken["rmse_m"] == 0.00125);
  CHECK(chicken["T"].size() == 16);
  CHECK(data["scans"][2]["found"].empty());
  CHECK(data["scans"][3]["failure"]["what"] == "holds 3 of 9 vertices");
  CHECK_THAT(data["scans"][0]["note"].get<std::string>(), Contains("scans/one.ply"));
  CHECK(page == page_of(folder.path()));
}

TEST_CASE("odd names and messages", "[report]") {
  const TemporaryFolder folder;
  const std::string name = "a<b>&\"c\"\xff";
  {
    formats::begin_results(folder.path());
    formats::ResultsWriter writer(folder.path());
    writer.write(frame(0, name), {{found("</td><script>x</script>", 2)}}, {});
    writer.write(formats::FailureReport{1, name, "<node>", "\"&\xfe\n"});
  }
  std::ofstream(folder / "effective.yaml") << "</pre>\xff\n";
  const std::string page = whole_page(folder);
  CHECK_THAT(page, Contains("a&lt;b&gt;&amp;&quot;c&quot;\xef\xbf\xbd"));
  CHECK(count(page, "</script>") == 2);  // the viewer and its data, and none of the names
  CHECK(data_of(page)["models"][0]["name"] == "</td><script>x</script>");
}

TEST_CASE("torn and strange lines of results are left out", "[report]") {
  const TemporaryFolder folder;
  write_run(folder.path());
  const std::string whole = read_text(folder / "results.json");
  folder.write("results.json", whole.substr(0, whole.find("three") + 2));
  std::string page = whole_page(folder);
  CHECK_THAT(page,
             Contains("<dt>frames answered</dt><dd>2</dd>") && Contains("Torn lines left out: 1."));

  folder.write(
      "results.json",
      "{\"frames\": [\n"
      "{\"frame\": \"x\", \"file\": 7, \"stages\": [1], \"detections\": 3},\n"
      "{\"frame\": 1e300, \"stages\": {\"a\": \"b\"}, \"detections\": [{\"confidence\": null}]},\n"
      "{\"frame\": 2, \"detections\": [{\"confidence\": -1e300, \"obj_id\": \"<\"}, []]}\n");
  page = whole_page(folder);
  CHECK_THAT(without_scripts(page),
             Contains("<dt>frames answered</dt><dd>3</dd>") && !Contains("nan"));
  folder.write("results.json", "\x89\xff{{{");
  folder.write("failures.json", "");
  CHECK_THAT(whole_page(folder), Contains("<dt>frames answered</dt><dd>0</dd>"));
}

TEST_CASE("thousands of frames", "[report]") {
  const TemporaryFolder folder;
  std::string results = "{\"frames\": [\n";
  for (int i = 0; i < 2050; ++i)
    results += "{\"frame\": " + std::to_string(i) + ", \"file\": \"a.ply\", \"detections\": []},\n";
  folder.write("results.json", results);
  const std::string page = page_of(folder.path());
  CHECK(data_of(page)["scans"].size() == 2050);
  CHECK(page.size() < 3'000'000);
}

TEST_CASE("an experiment: its table and plot, and each method's run and evaluation", "[report]") {
  const TemporaryFolder folder;
  const nlohmann::ordered_json rows = {
      {{"method", "posevote"}, {"object", "all"}, {"correct", 187.0}, {"recall", 0.99468}},
      {{"method", "posevote"}, {"object", "1"}, {"correct", 45.0}, {"recall", 1.0}}};
  const nlohmann::ordered_json table{{"dataset", "a <replica>"}, {"rows", rows}};
  write_report(folder / "uwa", table.dump(), to_csv(rows), "<svg id=\"frame0\"></svg>");
  write_run(folder / "posevote");
  write_evaluation(small_evaluation(), folder / "posevote/evaluation");
  CHECK(read_text(folder / "posevote/evaluation/verdicts.csv") ==
        "rule,line,score,correct\npose,5,0.7,1\npose,6,0.2,0\n");
  folder.write("replica/test/000001/scene_gt.json", "{}");
  const std::string page = whole_page(folder);
  CHECK_THAT(page, Contains("<h2 id=\"part0\">uwa</h2>") &&
                       Contains("<h2 id=\"part1\">posevote</h2>") &&
                       Contains("<h2 id=\"part2\">posevote/evaluation</h2>") && !Contains("part3"));
  CHECK_THAT(page, Contains("Data set: a &lt;replica&gt;") &&
                       Contains("<td class=\"number\">187</td><td class=\"number\">0.995</td>") &&
                       Contains("Object by object"));
  CHECK_THAT(page, Contains("pose: pose 50 mm, 7.5 deg.") && Contains("1: chef &amp; co.") &&
                       Contains("Note: image 7 was not judged.") &&
                       Contains("Instance by instance"));
  CHECK(count(page, "data:image/svg+xml") == 3);
  CHECK(data_of(page, "run1")["scans"].size() == 4);
}

TEST_CASE("an experiment and an evaluation that are torn", "[report]") {
  const TemporaryFolder folder;
  folder.write("uwa.json", "{\"dataset\": \"x");
  folder.write("uwa.csv", "method,recall\nposevote,0.5\nransac,<0.5\nhough3d");
  folder.write("uwa.svg", "<svg><g");
  folder.write("growth.json", {});
  folder.write("growth.csv", "");
  folder.write("growth.svg", "");
  folder.write("judged/evaluation.json", "{\"all\": 3}");
  const std::string page = whole_page(folder);
  CHECK_THAT(page, Contains("uwa.json cannot be read.") && Contains("<td>ransac</td>") &&
                       !Contains("hough3d") && Contains("evaluation.json cannot be read."));
}

TEST_CASE("a folder that holds nothing of ours is refused by name", "[report]") {
  const TemporaryFolder folder;
  folder.write("notes.csv", "a,b\n1,2\n");
  folder.write("data/pictures/a.png", "x");
  CHECK_THROWS_AS(page_of(folder.path()), std::invalid_argument);
  CHECK_THROWS_WITH(page_of(folder.path()),
                    Contains(folder.path().string()) && Contains("expected results.json"));
  CHECK_THROWS_AS(page_of(folder / "nowhere"), std::invalid_argument);
  CHECK_THROWS_WITH(page_of(folder / "notes.csv"), Contains("notes.csv: no such folder"));
}

TEST_CASE("posevote report and view on the command line", "[report]") {
  const TemporaryFolder folder;
  write_run(folder / "out");
  const std::string out = (folder / "out").string();
  const CommandResult made = run_posevote(folder, "report " + out);
  INFO(made.output);
  CHECK(made.status == 0);
  CHECK_THAT(made.output, Contains("wrote " + out + "/report.html"));
  CHECK(read_text(folder / "out/report.html") == page_of(folder / "out"));
  CHECK(run_posevote(folder, "view " + out + " --out " + (folder / "a.html").string()).status == 0);
  CHECK(read_text(folder / "a.html") == page_of(folder / "out"));

  CHECK(run_posevote(folder, "report " + (folder / "nowhere").string()).status == 2);
  CHECK(run_posevote(folder, "report " + out + " --size nan").status == 2);
  const CommandResult scans = run_posevote(folder, "view " + out + " --scans four");
  CHECK(scans.status == 2);
  CHECK_THAT(scans.output, Contains("--scans four"));
  const CommandResult none = run_posevote(folder, "view " + folder.path().string());
  CHECK(none.status == 2);
  CHECK_THAT(none.output, Contains("no results.json of a run"));
  const CommandResult full = run_posevote(folder, "report " + out + " --out /dev/full");
  CHECK(full.status == 1);
  CHECK_THAT(full.output, Contains("/dev/full: cannot be written"));
}

}  // namespace posevote::report_test
