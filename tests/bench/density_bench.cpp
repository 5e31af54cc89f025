// SPDX-License-Identifier: BSD-3-Clause
// The density of votes like those of a real scan: 10 500 correspondences x 60 votes whose
// translation balls of 1 cm hold some 5 800 votes, of which some 75 pass the rotation test
// as a laser scan of UWA has them. The textbook version, a k-d tree on the translations and a linear
// rotation test, runs on a sample of the votes beside it.
#include <benchmark/benchmark.h>
#include <oneapi/tbb/global_control.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_types.h>

#include <cmath>
#include <random>

#include "nodes/density/pose_index.hpp"
#include "nodes/density/sorted_votes.hpp"
#include "tests/support/instruction_set.hpp"

namespace posevote {
namespace {

constexpr std::uint32_t kCorrespondences = 10500;
constexpr std::uint32_t kRotations = 60;
constexpr double kDegree = 3.14159265358979 / 180;

class Generator {
 public:
  /// One correspondence in fourteen is right: its circle passes through one common pose. The others
  /// scatter, region by region: points of one flat region match points of another, which is what
  /// makes the rotations of near votes alike.
  VoteSet scan_like_votes() {
    votes_.votes_per_correspondence = kRotations;
    Eigen::Vector3d patch = direction(), model_patch = direction();
    for (std::uint32_t i = 0; i < kCorrespondences; ++i) {
      votes_.scene_feature.push_back(i);
      if (i % 14 == 0) {
        const Eigen::Vector3d n = direction();
        const Eigen::Vector3d r = 0.05 * uniform_(random_) * n.cross(direction());
        add_circle(-r, r, n, Eigen::Quaterniond::Identity());
        continue;
      }
      if (i % 80 == 1) patch = direction(), model_patch = direction();
      const Eigen::Vector3d n = (patch + 0.1 * direction()).normalized();
      const Eigen::Vector3d n_model = (model_patch + 0.1 * direction()).normalized();
      const Eigen::Vector3d q(uniform_(random_), uniform_(random_), uniform_(random_));
      add_circle(0.036 * q, 0.02 * uniform_(random_) * n.unitOrthogonal(), n,
                 Eigen::Quaterniond::FromTwoVectors(n_model, n));
    }
    return votes_;
  }

 private:
  Eigen::Vector3d direction() {
    return Eigen::Vector3d(normal_(random_), normal_(random_), normal_(random_)).normalized();
  }

  void add_circle(const Eigen::Vector3d& q, const Eigen::Vector3d& r, const Eigen::Vector3d& n,
                  const Eigen::Quaterniond& align) {
    const double start = uniform_(random_);
    for (std::uint32_t k = 0; k < kRotations; ++k) {
      const Eigen::AngleAxisd turn((start + k) * 6 * kDegree, n);
      const Eigen::Vector3f t = (q + turn * r).cast<float>();
      const Eigen::Quaternionf rotation = (turn * align).cast<float>();
      votes_.tx.push_back(t.x());
      votes_.ty.push_back(t.y());
      votes_.tz.push_back(t.z());
      votes_.qw.push_back(rotation.w());
      votes_.qx.push_back(rotation.x());
      votes_.qy.push_back(rotation.y());
      votes_.qz.push_back(rotation.z());
    }
  }

  std::mt19937 random_{1};
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
  VoteSet votes_;
};

const VoteSet& votes() {
  static const VoteSet set = Generator().scan_like_votes();
  return set;
}

density::VotePoint point(std::size_t v) { return density::vote_point(votes(), v); }

void build_index(benchmark::State& state) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(0)));
  votes();
  for (auto _ : state) benchmark::DoNotOptimize(density::PoseIndex(votes(), {}));
}

void density(benchmark::State& state) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(0)));
  votes();
  for (auto _ : state) benchmark::DoNotOptimize(density::PoseIndex(votes(), {}).densities());
}

/// On a processor that has nothing newer than AVX2.
void density_avx2(benchmark::State& state) {
  const test::OnInstructionSet there(HWY_AVX2);
  if (!there) return state.SkipWithError("no AVX2 here");
  density(state);
}

/// Takes away the first 30 % of the correspondences.
void subtract(benchmark::State& state) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(0)));
  const density::PoseIndex index(votes(), {});
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
  const density::PoseIndex index(votes(), {});
  std::size_t v = 0;
  for (auto _ : state) {
    v = (v + 7919) % votes().tx.size();
    const density::VotePoint p = point(v);
    benchmark::DoNotOptimize(
        index.neighbours({p.tx, p.ty, p.tz}, Eigen::Quaternionf(p.qw, p.qx, p.qy, p.qz)));
  }
}

/// Section 3.2 of the paper to the letter, on every 631st vote: `full_run` is what all would take.
void textbook(benchmark::State& state) {
  constexpr std::size_t kStride = 631;
  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (std::size_t v = 0; v < votes().tx.size(); ++v)
    cloud->push_back({votes().tx[v], votes().ty[v], votes().tz[v]});
  pcl::KdTreeFLANN<pcl::PointXYZ> tree(false);
  tree.setInputCloud(cloud);
  pcl::Indices found;
  std::vector<float> squared;
  double near = 0, members = 0, sum = 0, queries = 0;
  for (auto _ : state)
    for (std::size_t v = 0; v < votes().tx.size(); v += kStride) {
      tree.radiusSearch(*cloud, static_cast<int>(v), 0.01, found, squared);
      for (const int other : found) {
        const density::VotePoint a = point(v), b = point(static_cast<std::size_t>(other));
        const float dot = a.qw * b.qw + a.qx * b.qx + a.qy * b.qy + a.qz * b.qz;
        const float angle = 2 * std::acos(std::min(1.0F, std::abs(dot)));
        if (angle > 22.5F * static_cast<float>(kDegree)) continue;
        sum += std::exp(-density::squared_distance(a, b) / (2 * 0.01F * 0.01F)) *
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
      1.0 / kStride, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK(build_index)
    ->Arg(1)
    ->Arg(2)
    ->ArgName("threads")
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(density_avx2)->Arg(1)->ArgName("threads")->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(density)->Arg(1)->Arg(2)->ArgName("threads")->UseRealTime()->Unit(
    benchmark::kMillisecond);
BENCHMARK(subtract)->Arg(1)->Arg(2)->ArgName("threads")->UseRealTime()->Unit(
    benchmark::kMillisecond);
BENCHMARK(neighbours)->Unit(benchmark::kMicrosecond);
BENCHMARK(textbook)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace posevote

BENCHMARK_MAIN();
