// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/company.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "nodes/poses/confidence.hpp"

namespace posevote::company_test {
namespace {

using poses::Companion;
using Companions = std::vector<Companion>;

/// Of so many objects, each there once.
Companions one_of_each(int objects, double confidence) {
  Companions all;
  for (int i = 1; i <= objects; ++i) all.push_back({i, confidence});
  return all;
}

}  // namespace

TEST_CASE("who is alone gets nothing from others", "[poses]") {
  CHECK(poses::log_odds_in_company({}, 1).empty());
  CHECK(poses::log_odds_in_company({{1, 0.7}}, 1).at(0) == Approx(0).margin(1e-12));
  CHECK(poses::log_odds_in_company({{1, 0.7}}, 8).at(0) == Approx(0).margin(1e-12));
}

TEST_CASE("a repeat is doubted the more, the more other things are there once", "[poses]") {
  const auto doubted = [](int objects) {
    Companions all = one_of_each(objects, 0.999);
    all.push_back({1, 0.8});
    return poses::log_odds_in_company(all, 8).back();
  };
  // Before one looks both are as likely: the one that says that it is false says so of 0.2.
  const double may_repeat = 1 / (1 + 0.2);
  CHECK(doubted(1) ==
        Approx(poses::log_odds_of(0.8 * may_repeat) - poses::log_odds_of(0.8)).margin(0.01));
  CHECK(doubted(3) < doubted(1));
  CHECK(doubted(6) < doubted(3));
  CHECK(poses::probability_of(poses::log_odds_of(0.8) + doubted(6)) < 0.3);
}

TEST_CASE("where one thing surely is there twice, others may be", "[poses]") {
  Companions all = one_of_each(6, 0.999);
  all.push_back({1, 0.8});
  all.push_back({2, 0.9999});
  CHECK(poses::log_odds_in_company(all, 8).at(6) > -0.1);
  const Companions bin(12, {1, 0.9});
  for (const double log_odds : poses::log_odds_in_company(bin, 1))
    CHECK(log_odds == Approx(0).margin(1e-6));
}

TEST_CASE("what completes the things that are looked for is believed more", "[poses]") {
  Companions all = one_of_each(7, 0.999);
  all.back().confidence = 0.4;
  CHECK(poses::log_odds_in_company(all, 8).at(6) == Approx(std::log(7.0 / 2)).margin(0.02));
  CHECK(poses::log_odds_in_company(all, 7).at(6) == Approx(std::log(7.0)).margin(0.02));
  // Few of many there: that speaks against none of them.
  CHECK(poses::log_odds_in_company(all, 100).at(6) == 0);
}

TEST_CASE("the order of instances makes no difference", "[poses]") {
  const Companions all{{3, 0.9}, {1, 0.8}, {3, 0.6}, {2, 0.3}, {1, 0.85}};
  const Companions turned(all.rbegin(), all.rend());
  const std::vector<double> one = poses::log_odds_in_company(all, 4),
                            other = poses::log_odds_in_company(turned, 4);
  for (std::size_t i = 0; i < all.size(); ++i)
    CHECK(one[i] == Approx(other[all.size() - 1 - i]).margin(1e-12));
  CHECK(one[1] < 0);  // the less probable of two is the repeat
  CHECK(one[4] == 0);
}

}  // namespace posevote::company_test
