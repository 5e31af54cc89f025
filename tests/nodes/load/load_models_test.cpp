// SPDX-License-Identifier: BSD-3-Clause
#include <mutex>

#include "nodes/data/files.hpp"
#include "tests/nodes/formats/support.hpp"
#include "tests/support/run_node.hpp"

namespace posevote::load_models_test {

using namespace posevote::test;

TEST_CASE("load_models: one cloud a file, in order", "[load]") {
  const TempDir dir;
  ModelFiles files;
  for (int i = 0; i < 20; ++i) {
    const std::string name = "model" + std::to_string(i);
    files.push_back(
        {dir.write(name + ".obj", "v " + std::to_string(i) + " 0 0\nv 0 1 0\n"), i + 1, name});
  }
  const auto models = run_node<PerObject<Mesh>>("load_models", {{"unit", "mm"}}, files);
  REQUIRE(models.size() == 20);
  for (std::size_t i = 0; i < 20; ++i)
    CHECK(models[i].points(0, 0) == Approx(static_cast<double>(i) / 1000));
  const auto metres = run_node<PerObject<Mesh>>("load_models", {}, files);
  CHECK(metres[7].points(0, 0) == 7);
}

TEST_CASE("load_models: a model whose unit is evidently another is named", "[load]") {
  const TempDir dir;
  const ModelFiles files{{dir.write("a.obj", "v 100 0 0\nv 0 0 0\n"), 1, "a"},
                         {dir.write("b.obj", "v 0.1 0 0\nv 0 0 0\n"), 2, "b"}};
  const auto warnings = [&files](const std::string& unit) {
    std::vector<std::string> told;
    std::mutex telling;
    graph::FrameContext context;
    context.on_warning = [&](const std::string& what) {
      const std::lock_guard lock(telling);
      told.push_back(what);
    };
    const graph::NodeSpec* spec = graph::find_node("load_models");
    const auto params = spec->make_params();
    spec->params.at(0).set(params.get(), unit);
    spec->call({graph::StreamTraits<ModelFiles>::wrap(ModelFiles(files))}, context, params.get());
    return told;
  };
  REQUIRE(warnings("m").size() == 1);
  CHECK_THAT(warnings("m")[0], has("a.obj: its diagonal is 100 m, read as m: is it in mm?"));
  REQUIRE(warnings("mm").size() == 1);
  CHECK_THAT(warnings("mm")[0], has("b.obj: ") && has("is it in m? Say --model-unit m "));
  CHECK(warnings("cm").empty());
}

TEST_CASE("load_models: errors name every file that could not be read", "[load]") {
  const TempDir dir;
  const ModelFiles files{{dir.path("a.ply"), 1, "a"},
                         {dir.write("b.obj", "v 0 0 0\n"), 2, "b"},
                         {dir.write("c.obj", "v 0 0\n"), 3, "c"},
                         {dir.write("d.obj", "v 1 1 0\nv 0 0 0\n"), 4, "d"}};
  const auto load = [](const ModelFiles& f) { run_node<PerObject<Mesh>>("load_models", {}, f); };
  CHECK(error_of([&] { load(files); }) ==
        files[0].path.string() + ": there is no such file; " + files[1].path.string() +
            ": has 1 points and no extent: expected a surface; " + files[2].path.string() +
            ": line 1: ends where a number was expected");
  CHECK_THAT(error_of([&] { load({}); }), has("no models"));
}

}  // namespace posevote::load_models_test
