// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>
#include <random>

#include "nodes/data/model.hpp"
#include "nodes/geometry/cells.hpp"
#include "nodes/geometry/normal_noise.hpp"
#include "nodes/geometry/sensor_noise.hpp"
#include "tests/support/run_node.hpp"

namespace posevote::scan_octaves_test {
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

/// The same with noise that neighbours within some centimetres share: waves of that height.
Scan wavy(float spacing, float height, float per_metre = 300) {
  Scan scan = wall(1, spacing, 0);
  for (Eigen::Index i = 0; i < scan.points.rows(); ++i)
    scan.points(i, 2) +=
        height * std::sin(per_metre * scan.points(i, 0)) * std::sin(per_metre * scan.points(i, 1));
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

/// What is said of the scan, where an object has octaves of 1 to 4 mm.
struct Told {
  std::string warning;
  graph::Figures figures;
};

Told told_of(const Scan& scan) {
  ModelLibrary library;
  const std::vector<float> octaves{0.001F, 0.002F, 0.004F};
  library.models.push_back(object(octaves));
  for (const float resolution : octaves) library.octaves.push_back({resolution, nullptr, {}});
  Told told;
  graph::FrameContext context;
  context.on_warning = [&told](const std::string& what) { told.warning += what; };
  context.on_figure = [&told](const std::string& what, const std::vector<double>& figure) {
    told.figures[what] = figure;
  };
  const graph::NodeSpec* spec = graph::find_node("scan_octaves");
  spec->call({graph::StreamTraits<Scan>::wrap(Scan(scan)),
              graph::StreamTraits<ModelLibrary>::wrap(std::move(library))},
             context, spec->make_params().get());
  return told;
}

}  // namespace

TEST_CASE("a scan too coarse or too noisy for its objects is said so", "[prepare]") {
  using Catch::Matchers::Contains;
  CHECK(told_of(wall(1, 0.001F, 0.0005F)).warning == "");
  CHECK(told_of(wall(1, 0.004F, 0.0001F)).warning == "");
  CHECK_THAT(told_of(wall(1, 0.009F, 0)).warning, Contains("points are 8.5 mm apart, too far"));
  CHECK_THAT(told_of(wavy(0.002F, 0.005F, 130)).warning,
             Contains("noise tilts the scan's normals by"));
}

TEST_CASE("what was measured of a scan is told", "[prepare]") {
  auto figures = told_of(wall(1, 0.002F, 0.001F)).figures;
  CHECK(figures["range_m"].at(0) == Approx(1).epsilon(0.05));
  CHECK(figures["spacing_m"].at(0) == Approx(0.002).epsilon(0.15));
  CHECK(figures["noise_m"].at(0) == Approx(0.001).epsilon(0.15));
  CHECK(figures["resolution_m"].at(0) >= 0.6 * figures["spacing_m"].at(0));
  CHECK(figures["normal_tilt_deg"].at(0) > 0);
}

TEST_CASE("noise and spacing are measured from the scan", "[prepare]") {
  const Scan scan = wall(1, 0.002F, 0.001F);
  const auto noise = geometry::measure_noise(scan.points, Eigen::Vector3f::Zero());
  CHECK(noise.noise_at(1) == Approx(0.001).epsilon(0.15));
  CHECK(noise.spacing_at(1) == Approx(0.002).epsilon(0.15));
  CHECK(noise.noise_at(2) == Approx(0.004).epsilon(0.15));
  CHECK(geometry::measure_noise(PointMatrix(0, 3), Eigen::Vector3f::Zero()).ranges.empty());
  CHECK(geometry::measure_noise(PointMatrix::Ones(9, 3), Eigen::Vector3f::Zero()).ranges.empty());
}

TEST_CASE("how far noise tilts normals is measured over patches", "[prepare]") {
  // n points strewn over a square of edge w with noise s tilt its plane by sqrt(12 / n) s / w.
  const Scan scan = wall(1, 0.001F, 0.0002F);
  const auto rows = geometry::finite_rows(scan.points);
  const auto tilt = [&](float width) {
    return geometry::NoiseCubes(scan.points, rows, width).tilt(Eigen::Vector3f::Zero());
  };
  CHECK(tilt(0.005F).value() == Approx(std::sqrt(12.0 / 25) * 0.04).epsilon(0.15));
  CHECK(tilt(0.01F).value() == Approx(std::sqrt(12.0 / 100) * 0.02).epsilon(0.2));
  CHECK_FALSE(tilt(0.05F));   // hardly a patch has neighbours
  CHECK_FALSE(tilt(0.002F));  // four points make no patch
  CHECK_FALSE(geometry::NoiseCubes(scan.points, {}, 0.01F).tilt(Eigen::Vector3f::Zero()));
}

TEST_CASE("cubes that are widened tell what cubes of that width do", "[prepare]") {
  for (const double far : {1, 1000}) {  // digits must not be lost
    Scan scan = wall(1, 0.001F, 0.0002F);
    scan.points.col(0).array() += static_cast<float>(far);
    const auto rows = geometry::finite_rows(scan.points);
    geometry::NoiseCubes cubes(scan.points, rows, 0.005F);
    cubes.widen();
    const auto seen_from = Eigen::Vector3f(static_cast<float>(far), 0, 0);
    const auto tilt = geometry::NoiseCubes(scan.points, rows, 0.01F).tilt(seen_from);
    REQUIRE(tilt);
    CHECK(cubes.tilt(seen_from).value() == Approx(*tilt).epsilon(1e-5));
  }
}

TEST_CASE("a scan has the finest octaves of each object that its sensor can tell", "[prepare]") {
  const std::vector<float> fine{0.001F, 0.002F, 0.004F, 0.008F};
  using Octaves = std::vector<float>;
  CHECK(octaves_of_scan(wall(1, 0.0005F, 0), {fine}) == Octaves{0.001F, 0.002F});
  CHECK(octaves_of_scan(wall(1, 0.0025F, 0), {fine}) == Octaves{0.002F, 0.004F});
  CHECK(octaves_of_scan(wall(1, 0.002F, 0.002F), {fine}) == Octaves{0.002F, 0.004F});
  CHECK(octaves_of_scan(wall(1, 0.002F, 0.002F), {fine}, {{"noisy", "4"}}) ==
        Octaves{0.004F, 0.008F});
  CHECK(octaves_of_scan(wall(1, 0.0005F, 0), {fine}, {{"radii", "3"}}) ==
        Octaves{0.001F, 0.002F, 0.004F});
  CHECK(octaves_of_scan(wall(1, 0.0005F, 0), {fine}, {{"finest", "0.003"}}) ==
        Octaves{0.004F, 0.008F});
  // The coarsest that noise may choose where nothing is good enough.
  CHECK(octaves_of_scan(wall(1, 0.0005F, 1e-4F), {fine}, {{"tilt", "0"}}) ==
        Octaves{0.002F, 0.004F});
}

TEST_CASE("an octave coarser than noise may choose is for points that lie farther apart",
          "[prepare]") {
  const std::vector<float> fine{0.001F, 0.002F, 0.004F, 0.008F, 0.016F};
  using Octaves = std::vector<float>;
  CHECK(octaves_of_scan(wall(1, 0.0035F, 0), {fine}) == Octaves{0.002F, 0.004F});
  CHECK(octaves_of_scan(wall(1, 0.005F, 0), {fine}) == Octaves{0.004F, 0.008F});
  CHECK(octaves_of_scan(wall(1, 0.005F, 0), {fine}, {{"radii", "3"}}) ==
        Octaves{0.002F, 0.004F, 0.008F});
  CHECK(octaves_of_scan(wall(1, 0.04F, 0), {fine}) == Octaves{0.008F, 0.016F});
}

TEST_CASE("noise that neighbours share counts, however smooth it is", "[prepare]") {
  const std::vector<float> fine{0.001F, 0.002F, 0.004F, 0.008F};
  const Scan scan = wavy(0.0008F, 0.0012F);
  const auto noise = geometry::measure_noise(scan.points, Eigen::Vector3f::Zero());
  CHECK(noise.noise_at(1) < 0.0003F);
  CHECK(octaves_of_scan(scan, {fine}).front() >= 0.002F);
}

TEST_CASE("objects share octaves; of one that is too fine the coarsest are taken", "[prepare]") {
  const Scan scan = wall(1, 0.002F, 0.002F);
  CHECK(octaves_of_scan(scan, {{0.001F, 0.002F, 0.003F}, {0.003F, 0.004F, 0.008F}}) ==
        std::vector<float>{0.002F, 0.003F, 0.004F, 0.008F});
}

TEST_CASE("no choice of octaves needs no measuring", "[prepare]") {
  CHECK(octaves_of_scan(wall(1, 0.01F, 0.01F), {{0.001F, 0.002F}}) ==
        std::vector<float>{0.001F, 0.002F});
}

TEST_CASE("a scan of points on a line has octaves, too", "[prepare]") {
  Scan line;
  line.points.setZero(3000, 3);
  for (Eigen::Index i = 0; i < 3000; ++i) line.points.row(i) << 1e-4F * static_cast<float>(i), 0, 1;
  CHECK(octaves_of_scan(line, {{0.001F, 0.002F, 0.004F}}).size() == 2);
}

}  // namespace posevote::scan_octaves_test
