// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>

#include "tests/nodes/describe/described_body.hpp"

namespace posevote::describe_point_pairs_test {

using namespace posevote::test;

namespace {

const std::string kNode = "describe_point_pairs";
constexpr int kColumns = 10, kRows = 6;  // angles and distances of a histogram

/// A feature point at the origin that looks up, and neighbours given as position and normal.
Cloud around_origin(const std::vector<std::array<Eigen::Vector3f, 2>>& neighbours) {
  const auto count = static_cast<Eigen::Index>(neighbours.size());
  Cloud cloud;
  cloud.points.setZero(count + 1, 3);
  cloud.normals.setZero(count + 1, 3);
  cloud.normals(0, 2) = 1;
  for (Eigen::Index i = 0; i < count; ++i) {
    cloud.points.row(i + 1) = neighbours[static_cast<std::size_t>(i)][0].transpose();
    cloud.normals.row(i + 1) = neighbours[static_cast<std::size_t>(i)][1].transpose();
  }
  return cloud;
}

/// The descriptor of the origin for a radius of 6 m, so that a distance bin is 1 m wide.
FeatureSet describe_points(const Cloud& cloud) {
  return run_node<FeatureSet>(kNode, {{"radius", "6"}, {"min_neighbours", "1"}}, cloud,
                              FeaturePoints{{0}}, Scale{1});
}

Eigen::RowVectorXf describe_origin(const Cloud& cloud) {
  return describe_points(cloud).descriptors;
}

float bin(const Eigen::RowVectorXf& descriptor, int angle, int row, int column) {
  return descriptor[(angle * kRows + row) * kColumns + column];
}

}  // namespace

TEST_CASE("one pair falls into the bins of its four angles", "[describe]") {
  // n' is tilted by 30 deg to +y; d = x, b = d x n = -y. Bins are 18 deg wide, centred at 9, 27 ...
  const auto d = describe_origin(
      around_origin({{Eigen::Vector3f(1.5F, 0, 0), Eigen::Vector3f(0, 0.5F, 0.8660254F)}}));
  REQUIRE(d.size() == 240);
  // The one pair is half of what fills row 1, whose share is 1.5 / 6.
  const auto row_share = [](float share) {
    return Approx(std::sqrt(0.25F * share / 2)).margin(1e-3);
  };
  CHECK(bin(d, 0, 1, 4) == row_share(0.5F));  // (n, d) = 90 deg
  CHECK(bin(d, 0, 1, 5) == row_share(0.5F));
  CHECK(bin(d, 1, 1, 4) == row_share(0.5F));  // (n', d) = 90 deg
  CHECK(bin(d, 1, 1, 5) == row_share(0.5F));
  CHECK(bin(d, 2, 1, 1) == row_share(5.0F / 6));  // (n, n') = 30 deg
  CHECK(bin(d, 2, 1, 2) == row_share(1.0F / 6));
  CHECK(bin(d, 3, 1, 6) == row_share(5.0F / 6));  // (n', b) = 120 deg
  CHECK(bin(d, 3, 1, 7) == row_share(1.0F / 6));
  CHECK(d.squaredNorm() == Approx(4 * 0.25 / 2).margin(1e-4));  // nothing elsewhere
}

TEST_CASE("distances are shared between rows, and every row has its own weight", "[describe]") {
  const float half = std::sqrt(2.0F);
  const auto d =
      describe_origin(around_origin({{Eigen::Vector3f(1.5F, 0, 0), Eigen::Vector3f::UnitZ()},
                                     {Eigen::Vector3f(half, 0, half), Eigen::Vector3f::UnitZ()}}));
  // Row 1 holds the first pair (90 deg) and half of the second (45 deg, at 2 m); row 2 the other
  // half.
  for (const int column : {2, 4, 5})
    CHECK(bin(d, 0, 1, column) == Approx(std::sqrt(1.5F / 6 * 0.5F / 2.5F)).margin(1e-3));
  CHECK(bin(d, 0, 2, 2) == Approx(std::sqrt(2.5F / 6 * 0.5F / 1.5F)).margin(1e-3));
}

TEST_CASE("point pairs: (n, d) and (n', d) are told apart and keep their sign", "[describe]") {
  // Above the tangent plane by 45 deg, n' tilted toward d by 30 deg: (n, d) = 45, (n', d) = 15 deg.
  const auto d = describe_origin(around_origin(
      {{Eigen::Vector3f(1.0606602F, 0, 1.0606602F), Eigen::Vector3f(0.5F, 0, 0.8660254F)}}));
  CHECK(bin(d, 0, 1, 2) == Approx(std::sqrt(0.25F / 2)).margin(1e-3));
  CHECK(bin(d, 1, 1, 0) == Approx(std::sqrt(0.25F / 2 * 2 / 3)).margin(1e-3));
  CHECK(bin(d, 1, 1, 1) == Approx(std::sqrt(0.25F / 2 / 3)).margin(1e-3));
}

TEST_CASE("point pairs: turning a body changes nothing, a mirror does", "[describe]") {
  const Cloud body = bumpy_cloud(2, kResolution);
  Eigen::Affine3f turn(Eigen::AngleAxisf(2.1F, Eigen::Vector3f(1, -2, 0.5F).normalized()));
  turn.pretranslate(Eigen::Vector3f(0.3F, -0.2F, 0.8F));
  const FeatureSet still = described(kNode, body, 7);
  CHECK(typical_difference(still, described(kNode, moved(body, turn), 7)) < 1e-3F);
  const Eigen::Affine3f mirror(Eigen::Vector3f(1, 1, -1).asDiagonal());
  CHECK(typical_difference(still, described(kNode, moved(body, mirror), 7)) > 0.05F);
}

TEST_CASE("point pairs: a noisy body finds itself again", "[describe]") {
  CHECK(self_match_rate(kNode, 0.3F * kResolution) > 0.8);
}

TEST_CASE("point pairs: neighbours that face away do not count", "[describe]") {
  const Eigen::Vector3f where(1.5F, 0, 0), away(0, 0, -1), level(0, 1, 0);
  const Cloud cloud = around_origin({{where, Eigen::Vector3f::UnitZ()}, {-where, away}});
  CHECK(describe_origin(cloud).isApprox(
      describe_origin(around_origin({{where, Eigen::Vector3f::UnitZ()}})), 1e-6F));
  CHECK(describe_points(around_origin({{where, away}, {-where, level}})).points.rows() == 0);
}

TEST_CASE("point pairs: of a depth image only every so many points are neighbours", "[describe]") {
  const Eigen::Vector3f up = Eigen::Vector3f::UnitZ(), level(0, 0.5F, 0.8660254F);
  Cloud cloud = around_origin({{Eigen::Vector3f(1.5F, 0, 0), up}, {Eigen::Vector3f(0, 2, 0), up}});
  const auto both = describe_origin(cloud);
  cloud.view.pixels = {640, 480};
  const std::map<std::string, std::string> every_other{
      {"radius", "6"}, {"min_neighbours", "2"}, {"image_step", "2"}};
  const auto described_as = [&](const Cloud& of) {
    return run_node<FeatureSet>(kNode, every_other, of, FeaturePoints{{0}}, Scale{1}).descriptors;
  };
  const DescriptorMatrix second = described_as(cloud);
  REQUIRE(second.rows() == 1);  // it counts as two neighbours
  CHECK(second.isApprox(describe_origin(around_origin({{Eigen::Vector3f(0, 2, 0), up}})), 1e-6F));
  cloud.normals.row(1) = level;  // of the first, which plays no part
  CHECK(described_as(cloud) == second);
  cloud.view = {};
  cloud.normals.row(1) = up;
  CHECK(described_as(cloud).isApprox(both, 1e-6F));
}

TEST_CASE("point pairs: a third of a depth image describes nearly as all of it does",
          "[describe]") {
  Cloud body = bumpy_cloud(1, kResolution);
  const FeatureSet all = described(kNode, body, 5);
  body.view.pixels = {640, 480};
  const FeatureSet some = described(kNode, body, 5);
  REQUIRE(some.descriptors.rows() == all.descriptors.rows());
  const std::vector<float> off = differences(all, some);
  CHECK(off.front() > 0);
  CHECK(off[off.size() / 2] < 0.1F);
}

}  // namespace posevote::describe_point_pairs_test
