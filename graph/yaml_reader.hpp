// SPDX-License-Identifier: BSD-3-Clause
// Reads pipelines and configs from YAML. Whatever is wrong is added to `problems` with its place;
// what could be read is returned all the same, so that one run reports everything.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "graph/description.hpp"

namespace posevote::graph {

/// The file of the pipeline called `name` where another file, `from`, names it. Throws
/// std::invalid_argument if there is none.
using FindPipeline = std::function<std::string(const std::string& name, const std::string& from)>;
/// NAME.yaml in the folder of `from`.
std::string beside(const std::string& name, const std::string& from);

/// Reads `pipelines/NAME.yaml`:
///
///   models: train_models            # optional: pipeline whose result is a constant stream
///   inputs: [scene_file]            # streams that come with each frame
///   result: detections              # stream that a frame leaves with
///   nodes:
///     load_scene: {in: scene_file, out: scan, unit: mm}
///     downsample_scene: {node: downsample_voxels, in: [scan, scale], out: cloud}
///     describe_scene: {like: describe_models, in: {cloud: cloud, points: points}, out: features}
///
/// or a variant of another one, which says only what differs, and may have `models`, `inputs` and
/// `result` of its own:
///
///   extends: recognize
///   remove: [estimate_density]
///   replace:                        # the node of that name; `name`: what it is called here
///     cast_votes: {name: ransac, in: [correspondences, scene_features, scale], out: hypotheses}
///   insert:                         # `after` or `before` a node, `into` a stream; else at the end
///     save: {after: load_scene, in: scan}
///     smooth: {into: scan, out: smooth_scan}
///
/// A node that is put into a stream reads it, and whatever read it so far (the pipeline's result,
/// too) reads what the node makes instead. `in` may name more streams beside; without `out` the new
/// stream is called like the node. Of two nodes in one stream the one written last reads it first.
///
/// What it returns has no `extends` any more; each node says in which file it stands.
PipelineDescription read_pipeline(const std::string& file, std::vector<Problem>& problems,
                                  const FindPipeline& find = beside);

/// The pipeline as one file without `extends`.
std::string to_yaml(const PipelineDescription& pipeline);

/// Reads `configs/NAME.yaml`: `pipeline: NAME` and, per node, the parameters that differ; `plugins:
/// [libmine.so]`, as in a pipeline, names libraries that hold nodes of it, from the file's folder.
ConfigDescription read_config(const std::string& file, std::vector<Problem>& problems);

/// True where the file describes a pipeline itself (it has `nodes` or `extends`), not a config.
bool is_pipeline(const std::string& file);

/// Reads `--set node.param=value`.
Override read_set(const std::string& argument, std::vector<Problem>& problems);

/// Puts the overrides into the pipeline's nodes; one for a node that is not there is left in the
/// returned list, so that it can be tried on another pipeline of the same config.
std::vector<Override> apply_overrides(PipelineDescription& pipeline,
                                      const std::vector<Override>& overrides);

}  // namespace posevote::graph
