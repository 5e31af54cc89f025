// SPDX-License-Identifier: BSD-3-Clause
// `posevote check` of pipelines of one's own, and the example of every node.
#include <catch2/catch.hpp>

#include "graph/plan.hpp"
#include "graph/yaml_reader.hpp"
#include "tests/support/command.hpp"
#include "tools/commands.hpp"

namespace posevote::variants_test {

using namespace posevote::test;

namespace {

/// The output of `posevote check` on a file of that text, which must have that status.
std::string check(const std::string& yaml, int status, const std::string& more = "") {
  const TemporaryFolder folder;
  const CommandResult result =
      run_posevote(folder, "check " + folder.write("own.yaml", yaml) + " " + more);
  INFO(result.output);
  CHECK(result.status == status);
  return result.output;
}

}  // namespace

TEST_CASE("check knows the types of both ends of a pipeline", "[check]") {
  using Catch::Contains;
  CHECK_THAT(check("extends: recognize\nresult: scene_cloud\n"
                   "remove: [write_overlay, write_picture, write_results, segment_objects, "
                   "estimate_density, cast_votes, write_correspondences, match_features, "
                   "describe_scene, drop_flat, pick_scene_features]\n",
                   2),
             Contains("own.yaml:2:9: result: 'scene_cloud' is Cloud, expected Detections, which a "
                      "pipeline for scans gives"));
  CHECK_THAT(check("extends: recognize\ninputs: [scene_file, time]\n", 2),
             Contains("own.yaml:2:9: inputs: 2 streams, but each frame of a pipeline for scans "
                      "brings 1: SceneFile"));
  CHECK_THAT(check("extends: train_models\ninputs: [files]\n"
                   "replace: {load_models: {node: load_scene, in: files, out: model_meshes}}\n",
                   2),
             Contains("own.yaml:2:10: files: comes as vector<ModelFile> with each frame of a "
                      "pipeline for models, but load_models.scene_file expects SceneFile"));
  CHECK_THAT(check("extends: recognize\nmodels: recognize\n", 2),
             Contains("a pipeline for models"));
}

TEST_CASE("check --flat prints a pipeline that does the same", "[check]") {
  const std::string variant = "extends: ransac\nremove: [write_picture]\n";
  const std::string flat = check(variant, 0, "--flat");
  CHECK(flat.find("extends") == std::string::npos);
  CHECK(flat.find("ransac: {in: [correspondences, scene_features, scale], out: hypotheses}") !=
        std::string::npos);
  CHECK(flat.find("write_picture") == std::string::npos);
  CHECK(check(flat, 0, "--flat") == flat);
}

TEST_CASE("the example of every node can be pasted into a pipeline", "[nodes]") {
  for (const graph::NodeSpec* spec : graph::all_nodes()) {
    REQUIRE(!spec->inputs.empty());
    const std::string first = spec->inputs[0].name;
    const TemporaryFolder folder;
    std::vector<graph::Problem> problems;
    graph::PipelineDescription pipeline =
        graph::read_pipeline(folder.write("own.yaml", "inputs: [" + first + "]\nresult: " + first +
                                                          "\nnodes:\n  " + example(*spec)),
                             problems);
    graph::PlanEnds ends{"a pipeline", {spec->inputs[0].type}, spec->inputs[0].type, {}};
    for (std::size_t i = 1; i < spec->inputs.size(); ++i)
      ends.constants[spec->inputs[i].name] = spec->inputs[i].type;
    if (!spec->outputs.empty()) {
      REQUIRE(pipeline.nodes.size() == 1);
      pipeline.nodes[0].outputs.resize(1);  // nobody would read the others
      pipeline.result.stream = pipeline.nodes[0].outputs.at(0).stream;
      ends.result = spec->outputs[0].type;
    }
    graph::make_plan(pipeline, ends, problems);
    for (const graph::Problem& problem : problems)
      if (!problem.text.starts_with("reads '"))  // of the frame before: a node behind makes it
        FAIL_CHECK(example(*spec) << "\n" << to_string(problem));
  }
}

}  // namespace posevote::variants_test
