// SPDX-License-Identifier: BSD-3-Clause
// Scans whose frame is not their sensor's: a robot's, a turntable's.
#include <Eigen/Geometry>
#include <fstream>

#include "nodes/data/features.hpp"
#include "nodes/formats/read_scan.hpp"
#include "nodes/formats/write_ply.hpp"
#include "tests/pipelines/run_world.hpp"
#include "tests/support/run_node.hpp"

namespace posevote::sensor_pose_test {

using namespace posevote::test;

namespace {

/// From the sensor's frame into the robot's, where the sensor stands 1.4 m off the origin.
Eigen::Isometry3d T_robot_sensor() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, 0.2, -0.1).normalized()).matrix();
  T.translation() << 0.7, -0.4, 1.1;
  return T;
}

std::string numbers_of(const Eigen::Isometry3d& T) {
  std::ostringstream text;
  text << T.matrix().format(Eigen::IOFormat(Eigen::FullPrecision, Eigen::DontAlignCols));
  return text.str();
}

Mesh moved_scan() {
  Mesh scan = formats::read_mesh(world().scans / "000000.ply", 1);
  const Eigen::Isometry3f T = T_robot_sensor().cast<float>();
  scan.points = (scan.points * T.linear().transpose()).rowwise() + T.translation().transpose();
  return scan;
}

/// The scan with normals, as some scanners write them.
Mesh oriented_scan() {
  Scan scan;
  static_cast<Mesh&>(scan) = formats::read_mesh(world().scans / "000000.ply", 1);
  const Cloud cloud = run_node<Cloud>("estimate_normals", {}, scan, Scale{0.0015F});
  Mesh out;
  out.points = cloud.points;
  out.normals = cloud.normals;
  return out;
}

void write_pcd(const fs::path& file, const Mesh& scan) {
  std::ofstream out(file, std::ios::binary);
  const Eigen::Vector3d t = T_robot_sensor().translation();
  out << "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH "
      << scan.points.rows() << "\nHEIGHT 1\nVIEWPOINT " << t.x() << " " << t.y() << " " << t.z()
      << " 1 0 0 0\nPOINTS " << scan.points.rows() << "\nDATA binary\n";
  const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> rows = scan.points;
  out.write(reinterpret_cast<const char*>(rows.data()),
            static_cast<std::streamsize>(sizeof(float)) * rows.size());
}

Eigen::Isometry3d pose_of(const nlohmann::json& detection) {
  const std::vector<double> n = detection["T_scene_model"];
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(n.data());
  return T;
}

/// What is found in the scan as its sensor saw it; run once.
const nlohmann::json& still() {
  static const nlohmann::json found = [] {
    REQUIRE(world().run("still", "--scenes " + (world().scans / "000000.ply").string()).status ==
            0);
    return frames("still");
  }();
  return found;
}

/// The same objects at the same places, by the sensor.
void check_same(const nlohmann::json& moved) {
  REQUIRE(still().size() == 1);
  REQUIRE(moved.size() == 1);
  const nlohmann::json &here = still()[0]["detections"], &there = moved[0]["detections"];
  REQUIRE(here.size() == 2);
  REQUIRE(there.size() == 2);
  for (const nlohmann::json& a : here)
    for (const nlohmann::json& b : there) {
      if (a["obj_id"] != b["obj_id"]) continue;
      const Eigen::Isometry3d off = pose_of(a).inverse() * T_robot_sensor().inverse() * pose_of(b);
      CHECK(off.translation().norm() < 0.0005);
      CHECK(Eigen::AngleAxisd(off.linear()).angle() < 0.5 / 57.3);
      CHECK(a["score"].get<double>() == Approx(b["score"].get<double>()).margin(0.05));
    }
}

std::string scene(const fs::path& file) { return "--scenes " + file.string(); }

}  // namespace

TEST_CASE("a moved scan has the moved poses, if its sensor's pose is said", "[run]") {
  const World& w = world();
  const fs::path ply = w.folder / "robot/scan.ply", pcd = w.folder / "robot/points.pcd";
  fs::create_directories(ply.parent_path());
  const Mesh scan = moved_scan();
  formats::write_ply(ply, scan);
  write_pcd(pcd, scan);
  const std::string numbers = numbers_of(T_robot_sensor());

  SECTION("by the option, numbers or a file") {
    REQUIRE(w.run("option", scene(ply) + " --sensor-pose '" + numbers + "'").status == 0);
    check_same(frames("option"));
    const std::string file = w.folder.write("robot/where.txt", "# T_scan_sensor\n" + numbers);
    REQUIRE(w.run("option_file", scene(ply) + " --sensor-pose " + file).status == 0);
    CHECK(csv("option_file") == csv("option"));
    const std::string again = (w.folder / "option/effective.yaml").string();
    REQUIRE(run_posevote(w.folder, "run " + again + " --models " + w.models.string() + " " +
                                       scene(ply) + " --out " + (w.folder / "pose_again").string())
                .status == 0);
    CHECK(csv("pose_again") == csv("option"));
  }
  SECTION("by a file beside it, which the option goes before") {
    w.folder.write("robot/scan.pose", numbers);
    REQUIRE(w.run("beside", scene(ply)).status == 0);
    check_same(frames("beside"));
    w.folder.write("robot/scan.pose", "9 9 9");
    REQUIRE(w.run("before", scene(ply) + " --sensor-pose '" + numbers + "'").status == 0);
    CHECK(csv("before") == csv("beside"));
    fs::remove(w.folder / "robot/scan.pose");
  }
  SECTION("by a PCD's viewpoint") {
    REQUIRE(w.run("pcd", scene(pcd)).status == 0);
    check_same(frames("pcd"));
  }
}

