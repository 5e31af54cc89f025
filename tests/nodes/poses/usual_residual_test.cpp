// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/usual_residual.hpp"

#include <catch2/catch.hpp>
#include <cmath>

namespace posevote::usual_residual_test {

using namespace posevote::poses;

namespace {

poses::Fit fit_of(double systematic, std::size_t supported = 100) {
  poses::Fit fit;
  fit.systematic = systematic;
  fit.supported = supported;
  return fit;
}

}  // namespace

TEST_CASE("exactness is judged by the instances before", "[poses]") {
  poses::UsualResidual usual;
  CHECK(usual.exactness(fit_of(0.1), 1, {1, 0}) == 1);  // there are none
  usual.add(fit_of(0.001), 1);
  CHECK(usual.exactness(fit_of(0.001), 1, {1, 0}) == 1);
  CHECK(usual.exactness(fit_of(0.002), 1, {1, 0}) == Approx(0.5));
  CHECK(usual.exactness(fit_of(0.0015), 1, {1.5, 0}) == 1);
  CHECK(usual.exactness(fit_of(0.003), 1, {1, 0.003}) == Approx(std::sqrt(10.0 / 18)));
  usual.add(fit_of(0.002, 300), 1);  // the mean of squares, by support
  CHECK(usual.exactness(fit_of(0.002), 1, {1, 0}) == Approx(std::sqrt(3.25 / 4)));
}

TEST_CASE("what noise may leave in few points is tolerated", "[poses]") {
  poses::UsualResidual usual;
  usual.add(fit_of(0.001), 1);
  poses::Fit few = fit_of(0.002);
  few.systematic_doubt = 0.002;
  CHECK(usual.exactness(few, 1, {1, 0}) == Approx(std::sqrt(5.0 / 8)));
}

TEST_CASE("what is farther away may be less exact", "[poses]") {
  poses::UsualResidual usual;
  usual.add(fit_of(0.001), 1);
  CHECK(usual.exactness(fit_of(0.004), 2, {1, 0}) == 1);
  CHECK(usual.exactness(fit_of(0.005), 2, {1, 0}) == Approx(0.8));
  CHECK(usual.exactness(fit_of(0.001), 0.5, {1, 0}) ==
        1);  // but what is nearer need not be more so
}

TEST_CASE("instances that leave nothing ask for as much as the least", "[poses]") {
  poses::UsualResidual usual;
  usual.add(fit_of(0), 1);
  CHECK(usual.exactness(fit_of(0), 1, {1, 0.0005}) == 1);
  CHECK(usual.exactness(fit_of(0.0005), 1, {1, 0.0005}) == Approx(std::sqrt(0.5)));
}

}  // namespace posevote::usual_residual_test
