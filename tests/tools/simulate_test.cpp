// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/simulate.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "graph/problem.hpp"
#include "nodes/formats/color_image.hpp"
#include "nodes/formats/depth_image.hpp"
#include "nodes/formats/read_scan.hpp"
#include "nodes/geometry/nearest_index.hpp"
#include "nodes/layouts/ground_truth.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/tools/seen_colors.hpp"
#include "tools/simulate/shapes.hpp"
#include "tools/simulate/spec.hpp"

namespace posevote::simulate_test {

using Catch::Contains;
using posevote::test::likeness_of;
using posevote::test::read_text;
using posevote::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

constexpr const char* kSmall = R"(seed: 4
models:
  - {shape: boulder, seed: 1, size: 0.15}
  - {shape: horn, size: 0.15}
scenes:
  - {objects: [1, 2], clutter: 0}
  - {sensor: rgbd, objects: [2], clutter: 0, elevation: 70}
)";

std::map<std::string, std::string> all_files(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), folder).string()] = read_text(entry.path());
  return files;
}

}  // namespace

TEST_CASE("a painted set has the same geometry, and colours that agree", "[simulate][color]") {
  const TemporaryFolder folder;
  std::string text = kSmall;
  text.replace(text.find("{shape: horn, size: 0.15}"), 25, "{shape: carton, size: 0.15}");
  Spec spec = read_spec(folder.write("spec.yaml", text));
  simulate_set(spec, folder / "plain");
  spec.colors = true;
  simulate_set(spec, folder / "painted");
  simulate_set(spec, folder / "again");
  const auto plain = all_files(folder / "plain"), painted = all_files(folder / "painted");
  CHECK(painted == all_files(folder / "again"));
  for (const auto& [name, bytes] : plain)
    if (!name.starts_with("models/")) CHECK(painted.at(name) == bytes);

  // What the camera saw of the carton, against its model, which has a texture: like at the true pose.
  const Mesh model = formats::read_mesh(folder / "painted/models/obj_000002.ply", 0.001);
  CHECK(model.texture);
  CHECK(formats::read_mesh(folder / "painted/models/obj_000001.ply", 0.001).colors.rows() > 1000);
  const fs::path scene = folder / "painted/test/000001";
  const ColorImage image = formats::read_color_image(scene / "rgb/000001.jpg");
  const layouts::GroundTruth truth = layouts::read_ground_truth(folder / "painted", "test");
  const layouts::TrueInstance& carton = truth.instances.back();
  const Camera camera = *truth.images.at({1, 1}).camera;
  // By green of the model and as seen, less the mean of each side, which has its own share of light;
  // the image is registered to a pixel or two.
  double likeness = -1;
  for (const double du : {-3, -2, -1, 0, 1, 2, 3})
    for (const double dv : {-3, -2, -1, 0, 1, 2, 3})
      likeness =
          std::max(likeness, likeness_of(model, carton.T_scene_model, camera, image, du, dv));
  CHECK(likeness > 0.7);
}

TEST_CASE("a simulated set: same bytes twice, true poses fit the scans", "[simulate]") {
  const TemporaryFolder folder;
  const std::string spec = folder.write("spec.yaml", kSmall);
  simulate_set(spec, folder / "a");
  simulate_set(spec, folder / "b");
  const auto files = all_files(folder / "a");
  CHECK(files == all_files(folder / "b"));
  for (const char* name : {"models/obj_000001.ply", "models/obj_000002.ply",
                           "models/models_info.json", "test/000001/depth/000000.png",
                           "test/000001/depth/000001.png", "test/000001/scene_camera.json",
                           "test/000001/scene_gt.json", "test/000001/scene_gt_info.json",
                           "test_targets_bop19.json", "scans/000000.ply", "scans/000001.ply"})
    CHECK(files.contains(name));
  CHECK(files.size() == 11);

  const layouts::GroundTruth truth = layouts::read_ground_truth(folder / "a", "test");
  REQUIRE(truth.instances.size() == 3);
  for (const layouts::TrueInstance& instance : truth.instances) {
    const Scan scan = formats::read_scan(
        folder / "a" / "scans" / ("00000" + std::to_string(instance.im_id) + ".ply"), 1);
    const geometry::NearestIndex surface(scan.points, 0.01F);
    const layouts::TrueObject& object = truth.objects.at(instance.obj_id);
    std::vector<float> distances;
    for (Eigen::Index i = 0; i < object.points.rows(); i += 3) {
      const Eigen::Vector3d point =
          instance.T_scene_model * object.points.row(i).transpose().cast<double>();
      if (const auto near = surface.nearest(point.cast<float>(), 0.02F))
        distances.push_back(std::sqrt(near.squared));
    }
    REQUIRE(distances.size() > 500);
    std::sort(distances.begin(), distances.end());
    // The far side is not in the scan: about half of the model lies on it. The RGB-D image (the
    // second) is sampled at 1.6 mm, the laser's at 0.8 mm.
    CHECK(distances[distances.size() / 4] < (instance.im_id == 0 ? 0.001F : 0.0015F));
    REQUIRE(instance.visible);
    CHECK(*instance.visible > 0.1);
  }
}

