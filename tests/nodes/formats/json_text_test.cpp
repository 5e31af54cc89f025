// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/json_text.hpp"

#include <catch2/catch.hpp>

#include "nodes/formats/results_writer.hpp"
#include "nodes/layouts/files.hpp"
#include "tests/support/temporary_folder.hpp"

namespace posevote::json_text_test {

using Catch::Contains;
using nlohmann::json;

namespace {

std::string nested(std::size_t depth) {
  std::string text;
  for (std::size_t i = 0; i < depth; ++i) text += "{\"a\":";
  return text + "1" + std::string(depth, '}');
}

}  // namespace

TEST_CASE("JSON of any depth is read or refused, and does not overflow the stack", "[json]") {
  const auto whole = formats::parse_json<json>(R"({"a": [1, {"b": null}], "c": "d"})");
  CHECK(whole == json::parse(R"({"a": [1, {"b": null}], "c": "d"})"));
  CHECK(formats::parse_json<json>(nested(60)) == json::parse(nested(60)));
  CHECK_THROWS_WITH(formats::parse_json<json>(nested(100000)), "is nested deeper than 64");
  CHECK_THROWS_WITH(formats::parse_json<json>(std::string(100000, '[')),
                    Contains("deeper than 64"));
  CHECK_THROWS_WITH(formats::parse_json<json>("{\n \"a\": ]}"),
                    Contains("is no JSON: parse error at line 2, column 7"));
}

TEST_CASE("what is wrong is said in a line of bounded length, whatever was read last", "[json]") {
  std::string accents = "{\"";
  for (int i = 0; i < 1000; ++i) accents += "\u00e9";
  for (const std::string& text : {std::string(100000, '\n') + "~", accents, "x" + accents}) {
    std::string said;
    try {
      (void)formats::parse_json<json>(text);
    } catch (const std::runtime_error& error) {
      said = error.what();
    }
    CHECK_THAT(said, Contains("is no JSON: parse error at line "));
    CHECK(said.size() < 500);
    CHECK_NOTHROW(json(said).dump());  // no character is cut
  }
}

TEST_CASE("a value in a message is of bounded length, whatever bytes it holds", "[json]") {
  CHECK(formats::shown(7) == "7");
  CHECK(formats::shown("seven") == "\"seven\"");
  CHECK(formats::shown("\xff").size() == 5);  // what is no UTF-8 is replaced
  const std::string said = formats::shown(std::string(100000, '\x16'));
  CHECK(said.size() < 500);
  CHECK_NOTHROW(json(said).dump());
}

TEST_CASE("files that are nested too deep are named, and results that are count as torn",
          "[json]") {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("scene_gt.json", nested(100000));
  CHECK_THROWS_WITH(layouts::read_json(file), file + ": is nested deeper than 64");
  const std::string line = "{\"frame\": 1, \"im_id\": " + nested(100000) + "}";
  const std::string results = folder.write("results.json", "{\n" + line + "\n");
  const formats::WrittenFrames frames = formats::read_frames(results, "im_id");
  CHECK(frames.items.empty());
  CHECK(frames.torn == 1);
}

TEST_CASE("what the JSON library says comes without its number", "[json]") {
  try {
    (void)json::parse("[1]").at("a");
    FAIL("accepted");
  } catch (const json::exception& error) {
    CHECK_THAT(error.what(), Contains("[json.exception"));
    CHECK_THAT(formats::reason_of(error), !Contains("json.exception") && Contains("cannot use at"));
  }
}

}  // namespace posevote::json_text_test
