// SPDX-License-Identifier: BSD-3-Clause
#include "tools/experiment/correspondence_quality.hpp"

#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>

namespace posevote {
namespace {

constexpr std::size_t kColumns = 15;  // obj_id, distance, ratio, 4 x 3 coordinates

std::array<double, kColumns> parse_row(const std::string& line, const std::string& where) {
  std::array<double, kColumns> row{};
  std::istringstream stream(line);
  for (std::size_t i = 0; i < kColumns; ++i) {
    char comma = ',';
    if (i > 0) stream >> comma;
    if (!(stream >> row[i]) || comma != ',')
      throw std::runtime_error(where + ": expected " + std::to_string(kColumns) +
                               " numbers, separated by commas");
  }
  return row;
}

}  // namespace

CorrespondenceJudge::CorrespondenceJudge(Cloud model, double radius)
    : model_(std::move(model)),
      radius_(radius),
      index_(model_.points, static_cast<float>(2 * radius)) {}

CorrespondenceQuality CorrespondenceJudge::judge(const std::filesystem::path& csv,
                                                 const Eigen::Isometry3d& T_scene_model) const {
  std::ifstream stream(csv);
  std::string line;
  if (!std::getline(stream, line)) throw std::runtime_error(csv.string() + ": cannot be read");
  CorrespondenceQuality quality;
  const Eigen::Isometry3d T_model_scene = T_scene_model.inverse();
  std::size_t inliers = 0, compared = 0;
  double degrees = 0;
  for (int number = 2; std::getline(stream, line); ++number) {
    const auto row = parse_row(line, csv.string() + ":" + std::to_string(number));
    const Eigen::Map<const Eigen::Matrix<double, 3, 4>> columns(row.data() + 3);
    const Eigen::Vector3d scene = T_model_scene * Eigen::Vector3d(columns.col(0));
    const Eigen::Vector3d normal = T_model_scene.linear() * columns.col(1);
    ++quality.count;
    inliers += (scene - columns.col(2)).norm() <= radius_;
    const auto near = index_.nearest(scene.cast<float>(), static_cast<float>(2 * radius_));
    if (!near) continue;
    const Eigen::Vector3d truth = model_.normals.row(near.index).transpose().cast<double>();
    if (truth.isZero()) continue;
    ++compared;
    degrees += std::atan2(normal.cross(truth).norm(), normal.dot(truth)) * 180 / std::numbers::pi;
  }
  const auto share = [](double part, std::size_t whole) {
    return whole > 0 ? part / static_cast<double>(whole) : 0;
  };
  quality.inlier_rate = share(static_cast<double>(inliers), quality.count);
  quality.normal_deg = share(degrees, compared);
  return quality;
}

}  // namespace posevote
