// SPDX-License-Identifier: BSD-3-Clause
// The hot kernels outside of the density (density_bench.cpp), each beside what it replaces, on a
// simulated RGB-D image of 640 x 480 pixels with a figure on a table. Items are what a kernel
// handles one by one: points, descriptors, queries. One thread.
//
//   build/tests/bench_kernels [--benchmark_filter=...]
//   build/tests/bench_kernels --benchmark_out=new.json    # compare: benchmark's tools/compare.py
#include <benchmark/benchmark.h>
#include <oneapi/tbb/global_control.h>
#include <pcl/PCLPointCloud2.h>
#include <pcl/io/ply_io.h>
#include <unistd.h>

#include <filesystem>
#include <numbers>

#include "nodes/data/model.hpp"
#include "nodes/data/votes.hpp"
#include "nodes/descriptors/descriptor_index.hpp"
#include "nodes/formats/read_scan.hpp"
#include "nodes/formats/write_ply.hpp"
#include "nodes/geometry/icp.hpp"
#include "nodes/geometry/nearest_index.hpp"
#include "nodes/poses/measure_fit.hpp"
#include "tests/support/run_node.hpp"
#include "tools/simulate/scanner.hpp"
#include "tools/simulate/shapes.hpp"

namespace posevote {
namespace {

using test::run_node;

constexpr float kResolution = 0.0025F;  // [m]

struct Scene {
  Cloud oriented, cloud;
  FeaturePoints points;
  FeatureSet features;
};

Scene prepare(Cloud oriented) {
  const Scale scale{kResolution};
  Scene scene;
  scene.oriented = std::move(oriented);
  scene.cloud = run_node<Cloud>("downsample_voxels", {}, scene.oriented, scale);
  scene.points = run_node<FeaturePoints>("pick_feature_points", {}, scene.cloud, scale);
  scene.features =
      run_node<FeatureSet>("describe_point_pairs", {}, scene.cloud, scene.points, scale);
  return scene;
}

struct Setting {
  Mesh mesh;
  Scan raw;
  Scene model, scan;
  Eigen::Isometry3d T_scene_model;

