// SPDX-License-Identifier: BSD-3-Clause
// Procedural scans with known answers: star-shaped bumpy bodies, posed anywhere, seen by one sensor
// that hides what lies behind, and correspondences of which a given share is wrong.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "nodes/data/model.hpp"
#include "nodes/geometry/outline.hpp"
#include "nodes/geometry/select_rows.hpp"

namespace posevote::test {

inline constexpr float kResolution = 0.003F;

/// A star-shaped body: radius = 5 cm x (1 + six waves); the seed chooses the waves.
class BumpyBody {
 public:
  explicit BumpyBody(int seed) {
    std::mt19937 random(static_cast<std::uint32_t>(seed) * 7919U + 1U);
    const auto uniform = [&random](double low, double high) {
      return low + (high - low) * static_cast<double>(random()) / 4294967295.0;
    };
    for (Wave& wave : waves_) {
      for (Eigen::Index axis = 0; axis < 3; ++axis) wave.direction[axis] = uniform(-1, 1);
      wave.direction = uniform(2, 6) * wave.direction.normalized();
      wave.phase = uniform(0, 6);
    }
  }

  double radius(const Eigen::Vector3d& direction) const {
    double sum = 1;
    for (const Wave& wave : waves_)
      sum += 0.11 * std::sin(wave.direction.dot(direction) + wave.phase);
    return 0.05 * sum;
  }

  Eigen::Vector3d normal(const Eigen::Vector3d& direction) const {
    const auto level = [this](const Eigen::Vector3d& p) {
      return p.norm() - radius(p.normalized());
    };
    const Eigen::Vector3d p = radius(direction) * direction;
    Eigen::Vector3d gradient;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d h = 1e-5 * Eigen::Vector3d::Unit(axis);
      gradient[axis] = level(p + h) - level(p - h);
    }
    return gradient.normalized();
  }

 private:
  struct Wave {
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();
    double phase = 0;
  };
  std::array<Wave, 6> waves_;
};

/// The whole surface, about one point per spacing^2. `roll` turns the sampling, not the body.
inline Cloud bumpy_cloud(int shape, float spacing, double roll = 0) {
  const double area = 4 * M_PI * 0.05 * 0.05 * 1.3;
  const int count = static_cast<int>(area / static_cast<double>(spacing * spacing));
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(roll, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const BumpyBody body(shape);
  Cloud cloud;
  cloud.points.resize(count, 3);
  cloud.normals.resize(count, 3);
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, angle = 2.399963229728653 * i;
    const double ring = std::sqrt(1 - z * z);
    const Eigen::Vector3d d =
        turn * Eigen::Vector3d(ring * std::cos(angle), ring * std::sin(angle), z);
    cloud.points.row(i) = (body.radius(d) * d).cast<float>().transpose();
    cloud.normals.row(i) = body.normal(d).cast<float>().transpose();
  }
  return cloud;
}

/// Every `step`-th point.
inline FeatureSet features_of(const Cloud& cloud, Eigen::Index step = 6) {
  const auto rows = Eigen::seqN(0, cloud.points.rows() / step, step);
  Cloud some = geometry::select_rows(cloud, rows);
  return {std::move(some.points), std::move(some.normals), {}, {}, {}};
}

/// A model whose feature points are every fourth point of its cloud.
inline std::shared_ptr<const Model> bumpy_model(int shape) {
  auto model = std::make_shared<Model>();
  model->name = "bumpy" + std::to_string(shape);
  model->obj_id = shape;
  model->cloud = bumpy_cloud(shape, kResolution);
  model->resolution = kResolution;
  model->features = features_of(model->cloud, 4);
  const Eigen::RowVector3f low = model->cloud.points.colwise().minCoeff();
  const Eigen::RowVector3f high = model->cloud.points.colwise().maxCoeff();
  model->center = (0.5F * (low + high)).transpose();
  model->diagonal = (high - low).norm();
  model->outline = geometry::outline_of(model->cloud, 5 * kResolution, 4 * kResolution);
  return model;
}

/// A pose before the sensor at the origin, which looks along z.
inline Eigen::Isometry3d pose(double x, double y, double z, double angle,
                              const Eigen::Vector3d& axis = {0.3, -0.8, 0.5}) {
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  T_scene_model.linear() = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  T_scene_model.translation() = Eigen::Vector3d(x, y, z);
  return T_scene_model;
}

/// One body of a scene.
struct Placed {
  int shape = 0;
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
};

