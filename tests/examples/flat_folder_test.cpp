// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>

#include "nodes/formats/write_ply.hpp"
#include "nodes/layouts/ground_truth.hpp"
#include "pipelines/inputs.hpp"
#include "tests/support/temporary_folder.hpp"

namespace posevote::flat_folder_test {

TEST_CASE("a set in a layout of one's own is run and judged as others", "[examples]") {
  const test::TemporaryFolder folder;
  Mesh bar;
  bar.points.resize(3, 3);
  bar.points << 0, 0, 0, 0.1F, 0, 0, 0, 0.2F, 0;
  for (const char* name : {"scans/a.ply", "scans/b.ply", "models/bar.ply"}) {
    std::filesystem::create_directories((folder / name).parent_path());
    formats::write_ply(folder / name, bar, 1000);
  }
  folder.write("poses.txt", "1 1  1 0 0 10  0 1 0 20  0 0 1 900\n");
  CHECK(list_dataset_scenes(folder.path().string(), "test").size() == 2);
  const layouts::GroundTruth truth = layouts::read_ground_truth(folder.path(), "test");
  REQUIRE(truth.instances.size() == 1);
  CHECK(truth.instances[0].im_id == 1);
  CHECK(truth.instances[0].T_scene_model.translation().z() == Approx(0.9));
  CHECK(truth.objects.at(1).diameter == Approx(std::hypot(0.1, 0.2)));
  folder.write("poses.txt", "1 1  1 0 0\n");
  CHECK_THROWS_WITH(layouts::read_ground_truth(folder.path(), "test"),
                    Catch::Contains("poses.txt:1: expected a scan"));
}

}  // namespace posevote::flat_folder_test