TEST_CASE("where nobody says where the sensor stood, the scan is asked", "[run]") {
  const World& w = world();
  const fs::path folder = w.folder / "unsaid";
  fs::create_directories(folder);
  const auto warning = [&](const std::string& out, const fs::path& file, const std::string& more) {
    const CommandResult run = w.run(out, scene(file) + more);
    INFO(run.output);
    CHECK(run.status == 0);
    const std::size_t at = run.output.find("warning: " + file.string() + ": load_scene: ");
    const std::size_t end = run.output.find('\n', at);
    CHECK(run.output.find("warning", end) == std::string::npos);  // one a scan
    return at == std::string::npos ? "" : run.output.substr(at, end - at);
  };
  const auto has = [](const std::string& what) { return Catch::Contains(what); };

  SECTION("a scan around the origin cannot tell, and says so") {
    Mesh scan = formats::read_mesh(w.scans / "000000.ply", 1);
    scan.points.rowwise() -= scan.points.colwise().mean().eval();
    formats::write_ply(folder / "around.ply", scan);
    CHECK_THAT(warning("around", folder / "around.ply", ""),
               has("lies around its frame's origin") && has("--sensor-pose"));
    CHECK(warning("around_said", folder / "around.ply", " --sensor-pose '0 0 0'") == "");
  }
  SECTION("normals tell roughly") {
    Mesh scan = oriented_scan();
    formats::write_ply(folder / "normals.ply", scan);
    CHECK(warning("normals", folder / "normals.ply", "") == "");
    scan.points.rowwise() += Eigen::RowVector3f(0.9F, 0.2F, -1.8F);  // the origin lies behind it
    formats::write_ply(folder / "behind.ply", scan);
    CHECK_THAT(warning("behind", folder / "behind.ply", ""),
               has("of the file's normals point to the origin: the sensor is taken to have stood"));
    CHECK(frames("behind")[0]["detections"].size() == frames("normals")[0]["detections"].size());
    CHECK_THAT(warning("wrong", folder / "behind.ply", " --sensor-pose '0 0 9'"),
               has("point to the sensor at"));
    CHECK(warning("right", folder / "behind.ply", " --sensor-pose '0.9 0.2 -1.8'") == "");
  }
  SECTION("inverted normals are turned") {
    Mesh scan = oriented_scan();
    scan.normals *= -1;
    formats::write_ply(folder / "inverted.ply", scan);
    CHECK_THAT(warning("inverted", folder / "inverted.ply", ""), has("taken as inverted"));
    CHECK(frames("inverted")[0]["detections"].size() == 2);
  }
}

TEST_CASE("a sensor's pose or a unit that cannot be is refused by name", "[run]") {
  const World& w = world();
  const auto refused = [&w](const std::string& more, const std::string& why) {
    const CommandResult run = w.run("bad_pose", w.scans_argument() + " " + more);
    INFO(run.output);
    CHECK(run.status == 2);
    CHECK(run.output.find(why) != std::string::npos);
  };
  refused("--sensor-pose '1 2 3 4 5 6'", "--sensor-pose 1 2 3 4 5 6: the sensor's pose has 6");
  refused("--sensor-pose '-1 2 nan'", "number 3 of the sensor's pose is nan");
  refused("--sensor-pose '0 0 0 1 1 1 1'", "length 2, expected 1");
  refused("--sensor-pose nowhere.txt", "no such file");
  const std::string file = w.folder.write("bad.txt", "1 2\n3 four\n");
  refused("--sensor-pose " + file, "bad.txt: line 2: ");
  refused("--set load_scene.sensor_pose=[1,2]", "load_scene: the sensor's pose has 2");
  refused("--scene-unit inch", "--scene-unit: load_scene.unit: ");
  refused("--model-unit parsec", "--model-unit: load_models.unit: ");
}

}  // namespace posevote::sensor_pose_test
