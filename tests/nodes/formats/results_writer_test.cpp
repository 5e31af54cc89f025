// SPDX-License-Identifier: BSD-3-Clause
#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>

#include "nodes/formats/results_files.hpp"
#include "nodes/formats/results_tables.hpp"
#include "tests/support/temporary_folder.hpp"

namespace posevote::results_writer_test {

using posevote::test::read_text;
using posevote::test::TemporaryFolder;

namespace {

formats::FrameReport frame(std::size_t number) {
  return {
      number, {"scans/a.ply", 0, static_cast<int>(number), {}}, 1.25, {{"load_scene", 0.5}}, "a"};
}

Detections one_chef() {
  Detection found;
  found.obj_id = 7;
  found.model = "chef";
  found.confidence = 0.5;
  found.look_alikes = {{Eigen::Isometry3d::Identity(), 0.5}};
  found.score = 0.4;
  found.density = 100;
  found.T_scene_model.linear() =
      Eigen::AngleAxisd(std::acos(0.0), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  found.T_scene_model.translation() = Eigen::Vector3d(0.1, -0.2, 1.5);
  return {{found}};
}

std::string bop_rows(std::size_t number) {
  return formats::bop_rows(formats::to_json(frame(number), one_chef()));
}

nlohmann::json json(const std::filesystem::path& file) {
  return nlohmann::json::parse(read_text(file));
}

}  // namespace

TEST_CASE("a row of results.csv is BOP's: R row by row, t in mm", "[write]") {
  const std::string row = bop_rows(3);
  int scene = 0;
  int image = 0;
  int object = 0;
  double score = 0;
  double r[9];
  double t[3];
  double time = 0;
  REQUIRE(std::sscanf(row.c_str(),
                      "%d,%d,%d,%lf,%lf %lf %lf %lf %lf %lf %lf %lf %lf,%lf %lf %lf,%lf\n", &scene,
                      &image, &object, &score, r, r + 1, r + 2, r + 3, r + 4, r + 5, r + 6, r + 7,
                      r + 8, t, t + 1, t + 2, &time) == 17);
  CHECK(scene == 0);
  CHECK(image == 3);
  CHECK(object == 7);
  CHECK(score == 0.5);
  CHECK(r[1] == Approx(-1));  // first row, second column
  CHECK(r[3] == Approx(1));
  CHECK(t[0] == Approx(100));
  CHECK(t[1] == Approx(-200));
  CHECK(t[2] == Approx(1500));
  CHECK(time == 1.25);
}

TEST_CASE("the files are complete after every frame", "[write]") {
  const TemporaryFolder folder;
  formats::begin_results(folder / "out");
  formats::ResultsWriter writer(folder / "out");
  CHECK(json(folder / "out/results.json")["frames"].empty());
  CHECK(json(folder / "out/failures.json").empty());
  for (std::size_t i = 0; i < 3; ++i) {
    writer.write(frame(i), one_chef(), {{"load_scene", 1, 0.5, 0.5}});
    const auto results = json(folder / "out/results.json");
    REQUIRE(results["frames"].size() == i + 1);
    CHECK(results["frames"][i]["frame"] == i);
    CHECK(results["frames"][i]["detections"][0]["T_scene_model"][3] == 0.1);
    CHECK(results["nodes"][0] == nlohmann::json::parse(
                                     R"({"node": "load_scene", "calls": 1, "total_s": 0.5,
                                         "mean_s": 0.5, "max_s": 0.5, "share": 1.0})"));
  }
  writer.write(formats::FailureReport{3, "scans/bad\xff.ply", "load_scene", "truncated"});
  writer.write(formats::FailureReport{4, "b.ply", "load_scene", "empty"});
  const auto failures = json(folder / "out/failures.json");
  REQUIRE(failures.size() == 2);
  CHECK(failures[1]["what"] == "empty");
}

TEST_CASE(
    "a pose is written as a matrix, a quaternion and a translation; what was rejected with why",
    "[write]") {
  const TemporaryFolder folder;
  formats::begin_results(folder / "out");
  Detections chef = one_chef();
  Detection& item = chef.items[0];
  item.T_scene_model = Eigen::Translation3d(1, 2, 3) *
                       Eigen::AngleAxisd(-1.5707963267948966, Eigen::Vector3d::UnitX());
  chef.rejected = {item};
  chef.rejected[0].why = "confidence 0.20 is below min_confidence 0.50";
  formats::ResultsWriter(folder / "out").write(frame(0), chef, {});
  const nlohmann::json results = json(folder / "out/results.json");
  CHECK(results["about"]["units"] == "m, rad, s");
  const nlohmann::json written = results["frames"][0];
  const nlohmann::json q = written["detections"][0]["q_wxyz"];
  CHECK(q[0] == Approx(std::sqrt(0.5)));  // of the two quaternions the one with w >= 0
  CHECK(q[1] == Approx(-std::sqrt(0.5)));
  CHECK(written["detections"][0]["t_m"] == nlohmann::json({1.0, 2.0, 3.0}));
  CHECK(!written["detections"][0].contains("why"));
  CHECK(written["rejected"][0]["why"] == "confidence 0.20 is below min_confidence 0.50");
}

TEST_CASE("a covariance is written row by row, or null, and the time of the search beside it",
          "[write]") {
  const TemporaryFolder folder;
  formats::begin_results(folder / "out");
  Detections chef = one_chef();
  chef.items.push_back(chef.items[0]);
  Detection& item = chef.items[0];
  item.covariance = Eigen::Matrix<double, 6, 6>::Identity();
  (*item.covariance)(1, 5) = 0.25;
  item.seconds = 0.5;
  formats::ResultsWriter(folder / "out").write(frame(0), chef, {});
  const auto found = json(folder / "out/results.json")["frames"][0]["detections"];
  REQUIRE(found[0]["covariance"].size() == 36);
  CHECK(found[0]["covariance"][7] == 1);
  CHECK(found[0]["covariance"][11] == 0.25);
  CHECK(found[0]["covariance"][31] == 0);
  CHECK(found[0]["seconds"] == 0.5);
  CHECK(found[1]["covariance"].is_null());
}

TEST_CASE("detections.csv names scan and model, in metres, quoted as RFC 4180 asks", "[write]") {
  const TemporaryFolder folder;
  formats::begin_results(folder / "out");
  Detections chef = one_chef();
  chef.items[0].model = "chef, \"old\"";
  chef.items[0].rmse = 0.00125;
  formats::FrameReport report = frame(3);
  report.file.path = "scans/a\nb.ply";
  formats::ResultsWriter(folder / "out").write(report, chef, {});
  const std::string text = read_text(folder / "out/detections.csv");
  const std::string head =
      "frame,scan,scene_id,im_id,obj_id,model,confidence,x_m,y_m,z_m,qw,qx,qy,qz,rms_m,pose_"
      "confidence\n"
      "3,\"scans/a\nb.ply\",0,3,7,\"chef, \"\"old\"\"\",0.5,0.1,-0.2,1.5,";
  CHECK(text.substr(0, head.size()) == head);
  double q[4], rms = 0, pose_confidence = 0;
  REQUIRE(std::sscanf(text.c_str() + head.size(), "%lf,%lf,%lf,%lf,%lf,%lf\n", q, q + 1, q + 2,
                      q + 3, &rms, &pose_confidence) == 6);
  CHECK(pose_confidence == 0.25);
  nlohmann::ordered_json earlier = formats::to_json(report, chef);  // before it was written
  earlier["detections"][0].erase("pose_confidence");
  CHECK_THAT(formats::table_rows(earlier), Catch::EndsWith(",0.00125,\n"));
  CHECK(q[0] == Approx(std::sqrt(0.5)));
  CHECK(q[3] == Approx(std::sqrt(0.5)));
  CHECK(rms == 0.00125);
}

TEST_CASE("poses that a scan does not tell apart are listed where there are any", "[write]") {
  const TemporaryFolder folder;
  formats::begin_results(folder / "out");
  Detections chef = one_chef();
  chef.items.push_back(chef.items[0]);
  chef.items[0].look_alikes[0].motion.translation().y() = 0.1;
  chef.items[1].look_alikes.clear();
  formats::ResultsWriter(folder / "out").write(frame(0), chef, {});
  const auto found = json(folder / "out/results.json")["frames"][0]["detections"];
  CHECK(found[0]["pose_confidence"] == 0.25);
  REQUIRE(found[0]["look_alikes"].size() == 1);
  CHECK(found[0]["look_alikes"][0]["motion"][7] == 0.1);
  CHECK(found[0]["look_alikes"][0]["probability"] == 0.5);
  CHECK_FALSE(found[1].contains("look_alikes"));
}

TEST_CASE("equal poses of a detection are listed as BOP does, in metres", "[write]") {
  const TemporaryFolder folder;
  formats::begin_results(folder / "out");
  Detections can = one_chef();
  Symmetries& symmetries = can.items[0].symmetries;
  symmetries.fixed_point = {0.1F, 0, 0.2F};
  symmetries.turns.emplace_back(0, 1, 0, 0);  // a half turn about x
  symmetries.axes = {Eigen::Vector3f::UnitZ()};
  formats::ResultsWriter(folder / "out").write(frame(0), can, {});
  const auto listed = json(folder / "out/results.json")["frames"][0]["detections"][0]["symmetries"];
  REQUIRE(listed["discrete"].size() == 1);
  const std::vector<double> about_x{1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0.4, 0, 0, 0, 1};
  for (std::size_t i = 0; i < 16; ++i)
    CHECK(listed["discrete"][0][i] == Approx(about_x[i]).margin(1e-7));
  CHECK(listed["continuous"][0]["axis"] == nlohmann::json::parse("[0.0, 0.0, 1.0]"));
  CHECK(listed["continuous"][0]["offset"][2] == Approx(0.2));
}

TEST_CASE("a full disk keeps what is written and names the file", "[write]") {
  const TemporaryFolder folder;
  folder.write("list.json", formats::json_list("[", {}, "\n]\n"));
  formats::AppendJson list(folder / "list.json", "\n]\n");
  list.append("1");
  const std::string before = read_text(folder / "list.json");
  // A file-size limit stands in for the full disk: writes beyond it fail with an error.
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = old;
  small.rlim_cur = 4000;
  setrlimit(RLIMIT_FSIZE, &small);
  std::string message;
  try {
    list.append("\"" + std::string(8000, 'x') + "\"");
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &old);
  CHECK(message.find("list.json: cannot be written") != std::string::npos);
  CHECK(read_text(folder / "list.json") == before);
  list.append("2");
  CHECK(json(folder / "list.json") == nlohmann::json::parse("[1, 2]"));
}

}  // namespace posevote::results_writer_test
