// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/prepare/image_normals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "graph/parallel.hpp"
#include "nodes/geometry/cells.hpp"
#include "nodes/geometry/plane_fit.hpp"
#include "nodes/prepare/image_tile.hpp"

namespace posevote::prepare {
namespace {

constexpr float kNowhere = 1e9F;       // no measurement; finite, so that times 0 it is 0
constexpr float kMostSpacings = 12;    // in a radius: more than a plane needs
constexpr float kTogether = 1.0F / 3;  // of the radius, between pixels that share a plane
// Pixels of a window, on average: near points before a far ground have large ones.
constexpr float kMostPixels = 4 * (2 * kMostSpacings) * (2 * kMostSpacings);
// On smooth ground only the corners of tiles get planes of their own (image_tile.hpp): half the
// time, and no more off than noise makes it, for a window is three tiles wide.
constexpr int kTile = 4;  // pixels

/// A point of the cloud and its pixel.
struct Place {
  std::uint32_t point, pixel;
};

/// A depth image as an array of points.
class PixelPlanes {
 public:
  explicit PixelPlanes(const Scan& scan)
      : width_(scan.view.pixels.x()),
        height_(scan.view.pixels.y()),
        viewpoint_(scan.view.origin),
        low_(scan.view.image.min()),
        per_ray_(scan.view.pixels.cast<float>().cwiseQuotient(scan.view.image.sizes())) {
    const std::size_t size = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    for (auto* column : {&x_, &y_, &z_}) column->assign(size + geometry::kGridPadding, kNowhere);
    weights_.assign(size + geometry::kGridPadding, 0);
    point_in_.resize(size);
    find_places(scan.points);
    const auto no_order = [](const Place& a, const Place& b) { return a.pixel >= b.pixel; };
    complete_ = (places_.empty() || places_.back().pixel != kOutside) &&
                std::adjacent_find(places_.begin(), places_.end(), no_order) == places_.end();
    if (complete_) put_all(scan.points);
  }

  /// Whether every point is in the image, and no two in one pixel.
  bool complete() const { return complete_; }
  /// All points, in the order of their pixels.
  const std::vector<Place>& places() const { return places_; }

  /// The typical distance between points side by side [m].
  float spacing() const {
    std::vector<float> distances;
    for (const std::size_t i : geometry::sample_of(places_.size())) {
      const std::uint32_t pixel = places_[i].pixel;
      float nearest = kNowhere;
      for (const std::uint32_t step : {1U, static_cast<std::uint32_t>(width_)}) {
        if (pixel >= step) nearest = std::min(nearest, distance(pixel, pixel - step));
        nearest = std::min(nearest, distance(pixel, pixel + step));
      }
      if (nearest < kNowhere / 2) distances.push_back(nearest);
    }
    return geometry::upper_median(std::move(distances));
  }

  /// Pixels that a plane looks at, on average.
  float window_size(float radius) const {
    const std::vector<std::size_t> sample = geometry::sample_of(places_.size());
    std::vector<geometry::GridRun> rows;
    double sum = 0;
    for (const std::size_t i : sample) {
      find_window(point(places_[i].pixel), radius, rows);
      sum += static_cast<double>(rows.size()) * (rows.front().end - rows.front().begin);
    }
    return static_cast<float>(sum / static_cast<double>(sample.size()));
  }

  geometry::Plane fit(const Eigen::Vector3f& place, float radius, int min_neighbours) const {
    thread_local std::vector<geometry::GridRun> around;
    find_window(place, radius, around);
    return geometry::plane_of(
        geometry::plane_moments({x_.data(), y_.data(), z_.data(), weights_.data()}, around.data(),
                                around.size(), place.data(), radius),
        radius, min_neighbours);
  }

  Eigen::Vector3f point(std::uint32_t pixel) const { return {x_[pixel], y_[pixel], z_[pixel]}; }

