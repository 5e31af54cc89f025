// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/match/library_file.hpp"

#include <signal.h>
#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <thread>

#include "nodes/match/library_payload.hpp"
#include "tests/nodes/match/small_library.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace posevote;
using namespace posevote::test;
namespace fs = std::filesystem;

namespace {

const std::string kKey(32, 'a');

ModelLibrary example() { return make_library({{0, 10, 11}, {100}, {20, 30}}, {}, {3, 1, 9}); }

/// Why the file is not loaded; "" if it is.
std::string refusal(const fs::path& file, const std::string& key = kKey) {
  std::string why_not;
  return load_library(file, key, why_not) ? "" : why_not;
}

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

TEST_CASE("a library comes back from its file byte by byte", "[match]") {
  const TemporaryFolder folder;
  const ModelLibrary library = example();
  save_library(library, folder / "a", kKey);
  std::string why_not;
  const auto loaded = load_library(folder / "a", kKey, why_not);
  REQUIRE(loaded);
  save_library(*loaded, folder / "b", kKey);
  CHECK(read_text(folder / "a") == read_text(folder / "b"));
  CHECK(loaded->scale.resolution == library.scale.resolution);
  REQUIRE(loaded->models.size() == 3);
  CHECK(loaded->models[2]->name == "m9");
  CHECK(loaded->models[2]->obj_id == 9);
  CHECK(loaded->models[2]->cloud.points == library.models[2]->cloud.points);
  CHECK(loaded->models[2]->cloud.faces == library.models[2]->cloud.faces);
  CHECK(loaded->models[2]->cloud.dropped == 4);
  CHECK(loaded->models[2]->features.normals == library.models[2]->features.normals);
  CHECK(loaded->models[2]->center == library.models[2]->center);
  CHECK(loaded->models[2]->diagonal == library.models[2]->diagonal);
  const DescriptorMatrix queries = features_at({3, 33, 77}).descriptors;
  const auto before = library.index->nearest_two(queries);
  const auto after = loaded->index->nearest_two(queries);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(before[i].row[0] == after[i].row[0]);
    CHECK(before[i].squared[1] == after[i].squared[1]);
  }
}

TEST_CASE("how a library is searched is kept in its file", "[match]") {
  const TemporaryFolder folder;
  save_library(
      make_library({{1, 2}}, {{"search", "approximate"}, {"trees", "3"}, {"checks", "99"}}),
      folder / "a", kKey);
  std::string why_not;
  const auto loaded = load_library(folder / "a", kKey, why_not);
  REQUIRE(loaded);
  CHECK(loaded->index->options().trees == 3);
  CHECK(loaded->index->options().checks == 99);
  CHECK_FALSE(loaded->index->reproducible());
}

TEST_CASE("any damaged byte and any missing end is noticed", "[match]") {
  const TemporaryFolder folder;
  save_library(example(), folder / "a", kKey);
  const std::string good = read_text(folder / "a");
  int loaded = 0;
  for (std::size_t i = 0; i < good.size(); i += i < 120 ? 1 : 17) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ (1 << (i % 8)));
    loaded += refusal(folder.write("bad", bad)).empty();
    loaded += refusal(folder.write("bad", good.substr(0, i))).empty();
  }
  CHECK(loaded == 0);
  CHECK_THAT(refusal(folder.write("bad", good + "x")), Catch::Contains("damaged"));
  CHECK(refusal(folder.write("bad", good)).empty());
}

TEST_CASE("the payload is checked by itself: a checksum proves nothing", "[match]") {
  const std::string good = encode_library(example());
  // A file can hold anything under a right checksum; none of these may crash or allocate wildly.
  for (std::size_t i = 0; i < good.size(); ++i)
    for (const char value : {'\0', '\x7F', '\xFF'}) {
      std::string bad = good;
      bad[i] = value;
      try {
        decode_library(bad);
      } catch (const std::runtime_error&) {
      }
      if (i + 8 > good.size()) continue;
      std::fill_n(bad.begin() + static_cast<std::ptrdiff_t>(i), 8, value);
      try {
        decode_library(bad);
      } catch (const std::runtime_error&) {
      }
    }
  CHECK_THROWS_WITH(decode_library(good + "x"), Catch::Contains("damaged"));
  CHECK_NOTHROW(decode_library(good));
}

