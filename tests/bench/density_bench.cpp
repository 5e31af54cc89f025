// SPDX-License-Identifier: BSD-3-Clause
// The density of a real scan's votes, in miniature nothing: 10 500 correspondences x 60 votes whose
// translation balls of 1 cm hold some 5 800 votes, of which some 75 pass the rotation test
// (METHOD.md, section 3). The textbook version, a k-d tree on the translations and a linear
// rotation test, runs on a sample of the votes beside it.
#include <benchmark/benchmark.h>
#include <oneapi/tbb/global_control.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_types.h>

#include <cmath>
#include <random>

#include "nodes/vote/pose_index.hpp"

namespace posevote {
namespace {

constexpr int kCorrespondences = 10500;
constexpr std::uint32_t kRotations = 60;
constexpr double kDegree = 3.14159265358979 / 180;

/// Circles of votes as cast_votes makes them, on scene points of one flat region after another,
/// which is what makes rotations of near votes alike.
VoteSet scan_like_votes() {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto direction = [&] {
    return Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized().eval();
  };
  VoteSet votes;
  votes.votes_per_correspondence = kRotations;
  Eigen::Vector3d patch_normal = direction(), model_normal = direction();
  for (int i = 0; i < kCorrespondences; ++i) {
    if (i % 12 == 0) patch_normal = direction(), model_normal = direction();
    const Eigen::Vector3d n = (patch_normal + 0.1 * direction()).normalized();
    const Eigen::Vector3d center =
        0.055 * Eigen::Vector3d(uniform(random), uniform(random), uniform(random));
    const double radius = 0.02 * std::abs(uniform(random));
    const Eigen::Vector3d u = n.unitOrthogonal();
    const auto align =
        Eigen::Quaterniond::FromTwoVectors((model_normal + 0.1 * direction()).normalized(), n);
    for (std::uint32_t k = 0; k < kRotations; ++k) {
      const Eigen::AngleAxisd turn(k * 6 * kDegree, n);
      const Eigen::Vector3d t = center + turn * u * radius;
      const Eigen::Quaternionf q = (turn * align).cast<float>();
      votes.tx.push_back(static_cast<float>(t.x()));
      votes.ty.push_back(static_cast<float>(t.y()));
      votes.tz.push_back(static_cast<float>(t.z()));
      votes.qw.push_back(q.w());
      votes.qx.push_back(q.x());
      votes.qy.push_back(q.y());
      votes.qz.push_back(q.z());
    }
    votes.scene_feature.push_back(static_cast<std::uint32_t>(i));
  }
  return votes;
}

const VoteSet& votes() {
  static const VoteSet set = scan_like_votes();
  return set;
}

VotePoint point(std::size_t v) {
  const VoteSet& s = votes();
  return {s.tx[v], s.ty[v], s.tz[v], s.qw[v], s.qx[v], s.qy[v], s.qz[v]};
}

void build_index(benchmark::State& state) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(0)));
  votes();
  for (auto _ : state) benchmark::DoNotOptimize(PoseIndex(votes(), {}));
}

void density(benchmark::State& state) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(0)));
  votes();
  for (auto _ : state) benchmark::DoNotOptimize(PoseIndex(votes(), {}).densities());
}

/// Takes away the first 30 % of the correspondences.
void subtract(benchmark::State& state) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(0)));
  const PoseIndex index(votes(), {});
  const std::vector<double> before = index.densities();
  std::vector<char> alive(before.size(), 1);
  std::vector<std::uint32_t> removed;
  for (std::uint32_t v = 0; v < before.size() * 3 / 10; ++v) {
    alive[v] = 0;
    removed.push_back(v);
  }
  for (auto _ : state) {
    std::vector<double> density = before;
    index.subtract(removed, alive, density);
    benchmark::DoNotOptimize(density);
  }
}

void neighbours(benchmark::State& state) {
  const PoseIndex index(votes(), {});
  std::size_t v = 0;
  for (auto _ : state) {
    v = (v + 7919) % votes().tx.size();
    const VotePoint p = point(v);
    benchmark::DoNotOptimize(
        index.neighbours({p.tx, p.ty, p.tz}, Eigen::Quaternionf(p.qw, p.qx, p.qy, p.qz)));
  }
}

/// Section 3.2 of the paper to the letter, on every 630th vote: `full_run` is what all would take.
void textbook(benchmark::State& state) {
  constexpr std::size_t kStride = 630;
  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (std::size_t v = 0; v < votes().tx.size(); ++v)
    cloud->push_back({votes().tx[v], votes().ty[v], votes().tz[v]});
  pcl::KdTreeFLANN<pcl::PointXYZ> tree(false);
  tree.setInputCloud(cloud);
  const Kernel kernel = make_kernel({});
  pcl::Indices found;
  std::vector<float> squared;
  double near = 0, members = 0, sum = 0, queries = 0;
  for (auto _ : state)
    for (std::size_t v = 0; v < votes().tx.size(); v += kStride) {
      tree.radiusSearch(*cloud, static_cast<int>(v), 0.01, found, squared);
      for (const int other : found) {
        const VotePoint a = point(v), b = point(static_cast<std::size_t>(other));
        const float dot = a.qw * b.qw + a.qx * b.qx + a.qy * b.qy + a.qz * b.qz;
        const float angle = 2 * std::acos(std::min(1.0F, std::abs(dot)));
        if (angle > 22.5F * static_cast<float>(kDegree)) continue;
        sum += std::exp(-squared_distance(a, b) * kernel.per_dt2) *
               std::exp(-angle * angle / (2 * 0.3926991F * 0.3926991F));
        ++members;
      }
      near += static_cast<double>(found.size());
      ++queries;
    }
  benchmark::DoNotOptimize(sum);
  state.counters["near_in_translation"] = near / queries;
  state.counters["neighbours"] = members / queries;
  state.counters["all_votes"] = benchmark::Counter(
      static_cast<double>(kStride),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK(build_index)
    ->Arg(1)
    ->Arg(2)
    ->ArgName("threads")
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(density)->Arg(1)->Arg(2)->ArgName("threads")->UseRealTime()->Unit(
    benchmark::kMillisecond);
BENCHMARK(subtract)->Arg(1)->Arg(2)->ArgName("threads")->UseRealTime()->Unit(
    benchmark::kMillisecond);
BENCHMARK(neighbours)->Unit(benchmark::kMicrosecond);
BENCHMARK(textbook)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace posevote

BENCHMARK_MAIN();
