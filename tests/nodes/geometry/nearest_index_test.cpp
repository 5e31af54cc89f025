// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/nearest_index.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "nodes/geometry/scan_surface.hpp"
#include "tests/support/instruction_set.hpp"

namespace posevote::nearest_index_test {
namespace {

constexpr float kReach = 0.01F;

std::optional<geometry::NearestPoint> by_brute_force(const PointMatrix& points,
                                                     const Eigen::Vector3f& center, float distance,
                                                     const std::vector<char>& hidden) {
  std::optional<geometry::NearestPoint> best;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const float dx = points(i, 0) - center.x(), dy = points(i, 1) - center.y(),
                dz = points(i, 2) - center.z();
    const float squared = dx * dx + dy * dy + dz * dz;
    if (hidden[static_cast<std::size_t>(i)] || !(squared <= distance * distance)) continue;
    if (!best || squared < best->squared)
      best = geometry::NearestPoint{static_cast<std::uint32_t>(i), squared};
  }
  return best;
}

PointMatrix random_points(Eigen::Index count, float size, std::mt19937& random) {
  std::uniform_real_distribution<float> place(-size, size);
  PointMatrix points(count, 3);
  for (float& value : points.reshaped()) value = place(random);
  return points;
}

void check_against_brute_force(const PointMatrix& points, float spread, std::mt19937& random) {
  geometry::NearestIndex near(points, kReach);
  std::vector<char> hidden(static_cast<std::size_t>(points.rows()));
  for (char& one : hidden) one = static_cast<char>(random() % 4 == 0);
  near.hide(hidden);
  PointMatrix normals = PointMatrix::Zero(points.rows(), 3);
  normals.col(2).setOnes();
  geometry::ScanSurface surface({points, normals, {}}, false, kReach);
  surface.take_out(hidden);
  std::uniform_real_distribution<float> place(-spread, spread), share(0, 1);
  int found = 0;
  for (int q = 0; q < 3000; ++q) {
    const Eigen::Vector3f center(place(random), place(random), place(random));
    const float distance = (q % 3 == 0 ? 4 * kReach : kReach) * share(random);
    const auto expected = by_brute_force(points, center, distance, hidden);
    const auto got = near.nearest(center, distance);
    const auto left = surface.nearest_compatible({center, Eigen::Vector3f::UnitZ()}, distance);
    REQUIRE(static_cast<bool>(got) == expected.has_value());
    REQUIRE(left.has_value() == expected.has_value());
    if (!got) continue;
    ++found;
    CHECK(got.index == expected->index);
    CHECK(got.squared == expected->squared);
    CHECK((left->point - center).squaredNorm() == Approx(expected->squared));
  }
  CHECK(found > 100);
}

}  // namespace

TEST_CASE("the nearest point within a distance is that of brute force", "[prepare]") {
  const test::OnInstructionSet there(GENERATE(from_range(test::instruction_sets())));
  if (!there) return;
  std::mt19937 random(1);
  check_against_brute_force(random_points(3000, 0.05F, random), 0.06F, random);
}

TEST_CASE("points on a raster, where distances and cubes tie", "[prepare]") {
  const test::OnInstructionSet there(GENERATE(from_range(test::instruction_sets())));
  if (!there) return;
  std::mt19937 random(2);
  PointMatrix points = random_points(2000, 0.03F, random);
  points = (points / kReach * 4).array().round().matrix() * (kReach / 4);
  check_against_brute_force(points, 0.03F, random);
}

TEST_CASE("an outlier far away costs no exactness", "[prepare]") {
  std::mt19937 random(3);
  PointMatrix points = random_points(2000, 0.03F, random);
  points.row(7) << 1e6F, -1e5F, 3e4F;
  if (GENERATE(false, true)) points.row(6) << -1e30F, -2e6F, 1e20F;
  points.row(8) << std::numeric_limits<float>::quiet_NaN(), 0, 0;
  points.row(9) << 0, std::numeric_limits<float>::infinity(), 0;
  check_against_brute_force(points, 0.03F, random);
}

TEST_CASE("an outlier far away costs no time, sparse points no memory", "[prepare]") {
  std::mt19937 random(4);
  PointMatrix points = random_points(200000, 0.5F, random);
  points.row(7) << 1e30F, -1e10F, 0;
  const geometry::NearestIndex near(points, kReach);
  // Each by brute force would take a minute.
  for (Eigen::Index i = 0; i < 100000; ++i) REQUIRE(near.nearest(points.row(i), kReach));
  // 4 GB if each had a block of its own.
  points = random_points(2000000, 1000, random);
  const geometry::NearestIndex sparse(points, kReach);
  for (std::uint32_t i = 0; i < 1000; ++i) CHECK(sparse.nearest(points.row(i), kReach).index == i);
}

TEST_CASE("nothing is near nothing", "[prepare]") {
  const PointMatrix none(0, 3), one = PointMatrix::Zero(1, 3);
  CHECK(!geometry::NearestIndex(none, kReach).nearest({0, 0, 0}, kReach));
  CHECK(!geometry::NearestIndex(one, 0).nearest({0, 0, 0}, kReach));
  CHECK(!geometry::ScanSurface({one, one, {}}, false, 0).is_near({0, 0, 0}, kReach));
  geometry::NearestIndex near(one, kReach);
  CHECK(near.nearest({0, 0, 0}, 0));
  CHECK(!near.nearest({0, std::nanf(""), 0}, kReach));
  CHECK(!near.nearest({1e30F, 0, 0}, kReach));
  CHECK(near.nearest({1e10F, 0, 0}, 1e11F));
  near.hide({1});
  CHECK(!near.nearest({0, 0, 0}, kReach));
}

}  // namespace posevote::nearest_index_test
