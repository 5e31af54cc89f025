// SPDX-License-Identifier: BSD-3-Clause
// How the colours of a posed model agree with those that the sensor saw there. Each supported point
// of the model makes a pair of what is expected and what is seen, in CIELAB. Exposure, white balance
// and the colour of the light shift or stretch all that is seen of an object alike, so what counts is
// how the two vary together over it (their correlation), and apart from that how far the mean
// chromaticity is off, which tells a red thing from a green one and is no more than a hint.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>

#include "nodes/data/clues.hpp"
#include "nodes/data/model.hpp"
#include "nodes/poses/terms.hpp"

namespace posevote::poses {

struct Sought;

/// The colours of a cloud as they look.
struct LookOf {
  PointMatrix lab;           ///< n x 3, or 0 x 3 where the cloud has no colours
  bool is_colorful = false;  ///< and not grey all over

  explicit LookOf(const Cloud& cloud);
};

/// What the pairs of a pose come to.
struct ColorFit {
  double patches = 0;   ///< so many places are apart; neighbours tell the same
  double likeness = 0;  ///< correlation over all channels, in [-1, 1]
  double contrast = 0;  ///< deviation of what is expected, in units of CIELAB
  bool has_tint = false;
  Eigen::Vector2d tint =
      Eigen::Vector2d::Zero();  ///< a*, b* seen less those expected, on the mean,
                                ///< as if as light
};

/// By about so many of the model's points. Nothing where the scan or the model has no colours, or
/// next to nothing of the model is supported.
std::optional<ColorFit> measure_colors(const Sought& sought, const Eigen::Isometry3d& T_scene_model,
                                       Eigen::Index points);

/// How much more colours speak for `a` than for `b`, in standard deviations, were the patches
/// independent (Fisher's z); 0 where one is not known.
double color_lead(const std::optional<ColorFit>& a, const std::optional<ColorFit>& b);

/// `usual_tint`: of other instances in the scan.
ColorClues color_clues_of(const ColorFit& fit, const Eigen::Vector2d& usual_tint,
                          const ColorTerms& terms);

/// The tint that the instances of a scan have in common, as the light and the camera make it.
class UsualTint {
 public:
  void add(const std::optional<ColorFit>& fit);
  /// Between none and the mean of what was added.
  Eigen::Vector2d tint() const { return sum_ / (count_ + 1); }

 private:
  Eigen::Vector2d sum_ = Eigen::Vector2d::Zero();
  double count_ = 0;
};

}  // namespace posevote::poses
