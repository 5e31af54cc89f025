// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/facing_points.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <vector>

#include "nodes/geometry/strewn.hpp"
#include "tests/support/instruction_set.hpp"

namespace posevote::facing_points_test {
namespace {

/// Points all over a cube that look everywhere, some of them nowhere.
Cloud strewn_cloud(Eigen::Index count) {
  Cloud cloud;
  std::srand(7);
  cloud.points = PointMatrix::Random(count, 3);
  cloud.normals = PointMatrix::Random(count, 3);
  cloud.normals.rowwise().normalize();
  for (Eigen::Index i = 5; i < count; i += 17) cloud.normals.row(i).setZero();
  for (Eigen::Index i = 6; i < count; i += 17)
    cloud.normals(i, 1) = std::numeric_limits<float>::quiet_NaN();
  return cloud;
}

struct Faced {
  std::size_t k;
  geometry::OrientedPoint point;
  float cosine;
};

std::vector<Faced> one_by_one(const Cloud& model, const geometry::Strewn& rows, std::size_t begin,
                              const Eigen::Isometry3f& T, const geometry::ScanSurface& scan) {
  std::vector<Faced> all;
  for (std::size_t k = begin; k < rows.size(); ++k) {
    const geometry::OrientedPoint p = geometry::posed_point(model, rows[k], T);
    if (const float cosine = scan.facing_cosine(p); cosine > 0) all.push_back({k, p, cosine});
  }
  return all;
}

}  // namespace

TEST_CASE("what faces the sensor is told many at a time as one by one", "[prepare]") {
  const test::OnInstructionSet there(GENERATE(from_range(test::instruction_sets())));
  if (!there) return;
  const bool single_view = GENERATE(true, false);
  Cloud seen = strewn_cloud(20);
  seen.view.origin = {0.1F, -0.2F, -3};
  const geometry::ScanSurface scan(seen, single_view, 0.1F);
  const Cloud model = strewn_cloud(1000);
  const Eigen::Isometry3f T = Eigen::Translation3f(0.3F, -0.1F, 0.7F) *
                              Eigen::AngleAxisf(0.8F, Eigen::Vector3f(1, 2, 3) / std::sqrt(14.0F));
  const geometry::Strewn rows(model.points.rows(), GENERATE(0, 333, 40));
  const std::size_t begin = rows.size() > 100 ? 70 : 0;
  const std::vector<Faced> expected = one_by_one(model, rows, begin, T, scan);
  std::vector<Faced> got;
  geometry::for_each_facing(model, rows, begin, rows.size(), T, scan,
                            [&](std::size_t k, const geometry::OrientedPoint& p, float cosine) {
                              got.push_back({k, p, cosine});
                            });
  REQUIRE(got.size() == expected.size());
  CHECK(5 * got.size() >= rows.size() - begin);
  for (std::size_t i = 0; i < got.size(); ++i) {
    CHECK(got[i].k == expected[i].k);
    CHECK(got[i].point.point == expected[i].point.point);
    CHECK(got[i].point.normal == expected[i].point.normal);
    CHECK(got[i].cosine == expected[i].cosine);
  }
}

}  // namespace posevote::facing_points_test
