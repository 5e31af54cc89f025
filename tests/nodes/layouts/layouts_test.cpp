// SPDX-License-Identifier: BSD-3-Clause
// Each layout of data sets, read from tiny files; and what is said of contradictions.
#include <catch2/catch.hpp>

#include "nodes/formats/write_ply.hpp"
#include "nodes/layouts/files.hpp"
#include "nodes/layouts/layout.hpp"
#include "tests/support/temporary_folder.hpp"

namespace posevote::layouts_test {

using namespace posevote::layouts;
using Catch::Contains;
using posevote::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

constexpr const char* kShift = "1 0 0 10\n0 1 0 20\n0 0 1 900\n0 0 0 1\n";

void write_box(const std::filesystem::path& file) {
  Mesh bar;
  bar.points.resize(8, 3);
  for (int i = 0; i < 8; ++i)
    bar.points.row(i) << (i & 1 ? 30.F : 0.F), (i & 2 ? 40.F : 0.F), (i & 4 ? 120.F : 0.F);
  fs::create_directories(file.parent_path());
  formats::write_ply(file, bar);
}

std::string message_of(const TemporaryFolder& folder, const std::string& targets = "") {
  try {
    layouts::read_ground_truth(folder.path(), "test", targets);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

std::vector<SceneFile> scenes_of(const TemporaryFolder& folder) {
  return layouts::find_layout(folder.path(), "test").scenes(folder.path(), "test");
}

/// By obj_id, as `run` numbers them.
std::map<int, fs::path> models_of(const TemporaryFolder& folder) {
  return layouts::number_models(layouts::find_layout(folder.path(), "test").models(folder.path()));
}

void write_sixd(const TemporaryFolder& folder) {
  write_box(folder / "models/obj_02.ply");
  folder.write("models/models_info.yml",
               "2: {diameter: 130, min_x: 0, min_y: 0, min_z: 0, size_x: 30, size_y: 40, size_z: "
               "120}\n");
  folder.write("test/05/info.yml",
               "7:\n  cam_K: [500.0, 0.0, 320.0, 0.0, 510.0, 240.0, 0.0, 0.0, 1.0]\n"
               "  depth_scale: 0.1\n");
  folder.write("test/05/gt.yml",
               "7:\n- cam_R_m2c: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n  cam_t_m2c: [10.0, 20, 9e2]\n"
               "  obj_bb: [1, 2, 3, 4]\n  obj_id: 2\n");
  folder.write("test/05/depth/0007.png", "");
}

void write_uwa(const TemporaryFolder& folder, const std::string& models, const std::string& scenes,
               const std::string& poses) {
  write_box(folder / (models + "chef.ply"));
  write_box(folder / (models + "T-rex_high.ply"));
  folder.write(scenes + "rs1.ply", "");
  folder.write(scenes + "rs2.ply", "");
  folder.write(scenes + "rs10.ply", "");
  folder.write(poses + "chef-rs1.xf", kShift);
  folder.write(poses + "T-rex-rs10.xf", kShift);
  folder.write(poses + "rhino-rs2.xf", kShift);
  folder.write("occlusion.txt", "scene\tobject\t% occlusion\n1\tchef\t77.5\n10\ttrex\t60\n");
}

/// A layout of one file, `truth.test`: all that a layout has to do.
const auto registered = layouts::register_layout(
    {"Test's", "truth.test",
     [](const fs::path& folder, const std::string&) { return fs::exists(folder / "truth.test"); },
     [](const fs::path& folder, const std::string&) {
       return std::vector<SceneFile>{{folder / "scan.ply", 3, 4, std::nullopt}};
     },
     [](const fs::path& folder) { return std::vector<fs::path>{folder / "models/chef.ply"}; },
     [](const fs::path&, const std::string&) {
       layouts::GroundTruth truth;
       truth.images[{3, 4}];
       truth.objects[1].symmetries = {Eigen::Isometry3d::Identity()};
       truth.instances.push_back({3, 4, 1, Eigen::Isometry3d::Identity(), std::nullopt});
       return truth;
     }});

}  // namespace

TEST_CASE("a registered layout is recognised, read, and named where none fits", "[dataset]") {
  const TemporaryFolder folder;
  CHECK_THAT(message_of(folder),
             Contains("is no data set with a split 'test'; expected one of\n  BOP: ") &&
                 Contains("\n  Test's: truth.test"));
  folder.write("truth.test", "");
  write_box(folder / "models/chef.ply");
  CHECK(layouts::find_layout(folder.path(), "test").name == "Test's");
  CHECK(scenes_of(folder).at(0).im_id == 4);
  const layouts::GroundTruth truth = layouts::read_ground_truth(folder.path(), "test");
  CHECK(truth.objects.at(1).name == "chef");
  CHECK(truth.objects.at(1).diameter == Approx(0.13));
}

TEST_CASE("of layouts that fit, the first by name; no two of one name", "[dataset]") {
  const TemporaryFolder folder;
  folder.write("truth.test", "");
  write_sixd(folder);
  CHECK(layouts::find_layout(folder.path(), "test").name == "SIXD 2017");
  CHECK_THROWS_WITH(layouts::register_layout(layouts::find_layout(folder.path(), "test")),
                    "two layouts are registered as 'SIXD 2017'");
}

TEST_CASE("SIXD 2017", "[dataset]") {
  const TemporaryFolder folder;
  write_sixd(folder);
  const layouts::GroundTruth truth = layouts::read_ground_truth(folder.path(), "test");
  REQUIRE(truth.instances.size() == 1);
  CHECK(truth.instances[0].scene_id == 5);
  CHECK(truth.instances[0].im_id == 7);
  CHECK(truth.instances[0].T_scene_model.translation().isApprox(Eigen::Vector3d(.01, .02, .9)));
  CHECK(truth.images.at({5, 7}).camera->fy == 510);
  CHECK(truth.images.at({5, 7}).camera->depth_scale == 0.1);
  CHECK(truth.objects.at(2).diameter == Approx(0.13));
  const auto scenes = scenes_of(folder);
  REQUIRE(scenes.size() == 1);
  CHECK(scenes[0].scene_id == 5);
  CHECK(scenes[0].im_id == 7);
  CHECK(scenes[0].camera->cx == 320);
  CHECK(scenes[0].path.filename() == "0007.png");
  CHECK(models_of(folder).at(2).filename() == "obj_02.ply");
}

TEST_CASE("UWA in folders, and all in one", "[dataset]") {
  for (const bool flat : {false, true}) {
    const TemporaryFolder folder;
    write_uwa(folder, flat ? "" : "models/", flat ? "" : "scenes/", flat ? "" : "ground_truth/");
    const layouts::GroundTruth truth = layouts::read_ground_truth(folder.path(), "test");
    REQUIRE(truth.instances.size() == 2);
    const auto scenes = scenes_of(folder);
    const std::map<int, fs::path> models = models_of(folder);
    REQUIRE(scenes.size() == 3);
    REQUIRE(models.size() == 2);
    for (const layouts::TrueInstance& instance : truth.instances) {
      const SceneFile& scene = scenes[static_cast<std::size_t>(instance.im_id)];
      const bool is_chef = models.at(instance.obj_id).stem() == "chef";
      CHECK(scene.im_id == instance.im_id);
      CHECK(scene.path.stem() == (is_chef ? "rs1" : "rs10"));
      CHECK(*instance.visible == Approx(is_chef ? 0.225 : 0.4));
      CHECK(instance.T_scene_model.translation().isApprox(Eigen::Vector3d(.01, .02, .9)));
      CHECK(truth.objects.at(instance.obj_id).diameter == Approx(0.13));
      CHECK(
          truth.objects.at(instance.obj_id).center.isApprox(Eigen::Vector3d(.015, .02, .06), 1e-6));
    }
    REQUIRE(truth.notes.size() == 1);
    CHECK_THAT(truth.notes[0], Contains("rhino"));
    CHECK(truth.images.size() == 3);  // the rhino's scene is judged: nothing else is in it
  }
}

TEST_CASE("UWA: contradictions are named", "[dataset]") {
  const TemporaryFolder folder;
  write_uwa(folder, "models/", "scenes/", "ground_truth/");
  folder.write("ground_truth/chef-rs3.xf", kShift);
  CHECK_THAT(message_of(folder), Contains("chef-rs3.xf: there is no scene rs3.ply"));
  fs::remove(folder / "ground_truth/chef-rs3.xf");
  folder.write("ground_truth/chef-rs2.xf", "1 0 0\n");
  CHECK_THAT(message_of(folder), Contains("chef-rs2.xf: expected 16 numbers, number 4"));
  folder.write("ground_truth/chef-rs2.xf", "1 0 0 0 0 2 0 0 0 0 1 0 0 0 0 1");
  CHECK_THAT(message_of(folder), Contains("chef-rs2.xf: R is no rotation"));
  fs::remove(folder / "ground_truth/chef-rs2.xf");
  folder.write("ground_truth/notes.xf", kShift);
  folder.write("ground_truth/chef-rs1-old.xf", "no numbers");
  CHECK(message_of(folder) == "accepted");  // the published archive holds such a one
  const auto notes = layouts::read_ground_truth(folder.path(), "test").notes;
  const auto told = [&notes](const std::string& name) {
    return std::any_of(notes.begin(), notes.end(), [&name](const std::string& note) {
      return note == name + ": left out, expected a name like OBJECT-rsN.xf";
    });
  };
  CHECK(told("notes.xf"));
  CHECK(told("chef-rs1-old.xf"));
}

TEST_CASE("image sets: contradictions are named", "[dataset]") {
  const TemporaryFolder folder;
  CHECK_THAT(message_of(folder), Contains("is no data set") && Contains("SIXD 2017"));
  write_sixd(folder);
  folder.write("test/05/depth/0008.png", "");
  CHECK(message_of(folder) == "accepted");  // an image without poses is not judged
  CHECK(layouts::read_ground_truth(folder.path(), "test").left_out.contains({5, 8}));
  CHECK_THROWS_WITH(scenes_of(folder), Contains("info.yml: image 8: has no camera"));
  fs::rename(folder / "test/05/depth/0007.png", folder / "test/05/depth/0009.png");
  write_box(folder / "models/obj_03.ply");
  fs::remove(folder / "models/obj_02.ply");
  CHECK_THAT(message_of(folder), Contains("obj_000002.ply: is missing"));
  fs::remove(folder / "test/05/info.yml");
  CHECK_THAT(message_of(folder), Contains("info.yml: is missing"));
  folder.write("test/05/gt.yml", "7: [{obj_id: 2}]\n");
  CHECK_THAT(message_of(folder), Contains("gt.yml: image 7, instance 0") && Contains("cam_R_m2c"));
  folder.write("test/05/gt.yml", "7: [\n");
  CHECK_THAT(message_of(folder), Contains("gt.yml"));
}

TEST_CASE("numbers that are none, and two images of one number, are named", "[dataset]") {
  const TemporaryFolder folder;
  write_sixd(folder);
  const auto targets = [&folder](const std::string& list) {
    return message_of(folder, folder.write("targets.json", list));
  };
  CHECK_THAT(targets("[]"), Contains("targets.json: is no JSON list of targets"));
  CHECK_THAT(targets(R"([{"scene_id": 5, "im_id": 7, "obj_id": 2, "inst_count": -1}])"),
             Contains("entry 0: inst_count is -1, expected a whole number from 1 up"));
  CHECK_THAT(targets(R"([{"scene_id": 5, "im_id": 7, "obj_id": 2.7}])"), Contains("obj_id is 2.7"));
  folder.write("test/05/depth/7.png", "");
  CHECK_THAT(message_of(folder), Contains("7.png: is image 7, as is "));
}

TEST_CASE("a model and its models_info in different units are refused", "[dataset]") {
  const TemporaryFolder folder;
  write_sixd(folder);
  CHECK(message_of(folder) == "accepted");
  const std::string info = posevote::test::read_text(folder / "models/models_info.yml");
  const std::size_t diameter = info.find("diameter: 130");
  REQUIRE(diameter != std::string::npos);
  folder.write("models/models_info.yml", std::string(info).replace(diameter, 13, "diameter: .13"));
  CHECK_THAT(message_of(folder), Contains("obj_02.ply: is a box of diagonal 130 mm") &&
                                     Contains("models_info says diameter 0.13 mm"));
}

TEST_CASE("poses of an image that is not there", "[dataset]") {
  const TemporaryFolder folder;
  write_sixd(folder);
  const std::string pose = "- {cam_R_m2c: [1,0,0,0,1,0,0,0,1], cam_t_m2c: [0,0,900], obj_id: 2}\n";
  folder.write("test/05/gt.yml", "7:\n" + pose + "8:\n" + pose);
  CHECK_THAT(message_of(folder), Contains("image 8 has true poses but no depth image"));
  folder.write("targets.json", R"([{"scene_id": 5, "im_id": 7, "obj_id": 2, "inst_count": 1}])");
  const layouts::GroundTruth truth =
      layouts::read_ground_truth(folder.path(), "test", (folder / "targets.json").string());
  CHECK(truth.instances.size() == 1);
  CHECK(truth.left_out.contains({5, 8}));
}

}  // namespace posevote::layouts_test