  /// Normals of all points, `count` with those that are not finite.
  PointMatrix normals(Eigen::Index count, float radius, int min_neighbours) const {
    PointMatrix normals = PointMatrix::Zero(count, 3);
    const int columns = (width_ - 1) / kTile + 1, rows = (height_ - 1) / kTile + 1;
    const std::vector<Tile::Patch> corners = tile_corners(columns, rows, radius, min_neighbours);
    graph::parallel_for(static_cast<std::size_t>(rows), 1, [&](std::size_t row) {
      const int down = std::min(kTile, height_ - 1 - kTile * static_cast<int>(row));
      for (int column = 0; column < columns; ++column) {
        const auto upper =
            corners.begin() + static_cast<std::ptrdiff_t>(row) * (columns + 1) + column;
        const auto lower = upper + columns + 1;
        const Tile tile({upper[0], upper[1], lower[0], lower[1]}, radius);
        const bool smooth = tile.is_smooth();
        const int across = std::min(kTile, width_ - 1 - kTile * column);  // at the border less
        for (int dv = 0; dv < kTile; dv += 2)
          for (int du = 0; du < kTile; du += 2) {
            const Block block = block_at(kTile * column + du, kTile * static_cast<int>(row) + dv);
            const Tile::Patch mean = tile.at(middle_of(du, across), middle_of(dv, down));
            if (!(smooth && take_normal(block, tile, mean, normals)))
              fit_block(block, radius, min_neighbours, normals);
          }
      }
    });
    return normals;
  }

 private:
  std::uint32_t pixel_at(int u, int v) const { return static_cast<std::uint32_t>(v * width_ + u); }

  static constexpr std::uint32_t kOutside = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t pixel_of_point(const Eigen::Vector3f& point) const {
    const Eigen::Vector3f ray = point - viewpoint_;
    const Eigen::Vector2f at = (ray.head<2>() / ray.z() - low_).cwiseProduct(per_ray_);
    const bool inside = ray.z() > 0 && at.minCoeff() >= 0 && at.x() < static_cast<float>(width_) &&
                        at.y() < static_cast<float>(height_);
    return inside ? pixel_at(static_cast<int>(at.x()), static_cast<int>(at.y())) : kOutside;
  }

  /// In the order of their pixels, so that the order of the points plays no part in a sample.
  void find_places(const PointMatrix& points) {
    const std::vector<std::uint32_t> rows = geometry::finite_rows(points);
    places_.resize(rows.size());
    graph::parallel_for(rows.size(), 8192, [&](std::size_t i) {
      places_[i] = {rows[i], pixel_of_point(points.row(rows[i]))};
    });
    const auto by_pixel = [](const Place& a, const Place& b) { return a.pixel < b.pixel; };
    if (!std::is_sorted(places_.begin(), places_.end(), by_pixel))
      std::sort(places_.begin(), places_.end(), by_pixel);
  }

  void put_all(const PointMatrix& points) {
    graph::parallel_for(places_.size(), 8192, [&](std::size_t k) {
      const auto [i, pixel] = places_[k];
      x_[pixel] = points(i, 0);
      y_[pixel] = points(i, 1);
      z_[pixel] = points(i, 2);
      weights_[pixel] = 1;
      point_in_[pixel] = i;
    });
  }

  /// The distance of two pixels, the second of which may be outside or without a measurement.
  float distance(std::uint32_t a, std::uint32_t b) const {
    if (b >= weights_.size() || weights_[b] == 0) return kNowhere;
    return (point(a) - point(b)).norm();
  }

  /// The pixels that a ball may cover. With d in the ball and r the ray x / z, the pixel moves by
  /// (d_x - r d_z) / (z + d_z), which is at most radius sqrt(1 + r^2) / (z - radius).
  void find_window(const Eigen::Vector3f& place, float radius,
                   std::vector<geometry::GridRun>& rows) const {
    rows.clear();
    const Eigen::Vector3f ray = place - viewpoint_;
    const Eigen::Vector2f r = ray.head<2>() / ray.z();
    Eigen::Vector2f reach = Eigen::Vector2f::Constant(kNowhere);
    if (ray.z() > 1.001F * radius)
      reach = (1.001F * radius / (ray.z() - radius)) * (1 + r.array().square()).sqrt();
    const Eigen::Vector2f size(static_cast<float>(width_ - 1), static_cast<float>(height_ - 1));
    const auto pixel_of = [&](const Eigen::Vector2f& at) -> Eigen::Vector2i {
      const Eigen::Vector2f pixel = (at - low_).cwiseProduct(per_ray_);
      return pixel.cwiseMax(0).cwiseMin(size).cast<int>();
    };
    const Eigen::Vector2i first = pixel_of(r - reach), last = pixel_of(r + reach);
    for (int v = first.y(); v <= last.y(); ++v)
      rows.push_back({pixel_at(first.x(), v), pixel_at(last.x(), v) + 1});
  }

