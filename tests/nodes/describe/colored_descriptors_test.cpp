// SPDX-License-Identifier: BSD-3-Clause
// What descriptors of colours tell, and what must not change them.
#include <catch2/catch.hpp>

#include "tests/nodes/describe/described_body.hpp"

namespace posevote::colored_descriptors_test {

using namespace posevote::test;

namespace {

const std::map<std::string, std::string> kParams = {{"radius", "8"}};
constexpr const char* kColored[] = {"describe_color_pairs", "describe_cshot"};

Cloud body() { return painted(bumpy_cloud(2, kResolution)); }

/// By how much the descriptors of the body change with its colours, in the median, relative.
float change(const std::string& node, const Cloud& other) {
  const FeatureSet a = described(node, body(), 11, kParams);
  const FeatureSet b = described(node, other, 11, kParams);
  REQUIRE(a.points.rows() == b.points.rows());
  const std::vector<float> all = differences(a, b);
  return all[all.size() / 2];
}

}  // namespace

TEST_CASE("other colours change descriptors of colours, those of shape are the same bytes",
          "[describe]") {
  Cloud other = body();
  other.colors = other.colors.colwise().reverse().eval();
  for (const char* node : kColored) {
    INFO(node);
    CHECK(change(node, other) > 0.2F);
  }
  for (const char* node : {"describe_point_pairs", "describe_shot"}) {
    INFO(node);
    CHECK(change(node, other) == 0);
  }
}

TEST_CASE("the exposure and a cast change histograms of colour differences little", "[describe]") {
  Cloud dark = body(), cast = body();
  dark.colors *= 0.5F;
  cast.colors.col(2) *= 0.7F;
  Cloud other = body();
  other.colors = other.colors.colwise().reverse().eval();
  const float most = change("describe_color_pairs", other);
  CHECK(change("describe_color_pairs", dark) < 0.4F * most);
  CHECK(change("describe_color_pairs", cast) < 0.4F * most);
}

TEST_CASE("what has no colours, or is white all over, is of one colour", "[describe]") {
  Cloud bare = body(), white = body();
  bare.colors.resize(0, 3);
  white.colors.setOnes();
  for (const char* node : kColored) {
    INFO(node);
    const DescriptorMatrix none = described(node, bare, 11, kParams).descriptors;
    const DescriptorMatrix one = described(node, white, 11, kParams).descriptors;
    REQUIRE(none.rows() > 0);
    CHECK(none.allFinite());
    CHECK((none - one).norm() < 1e-4F * none.norm());
  }
}

}  // namespace posevote::colored_descriptors_test
