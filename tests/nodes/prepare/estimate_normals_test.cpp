// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>
#include <filesystem>
#include <limits>

#include "nodes/data/features.hpp"
#include "nodes/formats/read_scan.hpp"
#include "nodes/geometry/normals.hpp"
#include "nodes/geometry/plane_normals.hpp"
#include "nodes/geometry/winding.hpp"
#include "tests/support/real_data.hpp"
#include "tests/support/run_node.hpp"
#include "tests/support/shapes.hpp"

namespace posevote::estimate_normals_test {

using Catch::Matchers::Contains;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
const Scale kScale{0.0015F};

Cloud oriented(Scan scan, const std::map<std::string, std::string>& params = {}) {
  return test::run_node<Cloud>("estimate_normals", params, std::move(scan), kScale);
}

/// 1.5 mm between points; the sensor far along z.
Scan sphere_scan(float noise = 0) {
  Scan scan;
  scan.points = test::shaken(test::sphere(14000, 0.05F), noise);
  scan.view.origin = {0, 0, 10};
  return scan;
}

/// Outward normals of sphere_scan, turned to the sensor.
PointMatrix toward_sensor() {
  PointMatrix normals = test::sphere(14000, 1);
  for (Eigen::Index i = 0; i < normals.rows(); ++i)
    if (normals(i, 2) < 0) normals.row(i) *= -1.0F;
  return normals;
}

/// Mean angle to these [deg], but for the limb, where the sensor looks along the surface.
double error_of(const Cloud& out) {
  const PointMatrix truth = toward_sensor();
  REQUIRE(out.normals.rows() == truth.rows());
  std::vector<Eigen::Index> seen;
  for (Eigen::Index i = 0; i < truth.rows(); ++i)
    if (truth(i, 2) > 0.5F) seen.push_back(i);
  return test::mean_angle(out.normals(seen, Eigen::all), truth(seen, Eigen::all));
}

}  // namespace

TEST_CASE("estimate_normals finds those of a sphere, toward the sensor", "[prepare]") {
  const Cloud out = oriented(sphere_scan());
  REQUIRE(out.points.rows() == 14000);
  CHECK(error_of(out) < 1);
  CHECK(out.view.origin == Eigen::Vector3f(0, 0, 10));
  for (Eigen::Index i = 0; i < out.points.rows(); ++i)
    REQUIRE(out.normals.row(i).dot(out.view.origin.transpose() - out.points.row(i)) >= 0);
}

TEST_CASE("estimate_normals widens its neighbourhoods with the noise", "[prepare]") {
  CHECK(geometry::suitable_planes(sphere_scan().points, 0.0045F, 3)->radius() < 0.006F);
  CHECK(geometry::suitable_planes(sphere_scan(0.0075F).points, 0.0045F, 3)->radius() > 0.010F);
  CHECK(error_of(oriented(sphere_scan(0.0025F))) < 5);
  CHECK(error_of(oriented(sphere_scan(0.0075F))) < 9);
}

TEST_CASE("estimate_normals turns with the scan and does not mind the order", "[prepare]") {
  const Scan scan = sphere_scan(0.001F);
  const Cloud plain = oriented(scan);
  Scan turned = scan;
  turned.points = scan.points * test::some_rotation().transpose();
  turned.view.origin = test::some_rotation() * scan.view.origin;
  CHECK(test::mean_angle(oriented(turned).normals,
                         plain.normals * test::some_rotation().transpose()) < 3);
  const std::vector<Eigen::Index> order = test::shuffled(scan.points.rows());
  Scan mixed = scan;
  mixed.points = scan.points(order, Eigen::all);
  CHECK(test::mean_angle(oriented(mixed).normals, plain.normals(order, Eigen::all)) < 0.5);
}

TEST_CASE("estimate_normals takes the file's normals where they are usable", "[prepare]") {
  Scan scan = sphere_scan();
  scan.normals = PointMatrix::Constant(14000, 3, 2);  // of no length one, and wrong on purpose
  scan.normals.row(1).setZero();
  scan.normals.row(2) << kNan, 0, 1;
  scan.normals.row(3) << -1e-20F, 0, 0;
  const Cloud out = oriented(scan);
  CHECK(out.normals.row(7).isApprox(Eigen::RowVector3f::Constant(std::sqrt(1.0F / 3)), 1e-5F));
  const PointMatrix truth = toward_sensor();
  for (const int i : {1, 2, 3}) CHECK(out.normals.row(i).dot(truth.row(i)) > 0.99F);
  CHECK(out.points.rows() == 14000);

  const Cloud only_file = oriented(scan, {{"source", "file"}});
  CHECK(only_file.points.rows() == 13997);
  CHECK(error_of(oriented(scan, {{"source", "pca"}})) < 1);
}

TEST_CASE("estimate_normals turns the file's normals to the sensor", "[prepare]") {
  Scan scan;
  scan.points.resize(2, 3);
  scan.points << 0, 0, 1, 0, 0, 1.1F;
  scan.normals.resize(2, 3);
  scan.normals << 0, 0, 1, 0, 0, -1;
  const Cloud out = oriented(scan);
  CHECK(out.normals(0, 2) == -1);
  CHECK(out.normals(1, 2) == -1);
}

