// SPDX-License-Identifier: BSD-3-Clause
// A picture of each scan with the found models in place: OUT/pictures/FRAME.png.
//
// Seen from the sensor: the scan in grey, each found instance in a colour of its own, with its name
// and score; a scan that has colours in these, with the outlines of what was found over it. Time grows with the points and, mildly, with the picture's size. Where there is no
// output folder, that is an error; a file that cannot be written fails the frame.
//
//   write_picture: {in: [scene_cloud, detections, library], width: 1280, every: 1}
#include <cstdio>
#include <filesystem>

#include "graph/registry.hpp"
#include "nodes/data/detections.hpp"
#include "nodes/data/model.hpp"
#include "nodes/pictures/painter.hpp"

namespace posevote::write {
namespace {

struct Params {
  int width = 1280;
  int every = 0;
};

/// The points of all found models, in the scan's frame.
PointMatrix found_points(const Detections& detections, const ModelLibrary& library) {
  PointMatrix all(0, 3);
  for (const Detection& found : detections.items) {
    const Model* model = find_model(library, found.obj_id);
    if (!model) continue;
    const Eigen::Isometry3f T_scene_model = found.T_scene_model.cast<float>();
    all.conservativeResize(all.rows() + model->cloud.points.rows(), 3);
    all.bottomRows(model->cloud.points.rows()) =
        (model->cloud.points * T_scene_model.linear().transpose()).rowwise() +
        T_scene_model.translation().transpose();
  }
  return all;
}

void write_picture(const Cloud& scan, const Detections& detections, const ModelLibrary& library,
                   const graph::FrameContext& context, const Params& params) {
  if (context.out.empty() || params.every == 0 ||
      context.number % static_cast<std::uint64_t>(params.every) != 0)
    return;
  pictures::Painter painter(scan, found_points(detections, library), params.width,
                            library.octaves.front().resolution);
  const bool in_colors = scan.colors.rows() > 0;
  if (in_colors)
    painter.draw_in_colors(scan);
  else
    painter.draw(scan, Eigen::Isometry3f::Identity(), {0.72F, 0.72F, 0.70F}, 0);
  for (std::size_t i = 0; i < detections.items.size(); ++i) {
    const Detection& found = detections.items[i];
    const Model* model = find_model(library, found.obj_id);
    if (!model) continue;
    const Eigen::Isometry3f T_scene_model = found.T_scene_model.cast<float>();
    const pictures::Colour colour = pictures::distinct_colour(i);
    // A good fit lies on the scan: without a lead, scan and model would mix at random.
    if (in_colors)
      painter.outline(model->cloud, T_scene_model, colour);
    else
      painter.draw(model->cloud, T_scene_model, colour, 2 * library.octaves.front().resolution);
    char score[32];
    std::snprintf(score, sizeof score, " %.2f", found.confidence);
    painter.label(T_scene_model * model->center, found.model + score, colour);
  }
  std::filesystem::create_directories(context.out / "pictures");
  painter.save(context.out / "pictures" / (context.name + ".png"));
}

const auto registered =
    graph::register_node("write_picture", write_picture,
                         "A picture of each scan with the found models in place.")
        .input("scan")
        .input("detections")
        .input("library")
        .param("width", &Params::width, "pixel", "Width of the picture.", graph::in_range(64, 4096))
        .param("every", &Params::every, "frames", "Only every n-th frame; 0: none.",
               graph::at_least(0));

}  // namespace
}  // namespace posevote::write