TEST_CASE("depth image and PLY scan hold the same points", "[simulate]") {
  const TemporaryFolder folder;
  simulate_set(folder.write("spec.yaml", kSmall), folder / "out");
  const formats::DepthImage depth =
      formats::read_depth_image(folder / "out" / "test/000001/depth/000000.png");
  CHECK(depth.width == 800);
  const auto camera =
      nlohmann::json::parse(read_text(folder / "out" / "test/000001/scene_camera.json"))["0"];
  const double scale = camera["depth_scale"].get<double>();
  const auto k = camera["cam_K"].get<std::vector<double>>();
  const Scan scan = formats::read_scan(folder / "out" / "scans/000000.ply", 1);
  Eigen::Index i = 0;
  double worst = 0;
  for (std::size_t pixel = 0; pixel < depth.values.size(); ++pixel) {
    if (depth.values[pixel] == 0) continue;
    const double z = depth.values[pixel] * scale * 0.001;
    const double x = (static_cast<double>(pixel % depth.width) - k[2]) * z / k[0];
    const double y = (static_cast<double>(pixel / depth.width) - k[5]) * z / k[4];
    REQUIRE(i < scan.points.rows());
    worst = std::max(
        worst,
        (scan.points.row(i++).cast<double>() - Eigen::RowVector3d(x, y, z)).cwiseAbs().maxCoeff());
  }
  CHECK(i == scan.points.rows());
  CHECK(worst < 1e-6);
}

TEST_CASE("a folder that holds something is refused", "[simulate]") {
  const TemporaryFolder folder;
  const std::string spec = folder.write("spec.yaml", kSmall);
  folder.write("out/precious.txt", "x");
  CHECK_THROWS_AS(simulate_set(spec, folder / "out"), std::invalid_argument);
  CHECK_THROWS_AS(simulate_set(spec, spec), std::invalid_argument);
  CHECK(all_files(folder / "out").size() == 1);
  folder.write("new.unfinished/precious.txt", "x");
  CHECK_THROWS_WITH(simulate_set(spec, folder / "new"),
                    Catch::Contains("precious.txt: is in the way"));
  CHECK(all_files(folder / "new.unfinished").size() == 1);
}

TEST_CASE("an empty folder is filled, not replaced", "[simulate]") {
  const TemporaryFolder folder;
  const std::string spec = folder.write("spec.yaml", kSmall);
  const fs::path out = folder / "mounted", elsewhere = folder / "link";
  fs::create_directory(out);
  fs::create_directory_symlink(out, elsewhere);
  fs::create_directories(out / ".unfinished" / "models");  // of a simulation that was stopped
  simulate_set(spec, elsewhere);
  CHECK(fs::is_symlink(elsewhere));
  CHECK(fs::exists(out / "test_targets_bop19.json"));
  CHECK(!fs::exists(out / ".unfinished"));
  CHECK_THROWS_AS(simulate_set(spec, out), std::invalid_argument);
}

TEST_CASE("all problems of a spec are reported, with their places", "[simulate]") {
  const TemporaryFolder folder;
  const std::string file = folder.write("spec.yaml", R"(seed: x
models:
  - {shape: bolder, size: -1}
  - {sedd: 1}
scenes:
  - {objects: [1, 3], clutter: 1.5, clutter: 2}
  - {sensor: laser}
views: 3
)");
  try {
    read_spec(file);
    FAIL("accepted");
  } catch (const graph::ConfigError& error) {
    const std::string text = error.what();
    CHECK_THAT(text, Contains(file + ":1:7: seed: is 'x', expected int"));
    CHECK_THAT(text, Contains(file + ":3:13: models[1].shape: is 'bolder'"));
    CHECK_THAT(text, Contains("did you mean 'boulder'"));
    CHECK_THAT(text, Contains(file + ":3:27: models[1].size: is '-1'"));
    CHECK_THAT(text, Contains(file + ":4:6: models[2].sedd: unknown key, did you mean 'seed'?"));
    CHECK_THAT(text, Contains("models[2].shape: missing"));
    CHECK_THAT(text, Contains(file + ":6:19: scenes[1].objects: expected the number of a model"));
    CHECK_THAT(text, Contains("scenes[1].clutter: is '1.5', expected int"));
    CHECK_THAT(text, Contains("scenes[1].clutter: given twice, first in line 6"));
    CHECK_THAT(text, Contains("scenes[2].objects: missing"));
    CHECK_THAT(text, Contains(file + ":8:1: views: unknown key"));
    CHECK(error.problems().size() == 10);
  }
  CHECK_THROWS_WITH(read_spec("/nowhere.yaml"), Contains("/nowhere.yaml: cannot be read"));
  CHECK_THROWS_AS(read_spec(folder.path().string()), graph::ConfigError);
  CHECK_THROWS_AS(read_spec(folder.write("a.yaml", "")), graph::ConfigError);
  CHECK_THROWS_AS(read_spec(folder.write("b.yaml", "models: [")), graph::ConfigError);
  CHECK_THROWS_AS(read_spec(folder.write("c.yaml", "models: 1\nscenes: {a: 1}")),
                  graph::ConfigError);
}

