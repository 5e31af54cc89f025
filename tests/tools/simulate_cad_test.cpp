// SPDX-License-Identifier: BSD-3-Clause
// Shapes of few triangles, and what the simulation makes of such meshes.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <numbers>

#include "tools/simulate/cad_mesh.hpp"
#include "tools/simulate/pieces.hpp"
#include "tools/simulate/scanner.hpp"
#include "tools/simulate/shapes.hpp"
#include "tools/simulate/split_faces.hpp"

namespace posevote::simulate_cad_test {

using namespace posevote::simulate;

namespace {

double volume(const Mesh& mesh) {
  double sum = 0;
  for (Eigen::Index face = 0; face < mesh.faces.rows(); ++face)
    sum += corners_of(mesh, face).determinant() / 6;
  return sum;
}

/// Every edge is used once in each direction.
bool is_closed(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (Eigen::Index face = 0; face < mesh.faces.rows(); ++face)
    for (int k = 0; k < 3; ++k) ++uses[{mesh.faces(face, k), mesh.faces(face, (k + 1) % 3)}];
  for (const auto& [edge, count] : uses)
    if (count != 1 || !uses.contains({edge.second, edge.first})) return false;
  return true;
}

std::vector<std::string> coarse_shape_names() {
  std::vector<std::string> names = shape_names();
  for (const std::string& fine : fine_shape_names()) std::erase(names, fine);
  return names;
}

/// By which a regular polygon's area falls short of its circle's.
double of_circle(int corners) {
  const double angle = 2 * std::numbers::pi / corners;
  return std::sin(angle) / angle;
}

Eigen::Vector3d sides(const Mesh& mesh) {
  return (mesh.points.colwise().maxCoeff() - mesh.points.colwise().minCoeff())
      .transpose()
      .cast<double>();
}

/// Whether the mesh has a vertex at every place where a turned one has one.
bool maps_onto_itself(const Mesh& mesh, const Eigen::Matrix3d& turn) {
  for (Eigen::Index i = 0; i < mesh.points.rows(); ++i) {
    const Eigen::RowVector3f moved =
        (turn * mesh.points.row(i).transpose().cast<double>()).cast<float>().transpose();
    if ((mesh.points.rowwise() - moved).rowwise().norm().minCoeff() > 1e-5F) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("coarse shapes are closed, outward, of few triangles and of the size asked for",
          "[simulate]") {
  // Counted by hand: two a side, a polygon of n corners and h holes takes n + 2 h - 2.
  const std::map<std::string, Eigen::Index> triangles{
      {"can", 316},  {"flange", 480}, {"bolt", 164},  {"bracket", 240},
      {"gear", 384}, {"tee", 360},    {"carton", 12}, {"plate", 300}};
  REQUIRE(coarse_shape_names().size() == 18);
  for (const std::string& name : coarse_shape_names())
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      INFO(name << " " << seed);
      const Mesh mesh = make_shape(name, seed, 0.15);
      CHECK(mesh.points.allFinite());
      CHECK(is_closed(mesh));
      CHECK(volume(mesh) > 0);
      CHECK(mesh.faces.rows() <= 1000);
      if (const auto part = triangles.find(name); part != triangles.end()) {
        CHECK(mesh.faces.rows() <= 500);
        CHECK(mesh.faces.rows() == part->second);
      }
      CHECK(sides(mesh).maxCoeff() == Approx(0.15));
      const Mesh stretched = make_shape(name, seed, Eigen::Vector3d(0.05, 0.07, 0.21));
      CHECK((sides(stretched) - Eigen::Vector3d(0.05, 0.07, 0.21)).norm() < 1e-6);
    }
}

TEST_CASE("coarse shapes map onto themselves as they say", "[simulate]") {
  const std::map<std::string, std::size_t> turns{{"flange", 3}, {"bolt", 5}, {"gear", 11},
                                                 {"tee", 1},    {"tin", 1},  {"carton", 3}};
  for (const std::string& name : coarse_shape_names()) {
    INFO(name);
    const ShapeSymmetry symmetry = symmetry_of(name);
    const auto expected = turns.find(name);
    if (expected != turns.end()) CHECK(symmetry.turns.size() == expected->second);
    const Mesh mesh = make_shape(name, 1, 0.2);
    for (const Eigen::Matrix3d& turn : symmetry.turns) CHECK(maps_onto_itself(mesh, turn));
  }
  CHECK(symmetry_of("can").is_round);
  CHECK(symmetry_of("cup").is_round);
  CHECK_FALSE(symmetry_of("plate").is_round);
  const Eigen::Matrix3d half =
      Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  CHECK_FALSE(maps_onto_itself(make_shape("plate", 1, 0.2), half));
  CHECK_FALSE(maps_onto_itself(make_shape("bracket", 1, 0.2), half));
}

TEST_CASE("a plate with holes has the volume of a plate less that of its holes", "[simulate]") {
  CadMesh mesh;
  mesh.prism(rectangle(2, 1), 0, 0.5,
             {circle(16, 0.2, {-0.5, 0}), circle(12, 0.2, {0.5, 0}), circle(8, 0.1)});
  const Mesh made = mesh.finish();
  CHECK(is_closed(made));
  const double pi = std::numbers::pi;
  const double holes =
      pi * 0.04 * of_circle(16) + pi * 0.04 * of_circle(12) + pi * 0.01 * of_circle(8);
  CHECK(volume(made) == Approx(0.5 * (2 - holes)).epsilon(1e-5));
  CadMesh outside;
  CHECK_THROWS_AS(outside.top(rectangle(2, 1), 0, {circle(8, 0.1, {3, 0})}), std::logic_error);
}

TEST_CASE("turned profiles and pipes have the volume of what they stand for", "[simulate]") {
  CadMesh cone;
  cone.lathe({{1, 0}, {0.5, 2}}, 24);
  const Mesh made = cone.finish();
  CHECK(is_closed(made));
  CHECK(volume(made) ==
        Approx(std::numbers::pi * 2 / 3 * (1 + 0.5 + 0.25) * of_circle(24)).epsilon(1e-5));
  Ring low, high;
  for (const Eigen::Vector2d& corner : circle(6, 1)) {
    low.emplace_back(corner.x(), corner.y(), 0);
    high.emplace_back(corner.x() + 1, corner.y(), 2);
  }
  CadMesh leaning;
  leaning.tube({low, high});
  CHECK(volume(leaning.finish()) == Approx(2 * std::numbers::pi * of_circle(6)).epsilon(1e-5));
}

TEST_CASE("parts of a triangle cover it and are small", "[simulate]") {
  Eigen::Matrix3d triangle;
  triangle << 0, 3, 0, 0, 0, 1, 0, 0, 0;
  double area = 0;
  int count = 0;
  for_each_part(triangle, 0.5, [&](const Eigen::Matrix3d& part) {
    const Eigen::Vector3d cross =
        (part.col(1) - part.col(0)).cross(Eigen::Vector3d(part.col(2) - part.col(0)));
    CHECK(cross.z() > 0);
    area += cross.norm() / 2;
    for (int k = 0; k < 3; ++k) CHECK((part.col(k) - part.col((k + 1) % 3)).norm() <= 0.5 + 1e-9);
    ++count;
  });
  CHECK(area == Approx(1.5));
  CHECK(count == 49);  // 3.16 / 0.5 in seven steps
  for_each_part(triangle, 4, [&](const Eigen::Matrix3d& part) { CHECK(part == triangle); });
}

TEST_CASE("pieces of coarse bodies are solid", "[simulate]") {
  const Pieces pieces = cut_up(make_shape("carton", 1, 0.12));
  CHECK(pieces.list.size() > 30);
  std::size_t flat = 0;
  for (const std::set<std::uint32_t>& piece : pieces.list) {
    Eigen::RowVector3f low = pieces.points.row(*piece.begin()), high = low;
    for (const std::uint32_t i : piece) {
      low = low.cwiseMin(pieces.points.row(i));
      high = high.cwiseMax(pieces.points.row(i));
    }
    flat += (high - low).minCoeff() < 0.002F;
    CHECK((high - low).maxCoeff() < 0.045F);  // a cube is 20 mm wide, and triangles stick out of it
  }
  CHECK(flat * 10 < pieces.list.size());
}

TEST_CASE("half of a carton's surface is seen from afar, of however few triangles", "[simulate]") {
  const auto mesh = std::make_shared<const Mesh>(make_shape("carton", 1, 0.14));
  Body body{mesh, 1, Eigen::Isometry3d(Eigen::Translation3d(0, 0, 0.07))};
  const Eigen::Isometry3d view = look_at({0, 0, 0.05}, 2.5, 0.6, 0.8);
  const std::vector<double> seen = seen_surfaces({body}, find_sensor("plain"), view);
  CHECK(seen[0] == Approx(0.5).margin(0.02));
}

}  // namespace posevote::simulate_cad_test
