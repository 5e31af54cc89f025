// SPDX-License-Identifier: BSD-3-Clause
// ECSAD, equivalent circumference surface angle descriptor (Jorgensen, Buch, Kraft, VISAPP 2015):
// the neighbourhood is cut into 4 shells of equal thickness and these into 6, 12, 18 and 24
// sectors, so that all cells are about equally wide. A cell holds the mean angle between the
// direction to its points and the normal, here as the height over the tangent plane in rad. Cells
// that face each other across the feature point are averaged: 3 + 6 + 9 + 12 = 30 numbers.
//
// Sectors are counted from the direction of the edge that the point may lie on. Where the height
// is, by least squares, a + b cos 2 phi + c sin 2 phi in the direction phi, that is the one of its
// two extremal directions in which the surface bends less. It has no sign, and because of the
// averaging needs none. On planes, spheres and symmetric saddles it is undefined and the
// descriptor, where it is not zero there, does not repeat. A cell without points takes the mean of
// its shell, or zero.
//
// The authors used a radius of 10 mean edges of their meshes; on UWA's models one of those is some
// 1.27 of our resolutions.
//
// Left out are feature points without a usable normal or with fewer than `min_neighbours`
// neighbours off the normal's line. Time: O(feature points x neighbours).
//
//   describe_ecsad: {in: [cloud, points, scale], out: features, radius: 13}
#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "nodes/descriptors/feature_set.hpp"
#include "nodes/descriptors/register_descriptor.hpp"

namespace posevote::describe {
namespace {

struct Params {
  double radius = 13;
  int min_neighbours = 10;
};

constexpr int kShells = 4;
constexpr int kFewestSectors = 6;
constexpr int kLength = kFewestSectors / 2 * kShells * (kShells + 1) / 2;
constexpr double kPi = std::numbers::pi;

/// A neighbour in the frame of the feature point.
struct Sample {
  double distance;  ///< [m]
  double azimuth;   ///< from some tangent [rad]
  double height;    ///< angle over the tangent plane [rad]
};

std::vector<Sample> take_samples(const descriptors::Support& support, std::uint32_t point) {
  const Cloud& cloud = support.cloud();
  const Eigen::Vector3d center = cloud.points.row(point).transpose().cast<double>();
  const Eigen::Vector3d normal = cloud.normals.row(point).transpose().cast<double>().normalized();
  const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  std::vector<Sample> samples;
  const auto add = [&](std::uint32_t neighbour, float) {
    const Eigen::Vector3d offset = cloud.points.row(neighbour).transpose().cast<double>() - center;
    const double x = offset.dot(u), y = offset.dot(v), flat = std::hypot(x, y);
    if (flat > 0)
      samples.push_back({offset.norm(), std::atan2(y, x), std::atan2(offset.dot(normal), flat)});
  };
  support.grid().for_each_within(center.cast<float>(), support.radius(), add);
  return samples;
}

/// The tangent direction in which the surface bends least, in [-pi/4, 3 pi/4].
double edge_direction(const std::vector<Sample>& samples) {
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Eigen::Vector3d heights = Eigen::Vector3d::Zero();
  for (const Sample& sample : samples) {
    const Eigen::Vector3d terms(1, std::cos(2 * sample.azimuth), std::sin(2 * sample.azimuth));
    squares += terms * terms.transpose();
    heights += sample.height * terms;
  }
  const Eigen::Vector3d fit = squares.ldlt().solve(heights);
  const double highest = 0.5 * std::atan2(fit[2], fit[1]);
  return fit[0] <= 0 ? highest : highest + kPi / 2;
}

/// Angles are summed into 60 cells, then opposite ones averaged.
class Cells {
 public:
  void add(int shell, double azimuth, double height) {
    const int sectors = kFewestSectors * (shell + 1);
    // The first sector has the reference in its middle, so that an edge falls into one sector.
    const double turns = azimuth / (2 * kPi) + 2 + 0.5 / sectors;
    const int sector = static_cast<int>((turns - std::floor(turns)) * sectors) % sectors;
    Mean& mean = means_[first(shell) + static_cast<std::size_t>(sector)];
    mean.sum += height;
    ++mean.count;
  }

  void write(float* descriptor) const {
    for (int shell = 0; shell < kShells; ++shell) {
      const std::size_t half = first(shell + 1) / 2 - first(shell) / 2;
      const Mean* cell = &means_[first(shell)];
      Mean of_shell;
      std::vector<Mean> pairs(half);
      for (std::size_t i = 0; i < half; ++i)
        for (const Mean& mean : {cell[i], cell[i + half]})
          if (mean.count > 0)
            for (Mean* into : {&pairs[i], &of_shell}) {
              into->sum += mean.value();
              ++into->count;
            }
      for (const Mean& pair : pairs)
        *descriptor++ = static_cast<float>(pair.count > 0 ? pair.value() : of_shell.value());
    }
  }

 private:
  struct Mean {
    double sum = 0;
    int count = 0;
    double value() const { return count > 0 ? sum / count : 0; }
  };

  static std::size_t first(int shell) {
    const auto number = static_cast<std::size_t>(shell);
    return kFewestSectors * number * (number + 1) / 2;
  }

  std::array<Mean, 2 * static_cast<std::size_t>(kLength)> means_;
};

FeatureSet describe_ecsad(const Cloud& cloud, const FeaturePoints& points, const Scale& scale,
                          const Params& params) {
  const descriptors::Support support(cloud, points, scale, params.radius);
  const double shells_per_metre = kShells / static_cast<double>(support.radius());
  return support.describe_each(kLength, [&](std::uint32_t point, float* descriptor) {
    const std::vector<Sample> samples = take_samples(support, point);
    if (samples.size() < static_cast<std::size_t>(params.min_neighbours)) return false;
    const double edge = edge_direction(samples);
    Cells cells;
    for (const Sample& sample : samples)
      cells.add(std::min(static_cast<int>(sample.distance * shells_per_metre), kShells - 1),
                sample.azimuth - edge, sample.height);
    cells.write(descriptor);
    return true;
  });
}

const auto registered = descriptors::register_descriptor<Params>(
    "describe_ecsad", describe_ecsad,
    "ECSAD: mean angles to the normal in cells around it (30 numbers).", 1);

}  // namespace
}  // namespace posevote::describe
