// SPDX-License-Identifier: BSD-3-Clause
#include "tools/init/candidates.hpp"

#include <algorithm>
#include <cmath>

#include "graph/parallel.hpp"
#include "nodes/formats/units.hpp"
#include "nodes/geometry/normals.hpp"
#include "nodes/geometry/viewpoint.hpp"

namespace posevote::init {
namespace {

struct Span {
  double low, high;
};
constexpr Span kModel{0.01, 2};      ///< diagonals of what people look for [m]
constexpr Span kScan{0.05, 30};      ///< and of what they scan [m]
constexpr Span kRatio{0.3, 100};     ///< scan / largest model
constexpr Span kPossible{0.2, 400};  ///< beyond, check_size refuses
constexpr double kSame = 0.02;       ///< of a ratio's logarithm

/// Decades outside of the span.
double outside(double size, const Span& usual) {
  if (!(size > 0)) return 100;
  return std::max({0.0, std::log10(usual.low / size), std::log10(size / usual.high)});
}

/// Depth scales that are mistaken for one another: TUM's 5000 to the metre, 10 000, tools that
/// write 1/4 or 1/8 mm, metres for millimetres.
constexpr double kDepthScales[] = {1, 0.2, 0.1, 5, 10, 1000, 0.25, 0.125, 4, 8, 0.001};

struct Candidate {
  Settings settings;
  double ratio = 0, penalty = 0;
};

double largest_of(const std::vector<ModelLook>& models) {
  double largest = 0;
  for (const ModelLook& model : models) largest = std::max(largest, model.diagonal);
  return largest;
}

void add(const Settings& settings, double model, double scan, double handicap,
         std::vector<Candidate>& all) {
  Candidate candidate{settings, scan / model, handicap};
  candidate.penalty +=
      outside(model, kModel) + outside(scan, kScan) + outside(candidate.ratio, kRatio);
  if (outside(candidate.ratio, kPossible) == 0) all.push_back(candidate);
}

/// The likeliest of each ratio.
std::vector<Settings> without_repeats(std::vector<Candidate> all) {
  std::stable_sort(all.begin(), all.end(),
                   [](const Candidate& a, const Candidate& b) { return a.penalty < b.penalty; });
  std::vector<Candidate> kept;
  for (const Candidate& candidate : all) {
    const auto is_same = [&](const Candidate& other) {
      return std::abs(std::log10(candidate.ratio / other.ratio)) < kSame;
    };
    if (std::none_of(kept.begin(), kept.end(), is_same)) kept.push_back(candidate);
  }
  std::vector<Settings> settings;
  for (const Candidate& candidate : kept) settings.push_back(candidate.settings);
  return settings;
}

/// The middle of a scan, and how far its points lie from it.
struct Ball {
  Eigen::Vector3f middle;
  float radius;
};

Ball ball_of(const PointMatrix& points) {
  const Eigen::Vector3f middle = points.colwise().mean().transpose();
  return {middle,
          std::sqrt((points.rowwise() - middle.transpose()).rowwise().squaredNorm().mean())};
}

struct Place {
  Eigen::Vector3f towards;
  double hidden = 1;
};

/// Some of a scan's points, evenly from all of it.
PointMatrix some_points(const PointMatrix& points) {
  constexpr Eigen::Index kMost = 40000;
  const Eigen::Index step = points.rows() / kMost + 1;
  return points(Eigen::seq(0, points.rows() - 1, step), Eigen::all);
}

/// What is hidden from places all around the points.
std::vector<Place> places_around(const PointMatrix& points, const Ball& ball, float distance) {
  constexpr int kPlaces = 60;
  std::vector<Place> places(kPlaces);
  graph::parallel_for(kPlaces, 1, [&](std::size_t i) {
    const double z = 1 - (2.0 * static_cast<double>(i) + 1) / kPlaces;
    const double around = 2.399963 * static_cast<double>(i);  // the golden angle
    const double r = std::sqrt(1 - z * z);
    places[i].towards =
        Eigen::Vector3d(r * std::cos(around), r * std::sin(around), z).cast<float>();
    const Eigen::Vector3f place = ball.middle + distance * ball.radius * places[i].towards;
    // Which way the surface looks is not known: let all of it look here, and see what hides what.
    Mesh facing{points, (-points).rowwise() + place.transpose(), {}};
    geometry::normalise(facing.normals);
    places[i].hidden = geometry::share_hidden(facing, place);
  });
  return places;
}

}  // namespace

std::vector<Settings> likely_settings(const std::vector<ModelLook>& models, const ScanLook& scan,
                                      const Settings& given) {
  // Where sizes leave it open, what the pipeline takes without being told.
  constexpr double kUntold = 0.01, kOtherScale = 0.02, kRareUnit = 0.3;
  const double largest = largest_of(models);
  std::vector<Candidate> all;
  const std::string model_unit = formats::likely_unit(largest, 10).unit;
  const std::string scene_unit = formats::likely_unit(scan.diagonal, 30).unit;
  const auto rarity = [&](const std::string& unit, const std::string& untold) {
    return unit == untold ? 0 : unit == "m" || unit == "mm" ? kUntold : kRareUnit;
  };
  for (const std::string& model : formats::length_units()) {
    Settings settings = given;
    settings.model_unit = model;
    const double size = largest * formats::metres_per(model);
    const double handicap = rarity(model, model_unit);
    if (scan.is_depth)
      for (const double scale : kDepthScales) {
        settings.camera->depth_scale = given.camera->depth_scale * scale;
        add(settings, size, scan.diagonal * settings.camera->depth_scale,
            handicap + (scale == 1 ? 0 : kOtherScale), all);
      }
    else
      for (const std::string& unit : formats::length_units()) {
        settings.scene_unit = unit;
        add(settings, size, scan.diagonal * formats::metres_per(unit),
            handicap + rarity(unit, scene_unit), all);
      }
  }
  return without_repeats(std::move(all));
}

std::vector<Eigen::Vector3d> likely_sensors(const Scan& scan) {
  constexpr float kDistance = 4;  // x radius
  constexpr double kSeen = 0.03, kAlike = 0.01;
  constexpr float kNear = 0.5F, kApart = 0.2F;  // cosines
  constexpr std::size_t kMost = 3;
  const PointMatrix points = some_points(scan.points);
  const Ball ball = ball_of(points);
  std::vector<Place> places = places_around(points, ball, kDistance);
  std::vector<Eigen::Vector3d> sensors;
  while (sensors.size() < kMost && !places.empty()) {
    const Place best =
        *std::min_element(places.begin(), places.end(),
                          [](const Place& a, const Place& b) { return a.hidden < b.hidden; });
    if (best.hidden > kSeen) break;
    Eigen::Vector3f towards = Eigen::Vector3f::Zero();
    for (const Place& place : places)
      if (place.hidden <= best.hidden + kAlike && place.towards.dot(best.towards) > kNear)
        towards += place.towards;
    const Eigen::Vector3f at = ball.middle + kDistance * ball.radius * towards.normalized();
    sensors.push_back(at.cast<double>());
    std::erase_if(places, [&](const Place& place) {
      return place.towards.dot(towards.normalized()) > kApart;
    });
  }
  return sensors;
}

}  // namespace posevote::init
