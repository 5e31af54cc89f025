// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/text_scanner.hpp"

#include "tests/nodes/formats/support.hpp"

namespace posevote::text_scanner_test {

using namespace posevote::formats;
using namespace posevote::test;

namespace {

double number(const std::string& text) {
  formats::TextScanner in(text);
  REQUIRE(in.next_line());
  const double value = in.number();
  CHECK(in.line_done());
  return value;
}

}  // namespace

TEST_CASE("Numbers as programs write them", "[load][text]") {
  CHECK(number("1") == 1);
  CHECK(number(" \t-0.5 \r") == -0.5);
  CHECK(number("+2.5e-3") == 0.0025);
  CHECK(number("1E+02") == 100);
  CHECK(number("5.") == 5);
  CHECK(number(".5") == 0.5);
  for (const char* text : {"nan", "NaN", "-nan", "nan(ind)", "1.#QNAN", "-1.#IND", "+nan"})
    CHECK(std::isnan(number(text)));
  CHECK(number("inf") == HUGE_VAL);
  CHECK(number("-Infinity") == -HUGE_VAL);
  CHECK(number("-1.#INF") == -HUGE_VAL);
  CHECK(number("1e999") == HUGE_VAL);
  CHECK(number("-1e999") == -HUGE_VAL);
  CHECK(number("1e-999") == 0);
}

TEST_CASE("What is no number is an error", "[load][text]") {
  for (const char* text : {"abc", "1.2.3", "1,5", "0x10", "--1", "+-1", "+", "-", "1e", "12abc"})
    CHECK_THAT(error_of([&] { number(text); }), has("line 1: expected a number, found"));
}

TEST_CASE("Lines are counted, blank ones and comments skipped", "[load][text]") {
  formats::TextScanner in("\r\n# one\n a b # c\n\n \nlast", '#');
  REQUIRE(in.next_line());
  CHECK(in.line() == 3);
  CHECK(in.word() == "a");
  CHECK(in.word() == "b");
  CHECK(in.word() == "");
  REQUIRE(in.next_line());
  CHECK(in.line() == 6);
  CHECK(in.word() == "last");
  CHECK_FALSE(in.next_line());
  CHECK(in.line_done());
}

}  // namespace posevote::text_scanner_test
