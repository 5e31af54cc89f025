// SPDX-License-Identifier: BSD-3-Clause
#include "pipelines/inputs.hpp"

#include <catch2/catch.hpp>

#include "nodes/formats/format.hpp"
#include "tests/support/temporary_folder.hpp"

namespace posevote::inputs_test {

using posevote::test::TemporaryFolder;

TEST_CASE("scans are numbered by one sort over files, folders and globs", "[inputs]") {
  const TemporaryFolder folder;
  for (const char* name : {"b/2.PLY", "b/1.ply", "b/notes.txt", "a.pcd", "c/x.ply", "c/1.ply"})
    folder.write(name, "");
  std::filesystem::create_symlink(folder / "nowhere", folder / "b/3.ply");
  const auto scenes = list_scenes(
      {(folder / "c/*.ply").string(), (folder / "b").string(), (folder / "a.pcd").string()});
  REQUIRE(scenes.size() == 6);
  const std::vector<std::string> names{"a", "000001_1", "2", "3", "000004_1", "x"};
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    CHECK(scenes[i].number == i);
    CHECK(scenes[i].file.scene_id == 0);
    CHECK(scenes[i].file.im_id == static_cast<int>(i));
    CHECK(scenes[i].name == names[i]);
  }
}

TEST_CASE("scans come in the order in which people count", "[inputs]") {
  const TemporaryFolder folder;
  for (const char* name : {"scan10.ply", "scan2.ply", "scan002.ply", "scan1_b.ply", "scan.ply"})
    folder.write(name, "");
  std::vector<std::string> names;
  for (const SceneEntry& scene : list_scenes({folder.path().string()}))
    names.push_back(scene.file.path.stem().string());
  CHECK(names == std::vector<std::string>{"scan", "scan1_b", "scan002", "scan2", "scan10"});
}

TEST_CASE("models are numbered as people count, in whatever order, each once", "[inputs]") {
  const TemporaryFolder folder;
  std::vector<std::string> given;
  for (const char* name : {"part10.ply", "part2.ply", "part1.ply"})
    given.push_back(folder.write(name, ""));
  const auto names = [](const std::vector<std::string>& arguments) {
    std::vector<std::string> list;
    for (const ModelFile& model : list_models(arguments))
      list.push_back(std::to_string(model.obj_id) + " " + model.name);
    return list;
  };
  const std::vector<std::string> expected{"1 part1", "2 part2", "3 part10"};
  CHECK(names(given) == expected);
  CHECK(names({given[1], given[0], given[2]}) == expected);
  CHECK(names({(folder / "*.ply").string(), given[2]}) == expected);
  CHECK(names({folder.path().string()}) == expected);
}

TEST_CASE("no two scans have one name", "[inputs]") {
  const TemporaryFolder folder;
  for (const char* name : {"000001_a.ply", "a.off", "a.pcd", "b.ply"}) folder.write(name, "");
  std::vector<std::string> names;
  for (const SceneEntry& scene : list_scenes({folder.path().string()})) names.push_back(scene.name);
  CHECK(names == std::vector<std::string>{"000000_000001_a", "000001_a", "000002_a", "b"});
}

TEST_CASE("what a folder holds beside what can be read is counted", "[inputs]") {
  const TemporaryFolder folder;
  for (const char* name : {"a.tiff", "b.tiff", "c.xyz", "a.json", "a.pose", ".hidden.x"})
    folder.write(name, "");
  CHECK_THROWS_WITH(list_scenes({folder.path().string()}),
                    Catch::EndsWith(" file in it, but 2 files .tiff, 1 file .xyz"));
}

TEST_CASE("an argument that matches nothing is named", "[inputs]") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(list_scenes({"/nowhere/x.ply"}),
                    Catch::Contains("/nowhere/x.ply: no such file"));
  CHECK_THROWS_WITH(
      list_scenes({folder.path().string()}),
      Catch::Contains("no " + formats::list_endings(formats::Wanted::kAny) + " file"));
  CHECK_THROWS_WITH(list_models({"/nowhere/*.ply"}), Catch::Contains("/nowhere/*.ply"));
}

TEST_CASE("obj_id comes from the name, in whatever order; a clash is an error", "[inputs]") {
  const TemporaryFolder folder;
  const std::string named = folder.write("obj_000009.ply", "");
  const std::string plain = folder.write("chef.ply", "");
  const std::string clash = folder.write("obj_000001.ply", "");
  const std::string rex = folder.write("T-rex.ply", "");
  for (const std::vector<std::string>& given :
       {std::vector{named, plain, rex}, std::vector{plain, rex, named}}) {
    const ModelFiles models = list_models(given);
    REQUIRE(models.size() == 3);
    CHECK(models[0].obj_id == 1);
    CHECK(models[0].name == "T-rex");
    CHECK(models[1].obj_id == 2);
    CHECK(models[1].name == "chef");
    CHECK(models[2].obj_id == 9);
  }
  CHECK_THROWS_WITH(list_models({rex, clash}), Catch::Contains("has obj_id 1, as has"));
}

