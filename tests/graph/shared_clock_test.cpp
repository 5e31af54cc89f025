// SPDX-License-Identifier: BSD-3-Clause
#include "graph/shared_clock.hpp"

#include <catch2/catch.hpp>
#include <thread>

namespace posevote::shared_clock_test {
namespace {

using std::chrono::steady_clock;

void sleep() { std::this_thread::sleep_for(std::chrono::milliseconds(20)); }

double since(steady_clock::time_point start) {
  return std::chrono::duration<double, std::micro>(steady_clock::now() - start).count();
}

}  // namespace

TEST_CASE("who works alone is charged all the time, who idles nothing", "[trace]") {
  graph::detail::SharedClock clock;
  const auto start = steady_clock::now();
  sleep();
  const auto begin = steady_clock::now();
  const double alone = clock.begin();
  sleep();
  const double charged = clock.end(alone);
  CHECK(charged >= 20e3);
  CHECK(charged <= since(begin));
  CHECK(charged < since(start) - 19e3);
}

TEST_CASE("who works at the same time shares it", "[trace]") {
  graph::detail::SharedClock clock;
  const auto start = steady_clock::now();
  const double a = clock.begin();
  sleep();
  const double b = clock.begin();
  sleep();
  const double charged_a = clock.end(a);
  sleep();
  const double charged_b = clock.end(b);
  const double all = since(start);
  CHECK(charged_a >= 30e3);  // all of the first sleep, half of the second
  CHECK(charged_b >= 30e3);
  CHECK(charged_a + charged_b <= all);
  CHECK(charged_a + charged_b >= 60e3);
}

}  // namespace posevote::shared_clock_test
