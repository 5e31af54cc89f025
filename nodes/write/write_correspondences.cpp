// SPDX-License-Identifier: BSD-3-Clause
// The correspondences of each scan, to look into why an object was found or not:
// OUT/correspondences/FRAME.csv.
//
// A line a correspondence: obj_id, distance and ratio of the descriptors, then the scene's point
// and normal and the model's point and normal, in metres, each in its own frame. Off by default:
// some 2 MB a scan. Where there is no output folder, that is an error; a file that cannot be
// written fails the frame.
//
//   write_correspondences: {in: [correspondences, scene_features], every: 1}
#include <cstdio>
#include <filesystem>
#include <string>

#include "graph/registry.hpp"
#include "graph/write_file.hpp"
#include "nodes/data/model.hpp"

namespace posevote::write {
namespace {

struct Params {
  int every = 0;
};

void append_row(std::string& text, const PointMatrix& points, Eigen::Index row) {
  char number[32];
  for (int axis = 0; axis < 3; ++axis) {
    std::snprintf(number, sizeof number, ",%.7g", static_cast<double>(points(row, axis)));
    text += number;
  }
}

std::string rows_of(const Correspondences& object, const FeatureSet& scene) {
  std::string text;
  for (std::size_t i = 0; i < object.scene_feature.size(); ++i) {
    char head[64];
    std::snprintf(head, sizeof head, "%d,%.6g,%.6g", object.model->obj_id,
                  static_cast<double>(object.distance[i]), static_cast<double>(object.ratio[i]));
    text += head;
    append_row(text, scene.points, object.scene_feature[i]);
    append_row(text, scene.normals, object.scene_feature[i]);
    append_row(text, object.model->features.points, object.model_feature[i]);
    append_row(text, object.model->features.normals, object.model_feature[i]);
    text += '\n';
  }
  return text;
}

void write_correspondences(const PerObject<Correspondences>& correspondences,
                           const FeatureSet& scene_features, const graph::FrameContext& context,
                           const Params& params) {
  if (context.out.empty() || params.every == 0 ||
      context.number % static_cast<std::uint64_t>(params.every) != 0)
    return;
  const std::filesystem::path file = context.out / "correspondences" / (context.name + ".csv");
  std::filesystem::create_directories(file.parent_path());
  std::string text =
      "obj_id,distance,ratio,scene_x,scene_y,scene_z,scene_nx,scene_ny,scene_nz,"
      "model_x,model_y,model_z,model_nx,model_ny,model_nz\n";
  for (const auto& object : correspondences.slots) text += rows_of(*object, scene_features);
  graph::write_file(file, text);
}

const auto registered = graph::register_node("write_correspondences", write_correspondences,
                                             "The correspondences of each scan, as a table.")
                            .input("correspondences")
                            .input("scene_features")
                            .param("every", &Params::every, "frames",
                                   "Only every n-th frame; 0: none.", graph::at_least(0));

}  // namespace
}  // namespace posevote::write
