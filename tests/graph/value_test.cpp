// SPDX-License-Identifier: BSD-3-Clause
#include "graph/value.hpp"

#include <catch2/catch.hpp>

#include "tests/graph/number_nodes.hpp"
#include "tests/support/run_node.hpp"

namespace posevote::value_test {

using test::Number;
using Pointer = std::shared_ptr<const Number>;

namespace {

struct Limit {
  int most = 9;
  bool lose = false;
};

Pointer check_number(const Pointer& in, const Limit& limit) {
  if (in->value > limit.most) throw std::runtime_error(std::to_string(in->value) + " is too much");
  return limit.lose ? nullptr : in;
}

const auto registered = graph::register_node("check_number", check_number, "Passes a number on.")
                            .input("in")
                            .output("out")
                            .param("most", &Limit::most, "", "More is refused.")
                            .param("lose", &Limit::lose, "", "Returns nothing.");

}  // namespace

TEST_CASE("a node that takes and returns the pointer passes on the very value", "[value]") {
  const auto in = std::make_shared<const Number>(Number{7});
  CHECK(test::run_node<Pointer>("check_number", {}, in) == in);
  CHECK_THROWS_WITH(test::run_node<Pointer>("check_number", {{"most", "6"}}, in), "7 is too much");
}

TEST_CASE("a pointer's stream is of the type that it points to", "[value]") {
  const graph::NodeSpec* spec = graph::find_node("check_number");
  CHECK(spec->inputs.at(0).type == graph::StreamTraits<Number>::type());
  CHECK(spec->inputs.at(0).type.name == graph::StreamTraits<Number>::type().name);
  CHECK(test::run_node<Number>("check_number", {}, Number{5}).value == 5);
}

TEST_CASE("a node may not return a null pointer", "[value]") {
  CHECK_THROWS_WITH(
      test::run_node<Pointer>("check_number", {{"lose", "true"}}, Number{5}),
      Catch::Matchers::StartsWith("it returned no ") && Catch::Matchers::EndsWith("Number"));
}

}  // namespace posevote::value_test
