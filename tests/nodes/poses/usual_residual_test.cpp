// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/usual_residual.hpp"

#include <catch2/catch.hpp>

using namespace posevote;
using namespace posevote::poses;

namespace {

poses::Fit fit_of(double rmse, std::size_t supported = 100) {
  poses::Fit fit;
  fit.rmse = rmse;
  fit.supported = supported;
  return fit;
}

}  // namespace

TEST_CASE("exactness is judged by the instances before", "[poses]") {
  poses::UsualResidual usual;
  CHECK(usual.exactness(fit_of(0.1), 1, {1.5, 0}) == 1);  // there are none
  usual.add(fit_of(0.001), 1);
  CHECK(usual.exactness(fit_of(0.0015), 1, {1.5, 0}) == 1);
  CHECK(usual.exactness(fit_of(0.0018), 1, {1.5, 0}) == Approx(0.694).margin(0.001));
  CHECK(usual.exactness(fit_of(0.1), 1, {1.5, 0}) == 0.6);  // not less: the model may be a poor one
  CHECK(usual.exactness(fit_of(0.003), 1, {1.5, 0.003}) == 1);
  usual.add(fit_of(0.002, 300), 1);  // the mean of squares, by support
  CHECK(usual.exactness(fit_of(0.002), 1, {1, 0}) == Approx(3.25 / 4));
}

TEST_CASE("what is farther away may be less exact", "[poses]") {
  poses::UsualResidual usual;
  usual.add(fit_of(0.001), 1);
  CHECK(usual.exactness(fit_of(0.004), 2, {1, 0}) == 1);
  CHECK(usual.exactness(fit_of(0.005), 2, {1, 0}) == Approx(0.64));
  CHECK(usual.exactness(fit_of(0.001), 0.5, {1, 0}) ==
        1);  // but what is nearer need not be more so
}

TEST_CASE("instances that leave nothing ask for as much as the least", "[poses]") {
  poses::UsualResidual usual;
  usual.add(fit_of(0), 1);
  CHECK(usual.exactness(fit_of(0.0005), 1, {1.5, 0.0005}) == 1);
  CHECK(usual.exactness(fit_of(0.0006), 1, {1.5, 0.0005}) == Approx(25.0 / 36));
}
