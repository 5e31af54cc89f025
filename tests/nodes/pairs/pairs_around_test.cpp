// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pairs/pairs_around.hpp"

#include <catch2/catch.hpp>
#include <vector>

#include "nodes/pairs/pair_key.hpp"
#include "nodes/pairs/pair_votes.hpp"
#include "tests/support/instruction_set.hpp"
#include "tests/support/shapes.hpp"

namespace posevote::pairs_around_test {
namespace {

Cloud strewn(Eigen::Index count) {
  Cloud cloud;
  cloud.points = test::shaken(PointMatrix::Zero(count, 3), 0.1F);
  cloud.points.bottomRows(count / 2).col(2).setZero();  // in a plane
  cloud.normals = cloud.points.colwise().reverse().rowwise().normalized();
  cloud.normals.bottomRows(count / 2).rowwise() = Eigen::RowVector3f::UnitZ();
  return cloud;
}

struct Found {
  std::vector<float> length;
  std::vector<std::int32_t> from, to, between, turn, position;

  Found(const Cloud& cloud, const pairs::LocalFrame& at, float reach, bool keeps_all) {
    const pairs::PairScene scene = pairs::PairScene::of_thin(cloud, 0.01F);
    std::vector<geometry::GridRun> runs;
    scene.find_runs(at.point, reach, runs);
    const auto room = static_cast<std::size_t>(cloud.points.rows()) + geometry::kGridPadding;
    length.resize(room);
    for (auto* column : {&from, &to, &between, &turn, &position}) column->resize(room);
    const std::size_t count = pairs::find_pairs(
        scene.columns(), runs.data(), runs.size(), pairs::start_at(at, reach, keeps_all),
        {length.data(), from.data(), to.data(), between.data(), turn.data(), position.data()});
    length.resize(count);
    for (auto* column : {&from, &to, &between, &turn, &position}) column->resize(count);
  }
};

}  // namespace

TEST_CASE("pairs that are found many at once are those of one at a time, to the bit", "[pairs]") {
  const test::OnInstructionSet there(GENERATE(from_range(test::instruction_sets())));
  if (!there) return;
  const Cloud cloud = strewn(600);
  const geometry::PointGrid grid(cloud.points, 0.04F);  // as the scene's
  const float reach = 0.07F;
  std::size_t told = 0, flat = 0;
  for (Eigen::Index row = 0; row < cloud.points.rows(); row += 7) {
    const pairs::LocalFrame at(cloud.points.row(row).transpose(),
                               cloud.normals.row(row).transpose());
    const Found all(cloud, at, reach, true), some(cloud, at, reach, false);
    std::size_t k = 0, of_some = 0;
    grid.for_each_within(at.point, reach, [&](std::uint32_t i, float) {
      const Eigen::Vector3f offset = cloud.points.row(i).transpose() - at.point;
      const float length = offset.norm();
      REQUIRE(k < all.length.size());
      CHECK(all.length[k] == length);
      CHECK(grid.indices()[static_cast<std::size_t>(all.position[k])] == i);
      const std::uint16_t angles =
          length > 0
              ? pairs::angle_bins(at.normal, cloud.normals.row(i).transpose(), offset, length)
              : pairs::kNoAngles;
      CHECK((all.from[k] < 0) == (angles == pairs::kNoAngles));
      if (angles == pairs::kNoAngles) {
        ++k, ++flat;
        return;
      }
      CHECK(pairs::angle_bins(all.from[k], all.to[k], all.between[k]) == angles);
      CHECK(static_cast<std::uint8_t>(all.turn[k]) == at.turn_to(offset));
      REQUIRE(of_some < some.length.size());
      CHECK(some.position[of_some] == all.position[k]);
      ++k, ++of_some, ++told;
    });
    CHECK(k == all.length.size());
    CHECK(of_some == some.length.size());
  }
  CHECK(told > 1000);
  CHECK(flat > 1000);
}

}  // namespace posevote::pairs_around_test
