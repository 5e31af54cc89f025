// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/pairs/pair_table.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "nodes/color/srgb.hpp"
#include "nodes/pairs/color_step.hpp"
#include "nodes/pairs/pair_key.hpp"
#include "nodes/pairs/rims.hpp"
#include "nodes/pairs/thin_surface.hpp"

namespace posevote::pairs {
namespace {

constexpr float kMostSteps = 101;        ///< tables grow with it to the fourth power
constexpr std::uint32_t kFew = 64;       ///< of a bin: to look at all is quicker than to search
constexpr std::size_t kMostRims = 1500;  ///< tables grow with its square

float checked(float step, float reach) {
  if (!(step >= reach / kMostSteps) || !(step <= reach))
    throw std::runtime_error("a step of pairs of " + std::to_string(step) + " m does not fit " +
                             std::to_string(reach) + " m");
  return step;
}

std::vector<LocalFrame> frames_of(const Cloud& thin) {
  std::vector<LocalFrame> frames;
  for (Eigen::Index i = 0; i < thin.points.rows(); ++i)
    frames.emplace_back(thin.points.row(i).transpose(), thin.normals.row(i).transpose());
  return frames;
}

}  // namespace

PairTable::PairTable(const Cloud& cloud, float step, float reach)
    : PairTable(thin_surface(cloud, checked(step, reach)), step, reach, 0) {}

PairTable::PairTable(const Cloud& thin, float step, float reach, int)
    : PairTable(frames_of(thin), step, reach, thin.colors) {}

PairTable::PairTable(std::vector<LocalFrame> points, float step, float reach,
                     const ColorMatrix& colors)
    : step_(checked(step, reach)),
      reach_(reach),
      has_colors_(colors.rows() > 0),
      points_(std::move(points)) {
  const std::size_t count = points_.size();
  if (count > std::numeric_limits<std::uint16_t>::max())
    throw std::runtime_error("pairs of " + std::to_string(count) +
                             " points are too many: the step of pairs is too small");
  starts_.assign(pair_bins(length_bins(step, reach)) + 1, 0);
  const auto for_each_pair = [this](const auto& visit) {
    for (std::size_t a = 0; a < points_.size(); ++a)
      for (std::size_t b = 0; b < points_.size(); ++b) {
        const Eigen::Vector3f offset = points_[b].point - points_[a].point;
        const std::uint32_t bin = pair_bin(points_[a].normal, points_[b].normal, offset, step_);
        if (bin < starts_.size() - 1) visit(bin, a, b);
      }
  };
  for_each_pair([this](std::uint32_t bin, std::size_t, std::size_t) { ++starts_[bin]; });
  std::exclusive_scan(starts_.begin(), starts_.end(), starts_.begin(), 0U);
  ends_.resize(starts_.back() + kEndPadding);
  std::vector<std::uint32_t> next = starts_;
  const PointMatrix lab = has_colors_ ? color::lab_of(colors) : PointMatrix();
  colors_ = color::ColorShares(lab);
  const auto color_at = [&](std::size_t i) {
    return Eigen::Vector3f(lab.row(static_cast<Eigen::Index>(i)).transpose());
  };
  for_each_pair([&](std::uint32_t bin, std::size_t a, std::size_t b) {
    ends_[next[bin]++] = {static_cast<std::uint16_t>(a),
                          points_[a].turn_to(points_[b].point - points_[a].point),
                          has_colors_ ? color_step(color_at(a), color_at(b)) : std::uint8_t{0}};
  });
  for (std::size_t bin = 0; bin < bins(); ++bin)
    std::sort(ends_.begin() + starts_[bin], ends_.begin() + starts_[bin + 1],
              [](const PairEnd& x, const PairEnd& y) {
                return std::tie(x.turn, x.point) < std::tie(y.turn, y.point);
              });
}

void PairTable::add_turned(std::uint32_t bin, int turn, int most,
                           std::vector<TurnedRun>& runs) const {
  const auto first_turn = static_cast<std::uint8_t>(turn - most);
  const std::uint32_t begin = starts_[bin], end = starts_[bin + 1];
  if (end - begin <= kFew) {
    if (begin < end) runs.push_back({begin, end, first_turn});
    return;
  }
  const auto position = [&](int least) {
    const auto at = std::ranges::lower_bound(ends_.begin() + begin, ends_.begin() + end, least, {},
                                             &PairEnd::turn);
    return static_cast<std::uint32_t>(at - ends_.begin());
  };
  for (const int around : {-256, 0, 256}) {
    const int low = turn - most + around, high = turn + most + around;
    if (high < 0 || low > 255) continue;
    if (const TurnedRun run{position(low), position(high + 1), first_turn}; run.begin < run.end)
      runs.push_back(run);
  }
}

std::shared_ptr<const PairTable> index_pairs(const Model& model, float step) {
  constexpr std::size_t kOctave = 2;  // coarse, so that thinning is quick; fine beside the step
  const std::size_t coarser = std::min(kOctave, model.coarser.size());
  const Cloud& cloud = coarser == 0 ? model.cloud : model.coarser[coarser - 1]->cloud;
  return std::make_shared<const PairTable>(cloud, step, model.diagonal);
}

std::shared_ptr<const PairTable> index_rims(const Model& model, float step) {
  const std::vector<Rim> all = find_rims(model.cloud, kRimRadius * model.resolution);
  float edge = checked(step, model.diagonal);
  std::vector<Rim> thin = thin_rims(all, edge);
  while (thin.size() > kMostRims) thin = thin_rims(all, edge *= 1.2F);
  return std::make_shared<const PairTable>(frames_of(thin), step, model.diagonal);
}

}  // namespace posevote::pairs
