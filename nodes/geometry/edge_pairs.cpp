// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/edge_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "graph/parallel.hpp"
#include "nodes/geometry/outline.hpp"
#include "nodes/geometry/strewn.hpp"

namespace posevote::geometry {
namespace {

// x resolution.
constexpr float kStep = 0.5F;        // along a face
constexpr float kRim = 3;            // the end of a face is at most so far from a point at its rim
constexpr float kLookBeyond = 2.5F;  // an end, for what is there
constexpr float kLeastDrop = 2;      // behind an end

constexpr int kTried = 4;  // places, for each end that is wanted: few are at a rim

std::vector<Eigen::Index> strewn(std::size_t count, int wanted) {
  return Strewn(static_cast<Eigen::Index>(count), wanted).numbers();
}

/// How far a face goes on from `from`, in steps; nothing where it does up to `most`.
template <class GoesOn>
std::optional<float> length_of(const OrientedPoint& from, const Eigen::Vector3f& direction,
                               float step, float most, const GoesOn& goes_on) {
  for (float s = step; s <= most; s += step)
    if (!goes_on(OrientedPoint{from.point + s * direction, from.normal})) return s - step;
  return std::nullopt;
}

}  // namespace

std::vector<FaceEnd> find_face_ends(const Cloud& model, const SurfaceIndex& index,
                                    const Outline& outline, float resolution, int most) {
  std::vector<FaceEnd> ends;
  if (most == 0 || outline.ends.empty()) return ends;
  std::vector<FaceEnd> ahead;  // the place is where the model is no more
  for (Eigen::Index i = 0; i < model.points.rows(); ++i)
    for_each_end(model, outline, i, [&](const Eigen::Vector3f& place) {
      const Eigen::Vector3f from = model.points.row(i).transpose();
      ahead.push_back({i, from, (place - from) / outline.reach});
    });
  const auto agree = [](float cosine) {
    return cosine >= static_cast<float>(SurfaceTerms{}.least_normal_cosine);
  };
  std::vector<FaceEnd> all;
  for (const Eigen::Index k : strewn(ahead.size(), kTried * most))
    all.push_back(ahead[static_cast<std::size_t>(k)]);
  std::vector<std::optional<float>> lengths(all.size());
  // All sides of a model are there. Beyond the edge of a face the nearest point is soon one of the
  // face around the corner, where the scan, which seldom shows both, goes on for a spacing: any
  // point of the face will do.
  graph::parallel_for(all.size(), 64, [&](std::size_t k) {
    NearSurface surface(model, index);
    const OrientedPoint from{all[k].place, model.normals.row(all[k].row).transpose()};
    lengths[k] = length_of(from, all[k].direction, kStep * resolution, kRim * resolution,
                           [&](const OrientedPoint& at) {
                             return surface.is_near(at.point, at.normal, resolution, agree);
                           });
  });
  std::size_t kept = 0;
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    if (!lengths[k]) continue;
    all[kept] = all[k];
    all[kept++].place += *lengths[k] * all[k].direction;
  }
  all.resize(kept);
  for (const Eigen::Index k : strewn(all.size(), most))
    ends.push_back(all[static_cast<std::size_t>(k)]);
  return ends;
}

FaceEnds::FaceEnds(const Cloud& model, const std::vector<FaceEnd>& ends, const ScanSurface& scan,
                   const RangeView& view, float resolution, const EdgeTerms& terms)
    : model_(model),
      ends_(ends),
      scan_(scan),
      view_(view),
      resolution_(resolution),
      step_(kStep * resolution),
      reach_(static_cast<float>(terms.reach) * resolution),
      spread_(terms.spread * static_cast<double>(resolution)) {}

bool FaceEnds::is_free(const Eigen::Vector3f& beyond) const {
  if (view_.is_outside(beyond)) return false;
  const float measured = view_.measured_range(beyond);
  return measured == 0 || measured > (beyond - scan_.viewpoint()).norm() + kLeastDrop * resolution_;
}

IcpPair FaceEnds::pair_of(const FaceEnd& end, const Eigen::Isometry3f& T_scene_model) const {
  IcpPair pair;
  const OrientedPoint at{
      T_scene_model * end.place,
      T_scene_model.linear() * Eigen::Vector3f(model_.normals.row(end.row).transpose())};
  if (!scan_.faces_sensor(at)) return pair;
  const Eigen::Vector3f direction = T_scene_model.linear() * end.direction;
  const auto goes_on = [&](const OrientedPoint& place) {
    return scan_.nearest_compatible(place, resolution_).has_value();
  };
  float off = 0;  // of the scan's end from the model's
  if (goes_on(at)) {
    const auto length = length_of(at, direction, step_, reach_, goes_on);
    if (!length) return pair;
    off = *length;
  } else {
    do off -= step_;
    while (off > -reach_ && !goes_on({at.point + off * direction, at.normal}));
  }
  const double weight = biweight(1 - off * off / (reach_ * reach_));
  if (!(weight > 0) || !is_free(at.point + (off + kLookBeyond * resolution_) * direction))
    return pair;
  pair.row = end.row;
  pair.point = at.point.cast<double>();
  pair.normal = direction.cast<double>();
  pair.residual = -static_cast<double>(off);
  pair.weight = weight;
  return pair;
}

std::vector<IcpPair> FaceEnds::pairs(const Eigen::Isometry3d& T_scene_model,
                                     double variance) const {
  std::vector<IcpPair> pairs(ends_.size());
  graph::parallel_for(ends_.size(), 32, [&](std::size_t k) {
    pairs[k] = pair_of(ends_[k], T_scene_model.cast<float>());
  });
  std::erase_if(pairs, [](const IcpPair& pair) { return !(pair.weight > 0); });
  weigh_beside_planes(pairs, variance, spread_, static_cast<double>(resolution_));
  return pairs;
}

}  // namespace posevote::geometry
