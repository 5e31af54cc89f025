// SPDX-License-Identifier: BSD-3-Clause
// Describes how the colours around a feature point differ from its own, by histograms over all
// pairs with a neighbour within a radius: of the differences in L*, a* and b* (CIELAB), each in
// 4 distances x 5 bins by linear interpolation, what is beyond in the last bins. Differences, so
// that exposure and a colour cast change little. Point pairs with colour: Choi, Christensen (3D pose
// estimation of daily objects using an RGB-D camera, IROS 2012), here as histograms, as
// describe_point_pairs has them: each row is brought to the sum (row + 1/2) / 4 and square-rooted,
// so that the Euclidean distance is the Hellinger distance. 60 numbers.
//
// The point's own colour is the mean of what is within `center`: one point's is mostly noise. Only
// neighbours that face the same side count, n . n' >= `min_facing`.
//
// Colours alone describe nothing that is of one colour: they go beside a shape's descriptor, in one
// with it (fuse_features.weight). A cloud without colours is described as one of one colour.
//
// Left out are feature points without a usable normal or with fewer than `min_neighbours` such
// neighbours. Time: O(feature points x neighbours).
//
//   describe_color_pairs: {in: [cloud, points, scale], out: features, radius: 12}
#include <array>
#include <cmath>
#include <numeric>

#include "nodes/color/srgb.hpp"
#include "nodes/descriptors/distance_histogram.hpp"
#include "nodes/descriptors/feature_set.hpp"
#include "nodes/descriptors/register_descriptor.hpp"

namespace posevote::describe {
namespace {

struct Params {
  double radius = 12;
  double min_facing = 0.2;
  int min_neighbours = 10;
  double center = 2;
  double lightness_bin = 20;
  double chroma_bin = 12;
};

constexpr int kChannels = 3;
constexpr int kRows = 4;
constexpr int kColumns = 5;
constexpr int kLength = kChannels * kRows * kColumns;

using Histograms = std::array<std::array<std::array<float, kColumns>, kRows>, kChannels>;

/// `off`: differences in bins.
void add(const Eigen::RowVector3f& off, const descriptors::Shares& far, Histograms& histograms) {
  for (int channel = 0; channel < kChannels; ++channel) {
    const descriptors::Shares change(off[channel] + kColumns / 2.0F, kColumns);
    auto& histogram = histograms[static_cast<std::size_t>(channel)];
    for (int i = 0; i < 2; ++i)
      for (int k = 0; k < 2; ++k)
        histogram[static_cast<std::size_t>(far.bin[i])][static_cast<std::size_t>(change.bin[k])] +=
            far.weight[i] * change.weight[k];
  }
}

void write(const Histograms& histograms, float* descriptor) {
  for (const auto& histogram : histograms)
    for (int row = 0; row < kRows; ++row) {
      const auto& bins = histogram[static_cast<std::size_t>(row)];
      const float sum = std::accumulate(bins.begin(), bins.end(), 0.0F);
      descriptor = descriptors::write_row(bins, sum, row, kRows, descriptor);
    }
}

/// L*, a* and b* of a cloud's points, and their neighbours.
class ColorSupport {
 public:
  ColorSupport(const Cloud& cloud, const FeaturePoints& points, const Scale& scale,
               const Params& params)
      : support_(cloud, points, scale, params.radius),
        center_(static_cast<float>(params.center) * support_.resolution()),
        min_facing_(static_cast<float>(params.min_facing)),
        per_bin_(static_cast<float>(1 / params.lightness_bin),
                 static_cast<float>(1 / params.chroma_bin),
                 static_cast<float>(1 / params.chroma_bin)),
        lab_(cloud.colors.rows() > 0 ? color::lab_of(cloud.colors)
                                     : PointMatrix::Zero(cloud.points.rows(), 3)) {}

  const descriptors::Support& support() const { return support_; }

  /// Writes the descriptor of one point and returns how many neighbours it is made of.
  int describe(std::uint32_t point, float* descriptor) const {
    const Eigen::RowVector3f own = color_of(point);
    Histograms histograms{};
    int count = 0;
    for_each_facing(point, support_.radius(), [&](std::uint32_t i, float squared) {
      if (i == point) return;
      const descriptors::Shares far(kRows * std::sqrt(squared) / support_.radius(), kRows);
      add((lab_.row(i) - own).cwiseProduct(per_bin_), far, histograms);
      ++count;
    });
    write(histograms, descriptor);
    return count;
  }

 private:
  template <class Visit>
  void for_each_facing(std::uint32_t point, float radius, const Visit& visit) const {
    const Cloud& cloud = support_.cloud();
    const Eigen::Vector3f at = cloud.points.row(point), normal = cloud.normals.row(point);
    support_.grid().for_each_within(at, radius, [&](std::uint32_t i, float squared) {
      if (cloud.normals.row(i).dot(normal) >= min_facing_) visit(i, squared);
    });
  }

  Eigen::RowVector3f color_of(std::uint32_t point) const {
    Eigen::RowVector3f sum = Eigen::RowVector3f::Zero();
    float count = 0;
    for_each_facing(point, center_, [&](std::uint32_t i, float) {
      sum += lab_.row(i);
      ++count;
    });
    return count > 0 ? Eigen::RowVector3f(sum / count) : Eigen::RowVector3f(lab_.row(point));
  }

  descriptors::Support support_;
  float center_, min_facing_;
  Eigen::RowVector3f per_bin_;
  PointMatrix lab_;
};

FeatureSet describe_color_pairs(const Cloud& cloud, const FeaturePoints& points, const Scale& scale,
                                const Params& params) {
  const ColorSupport colors(cloud, points, scale, params);
  const auto one = [&](std::uint32_t point, float* descriptor) {
    return colors.describe(point, descriptor) >= params.min_neighbours;
  };
  return colors.support().describe_each(kLength, one);
}

const auto registered =
    descriptors::register_descriptor<Params>(
        "describe_color_pairs", describe_color_pairs,
        "Histograms of how colours around a point differ from its own (60 numbers).", 1)
        .param("min_facing", &Params::min_facing, "cosine",
               "Least n . n' of a neighbour; -1 takes all.", graph::in_range(-1, 1))
        .param("center", &Params::center, "x resolution",
               "The point's own colour is the mean of what is within.", graph::at_least(0))
        .param("lightness_bin", &Params::lightness_bin, "L*", "Width of a bin.",
               graph::greater_than(0))
        .param("chroma_bin", &Params::chroma_bin, "a*, b*", "Width of a bin.",
               graph::greater_than(0));

}  // namespace
}  // namespace posevote::describe
