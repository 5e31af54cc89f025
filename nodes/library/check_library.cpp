// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/library/check_library.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace posevote::library {
namespace {

void require(bool sound, const std::string& what) {
  if (!sound) throw std::runtime_error(what);
}

void require_length(float value, const std::string& what) {
  require(std::isfinite(value) && value > 0,
          what + " is " + std::to_string(value) + " m, expected more than 0");
}

void require_count(Eigen::Index count, Eigen::Index expected, const std::string& what) {
  require(count == expected,
          std::to_string(count) + " " + what + ", expected " + std::to_string(expected));
}

/// `or_zero`: an unusable normal is (0, 0, 0).
void require_unit(const PointMatrix& normals, bool or_zero, const std::string& what) {
  for (Eigen::Index i = 0; i < normals.rows(); ++i) {
    const float squared = normals.row(i).squaredNorm();
    require(std::abs(squared - 1) < 1e-3F || (or_zero && squared == 0),
            what + " " + std::to_string(i) + " has a squared length of " + std::to_string(squared) +
                ", expected 1");
  }
}

void check_cloud(const Cloud& cloud) {
  require(cloud.points.rows() > 0, "a cloud has no points");
  require(cloud.points.allFinite(), "a cloud has points that are not finite");
  require_count(cloud.normals.rows(), cloud.points.rows(), "normals");
  require_unit(cloud.normals, true, "normal");
  require(cloud.colors.rows() == 0 || cloud.colors.rows() == cloud.points.rows(),
          "colours are not of all points");
  require(cloud.colors.allFinite(), "colours are not finite");
}

void check_features(const FeatureSet& features) {
  require_count(features.normals.rows(), features.points.rows(), "feature normals");
  require(features.points.allFinite(), "feature points are not finite");
  require_unit(features.normals, false, "feature normal");
  Eigen::Index described = features.descriptors.rows();
  std::uint32_t next = 0;
  for (const Octave& octave : features.octaves) {
    require(octave.begin == next && octave.end >= octave.begin, "octaves overlap");
    next = octave.end;
    if (!octave.descriptors) continue;
    require_count(octave.descriptors->rows(), next - octave.begin, "descriptors");
    described += octave.descriptors->rows();
  }
  if (!features.octaves.empty()) require_count(next, features.points.rows(), "features in octaves");
  require_count(described, features.points.rows(), "descriptors");
}

/// Points lie in the bounding box, so within half its diagonal, give or take rounding.
void require_inside(const PointMatrix& points, const Model& model, const std::string& what) {
  const auto offsets = points.rowwise() - model.center.transpose();
  require(points.rows() == 0 || offsets.rowwise().norm().maxCoeff() <= 0.501F * model.diagonal,
          what + " lie outside of the bounding box");
}

void check_symmetries(const Symmetries& symmetries) {
  const auto is_unit = [](const auto& v) { return std::abs(v.norm() - 1) < 1e-3F; };
  require(symmetries.fixed_point.allFinite() && !symmetries.turns.empty() &&
              std::all_of(symmetries.turns.begin(), symmetries.turns.end(), is_unit) &&
              std::all_of(symmetries.axes.begin(), symmetries.axes.end(), is_unit),
          "a symmetry is no turn about a point");
}

void check_model(const Model& model) {
  require_length(model.diagonal, "the diagonal");
  require_length(model.resolution, "the resolution");
  require(model.center.allFinite(), "the centre is not finite");
  check_cloud(model.cloud);
  check_features(model.features);
  require_inside(model.cloud.points, model, "points");
  require_inside(model.features.points, model, "feature points");
  check_symmetries(model.symmetries);
  check_symmetries(model.shape_symmetries);
  for (const NearSymmetry& one : model.near_symmetries.items) {
    require(one.motion.matrix().allFinite() && one.motion.linear().isUnitary(1e-6),
            "a near symmetry is no motion");
    require(one.is_within(model.cloud.points.rows()),
            "a near symmetry names a point that is not there");
  }
  require_length(model.outline.reach, "the outline's reach");
  require_count(static_cast<Eigen::Index>(model.outline.ends.size()), model.cloud.points.rows(),
                "points in the outline");
  require_length(model.outline.gap_reach, "the gaps' reach");
  require_count(static_cast<Eigen::Index>(model.outline.gaps.size()), model.cloud.points.rows(),
                "points of gaps");
  const std::vector<std::uint32_t>& bends = model.outline.bends;
  if (!bends.empty())
    require_count(static_cast<Eigen::Index>(bends.size()), model.cloud.points.rows(),
                  "points of bends");
  require(std::ranges::all_of(bends, [&](std::uint32_t row) { return row < bends.size(); }),
          "a bend names a point that is not there");
  for (const auto& octave : model.coarser) {
    require(octave->resolution > model.resolution, "octaves do not ascend");
    check_model(*octave);
  }
}

}  // namespace

void check_library(const ModelLibrary& library) {
  require(!library.models.empty(), "there are no models");
  const Model* before = nullptr;
  for (const auto& model : library.models) {
    require(model != nullptr, "a model is missing");
    require(!before || before->obj_id < model->obj_id, "the models' obj_ids do not ascend");
    before = model.get();
    try {
      check_model(*model);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error("model '" + model->name + "': " + error.what());
    }
  }
}

}  // namespace posevote::library
