// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/prepare/image_normals.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include "nodes/geometry/plane_fit.hpp"
#include "nodes/geometry/plane_normals.hpp"
#include "tests/support/shapes.hpp"

namespace posevote::image_normals_test {
namespace {

constexpr int kColumns = 161, kRows = 121;  // odd: blocks of pixels end beside the image
constexpr float kFocal = 500;
constexpr float kRadius = 0.009F;

/// What a camera sees of z = depth(x / z, y / z); 0: nothing.
Scan image_of(const std::function<float(float, float)>& depth) {
  Scan scan;
  std::vector<Eigen::Vector3f> points;
  const Eigen::Vector2f half(0.5F * kColumns / kFocal, 0.5F * kRows / kFocal);
  for (int v = 0; v < kRows; ++v)
    for (int u = 0; u < kColumns; ++u) {
      const float x = (static_cast<float>(u) + 0.5F) / kFocal - half.x();
      const float y = (static_cast<float>(v) + 0.5F) / kFocal - half.y();
      if (const float z = depth(x, y); z > 0) points.emplace_back(x * z, y * z, z);
    }
  scan.points.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    scan.points.row(static_cast<Eigen::Index>(i)) = points[i];
  scan.view.image = {Eigen::Vector2f(-half), half};
  scan.view.pixels = {kColumns, kRows};
  return scan;
}

/// A ball of 6 cm, 0.7 m away, before a wall at 0.9 m.
float ball_and_wall(float x, float y) {
  const Eigen::Vector3f ray(x, y, 1), center(0, 0, 0.7F);
  const float along = ray.dot(center) / ray.squaredNorm();
  const float squared = 0.06F * 0.06F - (along * ray - center).squaredNorm();
  return squared > 0 ? along - std::sqrt(squared / ray.squaredNorm()) : 0.9F;
}

PointMatrix normals_of(const Scan& scan) {
  const auto normals = prepare::image_normals(scan, kRadius, 6, 5);
  REQUIRE(normals);
  REQUIRE(normals->rows() == scan.points.rows());
  return *normals;
}

}  // namespace

TEST_CASE("image_normals finds those of a ball and of the wall behind it", "[prepare]") {
  const Scan scan = image_of(ball_and_wall);
  const PointMatrix normals = normals_of(scan);
  std::vector<float> ball, wall;
  for (Eigen::Index i = 0; i < scan.points.rows(); ++i) {
    const Eigen::Vector3f p = scan.points.row(i), from_center = p - Eigen::Vector3f(0, 0, 0.7F);
    const Eigen::Vector3f normal = normals.row(i);
    if (p.z() == 0.9F)
      wall.push_back(std::abs(normal.z()));
    else if (from_center.normalized().z() < -0.7F)
      ball.push_back(std::abs(normal.dot(from_center.normalized())));
  }
  REQUIRE(ball.size() > 1000);
  // Blocks of two by two pixels, 1.4 mm apart on a radius of 60 mm, share a normal.
  CHECK(*std::min_element(ball.begin(), ball.end()) > std::cos(0.03F));
  CHECK(*std::min_element(wall.begin(), wall.end()) > 0.9999F);  // also beside the ball's edge
}

TEST_CASE("image_normals agrees with planes by search, noise and holes included", "[prepare]") {
  Scan scan = image_of([](float x, float y) {
    const auto cell = static_cast<int>(1000 * (x + 1)) * 7 + static_cast<int>(1000 * (y + 1)) * 13;
    return cell % 5 == 0 ? 0 : ball_and_wall(x, y);
  });
  const PointMatrix noise = test::shaken(PointMatrix::Zero(scan.points.rows(), 3), 0.001F);
  scan.points.array().colwise() *= 1 + noise.col(0).array();  // along the rays
  const PointMatrix by_search = geometry::suitable_planes(scan.points, kRadius, 6)->normals(5);
  const PointMatrix by_pixels = normals_of(scan);
  std::ptrdiff_t alike = 0;
  for (Eigen::Index i = 0; i < by_pixels.rows(); ++i)
    alike += std::abs(by_pixels.row(i).dot(by_search.row(i))) > 0.99F;
  CHECK(static_cast<double>(alike) > 0.95 * static_cast<double>(by_pixels.rows()));
}

TEST_CASE("image_normals mixes none into what is off the ground", "[prepare]") {
  // A ridge three pixels wide between the corners of tiles, before the wall, its top sloping.
  const auto is_ridge = [](float x) {
    const auto u = static_cast<int>(std::lround(x * kFocal + 0.5F * kColumns - 0.5F));
    return u >= 81 && u <= 83;
  };
  const Scan wall =
      image_of([&](float x, float y) { return is_ridge(x) ? 0.65F + 0.3F * y : 0.7F; });
  const PointMatrix of_wall = normals_of(wall);
  for (Eigen::Index i = 0; i < wall.points.rows(); ++i)
    if (is_ridge(wall.points(i, 0) / wall.points(i, 2))) REQUIRE(std::abs(of_wall(i, 2)) < 0.95F);
}

TEST_CASE("image_normals does not mind the order of the points", "[prepare]") {
  const Scan scan = image_of(ball_and_wall);
  const std::vector<Eigen::Index> order = test::shuffled(scan.points.rows());
  Scan mixed = scan;
  mixed.points = scan.points(order, Eigen::all);
  const PointMatrix expected = normals_of(scan)(order, Eigen::all);
  CHECK((normals_of(mixed).array() == expected.array()).all());
}

TEST_CASE("image_normals leaves to others what is no image, or too fine", "[prepare]") {
  const Scan scan = image_of(ball_and_wall);
  const auto refused = [](Scan other, float radius = kRadius) {
    return !prepare::image_normals(other, radius, 6, 5);
  };
  CHECK(!refused(scan));
  CHECK(refused(scan, 0.1F));  // 70 pixels
  Scan other = scan;
  other.view.pixels.setZero();
  CHECK(refused(other));
  other = scan;
  other.view.image.setEmpty();
  CHECK(refused(other));
  other = scan;
  other.points.row(3) << 5, 0, 1;  // beside the image
  CHECK(refused(other));
  other.points.row(3) = 1.01F * scan.points.row(4);  // in one pixel with another
  CHECK(refused(other));
  CHECK(refused(Scan{}));
}

TEST_CASE("image_normals leaves near ground before a far one to others", "[prepare]") {
  const auto with_near = [](int of_ten) {
    return image_of([of_ten](float x, float) {
      return static_cast<int>(1000 * (x + 1)) % 10 < of_ten ? 0.06F : 3.0F;
    });
  };
  CHECK(!prepare::image_normals(with_near(4), kRadius, 6, 5));  // thousands of pixels a window
  CHECK(prepare::image_normals(with_near(0), kRadius, 6, 5));
}

TEST_CASE("samples follow no columns", "[prepare]") {
  const std::vector<std::size_t> sample = geometry::sample_of(std::size_t{1280} * 1000);
  REQUIRE(sample.size() >= 1000);
  std::set<std::size_t> columns;
  for (const std::size_t i : sample) columns.insert(i % 1280);
  CHECK(columns.size() > 500);
  CHECK(std::is_sorted(sample.begin(), sample.end()));
  CHECK(sample.back() < std::size_t{1280} * 1000);
  CHECK(geometry::sample_of(3) == std::vector<std::size_t>{0, 1, 2});
  CHECK(geometry::sample_of(0).empty());
}

TEST_CASE("image_normals takes points that are not finite, and those right before the camera",
          "[prepare]") {
  Scan scan = image_of(ball_and_wall);
  scan.points.row(5).setConstant(std::numeric_limits<float>::quiet_NaN());
  scan.points.row(9) *= 0.004F;
  const PointMatrix normals = normals_of(scan);
  CHECK(normals.row(5).isZero());
  CHECK(normals.row(9).isZero());  // nothing near it
  CHECK(std::abs(normals(400, 2)) > 0.999F);
}

}  // namespace posevote::image_normals_test
