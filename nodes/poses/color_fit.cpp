// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/color_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "nodes/color/srgb.hpp"
#include "nodes/poses/sought.hpp"

namespace posevote::poses {
namespace {

constexpr std::size_t kFewestPairs = 12;

struct Pairs {
  std::vector<Eigen::Vector3d> expected, seen;
  std::vector<std::uint64_t> patches;  ///< that each lies in
};

/// The cube of a grid that a point of the model lies in.
std::uint64_t patch_of(const Eigen::Vector3f& offset, float edge) {
  std::uint64_t patch = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto cell = static_cast<std::int64_t>(std::floor(offset[axis] / edge));
    patch = (patch << 21) | (static_cast<std::uint64_t>(cell) & 0x1FFFFFU);
  }
  return patch;
}

Pairs pairs_of(const Sought& sought, const Eigen::Isometry3d& T_scene_model, Eigen::Index points) {
  const Cloud& model = sought.model.cloud;
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  const float edge = static_cast<float>(sought.terms.color.patch) * sought.model.diagonal;
  const Eigen::Index stride = model.points.rows() / points + 1;
  Pairs pairs;
  for (Eigen::Index i = 0; i < model.points.rows(); i += stride) {
    const geometry::OrientedPoint p = geometry::posed_point(model, i, T);
    if (!sought.scan.surface.faces_sensor(p)) continue;
    const auto row = sought.scan.surface.compatible_row(p, sought.params.tolerance);
    if (!row) continue;
    pairs.expected.emplace_back(sought.look->lab.row(i).transpose().cast<double>());
    pairs.seen.emplace_back(sought.scan.look.lab.row(*row).transpose().cast<double>());
    pairs.patches.push_back(patch_of(model.points.row(i).transpose() - sought.model.center, edge));
  }
  return pairs;
}

Eigen::Vector3d mean_of(const std::vector<Eigen::Vector3d>& values) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

std::size_t count_distinct(std::vector<std::uint64_t> values) {
  std::sort(values.begin(), values.end());
  return static_cast<std::size_t>(std::unique(values.begin(), values.end()) - values.begin());
}

double z_of(const ColorFit& fit) { return std::atanh(std::clamp(fit.likeness, -0.99, 0.99)); }

}  // namespace

LookOf::LookOf(const Cloud& cloud) : lab(color::lab_of(cloud.colors)) {
  constexpr float kGrey = 2;  // of a* and b*: nothing of it is seen
  is_colorful = lab.rows() > 0 && lab.rightCols(2).cwiseAbs().maxCoeff() > kGrey;
}

std::optional<ColorFit> measure_colors(const Sought& sought, const Eigen::Isometry3d& T_scene_model,
                                       Eigen::Index points) {
  if (sought.look->lab.rows() == 0 || sought.scan.look.lab.rows() == 0) return std::nullopt;
  const Pairs pairs = pairs_of(sought, T_scene_model, points);
  if (pairs.expected.size() < kFewestPairs) return std::nullopt;
  const ColorTerms& terms = sought.terms.color;
  ColorFit fit;
  fit.has_tint = sought.look->is_colorful && sought.scan.look.is_colorful;
  const double chroma = fit.has_tint ? 1 : 0;
  const Eigen::Vector3d weights(terms.lightness, chroma, chroma);
  const Eigen::Vector3d expected = mean_of(pairs.expected), seen = mean_of(pairs.seen);
  double together = 0, of_expected = 0, of_seen = 0;
  for (std::size_t i = 0; i < pairs.expected.size(); ++i) {
    const Eigen::Vector3d e = weights.cwiseProduct(pairs.expected[i] - expected);
    const Eigen::Vector3d s = weights.cwiseProduct(pairs.seen[i] - seen);
    together += e.dot(s);
    of_expected += e.squaredNorm();
    of_seen += s.squaredNorm();
  }
  const auto count = static_cast<double>(pairs.expected.size());
  const double noise = terms.noise * terms.noise;  // so that a plain surface is like nothing
  fit.patches = static_cast<double>(count_distinct(pairs.patches));
  fit.contrast = std::sqrt(of_expected / count);
  fit.likeness =
      together / count / std::sqrt((of_expected / count + noise) * (of_seen / count + noise));
  constexpr double kBlack = 16;  // added to L*, all three are proportional to the light's cube root
  if (fit.has_tint)
    fit.tint = seen.tail<2>() * ((expected[0] + kBlack) / (seen[0] + kBlack)) - expected.tail<2>();
  return fit;
}

double color_lead(const std::optional<ColorFit>& a, const std::optional<ColorFit>& b) {
  if (!a || !b) return 0;
  const double independent = std::max(0.0, std::min(a->patches, b->patches) - 3);
  return (z_of(*a) - z_of(*b)) * std::sqrt(independent / 2);
}

// Both are log odds of the colours being the object's rather than anybody's, under a normal
// distribution. Likeness: of values that correlate as much as the object's contrast allows over the
// scatter that true poses have, against values that do not at all; nothing, where the object is
// plain. Tint: of a mean that light and camera shift, against any.
ColorClues color_clues_of(const ColorFit& fit, const Eigen::Vector2d& usual_tint,
                          const ColorTerms& terms) {
  const double contrast = fit.contrast * fit.contrast;
  const double shared = contrast / (contrast + terms.scatter * terms.scatter);  // correlation^2
  const double per_patch =
      -0.5 * std::log1p(-shared) - (shared - std::sqrt(shared) * fit.likeness) / (1 - shared);
  ColorClues clues;
  clues.likeness = std::clamp(std::min(fit.patches, terms.most_patches) * per_patch, -10.0, 10.0);
  if (!fit.has_tint) return clues;
  const double off = (fit.tint - usual_tint).squaredNorm();
  const double own = terms.tint * terms.tint, any = terms.any_tint * terms.any_tint;
  clues.tint = std::max(std::log(any / own) - 0.5 * off * (1 / own - 1 / any), -5.0);
  return clues;
}

void UsualTint::add(const std::optional<ColorFit>& fit) {
  if (!fit || !fit->has_tint) return;
  sum_ += fit->tint;
  ++count_;
}

}  // namespace posevote::poses
