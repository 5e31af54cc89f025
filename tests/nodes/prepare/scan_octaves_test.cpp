// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>
#include <random>

#include "nodes/data/model.hpp"
#include "nodes/geometry/sensor_noise.hpp"
#include "tests/support/run_node.hpp"

using namespace posevote;

namespace {

/// A wall at some range, as a sensor at the origin sees it: points so far apart, so noisy.
Scan wall(float range, float spacing, float noise) {
  Scan scan;
  constexpr int kSide = 120;
  scan.points.resize(kSide * kSide, 3);
  std::mt19937 random(3);
  std::normal_distribution<float> off(0, noise);
  for (int i = 0; i < kSide * kSide; ++i)
    scan.points.row(i) << spacing * static_cast<float>(i % kSide - kSide / 2),
        spacing * static_cast<float>(i / kSide - kSide / 2), range + off(random);
  return scan;
}

/// An object with features at these resolutions.
std::shared_ptr<const Model> object(const std::vector<float>& resolutions) {
  Model model;
  const auto count = static_cast<Eigen::Index>(resolutions.size());
  model.features.points.setZero(count, 3);
  for (std::uint32_t i = 0; i < resolutions.size(); ++i)
    model.features.octaves.push_back({resolutions[i], i, i + 1});
  return std::make_shared<const Model>(std::move(model));
}

std::vector<float> octaves_of_scan(const Scan& scan, const std::vector<std::vector<float>>& objects,
                                   const std::map<std::string, std::string>& params = {}) {
  ModelLibrary library;
  for (const auto& resolutions : objects) {
    library.models.push_back(object(resolutions));
    for (const float resolution : resolutions) library.octaves.push_back({resolution, nullptr, {}});
  }
  const auto outputs = test::run_outputs("scan_octaves", params, scan, library);
  std::vector<float> found;
  for (const auto& slot : graph::StreamTraits<PerObject<Scale>>::unwrap(outputs.at(1)).slots)
    found.push_back(slot->resolution);
  CHECK(graph::StreamTraits<Scale>::unwrap(outputs.at(0)).resolution == found.at(0));
  return found;
}

}  // namespace

TEST_CASE("noise and spacing are measured from the scan", "[prepare]") {
  const Scan scan = wall(1, 0.002F, 0.001F);
  const auto noise = geometry::measure_noise(scan.points, Eigen::Vector3f::Zero());
  CHECK(noise.noise_at(1) == Approx(0.001).epsilon(0.15));
  CHECK(noise.spacing_at(1) == Approx(0.002).epsilon(0.15));
  CHECK(noise.noise_at(2) == Approx(0.004).epsilon(0.15));
  CHECK(geometry::measure_noise(PointMatrix(0, 3), Eigen::Vector3f::Zero()).ranges.empty());
  CHECK(geometry::measure_noise(PointMatrix::Ones(9, 3), Eigen::Vector3f::Zero()).ranges.empty());
}

TEST_CASE("a scan has the finest octaves of each object that its sensor can tell", "[prepare]") {
  const std::vector<float> fine{0.001F, 0.002F, 0.004F, 0.008F};
  CHECK(octaves_of_scan(wall(1, 0.0005F, 0), {fine}) == std::vector<float>{0.001F, 0.002F});
  CHECK(octaves_of_scan(wall(1, 0.0012F, 0), {fine}) == std::vector<float>{0.002F, 0.004F});
  CHECK(octaves_of_scan(wall(1, 0.0005F, 0.002F), {fine}) == std::vector<float>{0.004F, 0.008F});
  CHECK(octaves_of_scan(wall(1, 0.0005F, 0), {fine}, {{"radii", "3"}}) ==
        std::vector<float>{0.001F, 0.002F, 0.004F});
  CHECK(octaves_of_scan(wall(1, 0.0005F, 0), {fine}, {{"finest", "0.004"}}) ==
        std::vector<float>{0.004F, 0.008F});
}

TEST_CASE("objects share octaves; of one that is too fine the coarsest is taken", "[prepare]") {
  const Scan scan = wall(1, 0.0005F, 0.002F);
  CHECK(octaves_of_scan(scan, {{0.001F, 0.002F}, {0.004F, 0.008F}, {0.002F, 0.004F}}) ==
        std::vector<float>{0.002F, 0.004F, 0.008F});
}

TEST_CASE("one scale needs no measuring", "[prepare]") {
  CHECK(octaves_of_scan(wall(1, 0.01F, 0.01F), {{0.001F}}) == std::vector<float>{0.001F});
}
