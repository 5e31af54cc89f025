// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/simulate.hpp"

#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <numbers>
#include <stdexcept>

#include "graph/parallel.hpp"
#include "tools/simulate/bop_writer.hpp"
#include "tools/simulate/color_camera.hpp"
#include "tools/simulate/own_mesh.hpp"
#include "tools/simulate/painted_symmetry.hpp"
#include "tools/simulate/physics.hpp"
#include "tools/simulate/scanner.hpp"
#include "tools/simulate/scene.hpp"
#include "tools/simulate/sensor_file.hpp"
#include "tools/simulate/shapes.hpp"
#include "tools/simulate/spec.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;

constexpr double kTableSide = 1.2;      // at least [m]
constexpr double kTableRadii = 4;       // x radius, at least
constexpr double kTargetHeight = 0.05;  // the sensor looks at what lies on the ground [m]
constexpr double kNearest = 0.3;        // from nearer it looks lower [m]
constexpr int kArrangements = 100;      // tried for one image, before giving up
constexpr std::size_t kClutter = 12;    // different bodies that are no models

using SharedMesh = std::shared_ptr<const Mesh>;

/// What all images share.
struct Studio {
  Spec spec;
  std::vector<SharedMesh> models, clutter;
  std::vector<std::shared_ptr<const Paint>> paints, clutter_paints;  ///< none without colours
  std::map<std::string, Sensor> sensors;                             ///< as scenes call them
};

SharedMesh make_model(const ModelSpec& model) {
  if (!model.file.empty())
    return std::make_shared<const Mesh>(read_own_mesh(model.file, model.unit));
  const auto seed = static_cast<std::uint64_t>(model.seed);
  return std::make_shared<const Mesh>(
      model.x > 0 ? make_shape(model.shape, seed, Eigen::Vector3d(model.x, model.y, model.z))
                  : make_shape(model.shape, seed, model.size));
}

ShapeSymmetry symmetry_of_model(const ModelSpec& model, const Mesh& mesh) {
  return model.file.empty() ? symmetry_of(model.shape) : find_symmetry(mesh, model.file);
}

/// Of the next seed that makes one.
Mesh make_any(const std::string& shape, Random& random, double size) {
  try {
    return make_shape(shape, random.next(), size);
  } catch (const TooThin&) {
    return make_any(shape, random, size);
  }
}

/// Bodies of kinds that no model is of, as long as there are such kinds.
std::vector<SharedMesh> make_clutter(const Spec& spec) {
  std::vector<std::string> kinds = fine_shape_names();
  for (const ModelSpec& model : spec.models) std::erase(kinds, model.shape);
  if (kinds.empty()) kinds = fine_shape_names();
  std::vector<SharedMesh> clutter(kClutter);
  graph::parallel_for(kClutter, 1, [&](std::size_t i) {
    Random random(static_cast<std::uint64_t>(spec.seed), ~std::uint64_t{i});  // no image's stream
    const double size = random.uniform(0.08, 0.2) * (spec.clutter_size / 0.2);
    clutter[i] = std::make_shared<const Mesh>(make_any(kinds[i % kinds.size()], random, size));
  });
  return clutter;
}

/// Paints are chosen by streams of their own, so that a set in colour has the same geometry.
void mix_paints(Studio& studio) {
  const auto seed = static_cast<std::uint64_t>(studio.spec.seed);
  for (std::size_t i = 0; i < studio.models.size(); ++i) {
    const ModelSpec& model = studio.spec.models[i];
    studio.paints.push_back(std::make_shared<const Paint>(
        *studio.models[i], model.shape, Random(seed, std::uint64_t{i} << 32U).next()));
  }
  for (std::size_t i = 0; i < studio.clutter.size(); ++i)
    studio.clutter_paints.push_back(std::make_shared<const Paint>(
        *studio.clutter[i], "", Random(seed, (std::uint64_t{i} + 1) << 48U).next()));
}

Studio open_studio(const Spec& spec) {
  Studio studio{spec, {}, {}, {}, {}, {}};
  for (const SceneSpec& scene : spec.scenes)
    if (!studio.sensors.contains(scene.sensor))
      studio.sensors[scene.sensor] = read_sensor(scene.sensor);
  for (const ModelSpec& model : studio.spec.models) studio.models.push_back(make_model(model));
  const auto wants_clutter = [](const SceneSpec& scene) { return scene.clutter > 0; };
  if (std::any_of(studio.spec.scenes.begin(), studio.spec.scenes.end(), wants_clutter))
    studio.clutter = make_clutter(studio.spec);
  if (spec.colors) mix_paints(studio);
  return studio;
}

