// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/contour_pairs.hpp"

#include <algorithm>
#include <optional>

namespace posevote::geometry {
namespace {

constexpr float kGrazing = 0.2F;  // cosine: a contour is where a surface is seen at less
// x resolution.
constexpr float kStep = 0.5F;  // across the line of sight
constexpr float kDrop = 2;     // behind a contour, at least
// By so much more an object's own surface may be nearer than its contour than it is inside of it.
constexpr float kBulge = 3;

/// What the sensor saw in the direction of a place.
enum class Seen { kOutside, kNothing, kBehind, kSurface, kBefore };

class Contour {
 public:
  Contour(const RangeView& view, const Eigen::Vector3f& viewpoint, float resolution, float reach)
      : view_(view),
        viewpoint_(viewpoint),
        step_(kStep * resolution),
        drop_(kDrop * resolution),
        reach_(reach) {}

  /// How far outward the scan's contour is of a place on the model's; nothing where that is not
  /// told, or the place lies between what is known to be the object and what is known not to be.
  std::optional<float> offset(const Eigen::Vector3f& place, const Eigen::Vector3f& outward) const {
    const Seen here = seen(place, 0);
    if (here != Seen::kBehind && here != Seen::kSurface) return std::nullopt;
    const float way = here == Seen::kBehind ? -step_ : step_;
    const auto at = [&](int steps) {
      const float s = static_cast<float>(steps) * way;
      return seen(place + s * outward, kBulge * std::max(0.0F, -s));
    };
    const int most = static_cast<int>(reach_ / step_);
    int steps = 1;
    while (steps <= most && at(steps) == here) ++steps;
    const float found = static_cast<float>(steps - 1) * way;  // the last of those alike
    if (steps == 1 && at(steps) == Seen::kNothing) return std::nullopt;
    while (steps <= 2 * most && at(steps) == Seen::kNothing) ++steps;
    const Seen beyond = at(steps);
    const bool tells = beyond == (here == Seen::kBehind ? Seen::kSurface : Seen::kBehind);
    return tells ? std::optional(found) : std::nullopt;
  }

 private:
  /// `bulge`: by which the object's own surface may be nearer than the place [m].
  Seen seen(const Eigen::Vector3f& place, float bulge) const {
    const float measured = view_.measured_range(place);
    if (measured == 0) return view_.is_outside(place) ? Seen::kOutside : Seen::kNothing;
    const float behind = measured - (place - viewpoint_).norm();
    if (behind > drop_) return Seen::kBehind;
    return behind < -drop_ - bulge ? Seen::kBefore : Seen::kSurface;
  }

  const RangeView& view_;
  Eigen::Vector3f viewpoint_;
  float step_, drop_, reach_;
};

}  // namespace

std::vector<IcpPair> contour_pairs(const Cloud& model, const ScanSurface& scan,
                                   const RangeView& view, const Eigen::Isometry3d& T_scene_model,
                                   float resolution, double variance, const ContourTerms& terms) {
  if (terms.points == 0 || !view.usable()) return {};
  const float reach = static_cast<float>(terms.reach) * resolution;
  const Contour contour(view, scan.viewpoint(), resolution, reach);
  const auto pair_of = [&](const OrientedPoint& at) {
    IcpPair pair;
    const Eigen::Vector3f ray = (at.point - scan.viewpoint()).normalized();
    const float facing = -at.normal.dot(ray);
    if (!(facing >= 0 && facing < kGrazing)) return pair;
    const Eigen::Vector3f outward = (at.normal + facing * ray).normalized();
    const std::optional<float> off = contour.offset(at.point, outward);
    if (!off) return pair;
    pair.point = at.point.cast<double>();
    pair.normal = outward.cast<double>();
    pair.residual = -static_cast<double>(*off);
    pair.weight = biweight(static_cast<double>(1 - *off * *off / (reach * reach)));
    return pair;
  };
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  std::vector<IcpPair> pairs =
      strewn_pairs(model, terms.points,
                   [&](const Strewn& rows, std::size_t begin, std::size_t end, const auto& add) {
                     for (std::size_t k = begin; k < end; ++k)
                       add(k, pair_of(posed_point(model, rows[k], T)));
                   });
  const double spread = terms.spread * static_cast<double>(resolution);
  weigh_beside_planes(pairs, variance, spread, static_cast<double>(resolution));
  return pairs;
}

}  // namespace posevote::geometry