namespace detail {

inline void append(Cloud& scan, const Cloud& part, const Eigen::Isometry3d& T) {
  const Eigen::Index before = scan.points.rows();
  scan.points.conservativeResize(before + part.points.rows(), 3);
  scan.normals.conservativeResize(before + part.points.rows(), 3);
  const Eigen::Matrix3f R = T.linear().cast<float>();
  scan.points.bottomRows(part.points.rows()) =
      (part.points * R.transpose()).rowwise() + T.translation().cast<float>().transpose();
  scan.normals.bottomRows(part.points.rows()) = part.normals * R.transpose();
}

/// A wall behind everything, so that free space is measured as free.
inline Cloud wall(float z, float half_width) {
  const int side = static_cast<int>(2 * half_width / kResolution);
  Cloud cloud;
  cloud.points.resize(side * side, 3);
  cloud.normals.resize(side * side, 3);
  for (int i = 0; i < side * side; ++i) {
    cloud.points.row(i) << static_cast<float>(i % side) * kResolution - half_width,
        static_cast<float>(i / side) * kResolution - half_width, z;
    cloud.normals.row(i) << 0, 0, -1;
  }
  return cloud;
}

inline std::pair<int, int> ray_cell(const Eigen::RowVector3f& p) {
  const float cell = 2 * kResolution;  // at unit distance
  return {static_cast<int>(std::floor(p.x() / p.z() / cell)),
          static_cast<int>(std::floor(p.y() / p.z() / cell))};
}

}  // namespace detail

/// What a sensor at the origin sees of the bodies and a wall at z = 1.3 m: points that face it and
/// that nothing hides. `with_wall` false leaves the wall out.
inline Cloud scan_of(const std::vector<Placed>& bodies, bool with_wall = true) {
  Cloud all;
  all.points.resize(0, 3);
  all.normals.resize(0, 3);
  for (const Placed& body : bodies)
    detail::append(all, bumpy_cloud(body.shape, kResolution, 1.0), body.T_scene_model);
  if (with_wall) detail::append(all, detail::wall(1.3F, 0.3F), Eigen::Isometry3d::Identity());
  std::map<std::pair<int, int>, float> nearest;
  for (Eigen::Index i = 0; i < all.points.rows(); ++i) {
    float& z = nearest.try_emplace(detail::ray_cell(all.points.row(i)), 1e9F).first->second;
    z = std::min(z, all.points(i, 2));
  }
  std::vector<Eigen::Index> seen;
  for (Eigen::Index i = 0; i < all.points.rows(); ++i) {
    const bool faces = all.normals.row(i).dot(all.points.row(i)) < 0;
    const float front = nearest.at(detail::ray_cell(all.points.row(i)));
    if (faces && all.points(i, 2) < front + 0.02F) seen.push_back(i);
  }
  return geometry::select_rows(all, seen);
}

/// Matches of one object: scene features on one of its instances get the model feature that lies
/// there; a share of `wrong` of them, and one in `clutter` of all other features, get any.
inline Correspondences match_truly(const std::shared_ptr<const Model>& model,
                                   const FeatureSet& features, const std::vector<Placed>& bodies,
                                   double wrong, std::uint32_t clutter = 8) {
  std::mt19937 random(static_cast<std::uint32_t>(model->obj_id));
  const auto any = [&] {
    return static_cast<std::uint32_t>(random() %
                                      static_cast<std::uint32_t>(model->features.points.rows()));
  };
  Correspondences matches;
  matches.model = model;
  for (Eigen::Index i = 0; i < features.points.rows(); ++i) {
    Eigen::Index partner = -1;
    for (const Placed& body : bodies) {
      const Eigen::RowVector3f p =
          (body.T_scene_model.inverse() * features.points.row(i).transpose().cast<double>())
              .cast<float>()
              .transpose();
      Eigen::Index nearest = 0;
      const float d2 =
          (model->features.points.rowwise() - p).rowwise().squaredNorm().minCoeff(&nearest);
      if (body.shape == model->obj_id && d2 < 4 * kResolution * kResolution) partner = nearest;
    }
    const bool lies = random() % 1000U < static_cast<std::uint32_t>(1000 * wrong);
    if (partner < 0 && random() % clutter != 0) continue;
    matches.scene_feature.push_back(static_cast<std::uint32_t>(i));
    matches.model_feature.push_back(partner < 0 || lies ? any()
                                                        : static_cast<std::uint32_t>(partner));
    matches.distance.push_back(0.1F);
    matches.ratio.push_back(0.5F);
  }
  return matches;
}

}  // namespace posevote::test
