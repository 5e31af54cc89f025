// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/layouts/models_info.hpp"

#include <stdexcept>

#include "nodes/geometry/rotation.hpp"
#include "nodes/layouts/files.hpp"

namespace posevote::layouts {
namespace {

using nlohmann::json;

Eigen::Isometry3d read_symmetry(const json& list) {
  const std::vector<double> m = numbers(list, 16, "symmetries_discrete");
  return geometry::make_pose({m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]},
                             Eigen::Vector3d(m[3], m[7], m[11]) * kMetresPerUnit);
}

SymmetryAxis read_axis(const json& symmetry) {
  SymmetryAxis axis;
  axis.direction = metres(symmetry.at("axis"), "axis").normalized();
  if (symmetry.contains("offset")) axis.offset = metres(symmetry.at("offset"), "offset");
  if (!axis.direction.allFinite() || axis.direction.isZero() || !axis.offset.allFinite())
    throw std::invalid_argument("the axis of a symmetry has no direction");
  return axis;
}

/// What BOP lists is a whole group, so the mean of where it carries a point stays where it is.
Symmetries symmetries_of(const std::vector<Eigen::Isometry3d>& motions,
                         const std::vector<SymmetryAxis>& axes) {
  Symmetries found;
  found.turns.clear();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Isometry3d& motion : motions) {
    found.turns.emplace_back(Eigen::Quaterniond(motion.linear()).cast<float>());
    sum += motion * (axes.empty() ? Eigen::Vector3d::Zero() : axes[0].offset);
  }
  found.fixed_point = (sum / static_cast<double>(motions.size())).cast<float>();
  for (const SymmetryAxis& axis : axes) found.axes.push_back(axis.direction.cast<float>());
  return found;
}

}  // namespace

std::vector<Eigen::Isometry3d> read_symmetries(const json& info) {
  std::vector<Eigen::Isometry3d> symmetries{Eigen::Isometry3d::Identity()};
  for (const json& matrix : info.value("symmetries_discrete", json::array()))
    symmetries.push_back(read_symmetry(matrix));
  return symmetries;
}

std::vector<SymmetryAxis> read_axes(const json& info) {
  std::vector<SymmetryAxis> axes;
  for (const json& axis : info.value("symmetries_continuous", json::array()))
    axes.push_back(read_axis(axis));
  return axes;
}

std::map<int, Symmetries> known_symmetries(const std::filesystem::path& models_info) {
  std::map<int, Symmetries> known;
  if (!std::filesystem::exists(models_info)) return known;
  const json root = read_json(models_info);
  for (const auto& item : root.items()) {
    const json& info = item.value();
    const int obj_id = number_of(item.key());
    if (obj_id < 0) fail(models_info, formats::shown(item.key()) + " is no obj_id");
    located(models_info, "object " + item.key(), [&] {
      if (!info.is_object()) throw std::invalid_argument("is no JSON object");
      if (info.contains("symmetries_discrete") || info.contains("symmetries_continuous"))
        known[obj_id] = symmetries_of(read_symmetries(info), read_axes(info));
    });
  }
  return known;
}

}  // namespace posevote::layouts
