// SPDX-License-Identifier: BSD-3-Clause
// `explain` and `view` of runs over recordings: the scans are found again with their cameras.
#include "tests/pipelines/run_world.hpp"

namespace posevote::found_again_test {

using namespace posevote::test;

namespace {

/// The images of the world as a folder of depth PNGs with one camera for all.
struct Recordings {
  TemporaryFolder folder;
  fs::path pngs = folder / "pngs", tum = folder / "tum";

  Recordings() {
    const fs::path images = world().folder / "data/test/000001";
    nlohmann::json camera = read_json(images / "scene_camera.json")["0"];
    fs::create_directories(pngs / "depth");
    for (const auto& image : fs::directory_iterator(images / "depth"))
      fs::copy(image.path(), pngs / "depth" / image.path().filename());
    folder.write("pngs/camera.json", camera.dump());
    fs::copy(pngs, tum, fs::copy_options::recursive);
    folder.write("tum/depth.txt", "# timestamp file\n1.5 depth/000000.png\n2.5 depth/000001.png\n");
  }

  /// Runs over a recording, explains its second scan, and returns the page of the run.
  nlohmann::json look_at(const std::string& name, const std::string& scene) const {
    const std::string out = (folder / (name + "_out")).string();
    const auto done = [this](const std::string& arguments) {
      const CommandResult result = run_posevote(folder, arguments);
      INFO(arguments << "\n" << result.output);
      REQUIRE(result.status == 0);
      return result.output;
    };
    done("run demo --models " + world().models.string() + " --scenes " + (folder / name).string() +
         " --out " + out + " --cache " + (folder / "models").string() +
         " --set write_picture.every=0 --set write_overlay.every=0");
    const std::string said = done("explain " + out + " --scene " + scene + " --object 1 --json");
    const auto object = nlohmann::json::parse(said.substr(said.find('{')))["objects"][0];
    CHECK(object["found"] == true);
    CHECK(object["best"]["judged"]["confidence"] > 0.5);
    done("view " + out + " --votes obj_000001");
    CHECK_FALSE(fs::exists(folder / "cache/posevote"));  // the models were made for --cache
    const std::string page = read_text(out + "/report.html");
    const std::string begin = "<script type=\"application/json\" id=\"run0\">";
    const std::size_t at = page.find(begin) + begin.size();
    return nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
  }
};

}  // namespace

TEST_CASE("runs over depth images with one camera, and over TUM folders, are explained and viewed",
          "[view][explain]") {
  const Recordings recordings;
  for (const std::string name : {"pngs", "tum"}) {
    const nlohmann::json page = recordings.look_at(name, "000001");
    INFO(name << " " << page.dump().substr(0, 2000));
    REQUIRE(page["scans"].size() == (name == "pngs" ? 3 : 2));
    for (const nlohmann::json& scan : page["scans"]) {
      CHECK_FALSE(scan.contains("note"));
      CHECK(scan["scan"]["points"] > 10000);
      CHECK(scan["votes"]["true_points"] > 100);
    }
  }
}

}  // namespace posevote::found_again_test
