// SPDX-License-Identifier: BSD-3-Clause
// `posevote init` on data as people have them: what is wrong is named, and the config that is written
// finds the objects.
#include <Eigen/Geometry>

#include "nodes/data/features.hpp"
#include "nodes/formats/read_scan.hpp"
#include "nodes/formats/write_ply.hpp"
#include "tests/pipelines/run_world.hpp"
#include "tests/support/run_node.hpp"

namespace posevote::init_test {

using namespace posevote::test;

namespace {

Mesh scan_of_world() { return formats::read_mesh(world().scans / "000000.ply", 1); }

Mesh oriented_scan() {
  Scan scan;
  static_cast<Mesh&>(scan) = scan_of_world();
  const Cloud cloud = run_node<Cloud>("estimate_normals", {}, scan, Scale{0.0015F});
  return {cloud.points, cloud.normals, {}};
}

/// What init printed as JSON, and whether its config finds both objects by `run`.
struct Init {
  nlohmann::json said;
  std::string config, output;

  Init(const std::string& name, const std::string& scenes, const std::string& more = "") {
    const World& w = world();
    const fs::path out = w.folder / ("init_" + name);
    const CommandResult made =
        run_posevote(w.folder, "init " + out.string() + " --json --models " + w.models.string() +
                                   " --scenes " + scenes + " " + more);
    output = made.output;
    INFO(output);
    REQUIRE(made.status == 0);
    said = nlohmann::json::parse(output.substr(output.find("{\n \"models\"")));
    config = read_text(out / "config.yaml");
    CHECK(fs::exists(out / "first.png"));
    CHECK(read_text(out / "README.md").find(said["run"].get<std::string>()) != std::string::npos);
    const CommandResult run = run_posevote(
        w.folder, "run " + (out / "config.yaml").string() + " --models " + w.models.string() +
                      " --scenes " + scenes + " --out " + (out / "out").string());
    INFO(run.output);
    REQUIRE(run.status == 0);
    const nlohmann::json frame = read_json(out / "out/results.json")["frames"][0];
    CHECK(frame["detections"].size() == 2);
    CHECK(said["found"].size() == 2);
  }
  bool names(const std::string& what) const {
    for (const nlohmann::json& finding : said["wrong"])
      if (finding["what"] == what) return true;
    return false;
  }
  bool sets(const std::string& line) const { return config.find(line) != std::string::npos; }
};

std::string write(const std::string& name, const Mesh& scan, double units = 1) {
  const fs::path file = world().folder / "init_scans" / name;
  fs::create_directories(file.parent_path());
  formats::write_ply(file, scan, units);
  return file.string();
}

}  // namespace

TEST_CASE("init: models in mm with scans in m, and scans without normals", "[init]") {
  const Init init("mixed", (world().scans / "000000.ply").string());
  INFO(init.output);
  CHECK(init.names("units differ"));
  CHECK(init.names("no normals"));
  CHECK(init.sets("load_models:\n  unit: mm "));
  CHECK(init.sets("load_scene:\n  unit: m "));
  CHECK_FALSE(init.names("sensor unknown"));
}

TEST_CASE("init: both in mm, not metres", "[init]") {
  const Init init("mm", write("mm.ply", scan_of_world(), 1000));
  INFO(init.output);
  CHECK(init.names("unit"));
  CHECK(init.sets("load_scene:\n  unit: mm "));
}

TEST_CASE("init: normals that point away from the sensor", "[init]") {
  Mesh scan = oriented_scan();
  scan.normals *= -1;
  const Init init("inverted", write("inverted.ply", scan));
  INFO(init.output);
  CHECK(init.names("normals inverted"));
  CHECK_FALSE(init.names("no normals"));
}

TEST_CASE("init: a sensor that did not stand at the origin", "[init]") {
  SECTION("normals tell") {
    Mesh scan = oriented_scan();
    scan.points.rowwise() += Eigen::RowVector3f(0.9F, 0.2F, -1.8F);
    const Init init("behind", write("behind.ply", scan));
    INFO(init.output);
    CHECK(init.names("sensor elsewhere"));
  }
  SECTION("without normals, runs tell") {
    Mesh scan = scan_of_world();
    const Eigen::Isometry3f turn(
        Eigen::AngleAxisf(2.1F, Eigen::Vector3f(1, 0.2F, -0.1F).normalized()));
    scan.points.rowwise() -= scan.points.colwise().mean().eval();
    scan.points = (scan.points * turn.linear().transpose()).eval();
    const Init init("around", write("around.ply", scan));
    INFO(init.output);
    CHECK(init.names("sensor elsewhere"));
    CHECK(init.sets("sensor_pose: ["));
  }
}

namespace {

/// A set with depth images of 5000 units to the metre, made once.
const fs::path& tum_set() {
  static const fs::path set = [] {
    const World& w = world();
    w.folder.write("tum.yaml",
                   "{width: 640, height: 480, fx: 570, noise_z2: 0.0015, depth_scale: 0.2}");
    const std::string spec =
        w.folder.write("tum_spec.yaml",
                       "seed: 5\nmodels:\n"
                       "  - {shape: figure, seed: 3, size: 0.2}\n"
                       "  - {shape: kettle, seed: 4, size: 0.16}\n"
                       "scenes:\n"
                       "  - {sensor: tum.yaml, objects: [1, 2], clutter: 1}\n");
    const CommandResult made =
        run_posevote(w.folder, "simulate " + spec + " --out " + (w.folder / "tum").string());
    INFO(made.output);
    REQUIRE(made.status == 0);
    return w.folder / "tum";
  }();
  return set;
}

}  // namespace

TEST_CASE("init: a depth image of 5000 units to the metre, read as mm", "[init]") {
  const fs::path made = tum_set() / "test/000001/depth/000000.png";
  SECTION("the camera is said") {
    const fs::path image = world().folder / "tum_depth/frame.png";
    fs::create_directories(image.parent_path());
    fs::copy_file(made, image);
    const Init init("tum", image.string(), "--camera 570 570 319.5 239.5");
    INFO(init.output);
    CHECK(init.names("depth scale"));
    CHECK(init.sets("depth_scale: 0.2 "));
  }
  SECTION("the camera stands in a file that every run reads, without the scale") {
    const fs::path image = world().folder / "tum_intrinsics/frame.png";
    fs::create_directories(image.parent_path());
    fs::copy_file(made, image);
    world().folder.write("tum_intrinsics/intrinsics.txt", "570 570 319.5 239.5\n");
    const Init init("intrinsics", image.string());
    INFO(init.output);
    CHECK(init.names("depth scale"));
    CHECK_FALSE(init.names("camera unknown"));
    CHECK(init.sets("depth_scale: 0.2 "));
  }
  SECTION("the camera stands in a file beside it, with its scale") {
    const Init init("beside", made.string());
    INFO(init.output);
    CHECK_FALSE(init.names("depth scale"));
    CHECK_FALSE(init.names("camera unknown"));
    CHECK(init.sets("fx: 570 "));
    CHECK(init.sets("depth_scale: 0.2 "));
  }
}

TEST_CASE("init: models inside out, and files that cannot be read", "[init]") {
  const World& w = world();
  fs::create_directories(w.folder / "odd_models");
  Mesh model = formats::read_mesh(w.models / "obj_000001.ply", 1);
  model.faces.col(0).swap(model.faces.col(1));
  formats::write_ply(w.folder / "odd_models/obj_000001.ply", model);
  w.folder.write("odd_models/obj_000007.ply", "ply\nthis is none\n");
  w.folder.write("odd_scans/000001.ply", "ply\nnor this\n");
  fs::copy_file(w.scans / "000000.ply", w.folder / "odd_scans/000000.ply");
  const std::string arguments = "init " + (w.folder / "odd").string() + " --models " +
                                (w.folder / "odd_models").string() + " --scenes ";
  const CommandResult made = run_posevote(w.folder, arguments + (w.folder / "odd_scans").string());
  INFO(made.output);
  CHECK(made.status == 0);
  for (const char* said : {"model inside out", "model unreadable", "obj_000007.ply",
                           "scan unreadable", "Nothing to do", "1 found", "posevote run "})
    CHECK_THAT(made.output, Catch::Contains(said, Catch::CaseSensitive::No));

  const std::string before = read_text(w.folder / "odd/config.yaml");
  const std::string scan = (w.folder / "odd_scans/000000.ply").string();
  const CommandResult again = run_posevote(w.folder, arguments + scan);
  CHECK(again.status == 2);
  CHECK_THAT(again.output, Catch::Contains("config.yaml: is there already"));
  CHECK(read_text(w.folder / "odd/config.yaml") == before);
  CHECK(run_posevote(w.folder, arguments + scan + " --overwrite").status == 0);
  const CommandResult nothing = run_posevote(
      w.folder, "init " + (w.folder / "no_config").string() + " --models " + w.models.string() +
                    " --scenes " + (w.folder / "odd_scans/000001.ply").string());
  CHECK(nothing.status == 2);
  CHECK_THAT(nothing.output, Catch::Contains("nothing readable") && Catch::Contains("000001.ply"));
  CHECK_FALSE(fs::exists(w.folder / "no_config"));
}

}  // namespace posevote::init_test