/// No thing is as its model says.
void stretch(Body& body, double most, Random& random) {
  auto out = std::make_shared<Mesh>(*body.mesh);
  Eigen::Vector3d scale;
  for (int axis = 0; axis < 3; ++axis) {
    scale[axis] = 1 + random.uniform(-most, most);
    out->points.col(axis) *= static_cast<float>(scale[axis]);
  }
  body.mesh = out;
  body.T_paint_body.linear() = scale.cwiseInverse().asDiagonal();
}

/// Objects and clutter, in mixed order unless objects are to lie below, so that either may lie on
/// the other; the ground last.
std::vector<Body> arrange(const SceneSpec& scene, const Studio& studio, Random& random) {
  const bool bin = scene.ground == "bin";
  std::vector<Body> bodies;
  for (const int obj_id : scene.objects)
    bodies.push_back({studio.models[static_cast<std::size_t>(obj_id) - 1], obj_id,
                      Eigen::Isometry3d::Identity()});
  if (!studio.paints.empty())
    for (Body& body : bodies) body.paint = studio.paints[static_cast<std::size_t>(body.obj_id) - 1];
  if (scene.inexact > 0)
    for (Body& body : bodies) stretch(body, scene.inexact, random);
  for (int i = 0; i < scene.clutter; ++i) {
    const std::size_t which = random.next() % kClutter;
    bodies.push_back({studio.clutter[which], 0, Eigen::Isometry3d::Identity()});
    if (!studio.clutter_paints.empty()) bodies.back().paint = studio.clutter_paints[which];
  }
  for (std::size_t i = scene.objects_below ? 0 : bodies.size(); i > 1; --i)
    std::swap(bodies[i - 1], bodies[random.next() % i]);
  settle(bodies, scene.radius, bin || scene.ground == "fenced", random);
  if (scene.ground != "unseen")
    bodies.push_back(bin ? make_bin(scene.radius)
                         : make_table(std::max(kTableSide, kTableRadii * scene.radius)));
  return bodies;
}

struct Image {
  std::vector<Body> bodies;
  Sensor sensor;
  Eigen::Isometry3d T_world_sensor = Eigen::Isometry3d::Identity();
  SimulatedScan scan;
};

/// Whether as much is seen of each object as the scene asks for.
bool fits(const Image& image, const SceneSpec& scene) {
  if (scene.least_surface <= 0 && scene.most_surface >= 1) return true;
  const std::vector<double> seen = seen_surfaces(image.bodies, image.sensor, image.T_world_sensor);
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (image.bodies[i].obj_id != 0 &&
        (seen[i] < scene.least_surface || seen[i] > scene.most_surface))
      return false;
  return true;
}

/// Walks around what has settled, which costs less than letting it settle anew.
bool find_view(const SceneSpec& scene, Image& image) {
  constexpr int kViews = 12;
  constexpr double kDegree = std::numbers::pi / 180;
  const double height = kTargetHeight * std::min(1.0, scene.distance / kNearest);
  for (int i = 0; i < kViews; ++i) {
    const double azimuth = scene.azimuth + 360.0 * i / kViews;
    image.T_world_sensor =
        look_at({0, 0, height}, scene.distance, scene.elevation * kDegree, azimuth * kDegree);
    if (fits(image, scene)) return true;
  }
  return false;
}

Image make_image(const Studio& studio, std::size_t index) {
  const SceneSpec& scene = studio.spec.scenes[index];
  Image image;
  image.sensor = studio.sensors.at(scene.sensor);
  if (scene.noise != kSensorsOwn) image.sensor.noise = scene.noise, image.sensor.noise_z2 = 0;
  Random random(static_cast<std::uint64_t>(studio.spec.seed), index);
  for (int i = 0; i < kArrangements; ++i) {
    image.bodies = arrange(scene, studio, random);
    const std::uint64_t noise = random.next();
    if (!find_view(scene, image)) continue;
    image.scan = scan(image.bodies, image.sensor, image.T_world_sensor, noise);
    if (studio.spec.colors) {
      if (image.bodies.back().obj_id == 0 && scene.ground != "unseen")
        image.bodies.back().paint = std::make_shared<const Paint>(Paint::ground(noise));
      image.scan.colors = photograph(image.bodies, image.sensor, image.T_world_sensor, noise);
    }
    return image;
  }
  throw std::runtime_error("image " + std::to_string(index) + ": in " +
                           std::to_string(kArrangements) +
                           " arrangements some object showed less than least_surface of itself, or "
                           "more than most_surface");
}