TEST_CASE("one scene of each replica of few triangles: models as they are, noise as asked for",
          "[simulate]") {
  for (const char* name : {"parts", "household"}) {
    INFO(name);
    const TemporaryFolder folder;
    const std::string spec = std::string(POSEVOTE_SOURCE_DIR "/configs/") + name + "_scenes.yaml";
    const Spec all = read_spec(spec);
    simulate_set(spec, folder / "out", all.scenes.size());
    const layouts::GroundTruth truth = layouts::read_ground_truth(folder / "out", "test");
    CHECK(truth.objects.size() == all.models.size());
    CHECK(truth.instances.size() == all.scenes[0].objects.size());
    for (const auto& [obj_id, object] : truth.objects) {
      const ModelSpec& model = all.models[static_cast<std::size_t>(obj_id) - 1];
      char file[40];
      std::snprintf(file, sizeof file, "models/obj_%06d.ply", obj_id);
      const Mesh mesh = formats::read_mesh(folder / "out" / file, 0.001);
      CHECK(mesh.faces.rows() <= (name == std::string("parts") ? 500 : 1000));
      const Eigen::RowVector3f sides =
          mesh.points.colwise().maxCoeff() - mesh.points.colwise().minCoeff();
      if (model.x > 0)
        CHECK((sides.cast<double>() - Eigen::RowVector3d(model.x, model.y, model.z)).norm() < 1e-6);
      else
        CHECK(double{sides.maxCoeff()} == Approx(model.size));
      const ShapeSymmetry symmetry = symmetry_of(model.shape);
      CHECK(object.axes.size() == (symmetry.is_round ? 1 : 0));
      CHECK(object.symmetries.size() == symmetry.turns.size() + 1);
    }
    int counted = 0;
    for (const auto& [target, count] : truth.targets) counted += count;
    int visible = 0;
    for (const layouts::TrueInstance& instance : truth.instances)
      visible += *instance.visible >= all.least_visible;
    CHECK(counted == visible);
    CHECK(counted >= 5);
  }
}

TEST_CASE("a scene's noise takes the place of its sensor's", "[simulate]") {
  const TemporaryFolder folder;
  const auto table_noise = [&](const std::string& noise) {
    const std::string spec = folder.write(
        noise + ".yaml", "models: [{shape: carton, size: 0.1}]\nscenes: [{sensor: plain, noise: " +
                             noise + ", objects: [1], clutter: 0, elevation: 90, distance: 1}]\n");
    simulate_set(spec, folder / noise);
    const Scan scan = formats::read_scan(folder / noise / "scans/000000.ply", 1);
    double sum = 0, count = 0;  // the table is 1.05 m away; the object's shadow is all nearer
    for (Eigen::Index i = 0; i < scan.points.rows(); ++i)
      if (const double off = double{scan.points(i, 2)} - 1.05; std::abs(off) < 0.012)
        sum += off * off, ++count;
    REQUIRE(count > 10000);
    return std::sqrt(sum / count);
  };
  CHECK(table_noise("0.0005") == Approx(0.0005).epsilon(0.1));
  CHECK(table_noise("0.002") == Approx(0.002).epsilon(0.1));
}

TEST_CASE("the demo's spec is sound", "[simulate]") {
  const Spec spec = read_spec(std::string(POSEVOTE_SOURCE_DIR) + "/configs/demo_scenes.yaml");
  CHECK(spec.models.size() == 5);
  CHECK(spec.scenes.size() == 4);
}

}  // namespace posevote::simulate_test
