// SPDX-License-Identifier: BSD-3-Clause
// What holds for every descriptor, whatever it is made of.
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

#include "tests/nodes/describe/described_body.hpp"

namespace posevote::descriptors_test {

using namespace posevote::test;

namespace {

struct Expected {
  std::string node;
  Eigen::Index length;
  std::map<std::string, std::string> params;
  float turned;     ///< most that turning the body may change 99 of 100 descriptors, relative
  double self;      ///< least share of features that find themselves in another sampling
  float different;  ///< least typical distance to another surface's descriptors, relative
};

/// Descriptors with a local frame flip where the frame is ambiguous, those without are steady.
const std::vector<Expected>& all_descriptors() {
  static const std::vector<Expected> all = {
      {"describe_point_pairs", 240, {{"radius", "8"}}, 1e-3F, 0.8, 0.05F},
      {"describe_nd_histogram", 128, {{"radius", "8"}}, 1e-3F, 0.5, 0.05F},
      {"describe_spin_images", 153, {{"radius", "8"}}, 0.05F, 0.3, 0.05F},
      {"describe_fpfh", 33, {{"radius", "6"}}, 0.02F, 0.3, 0.05F},
      {"describe_ecsad", 30, {{"radius", "8"}}, 0.2F, 0.4, 0.05F},
      {"describe_shot", 352, {{"radius", "8"}}, 0.05F, 0.7, 0.05F},
      {"describe_color_pairs", 60, {{"radius", "8"}}, 1e-3F, 0.8, 0.05F},
      {"describe_cshot", 1344, {{"radius", "8"}}, 0.05F, 0.7, 0.05F},
      {"describe_rops", 135, {{"radius", "8"}}, 0.05F, 0.3, 0.05F},
      {"describe_usc", 1960, {{"radius", "8"}}, 0.2F, 0.4, 0.05F}};
  return all;
}

Eigen::Affine3f some_motion() {
  Eigen::Affine3f motion(Eigen::AngleAxisf(2.1F, Eigen::Vector3f(1, -2, 0.5F).normalized()));
  motion.pretranslate(Eigen::Vector3f(0.03F, -0.02F, 0.08F));
  return motion;
}

/// The same surface, its points in another order; feature point i stays feature point i.
FeatureSet described_backwards(const Expected& expected, const Cloud& body, std::uint32_t step) {
  Cloud reversed = body;
  reversed.points = body.points.colwise().reverse();
  reversed.normals = body.normals.colwise().reverse();
  reversed.colors = body.colors.colwise().reverse();
  FeaturePoints points = every(step, body);
  for (std::uint32_t& i : points.indices)
    i = static_cast<std::uint32_t>(body.points.rows()) - 1 - i;
  return run_node<FeatureSet>(expected.node, expected.params, reversed, points, Scale{kResolution});
}

void check_self(const Expected& expected) {
  INFO(expected.node);
  const double rate = self_match_rate(expected.node, 0, expected.params);
  CAPTURE(rate);
  CHECK(rate > expected.self);
}

}  // namespace

TEST_CASE("descriptors are of their length, and all different places differ", "[describe]") {
  for (const Expected& expected : all_descriptors()) {
    INFO(expected.node);
    const FeatureSet one =
        described(expected.node, painted(bumpy_cloud(2, kResolution)), 23, expected.params);
    const FeatureSet other =
        described(expected.node, painted(bumpy_cloud(3, kResolution)), 23, expected.params);
    CHECK(one.descriptors.cols() == expected.length);
    CHECK(one.descriptors.allFinite());
    std::vector<float> nearest;
    for (const auto& row : one.descriptors.rowwise())
      nearest.push_back((other.descriptors.rowwise() - row).rowwise().norm().minCoeff() /
                        row.norm());
    std::nth_element(nearest.begin(), nearest.begin() + nearest.size() / 2, nearest.end());
    CAPTURE(nearest[nearest.size() / 2]);
    CHECK(nearest[nearest.size() / 2] > expected.different);
  }
}

TEST_CASE("descriptors do not change where a body is moved", "[describe]") {
  const Cloud body = painted(bumpy_cloud(2, kResolution));
  const Cloud turned = moved(body, some_motion());
  for (const Expected& expected : all_descriptors()) {
    INFO(expected.node);
    const float change = typical_difference(described(expected.node, body, 11, expected.params),
                                            described(expected.node, turned, 11, expected.params));
    CAPTURE(change);
    CHECK(change < expected.turned);
  }
}

TEST_CASE("descriptors do not depend on the order of points", "[describe]") {
  const Cloud body = painted(bumpy_cloud(3, kResolution));
  for (const Expected& expected : all_descriptors()) {
    INFO(expected.node);
    const float change = typical_difference(described(expected.node, body, 11, expected.params),
                                            described_backwards(expected, body, 11));
    CAPTURE(change);
    CHECK(change < 0.01F);
  }
}

TEST_CASE("descriptors find a differently sampled body again", "[describe]") {
  for (const Expected& expected : all_descriptors())
    if (expected.length < 150) check_self(expected);
}

TEST_CASE("long descriptors find a differently sampled body again", "[describe]") {
  for (const Expected& expected : all_descriptors())
    if (expected.length >= 150 && expected.length < 1000) check_self(expected);
}

TEST_CASE("the longest descriptor finds a differently sampled body again", "[describe]") {
  for (const Expected& expected : all_descriptors())
    if (expected.length >= 1000) check_self(expected);
}

TEST_CASE("descriptors are the same bytes at any number of threads", "[describe]") {
  const Cloud body = painted(bumpy_cloud(2, kResolution));
  for (const Expected& expected : all_descriptors()) {
    INFO(expected.node);
    const std::uint32_t step = expected.node == "describe_rops" ? 5 : 20;  // several chunks
    FeatureSet one, two;
    oneapi::tbb::task_arena(1).execute(
        [&] { one = described(expected.node, body, step, expected.params); });
    oneapi::tbb::task_arena(2).execute(
        [&] { two = described(expected.node, body, step, expected.params); });
    CHECK(one.descriptors == two.descriptors);
    const FeatureSet some = described(expected.node, body, 3 * step, expected.params);
    Eigen::Index same = 0;  // whatever stands beside it in a chunk
    for (Eigen::Index i = 0; i < some.descriptors.rows(); ++i)
      same += some.descriptors.row(i) == one.descriptors.row(3 * i);
    CHECK(same == some.descriptors.rows());
  }
}

TEST_CASE("what cannot be described is left out", "[describe]") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const Expected& expected : all_descriptors()) {
    INFO(expected.node);
    Cloud body = painted(bumpy_cloud(1, kResolution));
    body.normals.row(0).setZero();
    body.normals.row(6).setConstant(nan);
    body.points.row(12).setConstant(nan);
    body.points.row(18) << 5, 5, 5;  // alone
    body.points.row(24).setConstant(std::numeric_limits<float>::infinity());
    body.normals.row(31).setConstant(std::numeric_limits<float>::infinity());  // of a neighbour
    const FeatureSet features = described(expected.node, body, 6, expected.params);
    CHECK(features.points.rows() == (body.points.rows() + 5) / 6 - 5);
    CHECK(features.points.row(0) == body.points.row(30));
    CHECK(features.normals.row(0) == body.normals.row(30));
    CHECK(features.points.rows() == features.descriptors.rows());
    CHECK(features.descriptors.allFinite());
  }
}

