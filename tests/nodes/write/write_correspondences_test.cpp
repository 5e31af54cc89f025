// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>

#include "nodes/data/features.hpp"
#include "tests/nodes/write/writer.hpp"
#include "tests/support/temporary_folder.hpp"

namespace posevote::write_correspondences_test {

using posevote::test::run_writer;
using posevote::test::TemporaryFolder;

namespace {

FeatureSet make_features(float z) {
  FeatureSet features;
  features.points.resize(2, 3);
  features.points << 0.25F, 0.5F, z, 1, 2, z;
  features.normals.resize(2, 3);
  features.normals << 0, 0, -1, 0, 1, 0;
  return features;
}

void write(const TemporaryFolder& folder, const std::string& every) {
  auto model = std::make_shared<Model>();
  model->obj_id = 7;
  model->features = make_features(0);
  PerObject<Correspondences> objects;
  objects.slots = {std::make_shared<Correspondences>(
      Correspondences{model, {1, 0}, {0, 1}, {0.5F, 0.25F}, {0.125F, 1}})};
  run_writer("write_correspondences", every, {0, "shelf", folder.path(), 0}, std::move(objects),
             make_features(3));
}

}  // namespace

TEST_CASE("write_correspondences: both ends of every correspondence", "[write]") {
  const TemporaryFolder folder;
  write(folder, "1");
  const std::string text = test::read_text(folder / "correspondences/shelf.csv");
  CHECK(text.substr(text.find('\n') + 1) ==
        "7,0.5,0.125,1,2,3,0,1,0,0.25,0.5,0,0,0,-1\n"
        "7,0.25,1,0.25,0.5,3,0,0,-1,1,2,0,0,1,0\n");
}

TEST_CASE("write_correspondences writes nothing where it is off, and says why it cannot",
          "[write]") {
  const TemporaryFolder folder;
  write(folder, "0");
  CHECK(!std::filesystem::exists(folder / "correspondences"));
  folder.write("correspondences", "a file where the folder should be");
  CHECK_THROWS_WITH(write(folder, "1"), Catch::Contains("correspondences"));
}

}  // namespace posevote::write_correspondences_test
