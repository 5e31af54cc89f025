// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/library/library_file.hpp"

#include <signal.h>
#include <sys/resource.h>
#include <xxhash.h>

#include <catch2/catch.hpp>
#include <cstring>
#include <limits>
#include <random>
#include <thread>

#include "nodes/library/library_payload.hpp"
#include "nodes/pairs/pair_table.hpp"
#include "tests/nodes/match/small_library.hpp"
#include "tests/support/temporary_folder.hpp"

namespace posevote::library_file_test {

using namespace posevote::test;
namespace fs = std::filesystem;

namespace {

template <class T>
std::string bytes_of(const T& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

const std::string kKey(32, 'a');

ModelLibrary example(const std::string& search = "exact") {
  return make_library({{0, 10, 11}, {100}, {20, 30}}, {{"search", search}}, {3, 1, 9});
}

/// What save_library would write around that payload.
std::string file_around(const std::string& payload) {
  XXH128_canonical_t hash;
  XXH128_canonicalFromHash(&hash, XXH3_128bits(payload.data(), payload.size()));
  std::string checksum;
  for (const unsigned char byte : hash.digest)
    for (const int digit : {byte >> 4, byte & 15})
      checksum += "0123456789abcdef"[static_cast<std::size_t>(digit)];
  library::ByteWriter out;
  for (const char letter : std::string("POSEVLIB")) out.put(letter);
  out.put(std::uint32_t{15});
  out.put(std::string_view(kKey));
  out.put(std::string_view(checksum));
  out.put(std::string_view(payload));
  return out.take();
}

/// Why the file is not loaded; "" if it is.
std::string refusal(const fs::path& file, const std::string& key = kKey) {
  std::string why_not;
  return library::load_library(file, key, why_not) ? "" : why_not;
}

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

TEST_CASE("a library comes back from its file byte by byte", "[match]") {
  const TemporaryFolder folder;
  const ModelLibrary library = example();
  library::save_library(library, folder / "a", kKey);
  std::string why_not;
  const auto loaded = library::load_library(folder / "a", kKey, why_not);
  REQUIRE(loaded);
  library::save_library(*loaded, folder / "b", kKey);
  CHECK(read_text(folder / "a") == read_text(folder / "b"));
  REQUIRE(loaded->octaves.size() == 1);
  CHECK(loaded->octaves[0].resolution == library.octaves[0].resolution);
  REQUIRE(loaded->models.size() == 3);
  CHECK(loaded->models[2]->name == "m9");
  CHECK(loaded->models[2]->obj_id == 9);
  CHECK(loaded->models[2]->cloud.points == library.models[2]->cloud.points);
  CHECK(loaded->models[2]->cloud.normals == library.models[2]->cloud.normals);
  CHECK(loaded->models[2]->features.normals == library.models[2]->features.normals);
  CHECK(loaded->models[2]->center == library.models[2]->center);
  CHECK(loaded->models[2]->diagonal == library.models[2]->diagonal);
  const Symmetries& symmetries = loaded->models[2]->symmetries;
  CHECK(symmetries.fixed_point == Eigen::Vector3f(0.5F, 0, 9));
  REQUIRE(symmetries.turns.size() == 2);
  CHECK(symmetries.turns[1].coeffs() == Eigen::Vector4f(1, 0, 0, 0));
  CHECK(symmetries.axes == std::vector<Eigen::Vector3f>{{0, 0, 1}});
  CHECK(loaded->models[2]->outline.ends == library.models[2]->outline.ends);
  CHECK(loaded->models[2]->outline.gap_reach == library.models[2]->outline.gap_reach);
  CHECK(loaded->models[2]->outline.gaps == library.models[2]->outline.gaps);
  CHECK(loaded->models[2]->outline.bends == library.models[2]->outline.bends);
  REQUIRE(loaded->models[2]->near_symmetries.items.size() == 1);
  const NearSymmetry& symmetry = loaded->models[2]->near_symmetries.items[0];
  CHECK(symmetry.motion.matrix() == library.models[2]->near_symmetries.items[0].motion.matrix());
  CHECK(symmetry.carried_off == std::vector<std::uint32_t>{0, 2});
  CHECK(symmetry.uncovered == std::vector<std::uint32_t>{1});
  const pairs::PairTable& pairs = *library.models[2]->pairs;
  REQUIRE(loaded->models[2]->pairs);
  CHECK(loaded->models[2]->pairs->step() == pairs.step());
  CHECK(loaded->models[2]->pairs->points().size() == pairs.points().size());
  REQUIRE(loaded->models[2]->rims);
  CHECK(loaded->models[2]->rims->step() == library.models[2]->rims->step());
  CHECK(loaded->models[2]->rims->points().size() == library.models[2]->rims->points().size());
  const DescriptorMatrix queries = features_at({3, 33, 77}).descriptors;
  const auto before = library.octaves[0].index->nearest_two(queries);
  const auto after = loaded->octaves[0].index->nearest_two(queries);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(before[i].row[0] == after[i].row[0]);
    CHECK(before[i].squared[1] == after[i].squared[1]);
  }
}

TEST_CASE("colours come back with a library", "[match][color]") {
  const TemporaryFolder folder;
  ModelLibrary library = example();
  Model painted = *library.models[1];
  painted.cloud.colors = ColorMatrix::Random(painted.cloud.points.rows(), 3).cwiseAbs();
  library.models[1] = std::make_shared<const Model>(painted);
  library::save_library(library, folder / "a", kKey);
  std::string why_not;
  const auto loaded = library::load_library(folder / "a", kKey, why_not);
  REQUIRE(loaded);
  CHECK(loaded->models[0]->cloud.colors.rows() == 0);
  CHECK(loaded->models[1]->cloud.colors == painted.cloud.colors);
}

TEST_CASE("how a library is searched is kept in its file", "[match]") {
  const TemporaryFolder folder;
  library::save_library(
      make_library({{1, 2}}, {{"search", "approximate"}, {"trees", "3"}, {"checks", "99"}}),
      folder / "a", kKey);
  std::string why_not;
  const auto loaded = library::load_library(folder / "a", kKey, why_not);
  REQUIRE(loaded);
  CHECK(loaded->octaves[0].index->options().trees == 3);
  CHECK(loaded->octaves[0].index->options().checks == 99);
  CHECK_FALSE(loaded->octaves[0].index->reproducible());
}

TEST_CASE("any damaged byte and any missing end is noticed", "[match]") {
  const TemporaryFolder folder;
  library::save_library(example(), folder / "a", kKey);
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

TEST_CASE("a file with a right checksum over a wrong payload is refused by name", "[match]") {
  const TemporaryFolder folder;
  ModelLibrary library = example();
  const std::string payload = library::encode_library(library);
  const float infinite = std::numeric_limits<float>::infinity();
  std::string bad = payload;
  const std::size_t place = bad.find(bytes_of(library.models[0]->resolution));
  std::memcpy(&bad.at(place), &infinite, sizeof infinite);
  CHECK(refusal(folder.write("good", file_around(payload))).empty());
  CHECK_THAT(refusal(folder.write("bad", file_around(bad))),
             Catch::Contains("damaged: model 'm1': the resolution is inf m"));
}

TEST_CASE("search options that are out of range are refused, whatever the search", "[match]") {
  for (const std::string search : {"exact", "kd_tree", "approximate"}) {
    const std::string good = library::encode_library(example(search));
    const auto with = [&](std::size_t option, std::int32_t value) {
      std::string bad = good;
      const std::size_t place = sizeof(std::uint64_t) + search.size();
      std::memcpy(&bad[place + option * sizeof value], &value, sizeof value);
      return bad;
    };
    INFO(search);
    for (const std::int32_t trees : {0, -1, 65, std::numeric_limits<std::int32_t>::max()})
      CHECK_THROWS_WITH(library::decode_library(with(0, trees)),
                        Catch::Contains("damaged: trees is"));
    for (const std::int32_t checks : {1, 0, -5})
      CHECK_THROWS_WITH(library::decode_library(with(1, checks)),
                        Catch::Contains("damaged: checks is"));
    CHECK_NOTHROW(library::decode_library(with(0, 64)));
    CHECK_NOTHROW(library::decode_library(with(1, std::numeric_limits<std::int32_t>::max())));
  }
}

TEST_CASE("a library that is not sound is not written", "[match]") {
  ModelLibrary library = example();
  library.octaves.clear();
  CHECK_THROWS_WITH(library::encode_library(library), Catch::Contains("no index"));
  library = example();
  Model flat = *library.models[0];
  flat.resolution = 0;
  library.models[0] = std::make_shared<const Model>(std::move(flat));
  CHECK_THROWS_WITH(library::encode_library(library), Catch::Contains("the resolution is 0"));
}

TEST_CASE("fused features come back with their blocks", "[match]") {
  ModelLibrary library = example();
  for (auto& model : library.models) {
    Model fused = *model;
    auto& descriptors = fused.features.octaves.at(0).descriptors;
    descriptors = std::make_shared<const DescriptorMatrix>(descriptors->replicate(1, 3));
    fused.features.blocks = {1, 2};
    model = std::make_shared<const Model>(std::move(fused));
  }
  library.octaves = descriptors::index_octaves(library.models, {});
  std::string payload = library::encode_library(library);
  CHECK(library::decode_library(payload).models[1]->features.blocks == descriptors::Blocks{1, 2});
  const std::uint32_t three = 3;
  const std::size_t last = payload.rfind(bytes_of(1U) + bytes_of(2U));  // of the last model
  std::memcpy(&payload.at(last + sizeof three), &three, sizeof three);
  CHECK_THROWS_WITH(library::decode_library(payload),
                    Catch::Contains("damaged: the features of 'm1'"));
}

TEST_CASE("a file of another kind, version or key is refused by name", "[match]") {
  const TemporaryFolder folder;
  library::save_library(example(), folder / "a", kKey);
  CHECK_THAT(refusal(folder / "a", std::string(32, 'b')), Catch::Contains("other models"));
  CHECK_THAT(refusal(folder / "none"), Catch::Contains("not a file"));
  CHECK_THAT(refusal(folder.path()), Catch::Contains("not a file"));
  CHECK_THAT(refusal(folder.write("text", "ply\nformat ascii 1.0\n")),
             Catch::Contains("not a model library"));
  CHECK_THAT(refusal(folder.write("empty", "")), Catch::Contains("not a model library"));
  std::string old = read_text(folder / "a");
  old[8] = 77;
  CHECK_THAT(refusal(folder.write("old", old)), Catch::Contains("version 77, expected 15"));
}

TEST_CASE("two threads may write the same file at once", "[match]") {
  const TemporaryFolder folder;
  const ModelLibrary library = example();
  int refused = 0;
  {
    const auto write = [&] {
      for (int i = 0; i < 50; ++i) library::save_library(library, folder / "a", kKey);
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
  CHECK_THROWS_WITH(library::save_library(example(), folder / "no" / "a", kKey),
                    Catch::Contains("no/a"));
  fs::create_directories(folder / "taken" / "x");
  CHECK_THROWS_WITH(library::save_library(example(), folder / "taken", kKey),
                    Catch::Contains("taken"));
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("a full disk leaves nothing behind, and the old file as it was", "[match]") {
  const TemporaryFolder folder;
  library::save_library(example(), folder / "a", kKey);
  const auto old_handler = ::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  REQUIRE(::getrlimit(RLIMIT_FSIZE, &limit) == 0);
  rlimit small = limit;
  small.rlim_cur = 100;
  REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
  std::string what;
  try {
    library::save_library(make_library({{1}}), folder / "a", kKey);
  } catch (const std::runtime_error& error) {
    what = error.what();
  }
  ::setrlimit(RLIMIT_FSIZE, &limit);
  ::signal(SIGXFSZ, old_handler);
  CHECK_THAT(what, Catch::Contains("cannot be written: File too large"));
  CHECK(files_in(folder.path()) == 1);
  CHECK(refusal(folder / "a").empty());
}

}  // namespace posevote::library_file_test
