// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <map>

#include "tools/simulate/painted_symmetry.hpp"
#include "tools/simulate/random.hpp"
#include "tools/simulate/shapes.hpp"
#include "tools/simulate/surface_nets.hpp"

namespace posevote::simulate_shapes_test {
namespace {

double volume(const Mesh& mesh) {
  double sum = 0;
  for (Eigen::Index face = 0; face < mesh.faces.rows(); ++face) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k)
      corners.col(k) = mesh.points.row(mesh.faces(face, k)).transpose().cast<double>();
    sum += corners.determinant() / 6;
  }
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

}  // namespace

TEST_CASE("surface nets of a sphere: on it, closed, outward", "[simulate]") {
  const Mesh mesh = surface_nets([](const Eigen::Vector3d& p) { return p.norm() - 1; }, 1.5, 0.1);
  CHECK((mesh.points.rowwise().norm().array() - 1).abs().maxCoeff() < 1e-4F);
  CHECK(is_closed(mesh));
  CHECK(volume(mesh) == Approx(4.18879).epsilon(0.02));
}

TEST_CASE("every fine shape is closed, outward and of the size asked for", "[simulate]") {
  REQUIRE(fine_shape_names().size() >= 5);
  for (const std::string& name : fine_shape_names()) {
    INFO(name);
    const Mesh mesh = make_shape(name, 1, 0.2);
    CHECK(mesh.points.allFinite());
    CHECK(mesh.points.rows() >= 5000);
    CHECK(mesh.points.rows() <= 50000);
    CHECK(is_closed(mesh));
    CHECK(volume(mesh) > 0);
    const Eigen::RowVector3f low = mesh.points.colwise().minCoeff();
    const Eigen::RowVector3f high = mesh.points.colwise().maxCoeff();
    CHECK((high - low).maxCoeff() == Approx(0.2F));
    CHECK((high + low).cwiseAbs().maxCoeff() < 1e-6F);
  }
}

TEST_CASE("a shape depends on its seed alone", "[simulate]") {
  const Mesh first = make_shape("horn", 1, 0.2), again = make_shape("horn", 1, 0.2);
  CHECK(first.points == again.points);
  CHECK(first.faces == again.faces);
  const Mesh other = make_shape("horn", 2, 0.2);
  CHECK((other.points.rows() != first.points.rows() || other.points != first.points));
  CHECK_THROWS_AS(make_shape("cube", 1, 0.2), std::invalid_argument);
}

TEST_CASE("a shape that chance made too thin is named", "[simulate]") {
  CHECK_THROWS_MATCHES(make_shape("figure", 2539018531502807723U, 0.2), TooThin,
                       Catch::Message("the figure of seed 2539018531502807723 has parts too thin "
                                      "to mesh; choose another seed"));
}

TEST_CASE("random numbers: known first value, mean 0, deviation 1, streams apart", "[simulate]") {
  CHECK(Random(0).next() == 0xE220A8397B1DCDAFU);  // splitmix64's published test value
  Random random(3);
  double sum = 0, squares = 0;
  for (int i = 0; i < 20000; ++i) {
    const double value = random.normal();
    sum += value;
    squares += value * value;
  }
  CHECK(sum / 20000 == Approx(0).margin(0.03));
  CHECK(squares / 20000 == Approx(1).epsilon(0.05));
  CHECK(Random(3, 0).next() != Random(3, 1).next());
  CHECK(Random(3, 1).next() == Random(3, 1).next());
}

TEST_CASE("of a painted thing those symmetries are left that its paint has", "[simulate]") {
  const Mesh can = make_shape("can", 1, 0.1);
  const ShapeSymmetry shape = symmetry_of("can");
  REQUIRE(shape.is_round);
  CHECK_FALSE(painted_symmetry(shape, can, Paint(can, "can", 1)).is_round);
  CHECK(painted_symmetry(shape, can, Paint::ground(1)).is_round);  // one colour
  const Mesh carton = make_shape("carton", 1, 0.1);
  CHECK(painted_symmetry(symmetry_of("carton"), carton, Paint::ground(1)).turns.size() ==
        symmetry_of("carton").turns.size());
  CHECK(painted_symmetry(symmetry_of("carton"), carton, Paint(carton, "carton", 1)).turns.empty());
}

}  // namespace posevote::simulate_shapes_test
