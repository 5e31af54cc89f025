// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>
#include <cstring>

#include "nodes/formats/read_scan.hpp"
#include "tests/nodes/write/writer.hpp"
#include "tests/support/temporary_folder.hpp"

namespace posevote::write_overlay_test {

using posevote::test::make_detection;
using posevote::test::make_library;
using posevote::test::make_patch;
using posevote::test::run_writer;
using posevote::test::TemporaryFolder;

namespace {

void write(const TemporaryFolder& folder, const Cloud& scan, const Detections& detections) {
  run_writer("write_overlay", "1", {0, "shelf", folder.path(), 0}, scan, detections,
             make_library());
}

/// Colour of the i-th point of an overlay with normals.
std::string colour_of(const std::filesystem::path& file, std::size_t i) {
  const std::string text = test::read_text(file);
  return text.substr(text.find("end_header\n") + 11 + 27 * i + 24, 3);
}

}  // namespace

TEST_CASE("write_overlay: the scan, then each model where it was found", "[write]") {
  const TemporaryFolder folder;
  const Cloud scan = make_patch(10, 0.01F, 1);
  Detection turned = make_detection({0.2, -0.1, 0.9});
  turned.T_scene_model.linear() =
      Eigen::AngleAxisd(std::acos(0.0), Eigen::Vector3d::UnitX()).toRotationMatrix();
  write(folder, scan, {{turned, make_detection({-0.2, 0, 0.8})}});
  const std::filesystem::path file = folder / "overlays/shelf.ply";
  const Mesh read = formats::read_mesh(file, 1);
  const Cloud model = make_library().models[0]->cloud;
  const Eigen::Index n = model.points.rows();
  REQUIRE(read.points.rows() == 100 + 2 * n);
  CHECK(read.points.topRows(100) == scan.points);
  // A quarter turn about x carries (x, y, 0) to (x, 0, y), and the normal (0, 0, -1) to (0, 1, 0).
  const Eigen::Vector3f first = model.points.row(0);
  CHECK((read.points.row(100).transpose() -
         Eigen::Vector3f(0.2F + first.x(), -0.1F, 0.9F + first.y()))
            .norm() < 1e-6F);
  CHECK((read.normals.row(100).transpose() - Eigen::Vector3f::UnitY()).norm() < 1e-6F);
  CHECK(read.points.row(100 + n).x() == Approx(-0.2F + first.x()));
  const std::string grey = colour_of(file, 0);
  const std::string one = colour_of(file, 100),
                    two = colour_of(file, 100 + static_cast<std::size_t>(n));
  CHECK(grey != one);
  CHECK(one != two);
  CHECK(colour_of(file, 99) == grey);
  CHECK(colour_of(file, 99 + static_cast<std::size_t>(n)) == one);
}

TEST_CASE("write_overlay takes scans that are empty or have no normals", "[write]") {
  const TemporaryFolder folder;
  Cloud scan = make_patch(4, 0.01F, 1);
  scan.normals.resize(0, 3);
  Detection unknown = make_detection({0, 0, 1});
  unknown.obj_id = 9;
  write(folder, scan, {{make_detection({0, 0, 1}), unknown}});
  CHECK(formats::read_mesh(folder / "overlays/shelf.ply", 1).points.rows() == 16 + 31 * 31);
  write(folder, Cloud(), {{make_detection({0, 0, 1})}});
  CHECK(formats::read_mesh(folder / "overlays/shelf.ply", 1).points.rows() == 31 * 31);
}

TEST_CASE("write_overlay writes nothing without an output folder, and says where it cannot",
          "[write]") {
  const TemporaryFolder folder;
  const Cloud scan = make_patch(100, 0.01F, 1);
  CHECK_NOTHROW(run_writer("write_overlay", "1", {}, scan, Detections(), make_library()));
  const test::FullDisk full(5000);
  CHECK_THROWS_WITH(write(folder, scan, {}), Catch::Contains("shelf.ply: cannot be written"));
  CHECK(std::filesystem::is_empty(folder / "overlays"));
}

TEST_CASE("write_overlay writes every n-th frame, or none", "[write]") {
  const TemporaryFolder folder;
  const auto written = [&](std::uint64_t number, const std::string& every) {
    const std::string name = std::to_string(number) + "-" + every;
    run_writer("write_overlay", every, {number, name, folder.path(), 0}, make_patch(4, 0.01F, 1),
               Detections(), make_library());
    return std::filesystem::exists(folder / ("overlays/" + name + ".ply"));
  };
  CHECK(written(3, "3"));
  CHECK_FALSE(written(4, "3"));
  CHECK_FALSE(written(0, "0"));
}

}  // namespace posevote::write_overlay_test
