// SPDX-License-Identifier: BSD-3-Clause
#include "tools/symmetry_report.hpp"

#include <numbers>

#include "tools/text.hpp"

namespace posevote {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

std::string direction(const Eigen::Vector3d& axis) {
  const Eigen::Vector3d rounded = (axis * 1000).array().round() / 1000 + 0.0;  // of -0 makes 0
  return format("(%g %g %g)", rounded.x(), rounded.y(), rounded.z());
}

/// The share of the surface by which the two poses differ.
double share_that_tells(const NearSymmetry& near, const Model& model) {
  const auto differing = static_cast<double>(near.carried_off.size() + near.uncovered.size());
  return differing / (2 * static_cast<double>(model.cloud.points.rows()));
}

std::vector<double> numbers(const Eigen::Vector3f& vector) {
  return {double(vector.x()), double(vector.y()), double(vector.z())};
}

std::vector<double> row_by_row(const Eigen::Matrix3d& rotation) {
  const Eigen::Matrix3d transposed = rotation.transpose();
  return {transposed.data(), transposed.data() + transposed.size()};
}

std::string near_line(const NearSymmetry& near, const Model& model) {
  return "  near: " + turn_text(near.motion.linear()) +
         format("; %.0f %% of the surface tells\n", 100 * share_that_tells(near, model));
}

}  // namespace

std::string turn_text(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd about(rotation);
  return format("a turn of %.0f deg about ", about.angle() / kDegree) + direction(about.axis());
}

std::string symmetry_report(const Model& model) {
  const Symmetries& symmetries = model.symmetries;
  if (!symmetries.any() && model.near_symmetries.items.empty()) return "  no symmetry\n";
  const Eigen::Vector3d point = 1000 * symmetries.fixed_point.cast<double>();
  std::string text;
  if (symmetries.any())
    text += format("  about the point (%.1f %.1f %.1f) mm:\n", point.x(), point.y(), point.z());
  for (const Eigen::Vector3f& axis : symmetries.axes)
    text += "  any turn about " + direction(axis.cast<double>()) + "\n";
  for (std::size_t i = 1; i < symmetries.turns.size(); ++i)
    text +=
        "  " + turn_text(symmetries.turns[i].cast<double>().normalized().toRotationMatrix()) + "\n";
  for (const NearSymmetry& near : model.near_symmetries.items) text += near_line(near, model);
  return text;
}

nlohmann::ordered_json symmetry_json(const Model& model) {
  using nlohmann::ordered_json;
  const Symmetries& symmetries = model.symmetries;
  ordered_json axes = ordered_json::array(), turns = axes, nears = axes;
  for (const Eigen::Vector3f& axis : symmetries.axes) axes.push_back(numbers(axis));
  for (const Eigen::Quaternionf& turn : symmetries.turns)
    turns.push_back(row_by_row(turn.cast<double>().normalized().toRotationMatrix()));
  for (const NearSymmetry& near : model.near_symmetries.items)
    nears.push_back({{"turn", row_by_row(near.motion.linear())},
                     {"share_that_tells", share_that_tells(near, model)}});
  return {{"fixed_point_m", numbers(symmetries.fixed_point)},
          {"axes", axes},
          {"turns", turns},
          {"near", nears}};
}

}  // namespace posevote
