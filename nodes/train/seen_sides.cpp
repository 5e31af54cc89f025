// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/train/seen_sides.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "graph/parallel.hpp"
#include "nodes/geometry/occluder.hpp"
#include "nodes/geometry/select_rows.hpp"
#include "nodes/geometry/strewn.hpp"

namespace posevote::train {
namespace {

using Eigen::Vector3f;

constexpr std::size_t kDirections = 128;   ///< of which 64 are on a side
constexpr Eigen::Index kPartSamples = 64;  ///< whose openness is looked at
constexpr float kGrazing = 0.05F;          ///< cosine: such a ray may meet the next facet

/// Spread evenly over the sphere (a Fibonacci lattice), neighbours far apart in the list.
std::array<Vector3f, kDirections> all_directions() {
  std::array<Vector3f, kDirections> directions;
  for (std::size_t i = 0; i < kDirections; ++i) {
    const std::size_t at = i * 53 % kDirections;  // has no factor in common
    const double z = 1 - (2 * static_cast<double>(at) + 1) / kDirections;
    const double turn = std::numbers::pi * (3 - std::sqrt(5.0)) * static_cast<double>(at);
    const double ring = std::sqrt(1 - z * z);
    directions[i] = {static_cast<float>(ring * std::cos(turn)),
                     static_cast<float>(ring * std::sin(turn)), static_cast<float>(z)};
  }
  return directions;
}

struct Sides {
  bool front = true;
  bool back = false;
};

class Judge {
 public:
  Judge(const PointMatrix& points, const geometry::WoundFaces& mesh,
        const geometry::FaceSamples& samples, const Visibility& how)
      : samples_(samples), how_(how), occluder_(points, mesh.faces) {}

  /// What sides a part has to the outside, by some of its samples.
  Sides sides_of(const std::vector<std::uint32_t>& part) const {
    const geometry::Strewn some(static_cast<Eigen::Index>(part.size()), kPartSamples);
    double front = 0, back = 0;
    for (const Eigen::Index k : some.numbers())
      for (const Vector3f& direction : directions_) {
        const std::uint32_t i = part[static_cast<std::size_t>(k)];
        const double cosine = normal(i).dot(direction);
        if (std::abs(cosine) < kGrazing) continue;
        if (occluder_.escapes(point(i), direction)) (cosine > 0 ? front : back) += cosine;
      }
    back = -back;
    if (how_.two_sided == "always") return {true, true};
    const bool both =
        how_.two_sided == "auto" && std::min(front, back) > how_.as_open * std::max(front, back);
    if (both) return {true, true};
    // Of a sheet that is to have one side the file says which.
    const bool turned = back * how_.as_open > front;
    return {!turned, turned};
  }

  bool is_seen(std::uint32_t sample, float side) const {
    return std::any_of(directions_.begin(), directions_.end(), [&](const Vector3f& direction) {
      return side * normal(sample).dot(direction) > kGrazing &&
             occluder_.escapes(point(sample), direction);
    });
  }

 private:
  Vector3f point(std::uint32_t sample) const { return samples_.points.row(sample); }
  Vector3f normal(std::uint32_t sample) const { return samples_.normals.row(sample); }

  const geometry::FaceSamples& samples_;
  const Visibility& how_;
  const geometry::Occluder occluder_;
  const std::array<Vector3f, kDirections> directions_ = all_directions();
};

/// The samples of each part, in ascending order.
std::vector<std::vector<std::uint32_t>> group_by_part(const geometry::WoundFaces& mesh,
                                                      const geometry::FaceSamples& samples) {
  std::vector<std::uint32_t> part_of(static_cast<std::size_t>(mesh.faces.rows()));
  for (std::uint32_t p = 0; p < mesh.parts.size(); ++p)
    for (const std::uint32_t f : mesh.parts[p].faces) part_of[f] = p;
  std::vector<std::vector<std::uint32_t>> groups(mesh.parts.size());
  for (std::uint32_t i = 0; i < samples.faces.size(); ++i)
    groups[part_of[samples.faces[i]]].push_back(i);
  return groups;
}

/// What is kept of each sample.
std::vector<Sides> judge(const PointMatrix& points, const geometry::WoundFaces& mesh,
                         const geometry::FaceSamples& samples, const Visibility& how) {
  const Judge by_rays(points, mesh, samples, how);
  const auto parts = group_by_part(mesh, samples);
  std::vector<Sides> kept(samples.faces.size());
  graph::parallel_for(parts.size(), 1, [&](std::size_t p) {
    const Sides sides = by_rays.sides_of(parts[p]);
    for (const std::uint32_t i : parts[p]) kept[i] = sides;
  });
  if (parts.size() == 1 || how.hidden) return kept;
  graph::parallel_for(kept.size(), 64, [&](std::size_t i) {
    const auto sample = static_cast<std::uint32_t>(i);
    kept[i].front = kept[i].front && by_rays.is_seen(sample, 1);
    kept[i].back = kept[i].back && by_rays.is_seen(sample, -1);
  });
  return kept;
}

}  // namespace

Cloud keep_seen(const PointMatrix& points, const geometry::WoundFaces& mesh,
                const geometry::FaceSamples& samples, const ColorMatrix& colors,
                const Visibility& how) {
  const bool one_body = mesh.parts.size() == 1 && mesh.parts[0].closed;
  if (one_body && how.two_sided != "always") return {samples.points, samples.normals, {}, colors};
  const std::vector<Sides> kept = judge(points, mesh, samples, how);
  std::vector<std::uint32_t> rows;
  std::vector<float> signs;
  const auto keep = [&](std::uint32_t i, float sign) {
    rows.push_back(i);
    signs.push_back(sign);
  };
  for (std::uint32_t i = 0; i < kept.size(); ++i) {
    if (kept[i].front) keep(i, 1);
    if (kept[i].back) keep(i, -1);
  }
  if (rows.empty()) throw std::runtime_error("none of its faces can be seen from outside");
  const Eigen::Map<const Eigen::VectorXf> sign(signs.data(), std::ssize(signs));
  return {samples.points(rows, Eigen::all),
          (samples.normals(rows, Eigen::all).array().colwise() * sign.array()).matrix(),
          {},
          geometry::select_if_any(colors, rows)};
}

}  // namespace posevote::train