TEST_CASE("a folder of models may hold their textures, a folder of scans depth images",
          "[inputs]") {
  const TemporaryFolder folder;
  folder.write("chef.obj", "");
  CHECK(list_scenes({folder.path().string()}).size() == 1);
  folder.write("chef.png", "");
  CHECK(list_models({folder.path().string()}).size() == 1);
  CHECK(list_scenes({folder.path().string()}).size() == 2);
  std::filesystem::remove(folder / "chef.obj");
  CHECK_THROWS_WITH(
      list_models({folder.path().string()}),
      Catch::Contains("no " + formats::list_endings(formats::Wanted::kMeshes) + " file in it"));
}

TEST_CASE("a BOP split gives images with their cameras", "[inputs]") {
  const TemporaryFolder folder;
  folder.write("test/000002/depth/000003.png", "");
  folder.write("test/000002/depth/000001.png", "");
  folder.write("test/000002/scene_camera.json",
               R"({"3": {"cam_K": [500, 0, 320, 0, 510, 240, 0, 0, 1], "depth_scale": 0.1},
                   "1": {"cam_K": [500, 0, 320, 0, 510, 240, 0, 0, 1]}})");
  const auto scenes = list_dataset_scenes(folder.path().string(), "test");
  REQUIRE(scenes.size() == 2);
  CHECK(scenes[1].file.scene_id == 2);
  CHECK(scenes[1].file.im_id == 3);
  CHECK(scenes[1].name == "000002_000003");
  CHECK(scenes[1].file.camera->fy == 510);
  CHECK(scenes[1].file.camera->cy == 240);
  CHECK(scenes[1].file.camera->depth_scale == 0.1);
  CHECK(scenes[0].file.camera->depth_scale == 1);
  folder.write("test/000002/depth/000007.png", "");
  CHECK_THROWS_WITH(list_dataset_scenes(folder.path().string(), "test"),
                    Catch::Contains("scene_camera.json: image 7"));
  CHECK_THROWS_WITH(list_dataset_scenes(folder.path().string(), "train"), Catch::Contains("train"));
}

TEST_CASE("models_info.json beside the models says their symmetries", "[inputs]") {
  const TemporaryFolder folder;
  folder.write("models/obj_000001.ply", "");
  folder.write("models/obj_000002.ply", "");
  folder.write("models/models_info.json",
               R"({"2": {"symmetries_continuous": [{"axis": [0, 0, 1], "offset": [0, 0, 0]}]}})");
  const ModelFiles models = list_models({(folder / "models").string()});
  CHECK_FALSE(models[0].symmetries.has_value());
  REQUIRE(models[1].symmetries.has_value());
  CHECK(models[1].symmetries->axes.size() == 1);
  folder.write("models/models_info.json", "{");
  CHECK_THROWS_WITH(list_models({(folder / "models").string()}),
                    Catch::Contains("models_info.json: is no JSON: parse error at line 1"));
}

TEST_CASE("shards share out all scans and keep their numbers", "[inputs]") {
  std::vector<SceneEntry> scenes(7);
  for (std::size_t i = 0; i < scenes.size(); ++i) scenes[i].number = i;
  std::size_t total = 0;
  for (const char* shard : {"1/3", "2/3", "3/3"}) total += take_shard(scenes, shard).size();
  CHECK(total == 7);
  CHECK(take_shard(scenes, "2/3")[1].number == 4);
  for (const char* wrong : {"0/3", "4/3", "1", "a/b", "1/", "-1/2"})
    CHECK_THROWS_AS(take_shard(scenes, wrong), std::invalid_argument);
}

TEST_CASE("a recording's folder gives its scans with their cameras, beside other files",
          "[inputs]") {
  const TemporaryFolder folder;
  folder.write("tum/depth.txt", "7.5 depth/b.png\n3 depth/a.png\n");
  folder.write("images/0.npy", "");
  folder.write("camera.json", R"({"fx": 500, "fy": 510, "cx": 320, "cy": 240})");
  folder.write("part.ply", "");
  const auto scenes = list_scenes({(folder / "tum").string(), (folder / "images/0.npy").string(),
                                   (folder / "part.ply").string()});
  REQUIRE(scenes.size() == 4);
  CHECK(scenes[0].file.camera->fx == 500);
  CHECK_FALSE(scenes[1].file.camera);
  CHECK(scenes[2].file.camera->depth_scale == 0.2);
  CHECK(scenes[3].name == "b");
  CHECK(scenes[3].file.im_id == 3);
  folder.write("camera.json", "{}");
  CHECK_THROWS_WITH(list_scenes({(folder / "images").string()}), Catch::Contains("camera.json"));
}

}  // namespace posevote::inputs_test
