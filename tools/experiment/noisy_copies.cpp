// SPDX-License-Identifier: BSD-3-Clause
#include "tools/experiment/noisy_copies.hpp"

#include <cstdio>

#include "nodes/formats/write_ply.hpp"
#include "tools/simulate/random.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;

Eigen::Isometry3d random_pose(Random& random) {
  Eigen::Isometry3d pose(random.rotation());
  pose.translation() = Eigen::Vector3d(0, 0, 1) + 0.2 * random.direction();
  return pose;
}

Mesh displaced(const Cloud& model, double most, const Eigen::Isometry3d& pose, Random& random) {
  Mesh copy;
  copy.points.resize(model.points.rows(), 3);
  for (Eigen::Index i = 0; i < model.points.rows(); ++i) {
    const Eigen::Vector3d point = model.points.row(i).transpose().cast<double>();
    const Eigen::Vector3d moved = point + random.uniform(0, most) * random.direction();
    copy.points.row(i) = (pose * moved).cast<float>();
  }
  return copy;
}

}  // namespace

std::vector<NoisyCopy> make_noisy_copies(const Cloud& model, const fs::path& folder,
                                         const std::vector<int>& levels, int seeds) {
  const double diagonal =
      (model.points.colwise().maxCoeff() - model.points.colwise().minCoeff()).norm();
  fs::create_directories(folder);
  std::vector<NoisyCopy> copies;
  for (const int level : levels)
    for (int seed = 1; seed <= seeds; ++seed) {
      char name[40];
      std::snprintf(name, sizeof name, "noise_%03d_seed_%02d.ply", level, seed);
      NoisyCopy copy{level * 1e-3, seed, Eigen::Isometry3d::Identity(), folder / name};
      Random random(static_cast<std::uint64_t>(seed), static_cast<std::uint64_t>(level));
      copy.T_scene_model = random_pose(random);
      if (!fs::exists(copy.file))
        formats::write_ply(copy.file,
                           displaced(model, copy.noise * diagonal, copy.T_scene_model, random));
      copies.push_back(copy);
    }
  return copies;
}

}  // namespace posevote