  Setting() {
    mesh = make_shape("figure", 1, 0.25);
    model = prepare(run_node<Cloud>("sample_surface", {}, mesh, Scale{kResolution}));
    const auto shared = std::make_shared<const Mesh>(mesh);
    std::vector<Body> bodies{{shared, 1, Eigen::Isometry3d::Identity()}, make_table(1.2)};
    bodies[0].T_world_body.translation().z() = 0.12;
    const Sensor sensor = find_sensor("rgbd");
    const Eigen::Isometry3d T_world_sensor = look_at({0, 0, 0.05}, 0.8, std::numbers::pi / 4, 0.3);
    raw = points_of(posevote::scan(bodies, sensor, T_world_sensor, 1).depth, sensor.camera);
    scan = prepare(run_node<Cloud>("estimate_normals", {}, raw, Scale{kResolution}));
    T_scene_model = T_world_sensor.inverse() * bodies[0].T_world_body;
  }
};

const Setting& setting() {
  static const Setting made;
  return made;
}

void count_items(benchmark::State& state, Eigen::Index items) {
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * items);
}

/// A binary PLY with faces in a file that goes with the process.
struct PlyFile {
  std::filesystem::path path = std::filesystem::temp_directory_path() /
                               ("kernel_bench_" + std::to_string(getpid()) + ".ply");
  PlyFile() { formats::write_ply(path, setting().mesh); }
  ~PlyFile() { std::filesystem::remove(path); }
};

void read_ply(benchmark::State& state) {
  const PlyFile file;
  for (auto _ : state) benchmark::DoNotOptimize(formats::read_mesh(file.path, 1));
  count_items(state, setting().mesh.points.rows());
}

void read_ply_pcl(benchmark::State& state) {
  const PlyFile file;
  for (auto _ : state) {
    pcl::PCLPointCloud2 cloud;
    pcl::PLYReader().read(file.path.string(), cloud);
    benchmark::DoNotOptimize(cloud);
  }
  count_items(state, setting().mesh.points.rows());
}

void estimate_normals(benchmark::State& state) {
  for (auto _ : state)
    benchmark::DoNotOptimize(
        run_node<Cloud>("estimate_normals", {}, setting().raw, Scale{kResolution}));
  count_items(state, setting().raw.points.rows());
}

void downsample(benchmark::State& state) {
  for (auto _ : state)
    benchmark::DoNotOptimize(
        run_node<Cloud>("downsample_voxels", {}, setting().scan.oriented, Scale{kResolution}));
  count_items(state, setting().scan.oriented.points.rows());
}

void describe(benchmark::State& state, const std::string& node) {
  const Scene& scan = setting().scan;
  for (auto _ : state)
    benchmark::DoNotOptimize(
        run_node<FeatureSet>(node, {}, scan.cloud, scan.points, Scale{kResolution}));
  count_items(state, static_cast<Eigen::Index>(scan.points.indices.size()));
}

void match(benchmark::State& state, const std::string& search) {
  auto model = std::make_shared<Model>();
  model->cloud = setting().model.cloud;
  model->features = setting().model.features;
  const std::vector<std::shared_ptr<const Model>> models{model};
  const ModelLibrary library{models, descriptors::index_octaves(models, {search})};
  for (auto _ : state)
    benchmark::DoNotOptimize(run_node<PerObject<Correspondences>>(
        "match_features", {}, setting().scan.features, library));
  count_items(state, setting().scan.features.descriptors.rows());
}

/// The model's points, posed: what ICP and the score ask for.
PointMatrix posed_points() {
  const Eigen::Isometry3f T = setting().T_scene_model.cast<float>();
  return (setting().model.cloud.points * T.linear().transpose()).rowwise() +
         T.translation().transpose();
}

void nearest_by_index(benchmark::State& state) {
  const PointMatrix& points = setting().scan.cloud.points;
  const geometry::NearestIndex near(points, 2 * kResolution);
  const PointMatrix queries = posed_points();
  for (auto _ : state)
    for (Eigen::Index i = 0; i < queries.rows(); ++i)
      benchmark::DoNotOptimize(near.nearest(queries.row(i).transpose(), 2 * kResolution));
  count_items(state, queries.rows());
}

void build_nearest_index(benchmark::State& state) {
  const PointMatrix& points = setting().scan.cloud.points;
  for (auto _ : state) benchmark::DoNotOptimize(geometry::NearestIndex(points, 2 * kResolution));
  count_items(state, points.rows());
}

void outline(benchmark::State& state) {
  const Cloud& cloud = setting().model.cloud;
  for (auto _ : state)
    benchmark::DoNotOptimize(geometry::outline_of(cloud, 9 * kResolution, 4 * kResolution));
  count_items(state, cloud.points.rows());
}

void score_pose(benchmark::State& state) {
  const Setting& s = setting();
  const Outline outline = geometry::outline_of(s.model.cloud, 9 * kResolution, 4 * kResolution);
  const geometry::RangeView view(s.scan.cloud, kResolution);
  const geometry::ScanSurface surface(s.scan.cloud, view.usable(), 2 * kResolution);
  for (auto _ : state)
    benchmark::DoNotOptimize(poses::measure_fit(s.model.cloud, outline, surface, view,
                                                s.T_scene_model, 2 * kResolution));
  count_items(state, s.model.cloud.points.rows());
}

void refine_pose(benchmark::State& state) {
  const Setting& s = setting();
  const geometry::ScanSurface surface(s.scan.cloud, true, 2 * kResolution);
  Eigen::Isometry3d start = s.T_scene_model;
  start.translation().x() += 2 * static_cast<double>(kResolution);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        geometry::icp(s.model.cloud, surface, start, {40, 5 * kResolution, 2 * kResolution}));
}

BENCHMARK(read_ply)->Unit(benchmark::kMillisecond);
BENCHMARK(read_ply_pcl)->Unit(benchmark::kMillisecond);
BENCHMARK(estimate_normals)->Unit(benchmark::kMillisecond);
BENCHMARK(downsample)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(describe, point_pairs, std::string("describe_point_pairs"))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(describe, shot_pcl, std::string("describe_shot"))->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(match, exact, std::string("exact"))->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(match, kd_tree_flann, std::string("kd_tree"))->Unit(benchmark::kMillisecond);
BENCHMARK(build_nearest_index)->Unit(benchmark::kMillisecond);
BENCHMARK(nearest_by_index)->Unit(benchmark::kMillisecond);
BENCHMARK(outline)->Unit(benchmark::kMillisecond);
BENCHMARK(score_pose)->Unit(benchmark::kMillisecond);
BENCHMARK(refine_pose)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace posevote

int main(int argc, char** argv) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
