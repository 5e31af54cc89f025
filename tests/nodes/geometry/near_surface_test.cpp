// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/near_surface.hpp"

#include <catch2/catch.hpp>

#include "tests/support/shapes.hpp"

namespace posevote::near_surface_test {
namespace {

/// Points in a ball of half a metre, with normals that have nothing to do with their places.
Cloud strewn(Eigen::Index count) {
  Cloud cloud;
  cloud.points = test::shaken(PointMatrix::Zero(count, 3), 0.5F);
  cloud.normals = cloud.points.colwise().reverse().rowwise().normalized();
  return cloud;
}

}  // namespace

TEST_CASE("whether a surface is near does not hang on where it was asked for before", "[segment]") {
  const Cloud cloud = strewn(500), ends = strewn(200);
  const geometry::SurfaceIndex index(cloud.points, 0.1F);
  const float radius = GENERATE(0.03F, 0.12F);
  const auto agrees = [](float cosine) { return cosine > 0.3F; };
  geometry::NearSurface asked(cloud, index);
  int near = 0;
  constexpr Eigen::Index kSteps = 10;  // from one end to the next
  for (Eigen::Index k = 0; k < kSteps * (ends.points.rows() - 1); ++k) {
    const float share = static_cast<float>(k % kSteps) / kSteps;
    const auto between = [&](const PointMatrix& rows) -> Eigen::Vector3f {
      return (1 - share) * rows.row(k / kSteps) + share * rows.row(k / kSteps + 1);
    };
    const Eigen::Vector3f place = between(ends.points), normal = between(ends.normals);
    bool expected = false;
    for (Eigen::Index i = 0; i < cloud.points.rows(); ++i)
      expected |= (cloud.points.row(i).transpose() - place).norm() <= radius &&
                  agrees(cloud.normals.row(i).dot(normal));
    REQUIRE(asked.is_near(place, normal, radius, agrees) == expected);
    near += expected ? 1 : 0;
  }
  CHECK(near > 20);
  CHECK(near < 1980);
}

}  // namespace posevote::near_surface_test
