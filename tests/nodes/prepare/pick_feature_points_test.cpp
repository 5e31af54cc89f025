// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>
#include <set>

#include "nodes/data/features.hpp"
#include "tests/support/run_node.hpp"
#include "tests/support/shapes.hpp"

namespace posevote::pick_feature_points_test {
namespace {

std::vector<std::uint32_t> picked(const PointMatrix& points, float resolution,
                                  const std::map<std::string, std::string>& params = {}) {
  Cloud cloud;
  cloud.points = points;
  return test::run_node<FeaturePoints>("pick_feature_points", params, cloud, Scale{resolution})
      .indices;
}

}  // namespace

TEST_CASE("pick_feature_points takes the point nearest to each voxel's centroid", "[prepare]") {
  PointMatrix points(5, 3);
  points << 0, 0, 0, 0.9F, 0, 0, 0.5F, 0.1F, 0, 3.1F, 0, 0, 3.2F, 0, 0;
  points.row(4) << 3.9F, 0.9F, 0.9F;
  CHECK(picked(points, 0.5F, {{"spacing", "2"}}) == std::vector<std::uint32_t>{2, 3});
  CHECK(picked(points, 0.01F).size() == 5);
}

TEST_CASE("pick_feature_points spreads over the whole cloud, each point once", "[prepare]") {
  const PointMatrix points = test::sphere(20000, 0.05F);
  const std::vector<std::uint32_t> indices = picked(points, 0.002F);
  CHECK(std::set<std::uint32_t>(indices.begin(), indices.end()).size() == indices.size());
  CHECK(indices.size() > 1000);  // 4 pi 50^2 / 5^2 = 1257
  CHECK(indices.size() < 2200);
  for (Eigen::Index i = 0; i < points.rows(); i += 97) {
    float nearest = 1;
    for (const std::uint32_t k : indices)
      nearest = std::min(nearest, (points.row(k) - points.row(i)).norm());
    CHECK(nearest < 0.005F * 1.74F);
  }
}

TEST_CASE("pick_feature_points widens the spacing until they fit", "[prepare]") {
  const PointMatrix points = test::sphere(20000, 0.05F);
  const std::size_t fit = picked(points, 0.001F, {{"max_points", "500"}}).size();
  CHECK(fit <= 500);
  CHECK(fit > 350);
  CHECK(picked(points, 0.001F, {{"max_points", "1"}}).size() == 1);
  CHECK(picked(points, 0.0001F).size() <= 10000);
  CHECK(picked(points, 0.0001F, {{"max_points", "0"}}).size() > 19000);
}

TEST_CASE("pick_feature_points picks the same points in any order", "[prepare]") {
  const PointMatrix points = test::sphere(20000, 0.05F);
  const std::vector<Eigen::Index> order = test::shuffled(points.rows());
  const auto of_plain = picked(points, 0.001F);
  const auto of_mixed = picked(points(order, Eigen::all), 0.001F);
  REQUIRE(of_plain.size() == of_mixed.size());
  for (std::size_t i = 0; i < of_plain.size(); ++i) CHECK(order[of_mixed[i]] == of_plain[i]);
}

TEST_CASE("pick_feature_points of nothing is nothing, of twins one", "[prepare]") {
  CHECK(picked(PointMatrix(0, 3), 0.001F).empty());
  CHECK(picked(PointMatrix::Ones(9, 3), 0.001F).size() == 1);
}

}  // namespace posevote::pick_feature_points_test