TEST_CASE("planes, lines and heaps of equal points are described or refused", "[describe]") {
  Cloud plane, line, heap;
  plane.points.resize(900, 3);
  line.points.setZero(900, 3);
  heap.points.setConstant(900, 3, 0.1F);
  for (Eigen::Index i = 0; i < 900; ++i) {
    plane.points.row(i) << static_cast<float>(i % 30), static_cast<float>(i / 30), 0;
    line.points(i, 0) = static_cast<float>(i) * kResolution;
  }
  plane.points *= kResolution;
  for (Cloud* cloud : {&plane, &line, &heap})
    cloud->normals = Eigen::RowVector3f(0, 0, 1).replicate(900, 1);
  for (const Expected& expected : all_descriptors()) {
    INFO(expected.node);
    const DescriptorMatrix flat = described(expected.node, plane, 7, expected.params).descriptors;
    CHECK(flat.rows() > 0);
    CHECK(flat.allFinite());
    CHECK(described(expected.node, line, 7, expected.params).descriptors.allFinite());
    CHECK(described(expected.node, heap, 7, expected.params).descriptors.allFinite());
  }
}

TEST_CASE("what makes no sense is refused by all descriptors", "[describe]") {
  const Cloud body = painted(bumpy_cloud(1, 2 * kResolution));
  for (const Expected& expected : all_descriptors()) {
    INFO(expected.node);
    const auto describe = [&](const Cloud& cloud, const FeaturePoints& points, float resolution) {
      return run_node<FeatureSet>(expected.node, {}, cloud, points, Scale{resolution});
    };
    Cloud bare = body;
    bare.normals.resize(0, 3);
    CHECK_THROWS_WITH(describe(bare, {{0}}, kResolution), Catch::Contains("0 normals"));
    CHECK(describe(body, {}, kResolution).descriptors.rows() == 0);  // nothing is left to search
    CHECK_THROWS_WITH(describe(body, {{999999}}, kResolution), Catch::Contains("999999"));
    CHECK_THROWS_WITH(describe(body, {{0}}, 0), Catch::Contains("resolution"));
    CHECK(describe(body, {{0, 1}}, 1e-6F).descriptors.rows() == 0);  // too few neighbours
    Cloud blind = body;
    blind.normals.setZero();
    CHECK(describe(blind, {{0}}, kResolution).descriptors.rows() == 0);
  }
}

}  // namespace posevote::descriptors_test
