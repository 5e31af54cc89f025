// SPDX-License-Identifier: BSD-3-Clause
#include "graph/activity.hpp"

#include <catch2/catch.hpp>
#include <thread>

#include "tests/graph/number_nodes.hpp"

namespace posevote::activity_test {

using namespace posevote::test;
using posevote::graph::Activity;

TEST_CASE("the call that has been running longest, with its objects", "[activity]") {
  Activity activity;
  CHECK_FALSE(activity.longest());
  {
    Activity::Call first(&activity, "describe", "rs1");
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    {
      Activity::Call second(&activity, "match", "rs2");
      CHECK(activity.longest()->node == "describe");
    }
    first.begin_objects(7);
    first.end_object();
    first.end_object();
    const Activity::Work work = *activity.longest();
    CHECK(work.frame == "rs1");
    CHECK(work.seconds >= 0.02);
    CHECK(work.done == 2);
    CHECK(work.objects == 7);
  }
  CHECK_FALSE(activity.longest());
  Activity::Call nowhere(nullptr, "describe", "rs1");
  nowhere.begin_objects(1);
  nowhere.end_object();
}

namespace {

std::atomic<bool> had_enough = false;
std::atomic<int> begun = 0;

struct Patience {
  int calls = 1;
};

/// Has enough after so many calls.
Number lose_patience(const Number& in, const Patience& patience) {
  if (++begun == patience.calls) had_enough = true;
  return in;
}

const auto registered = graph::register_node("lose_patience", lose_patience, "Has enough.")
                            .input("in")
                            .output("out")
                            .param("calls", &Patience::calls, "", "After.", graph::at_least(1));

/// How often lose_patience was called in a run that it cancels.
int calls_until_cancelled(const NumberPipeline& plan, int threads) {
  had_enough = false;
  begun = 0;
  Activity activity(&had_enough);
  graph::RunOptions options;
  options.activity = &activity;
  with_threads(threads, [&] {
    CHECK_THROWS_AS(run_numbers(plan, 1000, options, [](const auto&) {}), graph::Cancelled);
  });
  CHECK_FALSE(activity.longest());
  return begun;
}

}  // namespace

TEST_CASE("of a run that is cancelled no node begins any more", "[activity]") {
  const NumberPipeline plan = plan_of(kHead +
                                      "  wait_a_little: {in: n, out: a}\n"
                                      "  lose_patience: {in: a, out: b, calls: 5}\n"
                                      "  multiply: {in: b, out: r}\n");
  CHECK(calls_until_cancelled(plan, 1) == 5);
  CHECK(calls_until_cancelled(plan, 4) <= 8);  // those that had begun
}

TEST_CASE("nor does a node that runs once for each object with another one", "[activity]") {
  const NumberPipeline plan = plan_of(kHead +
                                      "  split: {in: n, out: objects}\n"
                                      "  lose_patience: {in: objects, out: same, calls: 2}\n"
                                      "  sum: {in: same, out: r}\n");
  CHECK(calls_until_cancelled(plan, 1) == 2);  // of three objects
}

TEST_CASE("what is made of constants can be cancelled, too", "[activity]") {
  const NumberPipeline plan = plan_of(kHead +
                                          "  lose_patience: {in: c, out: d, calls: 1}\n"
                                          "  multiply: {in: d, out: e}\n"
                                          "  add: {in: [n, e], out: r}\n",
                                      {{"c", graph::StreamTraits<Number>::type()}});
  had_enough = false;
  begun = 0;
  Activity activity(&had_enough);
  CHECK_THROWS_AS(graph::fold_constants(plan, {{"c", number(4)}}, &activity), graph::Cancelled);
}

}  // namespace posevote::activity_test
