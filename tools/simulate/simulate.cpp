// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/simulate.hpp"

#include <numbers>
#include <stdexcept>

#include "tools/simulate/bop_writer.hpp"
#include "tools/simulate/scanner.hpp"
#include "tools/simulate/scene.hpp"
#include "tools/simulate/shapes.hpp"
#include "tools/simulate/spec.hpp"

namespace posevote {
namespace {

using Meshes = std::vector<std::shared_ptr<const Cloud>>;

constexpr double kTableSide = 1.2;      // [m]
constexpr double kTargetHeight = 0.05;  // the sensor looks at what lies on the table [m]

Meshes make_models(const Spec& spec) {
  Meshes meshes;
  for (const ModelSpec& model : spec.models)
    meshes.push_back(std::make_shared<Cloud>(
        make_shape(model.shape, static_cast<std::uint64_t>(model.seed), model.size)));
  return meshes;
}

/// A body of any shape; its seed has 64 bits, those of models 30, so it is none of them.
Body make_clutter(Random& random) {
  const std::string& shape = shape_names()[random.next() % shape_names().size()];
  const std::uint64_t seed = random.next() | 1ULL << 63U;
  return {std::make_shared<Cloud>(make_shape(shape, seed, random.uniform(0.08, 0.2))), 0,
          Eigen::Isometry3d::Identity()};
}

/// Objects and clutter in mixed order, so that either may lie on the other; the table last.
std::vector<Body> arrange(const SceneSpec& scene, const Meshes& models, Random& random) {
  std::vector<Body> bodies;
  for (const int obj_id : scene.objects)
    bodies.push_back(
        {models[static_cast<std::size_t>(obj_id) - 1], obj_id, Eigen::Isometry3d::Identity()});
  for (int i = 0; i < scene.clutter; ++i) bodies.push_back(make_clutter(random));
  for (std::size_t i = bodies.size(); i > 1; --i)
    std::swap(bodies[i - 1], bodies[random.next() % i]);
  drop_bodies(bodies, scene.radius, random);
  if (scene.table) bodies.push_back(make_table(kTableSide));
  return bodies;
}

}  // namespace

void simulate(const std::string& spec_file, const std::filesystem::path& out, std::size_t step) {
  const Spec spec = read_spec(spec_file);
  BopWriter writer(out);
  const Meshes models = make_models(spec);
  for (std::size_t i = 0; i < models.size(); ++i)
    writer.add_model(static_cast<int>(i) + 1, *models[i]);
  for (std::size_t i = 0; i < spec.scenes.size(); i += step) {
    const SceneSpec& scene = spec.scenes[i];
    Random random(static_cast<std::uint64_t>(spec.seed), i);
    const std::vector<Body> bodies = arrange(scene, models, random);
    constexpr double kDegree = std::numbers::pi / 180;
    const Eigen::Isometry3d T_world_sensor = look_at(
        {0, 0, kTargetHeight}, scene.distance, scene.elevation * kDegree, scene.azimuth * kDegree);
    const Sensor sensor = find_sensor(scene.sensor);
    writer.add_image(bodies, sensor, T_world_sensor,
                     scan(bodies, sensor, T_world_sensor, random.next()));
  }
  writer.finish();
}

}  // namespace posevote