TEST_CASE("a file of another kind, version or key is refused by name", "[match]") {
  const TemporaryFolder folder;
  save_library(example(), folder / "a", kKey);
  CHECK_THAT(refusal(folder / "a", std::string(32, 'b')), Catch::Contains("other models"));
  CHECK_THAT(refusal(folder / "none"), Catch::Contains("not a file"));
  CHECK_THAT(refusal(folder.path()), Catch::Contains("not a file"));
  CHECK_THAT(refusal(folder.write("text", "ply\nformat ascii 1.0\n")),
             Catch::Contains("not a model library"));
  CHECK_THAT(refusal(folder.write("empty", "")), Catch::Contains("not a model library"));
  std::string old = read_text(folder / "a");
  old[8] = 77;
  CHECK_THAT(refusal(folder.write("old", old)), Catch::Contains("version 77, expected 1"));
}

TEST_CASE("two threads may write the same file at once", "[match]") {
  const TemporaryFolder folder;
  const ModelLibrary library = example();
  int refused = 0;
  {
    const auto write = [&] {
      for (int i = 0; i < 50; ++i) save_library(library, folder / "a", kKey);
    };
    std::jthread first(write), second(write);
    for (int i = 0; i < 50; ++i) {
      const std::string why = refusal(folder / "a");
      refused += !why.empty() && why != "is not a file";  // not there yet
    }
  }
  CHECK(refused == 0);
  CHECK(refusal(folder / "a").empty());
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("a library that cannot be written is an error that names the file", "[match]") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(save_library(example(), folder / "no" / "a", kKey), Catch::Contains("no/a"));
  fs::create_directories(folder / "taken" / "x");
  CHECK_THROWS_WITH(save_library(example(), folder / "taken", kKey), Catch::Contains("taken"));
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("a full disk leaves nothing behind, and the old file as it was", "[match]") {
  const TemporaryFolder folder;
  save_library(example(), folder / "a", kKey);
  const auto old_handler = ::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  REQUIRE(::getrlimit(RLIMIT_FSIZE, &limit) == 0);
  rlimit small = limit;
  small.rlim_cur = 100;
  REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
  std::string what;
  try {
    save_library(make_library({{1}}), folder / "a", kKey);
  } catch (const std::runtime_error& error) {
    what = error.what();
  }
  ::setrlimit(RLIMIT_FSIZE, &limit);
  ::signal(SIGXFSZ, old_handler);
  CHECK_THAT(what, Catch::Contains("cannot be written: File too large"));
  CHECK(files_in(folder.path()) == 1);
  CHECK(refusal(folder / "a").empty());
}

TEST_CASE("the hash of files depends on every byte, the order and the parameters", "[match]") {
  const TemporaryFolder folder;
  const fs::path a = folder.write("a", "ab"), b = folder.write("b", "c");
  const fs::path c = folder.write("c", "a"), d = folder.write("d", "bc");
  const std::string hash = hash_files({a, b}, "x");
  CHECK(hash.size() == 32);
  CHECK(hash.find_first_not_of("0123456789abcdef") == std::string::npos);
  CHECK(hash == hash_files({a, b}, "x"));
  CHECK(hash != hash_files({b, a}, "x"));
  CHECK(hash != hash_files({a, b}, "y"));
  CHECK(hash != hash_files({c, d}, "x"));
  CHECK(hash != hash_files({a}, "cx"));
  CHECK(hash_files({}, "") != hash_files({}, "x"));
  CHECK_THROWS_WITH(hash_files({folder / "none"}, ""), Catch::Contains("none: cannot be opened"));
  CHECK_THROWS_WITH(hash_files({folder.path()}, ""), Catch::Contains("cannot be opened"));
}

TEST_CASE("the hash of a large file covers all of it", "[match]") {
  const TemporaryFolder folder;
  std::string text(300000, 'x');
  const std::string hash = hash_files({folder.write("a", text)}, "");
  text.back() = 'y';
  CHECK(hash != hash_files({folder.write("a", text)}, ""));
}
