// SPDX-License-Identifier: BSD-3-Clause
// Each scan with the found models laid over it, for a viewer of point clouds:
// OUT/overlays/FRAME.ply.
//
// Binary PLY in metres, in the scan's frame: the scan in its colours or in grey, each found instance's points in a
// colour of its own (the same as in write_picture). Where there is no output folder, that is an
// error; a file that cannot be written fails the frame.
//
//   write_overlay: {in: [scene_cloud, detections, library], every: 1}
#include <filesystem>

#include "graph/registry.hpp"
#include "nodes/color/srgb.hpp"
#include "nodes/data/detections.hpp"
#include "nodes/data/model.hpp"
#include "nodes/formats/write_ply.hpp"
#include "nodes/pictures/canvas.hpp"

namespace posevote::write {
namespace {

struct Params {
  int every = 0;
};

formats::Rgb to_rgb(const pictures::Colour& colour) {
  return {static_cast<std::uint8_t>(255 * colour.x()), static_cast<std::uint8_t>(255 * colour.y()),
          static_cast<std::uint8_t>(255 * colour.z())};
}

/// Its own, or grey.
std::vector<formats::Rgb> scan_colours(const Cloud& scan) {
  std::vector<formats::Rgb> colours(static_cast<std::size_t>(scan.points.rows()),
                                    formats::Rgb{160, 160, 155});
  for (Eigen::Index i = 0; i < scan.colors.rows(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      colours[static_cast<std::size_t>(i)][k] =
          color::byte_of(scan.colors(i, static_cast<Eigen::Index>(k)));
  return colours;
}

void append(Mesh& to, const Cloud& cloud, const Eigen::Isometry3f& pose) {
  const Eigen::Index before = to.points.rows();
  const Eigen::Index added = cloud.points.rows();
  to.points.conservativeResize(before + added, 3);
  to.normals.conservativeResize(before + added, 3);
  to.points.bottomRows(added) =
      (cloud.points * pose.linear().transpose()).rowwise() + pose.translation().transpose();
  if (cloud.normals.rows() == added)
    to.normals.bottomRows(added) = cloud.normals * pose.linear().transpose();
  else
    to.normals.bottomRows(added).setZero();
}

void write_overlay(const Cloud& scan, const Detections& detections, const ModelLibrary& library,
                   const graph::FrameContext& context, const Params& params) {
  if (context.out.empty() || params.every == 0 ||
      context.number % static_cast<std::uint64_t>(params.every) != 0)
    return;
  Mesh overlay;
  append(overlay, scan, Eigen::Isometry3f::Identity());
  std::vector<formats::Rgb> colours = scan_colours(scan);
  for (std::size_t i = 0; i < detections.items.size(); ++i) {
    const Detection& found = detections.items[i];
    const Model* model = find_model(library, found.obj_id);
    if (!model) continue;
    append(overlay, model->cloud, found.T_scene_model.cast<float>());
    colours.resize(static_cast<std::size_t>(overlay.points.rows()),
                   to_rgb(pictures::distinct_colour(i)));
  }
  std::filesystem::create_directories(context.out / "overlays");
  formats::write_ply(context.out / "overlays" / (context.name + ".ply"), overlay, 1, colours);
}

const auto registered =
    graph::register_node("write_overlay", write_overlay,
                         "Each scan with the found models laid over it, as a coloured PLY.")
        .input("scan")
        .input("detections")
        .input("library")
        .param("every", &Params::every, "frames", "Only every n-th frame; 0: none.",
               graph::at_least(0));

}  // namespace
}  // namespace posevote::write
