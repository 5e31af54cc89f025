// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/poses/color_fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "nodes/color/srgb.hpp"
#include "nodes/geometry/facing_points.hpp"
#include "nodes/geometry/strewn.hpp"
#include "nodes/poses/sought.hpp"

namespace posevote::poses {
namespace {

constexpr std::size_t kFewestPairs = 12;

/// The cube of a grid that a point of the model lies in.
std::uint64_t cube_of(const Eigen::Vector3f& offset, float edge) {
  std::uint64_t cube = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto cell = static_cast<std::int64_t>(std::floor(offset[axis] / edge));
    cube = (cube << 21) | (static_cast<std::uint64_t>(cell) & 0x1FFFFFU);
  }
  return cube;
}

/// Pairs of one place of the model: their sums. A print's letters are finer than the scan's points,
/// the model's samples and what both are off by; of the mean over a place enough of them is left.
struct Patch {
  std::uint64_t cube = 0;
  double count = 0;
  Eigen::Vector3d expected = Eigen::Vector3d::Zero(), seen = Eigen::Vector3d::Zero();

  void add(const Patch& other) {
    count += other.count;
    expected += other.expected;
    seen += other.seen;
  }
};

std::vector<Patch> pairs_of(const Sought& sought, const Eigen::Isometry3d& T_scene_model,
                            Eigen::Index points) {
  const Cloud& model = sought.model.cloud;
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  const float edge = static_cast<float>(sought.terms.color.patch) * sought.model.diagonal;
  const geometry::Strewn rows(model.points.rows(), points);
  std::vector<Patch> pairs;
  const auto pair_up = [&](std::size_t k, const geometry::OrientedPoint& p, float) {
    const Eigen::Index i = rows[k];
    const auto row = sought.scan.surface.compatible_row(p, sought.params.tolerance);
    if (!row) return;
    pairs.push_back({cube_of(model.points.row(i).transpose() - sought.model.center, edge), 1,
                     sought.look->lab.row(i).transpose().cast<double>(),
                     sought.scan.look.lab.row(*row).transpose().cast<double>()});
  };
  geometry::for_each_facing(model, rows, 0, rows.size(), T, sought.scan.surface, pair_up);
  return pairs;
}

std::vector<Patch> gather(std::vector<Patch> pairs) {
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Patch& a, const Patch& b) { return a.cube < b.cube; });
  std::vector<Patch> patches;
  for (const Patch& pair : pairs) {
    if (patches.empty() || patches.back().cube != pair.cube)
      patches.push_back(pair);
    else
      patches.back().add(pair);
  }
  return patches;
}

double z_of(const ColorFit& fit) { return std::atanh(std::clamp(fit.likeness, -0.99, 0.99)); }

}  // namespace

LookOf::LookOf(const Cloud& cloud) : lab(color::lab_of(cloud.colors)) {
  constexpr float kGrey = 2;  // of a* and b*: nothing of it is seen
  is_colorful = lab.rows() > 0 && lab.rightCols(2).cwiseAbs().maxCoeff() > kGrey;
}

std::optional<ColorFit> measure_colors(const Sought& sought, const Eigen::Isometry3d& T_scene_model,
                                       Eigen::Index points) {
  if (!sought.look || sought.look->lab.rows() == 0) return std::nullopt;
  const std::vector<Patch> pairs = pairs_of(sought, T_scene_model, points);
  if (pairs.size() < kFewestPairs) return std::nullopt;
  const ColorTerms& terms = sought.terms.color;
  ColorFit fit;
  fit.has_tint = sought.look->is_colorful && sought.scan.look.is_colorful;
  const double chroma = fit.has_tint ? 1 : 0;
  const Eigen::Vector3d weights(terms.lightness, chroma, chroma);
  Patch all;
  for (const Patch& pair : pairs) all.add(pair);
  const Eigen::Vector3d expected = all.expected / all.count, seen = all.seen / all.count;
  double together = 0, of_expected = 0, of_seen = 0, squares = 0;
  for (const Patch& patch : gather(pairs)) {
    const Eigen::Vector3d e = weights.cwiseProduct(patch.expected / patch.count - expected);
    const Eigen::Vector3d s = weights.cwiseProduct(patch.seen / patch.count - seen);
    together += patch.count * e.dot(s);
    of_expected += patch.count * e.squaredNorm();
    of_seen += patch.count * s.squaredNorm();
    squares += patch.count * patch.count;
  }
  const double noise = terms.noise * terms.noise;  // so that a plain surface is like nothing
  fit.patches = all.count * all.count / squares;   // as many as if all held as much (Kish 1965)
  fit.contrast = std::sqrt(of_expected / all.count);
  fit.likeness = together / all.count /
                 std::sqrt((of_expected / all.count + noise) * (of_seen / all.count + noise));
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

// Both are log odds of the colours being the object's rather than anybody's, under normal
// distributions. Likeness: its z (Fisher's) about what true poses have, less the plainer the object
// is, against none, both with what chance and the world's doings scatter. Tint: of a mean that light
// and camera shift, against any.
ColorClues color_clues_of(const ColorFit& fit, const Eigen::Vector2d& usual_tint,
                          const ColorTerms& terms) {
  const double contrast = fit.contrast * fit.contrast;
  const double usual =
      std::atanh(terms.usual_likeness * contrast / (contrast + terms.plain * terms.plain));
  const double spread =
      terms.likeness_spread * terms.likeness_spread + 1 / std::max(1.0, fit.patches - 3);
  ColorClues clues;
  clues.likeness = usual * (z_of(fit) - usual / 2) / spread;
  // The offset was fitted where there is a tint: one that nobody sees must not cost what it takes.
  if (!fit.has_tint) {
    clues.tint = terms.weights.tint == 0 ? 0 : -terms.offset / terms.weights.tint;
    return clues;
  }
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
