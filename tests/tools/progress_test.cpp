// SPDX-License-Identifier: BSD-3-Clause
#include "tools/progress/progress.hpp"

#include <catch2/catch.hpp>

#include "tools/progress/console.hpp"
#include "tools/text.hpp"

namespace posevote::progress_test {

TEST_CASE("how far a task is, how fast it goes and what is left", "[progress]") {
  const Task frames{"frames", 200};
  CHECK(to_text(frames, {0, 1.2}) == "[0/200] frames, 1 s");
  CHECK(to_text(frames, {12, 4}) == "[12/200] 3 frames/s, 1 min 03 s left");
  CHECK(to_text(frames, {12, 300, "31 found, 1 failed"}) ==
        "[12/200] 0.04 frames/s, 1 h 18 min left, 31 found, 1 failed");
  CHECK(to_text(frames, {100, 60, "", {}, 10}) == "[100/200] 2 frames/s, 40 s left");
  CHECK(to_text(frames, {199, 300, "", {}, 100}) == "[199/200] 0.99 frames/s, 0 s left");
  CHECK(to_text(frames, {200, 4}) == "[200/200] 50 frames/s");
  const Task training{"training 4 models"};
  CHECK(to_text(training, {0, 12.4}) == "training 4 models, 12 s");
}

TEST_CASE("what takes long is named, and an interrupt", "[progress]") {
  Task task{"training 4 models"};
  CHECK(to_text(task, {0, 9, "", graph::Activity::Work{"describe", "", 1.9, 0, 0}}) ==
        "training 4 models, 9 s");
  CHECK(to_text(task, {0, 9, "", graph::Activity::Work{"describe", "", 3, 1, 8}}) ==
        "training 4 models, 9 s; describe for 3 s, 1 of 8 objects");
  CHECK(to_text({"frames", 9}, {0, 9, "", graph::Activity::Work{"match", "rs1", 7, 0, 0}}) ==
        "[0/9] frames, 9 s; match at rs1 for 7 s");
  const std::atomic<bool> interrupted = true;
  task = {"frames", 9};
  task.interrupted = &interrupted;
  CHECK(to_text(task, {2, 9}) == "[2/9] ending what is begun; Ctrl-C again ends at once");
}

TEST_CASE("text for a terminal and for a shell", "[text]") {
  CHECK(printable("rs1 \u00e9\u4e2d.ply") == "rs1 \u00e9\u4e2d.ply");
  CHECK(printable("a\x1b[31m\r\nb\x7f\t") == "a\\x1b[31m\\x0d\\x0ab\\x7f\\x09");
  CHECK(printable("a\xc2\x9b"
                  "31m") == "a\\x9b31m");  // CSI in one character
  CHECK(printable("a\x9b\xff") == "a\ufffd\ufffd");
  CHECK(quote_for_shell("out/a-1.ply") == "out/a-1.ply");
  CHECK(quote_for_shell("it's $HOME") == "'it'\\''s $HOME'");
  CHECK(quote_for_shell("") == "''");
  CHECK(duration_text(59.4) == "59 s");
  CHECK(duration_text(280) == "4 min 40 s");
  CHECK(duration_text(7500) == "2 h 05 min");
  CHECK(console::cut_to_width("abcdef", 4) == "abcd");
  CHECK(console::cut_to_width("\u4e2d\u4e2d\u4e2d", 5) == "\u4e2d\u4e2d");
  CHECK(console::cut_to_width("", 5).empty());
}

}  // namespace posevote::progress_test