  /// The corners of all tiles, a row and a column more than tiles; those behind the image's border
  /// are on it.
  std::vector<Tile::Patch> tile_corners(int columns, int rows, float radius,
                                        int min_neighbours) const {
    std::vector<Tile::Patch> corners(static_cast<std::size_t>((columns + 1) * (rows + 1)));
    graph::parallel_for(corners.size(), 64, [&](std::size_t i) {
      const int number = static_cast<int>(i);
      const int column = number % (columns + 1), row = number / (columns + 1);
      const std::uint32_t pixel =
          pixel_at(std::min(kTile * column, width_ - 1), std::min(kTile * row, height_ - 1));
      if (weights_[pixel] == 0) return;
      const Eigen::Vector3f place = point(pixel);
      const Eigen::Vector3f normal = fit(place, radius, min_neighbours).normal;
      const float side = normal.dot(viewpoint_ - place) < 0 ? -1 : 1;
      corners[i] = {place, side * normal};
    });
    return corners;
  }

  /// Where the middle of a block's two pixels lies in a tile of that size; 0 to 1.
  static float middle_of(int first, int size) {
    return std::min(1.0F,
                    (static_cast<float>(first) + 0.5F) / static_cast<float>(std::max(1, size)));
  }

  /// The pixels with a measurement of 2 x 2.
  struct Block {
    std::array<std::uint32_t, 4> pixels{};
    std::size_t count = 0;
  };

  Block block_at(int u, int v) const {
    Block block;
    for (int j = v; j < std::min(v + 2, height_); ++j)
      for (int i = u; i < std::min(u + 2, width_); ++i)
        if (const std::uint32_t pixel = pixel_at(i, j); weights_[pixel] != 0)
          block.pixels[block.count++] = pixel;
    return block;
  }

  /// False where the block is off the tile's ground.
  bool take_normal(const Block& block, const Tile& tile, const Tile::Patch& ground,
                   PointMatrix& normals) const {
    for (std::size_t i = 0; i < block.count; ++i)
      if (!tile.is_flush(point(block.pixels[i]), ground)) return false;
    for (std::size_t i = 0; i < block.count; ++i)
      normals.row(point_in_[block.pixels[i]]) = ground.normal;
    return true;
  }

  void fit_block(const Block& block, float radius, int min_neighbours, PointMatrix& normals) const {
    std::array<std::uint32_t, 4> left = block.pixels;
    const auto begin = left.begin();
    for (auto end = begin + static_cast<std::ptrdiff_t>(block.count); end != begin;) {
      // Those of one surface with the last go to the end.
      const Eigen::Vector3f last = point(*(end - 1));
      const auto group = std::partition(begin, end, [&](std::uint32_t pixel) {
        return (point(pixel) - last).norm() > kTogether * radius;
      });
      Eigen::Vector3f middle = Eigen::Vector3f::Zero();
      for (auto p = group; p != end; ++p) middle += point(*p) / static_cast<float>(end - group);
      const Eigen::Vector3f normal = fit(middle, radius, min_neighbours).normal;
      for (auto p = group; p != end; ++p) normals.row(point_in_[*p]) = normal;
      end = group;
    }
  }

  int width_, height_;
  Eigen::Vector3f viewpoint_;
  Eigen::Vector2f low_, per_ray_;  ///< first pixel's border; pixels in a unit of x / z and y / z
  std::vector<float> x_, y_, z_, weights_;  ///< row by row, padded; weight 0: no measurement
  std::vector<std::uint32_t> point_in_;     ///< each pixel with one
  std::vector<Place> places_;
  bool complete_ = false;
};

}  // namespace

std::optional<PointMatrix> image_normals(const Scan& scan, float smallest, float spacings,
                                         int min_neighbours) {
  if (scan.view.pixels.minCoeff() < 1 || scan.view.image.isEmpty()) return std::nullopt;
  const PixelPlanes planes(scan);
  if (!planes.complete()) return std::nullopt;
  const float spacing = planes.spacing();
  if (!(spacing > 0)) return std::nullopt;
  const float start = std::max(smallest, spacings * spacing);
  const auto is_quick = [&](float radius) {
    return radius <= kMostSpacings * spacing && planes.window_size(radius) <= kMostPixels;
  };
  const auto& places = planes.places();
  const float radius = geometry::suitable_radius(start, [&](float tried) {
    if (!is_quick(tried)) return 0.0F;  // no need to go on
    return geometry::typical_thickness(places.size(), [&](std::size_t i, int least) {
      return planes.fit(planes.point(places[i].pixel), tried, least);
    });
  });
  if (!is_quick(radius)) return std::nullopt;
  return planes.normals(scan.points.rows(), radius, min_neighbours);
}

}  // namespace posevote::prepare