TEST_CASE("estimate_normals takes faces and leaves out what none covers", "[prepare]") {
  Scan scan{test::box({0, 0, 0}, 0.2F), {}};
  scan.points.conservativeResize(9, 3);
  scan.points.row(8) << 5, 5, 5;
  scan.view.origin = {9, 9, 9};
  const Cloud out = oriented(scan);
  CHECK(out.points.rows() == 8);
  CHECK(out.normals.row(7).minCoeff() > 0.3F);
  CHECK(oriented(scan, {{"source", "faces"}}).points.rows() == 8);
}

TEST_CASE("estimate_normals does without points that have no surface around them", "[prepare]") {
  Scan scan = sphere_scan();
  scan.points.row(10) << 1000, 0, 0;
  scan.points.row(11) << kNan, 0, 0;
  for (Eigen::Index i = 100; i < 110; ++i)  // ten on a line
    scan.points.row(i) << 1 + 0.0005F * static_cast<float>(i), 0, 0;
  const Cloud out = oriented(scan);
  CHECK(out.points.rows() == 13988);
  CHECK(out.points.allFinite());
}

TEST_CASE("estimate_normals copes with any density", "[prepare]") {
  Scan coarse;  // 10 mm apart at a resolution of 1.5 mm
  coarse.points = test::sphere(300, 0.05F);
  coarse.view.origin = {0, 0, 10};
  CHECK(oriented(coarse).points.rows() == 300);
  Scan dense;  // all in one place but for a sphere
  dense.points = PointMatrix::Constant(200000, 3, 1);
  dense.points.topRows(14000) = test::sphere(14000, 0.05F);
  CHECK(oriented(dense).points.rows() == 14000);
}

TEST_CASE("estimate_normals fails by counts where nothing is left", "[prepare]") {
  Scan scan;
  CHECK_THROWS_WITH(oriented(scan), Contains("none of its 0 points"));
  scan.points = PointMatrix::Ones(40, 3);
  CHECK_THROWS_WITH(oriented(scan), Contains("none of its 40 points"));
  scan.points.setConstant(kNan);
  CHECK_THROWS_WITH(oriented(scan), Contains("none of its 40 points"));
  scan = {test::box({0, 0, 0}, 1), {}};
  CHECK_THROWS_WITH(oriented(scan, {{"source", "file"}}), Contains("none of its 8 points"));
  scan.normals = PointMatrix::Ones(3, 3);
  CHECK_THROWS_WITH(oriented(scan), Contains("3 normals for 8 points"));
  scan.normals.resize(0, 3);
  scan.faces(3, 1) = 8;
  CHECK_THROWS_WITH(oriented(scan), Contains("refers to point 8 of 8"));
}

TEST_CASE("estimate_normals of a whole body are a model's, the sensor aside", "[prepare]") {
  Scan scan = sphere_scan(0.001F);
  scan.normals = PointMatrix::Constant(14000, 3, 2);  // the file's, wrong on purpose: not used
  const Cloud out = oriented(scan, {{"outward", "true"}});
  const Cloud model =
      test::run_node<Cloud>("sample_surface", {{"spacing", "0"}}, Mesh(scan), kScale);
  CHECK(out.points == model.points);
  CHECK(out.normals == model.normals);
  CHECK(out.view.origin == scan.view.origin);
  CHECK((out.normals.col(2).array() < -0.9F).any());  // away from the sensor
  const graph::NodeSpec* spec = graph::find_node("estimate_normals");
  const auto params = spec->make_params();
  for (const auto& param : spec->params) {
    if (param.name == "outward") param.set(params.get(), "true");
    if (param.name == "source") param.set(params.get(), "file");
  }
  CHECK_THAT(spec->check(params.get()), Contains("source must be auto, faces or pca"));
}

TEST_CASE("estimate_normals on the Bunny with 3 % noise", "[prepare]") {
  const std::filesystem::path file = test::real_data() / "bunny/bunny.ply";
  if (!std::filesystem::exists(file)) {
    WARN("skipped: no " << file);
    return;
  }
  Scan scan = formats::read_scan(file, 1);
  const PointMatrix truth =
      geometry::face_normals(scan.points, geometry::wind_outward(scan.points, scan.faces));
  scan.points = test::shaken(scan.points, 0.0075F);
  scan.normals = truth;  // carried along to tell which points remain; not used
  const PointMatrix planes = geometry::suitable_planes(scan.points, 0.0045F, 6)->normals(5);
  double sum = 0;
  int count = 0;
  for (Eigen::Index i = 0; i < truth.rows(); ++i) {
    if (truth.row(i).isZero() || planes.row(i).isZero()) continue;
    sum += std::acos(std::min(1.0F, std::abs(truth.row(i).dot(planes.row(i)))));
    ++count;
  }
  CHECK(count > 34000);
  CHECK(sum / count * 180 / M_PI < 21);  // 56 by the faces
  scan.normals.resize(0, 3);
  const Cloud automatic = oriented(scan);
  CHECK(test::mean_angle(automatic.normals.topRows(100),
                         oriented(scan, {{"source", "pca"}}).normals.topRows(100)) < 0.1);
}

}  // namespace posevote::estimate_normals_test
