// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pairs/pair_votes.hpp"

#include <catch2/catch.hpp>

#include "tests/support/bumpy_scene.hpp"

namespace posevote::pair_votes_test {

using namespace posevote::test;

namespace {

std::vector<pairs::PairPeak> peaks_at(const pairs::LocalFrame& at, const pairs::PairTable& table,
                                      const pairs::PairScene& scene,
                                      const pairs::PeakOptions& options) {
  pairs::PairVotes votes;
  votes.go_to(at, scene, table.reach());
  return votes.peaks(table, options);
}

}  // namespace

TEST_CASE("a turn is told from u to v", "[pairs]") {
  const pairs::LocalFrame frame({1, 2, 3}, Eigen::Vector3f(1, 2, -1).normalized());
  CHECK((frame.u.cross(frame.v) - frame.normal).norm() < 1e-6F);
  CHECK(frame.axes().determinant() == Approx(1));
  for (int turn = 0; turn < 256; ++turn) {
    const float angle = (static_cast<float>(turn) + 0.5F) * static_cast<float>(M_PI) / 128;
    const Eigen::Vector3f offset =
        0.03F * (std::cos(angle) * frame.u + std::sin(angle) * frame.v) - 0.01F * frame.normal;
    CHECK(int{frame.turn_to(offset)} == turn);
  }
}

TEST_CASE("the best of a point's poses are told in descending order", "[pairs]") {
  const auto model = bumpy_model(1);
  const float step = 0.1F * model->diagonal;
  const pairs::PairTable table(model->cloud, step, model->diagonal);
  const pairs::PairScene scene(model->cloud, step);
  int right = 0;
  for (std::size_t i = 0; i < table.points().size(); ++i) {
    const auto peaks = peaks_at(table.points()[i], table, scene, {4, 0.5});
    REQUIRE(!peaks.empty());
    CHECK(peaks.size() <= 4);
    for (std::size_t k = 1; k < peaks.size(); ++k) {
      CHECK(peaks[k].pairs <= peaks[k - 1].pairs);
      CHECK(2 * peaks[k].pairs >= peaks[0].pairs);
    }
    const float turn = std::remainder(peaks[0].turn, static_cast<float>(2 * M_PI));
    right += peaks[0].point == i && std::abs(turn) < 0.2F ? 1 : 0;
  }
  CHECK(right > 0.9 * static_cast<double>(table.points().size()));  // the model itself, unmoved
}

TEST_CASE("what was counted before does not count again", "[pairs]") {
  const auto model = bumpy_model(1);
  const float step = 0.1F * model->diagonal;
  const pairs::PairTable fine(model->cloud, step, model->diagonal);
  const pairs::PairTable coarse(model->cloud, 2 * step, model->diagonal);
  const pairs::PairScene scene(model->cloud, step);
  const auto same = [](const auto& a, const auto& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
      return x.point == y.point && x.turn == y.turn && x.pairs == y.pairs;
    });
  };
  pairs::PairVotes used;
  for (const std::size_t i : {5U, 9U, 13U}) {
    used.go_to(fine.points()[i], scene, 1.5F * fine.reach());  // farther than either asks for
    for (const pairs::PairTable* table : {&fine, &coarse, &fine})
      CHECK(same(used.peaks(*table, {9, 0}), peaks_at(fine.points()[i], *table, scene, {9, 0})));
  }
}

TEST_CASE("a point with nothing around it has no pose", "[pairs]") {
  const auto model = bumpy_model(1);
  const pairs::PairTable table(model->cloud, 0.1F * model->diagonal, model->diagonal);
  const pairs::PairScene scene(model->cloud, 0.1F * model->diagonal);
  CHECK(peaks_at({{9, 9, 9}, {0, 0, 1}}, table, scene, {3, 0}).empty());
}

TEST_CASE("pairs of like colours count several times, and others still count", "[pairs]") {
  const auto model = bumpy_model(1);
  const float step = 0.1F * model->diagonal;
  const auto painted = [&](const Eigen::RowVector3f& low, const Eigen::RowVector3f& high) {
    Cloud cloud = model->cloud;
    const float middle = cloud.points.col(0).mean();
    cloud.colors.resize(cloud.points.rows(), 3);
    for (Eigen::Index i = 0; i < cloud.points.rows(); ++i)
      cloud.colors.row(i) = cloud.points(i, 0) < middle ? low : high;
    return cloud;
  };
  const Eigen::RowVector3f red(0.5F, 0.05F, 0.05F), blue(0.05F, 0.1F, 0.6F);
  const Cloud right = painted(red, blue), wrong = painted(blue, red);
  const pairs::PairTable plain(model->cloud, step, model->diagonal);
  const pairs::PairTable table(right, step, model->diagonal);
  REQUIRE(table.has_colors());
  CHECK(!plain.has_colors());
  const auto best = [&](const pairs::PairTable& of, const Cloud& scan, std::size_t i) {
    const pairs::PairScene scene(scan, step);
    const auto peaks = peaks_at(of.points()[i], of, scene, {1, 0, pairs::Turn::kOpen, 4});
    return peaks.empty() ? 0U : peaks[0].pairs;
  };
  for (std::size_t i = 0; i < table.points().size(); i += 7) {
    const std::uint32_t shape = best(plain, model->cloud, i);
    CHECK(best(table, right, i) > 3 * shape);
    CHECK(best(table, wrong, i) < best(table, right, i));
    CHECK(best(table, wrong, i) >= shape);
    CHECK(best(table, model->cloud, i) == shape);  // a scan without colours
    CHECK(best(plain, right, i) == shape);         // a model without
  }
}

}  // namespace posevote::pair_votes_test
