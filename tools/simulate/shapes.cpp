// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

#include "tools/simulate/fields.hpp"
#include "tools/simulate/goods.hpp"
#include "tools/simulate/household.hpp"
#include "tools/simulate/parts.hpp"
#include "tools/simulate/surface_nets.hpp"

namespace posevote {
namespace {

using namespace simulate;
using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;
constexpr double kExtent = 1.5;  // of the space that a field is sampled in

/// Where the ray from the origin leaves a body; the surface of the fields below lies within 1.4.
Vector3d surface_toward(const Field& field, const Vector3d& direction) {
  double outside = 1.4;
  while (outside > 0 && field(outside * direction) > 0) outside -= 0.02;
  return outside * direction;
}

/// Bumps and dents of various sizes on the surface that the origin sees.
Relief relief(const Field& field, Random& random, int bumps, int dents) {
  Relief made;
  const auto ball = [&](double low, double high) {
    const double radius = random.uniform(low, high);
    return Ball{surface_toward(field, random.direction()), radius};
  };
  for (int i = 0; i < bumps; ++i) made.bumps.push_back(ball(0.08, 0.2));
  for (int i = 0; i < dents; ++i) made.dents.push_back(ball(0.1, 0.2));
  return made;
}

/// Farther than this from a body, its skin and relief change nothing: they need not be computed.
constexpr double kFar = 0.5;

/// `field` with relief and an uneven skin.
Field roughen(const Field& field, Random& random, int bumps, int dents, double amplitude) {
  const Waves waves(random, 10, 7);
  const Relief shape = relief(field, random, bumps, dents);
  return [field, amplitude, waves, shape](const Vector3d& p) {
    const double smooth = field(p);
    return std::abs(smooth) > kFar ? smooth : shape.apply(smooth + amplitude * waves(p), p);
  };
}

/// A star-shaped body: radius by direction, from smooth noise.
Field boulder(Random& random) {
  const Vector3d axes(1, random.uniform(0.65, 0.85), random.uniform(0.5, 0.65));
  const Field body = [axes, waves = Waves(random, 8, 2.5)](const Vector3d& p) {
    const double length = p.norm();
    const Vector3d direction = p / std::max(length, 1e-9);
    const double radius = 0.9 / direction.cwiseQuotient(axes).norm();
    return 0.7 * (length - radius * (1 + 0.12 * waves(direction)));
  };
  return roughen(body, random, 7, 7, 0.015);
}

/// A bent tube that tapers, with knobs along it.
Field horn(Random& random) {
  const double turn = random.uniform(1.2, 1.7) * kPi, rise = random.uniform(0.5, 0.9);
  std::vector<Ball> spine;
  for (int i = 0; i <= 12; ++i) {
    const double part = i / 12.0, angle = turn * part;
    spine.push_back(
        {{0.75 * std::cos(angle), 0.75 * std::sin(angle), rise * (part - 0.5)}, 0.32 - 0.2 * part});
  }
  Relief knobs;
  for (int i = 0; i < 9; ++i) {
    const Ball& at = spine[static_cast<std::size_t>(i) + 1];
    knobs.bumps.push_back(
        {at.center + at.radius * random.direction(), at.radius * random.uniform(0.35, 0.6)});
  }
  return [spine, knobs, waves = Waves(random, 10, 8)](const Vector3d& p) {
    const double tube = to_chain(p, spine, 0.05);
    return std::abs(tube) > kFar ? tube : knobs.apply(tube + 0.012 * waves(p), p);
  };
}

/// Metaballs: where the sum of their influence is above a threshold.
Field coral(Random& random) {
  std::vector<Ball> balls{{Vector3d::Zero(), 0.45}};
  for (int i = 0; i < 9; ++i)
    balls.push_back({random.uniform(0.4, 0.85) * random.direction(), random.uniform(0.18, 0.34)});
  const Field body = [balls](const Vector3d& p) {
    double influence = 0;
    for (const Ball& ball : balls)
      influence += std::exp(-(p - ball.center).squaredNorm() / (ball.radius * ball.radius));
    return 0.4 * (0.35 - influence);
  };
  return roughen(body, random, 3, 2, 0.006);
}

/// A superellipsoid, tapered and twisted about its long axis.
Field wrench(Random& random) {
  const double twist = random.uniform(1.2, 1.8), taper = random.uniform(0.2, 0.35);
  const double width = random.uniform(0.5, 0.6), depth = random.uniform(0.25, 0.35);
  const Field body = [=](const Vector3d& p) {
    const double c = std::cos(twist * p.z()), s = std::sin(twist * p.z());
    const double wide = width * (1 - taper * p.z()), deep = depth * (1 + 0.5 * taper * p.z());
    const Vector3d q((c * p.x() + s * p.y()) / wide, (c * p.y() - s * p.x()) / deep, p.z());
    return 0.3 * (std::sqrt(q.cwiseAbs2().cwiseAbs2().sum()) - 1);  // exponent 4
  };
  return roughen(body, random, 6, 5, 0.012);
}

/// A lumpy torus with a handle across it.
Field kettle(Random& random) {
  const double lean = random.uniform(0.2, 0.4);
  const std::vector<Ball> handle{{{0.7, 0, 0.1}, 0.13},
                                 {{0.55, lean, 0.65}, 0.09},
                                 {{-0.1, lean, 0.85}, 0.09},
                                 {{-0.65, 0.2, 0.1}, 0.15}};
  const Field body = [handle, waves = Waves(random, 6, 3)](const Vector3d& p) {
    const double around = std::sqrt(p.x() * p.x() + p.y() * p.y()) - 0.7;
    const double ring = std::sqrt(around * around + p.z() * p.z()) - 0.24 - 0.06 * waves(p);
    return smooth_min(ring, to_chain(p, handle, 0.05), 0.08);
  };
  return roughen(body, random, 6, 0, 0.01);
}

/// A standing figure: trunk, head and limbs in a pose of its own.
Field figure(Random& random) {
  const auto near = [&](double x, double y, double z) -> Vector3d {
    return Vector3d(x, y, z) + 0.12 * random.direction();
  };
  const Ball hip{{0, 0, -0.2}, 0.26}, chest{{0, 0, 0.3}, 0.3};
  const std::vector<std::vector<Ball>> limbs{
      {hip, chest},
      {{near(0.05, 0.05, 0.75), 0.21}, {near(0.2, 0.1, 0.8), 0.13}},
      {chest, {near(0.5, 0.2, 0.2), 0.1}, {near(0.6, 0.5, 0.5), 0.13}},
      {chest, {near(-0.45, 0.1, 0.1), 0.11}, {near(-0.4, 0.4, -0.2), 0.14}},
      {hip, {near(0.25, 0.05, -0.65), 0.14}, {near(0.3, 0.15, -1), 0.16}},
      {hip, {near(-0.25, -0.1, -0.6), 0.15}, {near(-0.3, 0, -1), 0.18}}};
  const Field body = [limbs](const Vector3d& p) {
    double nearest = to_chain(p, limbs[0], 0.05);
    for (std::size_t i = 1; i < limbs.size(); ++i)
      nearest = smooth_min(nearest, to_chain(p, limbs[i], 0.05), 0.12);
    return nearest;
  };
  return roughen(body, random, 4, 3, 0.012);
}

/// A kind: a field that is meshed finely, or a mesh as it is.
struct Shape {
  Field (*field)(Random&) = nullptr;
  int cells = 0;  ///< that mesh half the space: more where walls are thin
  Mesh (*mesh)(Random&) = nullptr;
  int fold = 1;  ///< so many turns about z map it onto itself; 0: any
};

Shape fine(Field (*field)(Random&), int cells, int fold = 1) { return {field, cells, {}, fold}; }
Shape coarse(Mesh (*mesh)(Random&), int fold = 1) { return {nullptr, 0, mesh, fold}; }

const std::map<std::string, Shape>& shapes() {
  constexpr int kRich = 42, kFine = 64;
  static const std::map<std::string, Shape> known{{"boulder", fine(boulder, kRich)},
                                                  {"coral", fine(coral, kRich)},
                                                  {"figure", fine(figure, kRich)},
                                                  {"horn", fine(horn, kRich)},
                                                  {"kettle", fine(kettle, kRich)},
                                                  {"wrench", fine(wrench, kRich)},
                                                  {"camera", fine(camera, kFine)},
                                                  {"cup", fine(cup, kFine, 0)},
                                                  {"joystick", fine(joystick, kFine)},
                                                  {"juice", fine(juice, kFine)},
                                                  {"milk", fine(milk, kFine)},
                                                  {"shampoo", fine(shampoo, kFine)},
                                                  {"can", coarse(can, 0)},
                                                  {"flange", coarse(flange, 4)},
                                                  {"bolt", coarse(bolt, 6)},
                                                  {"bracket", coarse(bracket)},
                                                  {"gear", coarse(gear, 12)},
                                                  {"tee", coarse(tee, 2)},
                                                  {"carton", coarse(carton, 2)},
                                                  {"plate", coarse(plate)},
                                                  {"tin", coarse(tin, 2)},
                                                  {"bottle", coarse(bottle, 2)},
                                                  {"bowl", coarse(bowl, 0)},
                                                  {"mug", coarse(mug)},
                                                  {"pitcher", coarse(pitcher)},
                                                  {"banana", coarse(banana)},
                                                  {"drill", coarse(drill)},
                                                  {"scissors", coarse(scissors)},
                                                  {"marker", coarse(marker, 0)},
                                                  {"clamp", coarse(clamp)}};
  return known;
}

std::vector<std::string> names_of(bool all) {
  std::vector<std::string> list;
  for (const auto& [name, shape] : shapes())
    if (all || shape.field) list.push_back(name);
  return list;
}

/// Whether each edge joins exactly two triangles. Surface nets pinch the surface where two sheets
/// of it pass one cell.
bool is_manifold(const Mesh& mesh) {
  std::vector<std::uint64_t> edges;  // directed
  for (Eigen::Index face = 0; face < mesh.faces.rows(); ++face)
    for (int k = 0; k < 3; ++k)
      edges.push_back(std::uint64_t{mesh.faces(face, k)} << 32U | mesh.faces(face, (k + 1) % 3));
  std::sort(edges.begin(), edges.end());
  return std::adjacent_find(edges.begin(), edges.end()) == edges.end();
}

std::optional<Mesh> mesh_of(const Field& field, int cells) {
  constexpr int kTries = 15;  // a slightly finer grid cuts the sheets elsewhere
  for (int i = 0; i < kTries; ++i) {
    Mesh mesh = surface_nets(field, kExtent, kExtent / (cells + i));
    if (is_manifold(mesh)) return mesh;
  }
  return std::nullopt;
}

const Shape& find_shape(const std::string& name) {
  const auto found = shapes().find(name);
  if (found == shapes().end()) throw std::invalid_argument("no shape is called " + name);
  return found->second;
}

/// Of its own size, anywhere.
Mesh raw_mesh(const std::string& shape, std::uint64_t seed) {
  const Shape& kind = find_shape(shape);
  Random random(seed);
  if (kind.mesh) return kind.mesh(random);
  std::optional<Mesh> mesh = mesh_of(kind.field(random), kind.cells);
  if (!mesh)
    throw TooThin("the " + shape + " of seed " + std::to_string(seed) +
                  " has parts too thin to mesh; choose another seed");
  return *std::move(mesh);
}

/// Moves the bounding box' middle to the origin; gives its sides.
Eigen::RowVector3f center(Mesh& mesh) {
  const Eigen::RowVector3f low = mesh.points.colwise().minCoeff();
  const Eigen::RowVector3f high = mesh.points.colwise().maxCoeff();
  mesh.points.rowwise() -= 0.5F * (low + high);
  return high - low;
}

}  // namespace

ShapeSymmetry symmetry_of(const std::string& shape) {
  const int fold = find_shape(shape).fold;
  ShapeSymmetry symmetry{fold == 0, {}};
  for (int i = 1; i < fold; ++i)
    symmetry.turns.push_back(
        Eigen::AngleAxisd(2 * kPi * i / fold, Vector3d::UnitZ()).toRotationMatrix());
  if (shape == "carton")
    for (int axis = 0; axis < 2; ++axis)
      symmetry.turns.push_back(Eigen::AngleAxisd(kPi, Vector3d::Unit(axis)).toRotationMatrix());
  return symmetry;
}

const std::vector<std::string>& shape_names() {
  static const std::vector<std::string> names = names_of(true);
  return names;
}

const std::vector<std::string>& fine_shape_names() {
  static const std::vector<std::string> names = names_of(false);
  return names;
}

Mesh make_shape(const std::string& shape, std::uint64_t seed, double size) {
  Mesh mesh = raw_mesh(shape, seed);
  const Eigen::RowVector3f sides = center(mesh);
  mesh.points *= static_cast<float>(size) / sides.maxCoeff();
  return mesh;
}

Mesh make_shape(const std::string& shape, std::uint64_t seed, const Eigen::Vector3d& sides) {
  Mesh mesh = raw_mesh(shape, seed);
  const Eigen::RowVector3f own = center(mesh);
  mesh.points.array().rowwise() *= sides.transpose().cast<float>().array() / own.array();
  return mesh;
}

}  // namespace posevote