/// Makes images side by side and writes them in order.
void make_images(const Studio& studio, std::size_t step, BopWriter& writer) {
  namespace tbb = oneapi::tbb;
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::seconds kBetweenReports(5);
  const std::size_t all = (studio.spec.scenes.size() + step - 1) / step;
  std::size_t begun = 0, written = 0;
  Clock::time_point reported = Clock::now();
  tbb::parallel_pipeline(
      2 * static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()),
      tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order,
                                          [&](tbb::flow_control& control) {
                                            if (begun == all) control.stop();
                                            return step * begun++;
                                          }) &
          tbb::make_filter<std::size_t, std::shared_ptr<Image>>(
              tbb::filter_mode::parallel,
              [&](std::size_t i) { return std::make_shared<Image>(make_image(studio, i)); }) &
          tbb::make_filter<std::shared_ptr<Image>, void>(
              tbb::filter_mode::serial_in_order, [&](const std::shared_ptr<Image>& image) {
                writer.add_image(image->bodies, image->sensor, image->T_world_sensor, image->scan);
                ++written;
                if (Clock::now() - reported < kBetweenReports) return;
                reported = Clock::now();
                spdlog::info("{} of {} images", written, all);
              }));
}

/// What is there besides an unfinished simulation.
bool is_taken(const fs::path& out, const fs::path& unfinished) {
  if (!fs::exists(out)) return false;
  if (!fs::is_directory(out)) return true;
  return std::any_of(fs::directory_iterator(out), fs::directory_iterator(),
                     [&](const auto& entry) { return entry.path() != unfinished; });
}

/// What a simulation that was stopped left; somebody else's folder stays.
void remove_unfinished(const fs::path& folder) {
  if (!fs::exists(folder)) return;
  for (const auto& entry : fs::directory_iterator(folder))
    if (!BopWriter::makes(entry.path().filename()))
      throw std::invalid_argument(entry.path().string() +
                                  ": is in the way, and no simulation made it; move it");
  fs::remove_all(folder);
}

}  // namespace

void simulate_set(const std::string& spec_file, const fs::path& out, std::size_t step) {
  simulate_set(read_spec(spec_file), out, step);
}

void simulate_set(const Spec& spec, const fs::path& out, std::size_t step) {
  // Under its name there is a whole set or none. An empty folder stays the one it is, for it may be
  // a mount point, or where somebody's shell stands: what is made moves there at the end.
  const fs::path folder = out.has_filename() ? out : out.parent_path();
  const bool exists = fs::exists(folder);
  const fs::path unfinished =
      exists ? folder / ".unfinished" : fs::path(folder.string() + ".unfinished");
  if (is_taken(folder, unfinished))
    throw std::invalid_argument(out.string() + ": is not an empty folder; choose another --out");
  remove_unfinished(unfinished);
  const Studio studio = open_studio(spec);
  BopWriter writer(unfinished, spec.least_visible);
  for (std::size_t i = 0; i < studio.models.size(); ++i) {
    const Mesh& mesh = *studio.models[i];
    const Paint* paint = studio.paints.empty() ? nullptr : studio.paints[i].get();
    const ShapeSymmetry shape = symmetry_of_model(studio.spec.models[i], mesh);
    writer.add_model(static_cast<int>(i) + 1, mesh,
                     paint ? painted_symmetry(shape, mesh, *paint) : shape, paint);
  }
  make_images(studio, step, writer);
  writer.finish();
  if (!exists) return fs::rename(unfinished, folder);
  const std::vector<fs::path> made(fs::directory_iterator(unfinished), fs::directory_iterator{});
  for (const fs::path& path : made) fs::rename(path, folder / path.filename());
  fs::remove(unfinished);
}

}  // namespace posevote
