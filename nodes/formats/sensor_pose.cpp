// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/sensor_pose.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "nodes/formats/text_scanner.hpp"

namespace posevote::formats {
namespace {

constexpr double kRounding = 0.01;  // people write rotations with two or three digits

std::string text_of(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

Eigen::Matrix3d rotation_of_quaternion(const std::vector<double>& n) {
  const Eigen::Quaterniond q(n[6], n[3], n[4], n[5]);
  if (std::abs(q.norm() - 1) > kRounding)
    throw std::runtime_error("the quaternion qx qy qz qw has the length " + text_of(q.norm()) +
                             ", expected 1");
  return q.normalized().toRotationMatrix();
}

Eigen::Matrix3d rotation_of_matrix(const Eigen::Matrix4d& matrix) {
  const Eigen::RowVector4d last = matrix.row(3);
  if (!last.isApprox(Eigen::RowVector4d(0, 0, 0, 1), 1e-6))
    throw std::runtime_error("the last row of the matrix is " + text_of(last[0]) + " " +
                             text_of(last[1]) + " " + text_of(last[2]) + " " + text_of(last[3]) +
                             ", expected 0 0 0 1: 16 numbers go row by row");
  const Eigen::Matrix3d R = matrix.topLeftCorner<3, 3>();
  const double off = (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (off > kRounding)
    throw std::runtime_error(
        "the upper left 3 x 3 numbers are no rotation: R times its transpose is " + text_of(off) +
        " off the identity");
  if (R.determinant() < 0)
    throw std::runtime_error(
        "the upper left 3 x 3 numbers mirror (determinant -1), expected a rotation");
  return Eigen::Quaterniond(R).normalized().toRotationMatrix();
}

}  // namespace

std::vector<double> read_pose_numbers(std::string_view text) {
  std::string plain(text);
  std::replace_if(
      plain.begin(), plain.end(),
      [](char c) { return std::string_view(",;[](){}").find(c) != std::string_view::npos; }, ' ');
  std::vector<double> numbers;
  TextScanner in(plain, '#');
  while (in.next_line())
    while (!in.line_done()) numbers.push_back(in.number());
  return numbers;
}

Eigen::Isometry3d sensor_pose(const std::vector<double>& numbers) {
  const std::size_t count = numbers.size();
  if (count != 3 && count != 7 && count != 16)
    throw std::runtime_error("the sensor's pose has " + std::to_string(count) +
                             " numbers, expected 3 (x y z), 7 (x y z qx qy qz qw) or 16 (a 4 x 4 "
                             "matrix row by row)");
  for (std::size_t i = 0; i < count; ++i)
    if (!std::isfinite(numbers[i]))
      throw std::runtime_error("number " + std::to_string(i + 1) + " of the sensor's pose is " +
                               text_of(numbers[i]) + ", expected finite ones");
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << numbers[0], numbers[1], numbers[2];
  if (count == 7) pose.linear() = rotation_of_quaternion(numbers);
  if (count != 16) return pose;
  const Eigen::Matrix4d matrix =
      Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data());
  pose.linear() = rotation_of_matrix(matrix);
  pose.translation() = matrix.topRightCorner<3, 1>();
  return pose;
}

std::filesystem::path pose_file_of(const std::filesystem::path& scan) {
  return std::filesystem::path(scan).replace_extension(".pose");
}

}  // namespace posevote::formats
