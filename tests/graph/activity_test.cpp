// SPDX-License-Identifier: BSD-3-Clause
#include "graph/activity.hpp"

#include <catch2/catch.hpp>
#include <thread>

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
