// SPDX-License-Identifier: BSD-3-Clause
// `posevote explain` on whole runs: an object that is hidden, one that is not there, one whose file
// is in another unit.
#include <cmath>
#include <sstream>

#include "nodes/formats/color_image.hpp"
#include "nodes/formats/read_scan.hpp"
#include "nodes/formats/write_ply.hpp"
#include "tests/pipelines/run_world.hpp"

namespace posevote::explain_test {

using namespace posevote::test;

namespace {

CommandResult explain(const std::string& arguments) {
  return run_posevote(world().folder, "explain " + arguments);
}

/// The one object of an explanation.
nlohmann::json explained(const std::string& arguments) {
  const CommandResult result = explain(arguments + " --json");
  INFO(result.output);
  REQUIRE(result.status == 0);
  const std::string& text = result.output;
  return nlohmann::json::parse(text.substr(text.find('{'))).at("objects").at(0);
}

std::string text_of(const nlohmann::json& object) {
  std::string text;
  for (const auto& sentence : object.at("sentences")) text += sentence.get<std::string>() + "\n";
  return text;
}

/// A run over the world's scans, once for all cases.
std::string run_folder() {
  static const std::string out = [] {
    const CommandResult run = world().run("explained", world().scans_argument());
    INFO(run.output);
    REQUIRE(run.status == 0);
    return (world().folder / "explained").string();
  }();
  return out;
}

/// The pose that a run found of an object.
std::string found_pose(const std::string& out, std::size_t frame, int obj_id) {
  const nlohmann::json results = read_json(out + "/results.json");
  for (const auto& found : results.at("frames").at(frame).at("detections"))
    if (found["obj_id"] == obj_id) {
      std::string text;
      for (const auto& number : found["T_scene_model"]) text += number.dump() + " ";
      return text;
    }
  FAIL("the object is not found");
  return "";
}

}  // namespace

TEST_CASE("a found object is explained by its figures", "[explain]") {
  const nlohmann::json object = explained(run_folder() + " --scene 000000 --object 1");
  INFO(object.dump(1));
  CHECK(object["found"] == true);
  CHECK(object["best"]["features"] > 10);
  CHECK(object["best"]["agreeing"] > 5);
  CHECK(object["best"]["search"].back()["place"] > 0);
  CHECK(object["best"]["judged"]["confidence"] > 0.5);
}

TEST_CASE("an object that is not there has no pose that its matches agree on", "[explain]") {
  const nlohmann::json object = explained(run_folder() + " --scene 000001 --object 2");
  INFO(object.dump(1));
  CHECK(object["found"] == false);
  CHECK(object["verdict"]["cause"] == "no trace");
  CHECK(object["best"]["judged"]["confidence"] < 0.5);
}

TEST_CASE("an object behind a board is told hidden, by its true pose", "[explain]") {
  const World& w = world();
  const std::string pose = found_pose(run_folder(), 1, 1);
  const std::string truth = w.folder.write("truth.txt", pose);
  std::istringstream numbers(pose);
  Eigen::Matrix4d T_scene_model;
  for (int i = 0; i < 16; ++i) numbers >> T_scene_model(i / 4, i % 4);
  Scan scan = formats::read_scan(w.scans / "000001.ply", 1);
  const Eigen::Vector3f center = T_scene_model.topRightCorner<3, 1>().cast<float>();
  const float range = center.norm();
  // All that is measured around it comes to lie on a board two thirds of the way to it.
  for (Eigen::Index i = 0; i < scan.points.rows(); ++i) {
    const Eigen::Vector3f ray = scan.points.row(i).transpose().normalized();
    const float along = ray.dot(center) / range;
    if (std::acos(std::min(1.F, along)) * range < 0.2F)
      scan.points.row(i) = ray.transpose() * (0.67F * range / along);
  }
  scan.normals.resize(0, 3);
  fs::create_directories(w.folder / "hidden");
  formats::write_ply(w.folder / "hidden/behind.ply", scan, 1);
  const CommandResult run =
      w.run("hidden-out", "--scenes " + (w.folder / "hidden/behind.ply").string());
  INFO(run.output);
  REQUIRE(run.status == 0);
  const std::string out = (w.folder / "hidden-out").string();
  const nlohmann::json object = explained(out + " --object 1 --truth " + truth);
  INFO(object.dump(1));
  CHECK(object["found"] == false);
  CHECK(object["verdict"]["cause"] == "not seen");
  CHECK(object["verdict"]["detail"] == "hidden");
  CHECK(object["truth"]["seen"]["hidden"] > 0.8);
  CHECK(text_of(object).find("hidden") != std::string::npos);
}

TEST_CASE("all that a run missed is explained, and whether it can be told without the truth",
          "[explain]") {
  const World& w = world();
  const std::string set = (w.folder / "data").string();
  const std::string out = (w.folder / "missing").string();
  const CommandResult run =
      run_posevote(w.folder, "run demo --dataset " + set + " --out " + out +
                                 " --set segment_objects.min_confidence=0.999999");
  INFO(run.output);
  REQUIRE(run.status == 0);
  const CommandResult told = explain(out + " --dataset " + set + " --json");
  INFO(told.output);
  REQUIRE(told.status == 0);
  const nlohmann::json all = nlohmann::json::parse(told.output.substr(told.output.find('{')));
  CHECK(all["missed"] == 4);  // of three scans
  CHECK(all["causes"]["refused"] == 4);
  CHECK(all["confirmed"] == 4);
  CHECK(all["misses"][0]["scene"] == "000001_000000");
}

TEST_CASE("of an object that was found it is told where another may be", "[explain]") {
  const World& w = world();
  const std::string spec = w.folder.write("two.yaml",
                                          "seed: 6\n"
                                          "models:\n"
                                          "  - {shape: figure, seed: 3, size: 0.2}\n"
                                          "scenes:\n"
                                          "  - {sensor: rgbd, objects: [1, 1], clutter: 0}\n");
  const std::string set = (w.folder / "two").string(), out = (w.folder / "one-of-two").string();
  REQUIRE(run_posevote(w.folder, "simulate " + spec + " --out " + set).status == 0);
  const CommandResult run = run_posevote(w.folder, "run demo --dataset " + set + " --out " + out +
                                                       " --set segment_objects.max_instances=1");
  INFO(run.output);
  REQUIRE(run.status == 0);
  const auto objects = [&](const std::string& more) {
    const CommandResult told = explain(out + " --object 1 --scene 000001_000000 --json" + more);
    INFO(told.output);
    REQUIRE(told.status == 0);
    return nlohmann::json::parse(told.output.substr(told.output.find('{'))).at("objects");
  };
  const nlohmann::json told = objects("");
  INFO(told.dump(1));
  REQUIRE(told.size() >= 2);
  CHECK(told[0]["found"] == true);
  CHECK(told[0]["one_more"] == false);
  CHECK(told[1]["found"] == false);
  CHECK(told[1]["one_more"] == true);
  const nlohmann::json with_truth = objects(" --dataset " + set);
  REQUIRE(with_truth.size() == 2);
  CHECK(with_truth[1]["best_is_true"] == true);  // it is the candidate that was told
  CHECK(with_truth[1]["best"]["T_scene_model"] == told[1]["best"]["T_scene_model"]);
}

TEST_CASE("a model in another unit is named", "[explain]") {
  const World& w = world();
  fs::create_directories(w.folder / "units");
  fs::copy(w.models / "obj_000002.ply", w.folder / "units/obj_000002.ply");
  const Scan micrometres = formats::read_scan(w.models / "obj_000001.ply", 1000);
  formats::write_ply(w.folder / "units/obj_000001.ply", micrometres, 1);
  const std::string out = (w.folder / "units-out").string();
  const CommandResult run =
      run_posevote(w.folder, "run demo --models " + (w.folder / "units").string() + " --scenes " +
                                 (w.scans / "000000.ply").string() + " --out " + out);
  INFO(run.output);
  REQUIRE(run.status == 1);
  const nlohmann::json object = explained(out + " --object 1");
  INFO(object.dump(1));
  CHECK(object["verdict"]["cause"] == "scan failed");  // as check_size does it
  CHECK(text_of(object).find("--model-unit") != std::string::npos);
}

TEST_CASE("a setting is advised once it was tried", "[explain]") {
  const World& w = world();
  const CommandResult run =
      w.run("strict-out", "--set segment_objects.min_confidence=0.999999 --scenes " +
                              (w.scans / "000001.ply").string());
  INFO(run.output);
  REQUIRE(run.status == 0);
  const nlohmann::json object = explained((w.folder / "strict-out").string() + " --object 1 --try");
  INFO(object.dump(1));
  CHECK(object["found"] == false);
  CHECK(object["verdict"]["cause"] == "refused");
  REQUIRE(object["tried"].size() >= 1);
  CHECK(object["tried"].back()["found"] == true);
  CHECK(object["tried"].back()["setting"].get<std::string>().find("min_confidence=0.") !=
        std::string::npos);
  CHECK(text_of(object).find("finds it") != std::string::npos);
}

TEST_CASE("a scan that failed says in which node", "[explain]") {
  const World& w = world();
  w.folder.write("unreadable.ply", "Dear sir or madam\n");
  const CommandResult run =
      w.run("failed-out", "--scenes " + (w.folder / "unreadable.ply").string());
  CHECK(run.status == 1);
  const CommandResult said = explain((w.folder / "failed-out").string() + " --object 1");
  INFO(said.output);
  CHECK(said.status == 0);
  CHECK(said.output.find("load_scene") != std::string::npos);
}

TEST_CASE("what explain refuses", "[explain]") {
  const World& w = world();
  const std::string out = run_folder();
  const auto refused = [](const std::string& arguments, const std::string& why) {
    const CommandResult result = explain(arguments);
    INFO(result.output);
    CHECK(result.status == 2);
    CHECK(result.output.find(why) != std::string::npos);
  };
  refused(w.scans.string() + " --scene 1", "effective.yaml");
  refused(out + " --scene 00000", "did you mean '00000");
  refused(out, "say --scene");
  refused(out + " --dataset nowhere", "nowhere");
  refused(out + " --scene 000000 --object obj_00001", "did you mean 'obj_00000");
  refused(out + " --scene 000000 --truth nothing.txt", "--object");
  refused(out + " --scene 000000 --object 1 --truth nothing.txt", "nothing.txt");
}

TEST_CASE("pictures are drawn, and the run's own results stay as they are", "[explain]") {
  const World& w = world();
  const std::string out = run_folder();
  const std::string before = read_text(out + "/results.json");
  const auto drawn = [&](const std::string& what) {
    const std::string picture = (w.folder / (what + ".png")).string();
    const CommandResult result =
        explain(out + " --scene 000001 --object 1 --show " + what + " --picture " + picture);
    INFO(result.output);
    REQUIRE(result.status == 0);
    return formats::read_color_image(picture);
  };
  /// Share of an image's pixels in which a channel is well above both others; 3: in which none is.
  const auto share = [](const ColorImage& image, std::size_t channel) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < image.values.size(); i += 3) {
      std::size_t most = 3;
      for (std::size_t k = 0; k < 3; ++k)
        if (image.values[i + k] > image.values[i + (k + 1) % 3] + 60 &&
            image.values[i + k] > image.values[i + (k + 2) % 3] + 60)
          most = k;
      count += most == channel;
    }
    return 3.0 * static_cast<double>(count) / static_cast<double>(image.values.size());
  };
  constexpr std::size_t kRed = 0, kGreen = 1, kBlue = 2, kGrey = 3;
  CHECK(share(drawn("candidates"), kGrey) < 0.999);
  CHECK(share(drawn("matches"), kGreen) > 1e-4);
  const ColorImage votes = drawn("votes");
  CHECK(share(votes, kGrey) > 0.5);
  CHECK(share(votes, kRed) > 1e-5);
  CHECK(share(votes, kBlue) > share(votes, kRed));
  CHECK(read_text(out + "/results.json") == before);
}

}  // namespace posevote::explain_test
