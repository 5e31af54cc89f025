// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/physics.hpp"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tools/simulate/pieces.hpp"
#include "tools/simulate/split_faces.hpp"

namespace posevote {
namespace {

// Bullet is tuned for bodies of about one unit, so a unit is 0.1 m.
constexpr double kUnits = 10;                         // a metre
constexpr double kMargin = 0.0005, kGap = 0.01;       // [m]
constexpr double kStep = 1.0 / 250;                   // [s]
constexpr int kFall = 100, kLongest = 750;            // [steps]
constexpr double kStill = 0.01, kStillTurning = 0.1;  // [m/s], [rad/s]

btVector3 to_bullet(const Eigen::Vector3d& v) {
  const Eigen::Vector3d scaled = v * kUnits;
  return {static_cast<btScalar>(scaled.x()), static_cast<btScalar>(scaled.y()),
          static_cast<btScalar>(scaled.z())};
}

struct Mass {
  double volume = 0;  // [m^3]
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
};

Mass mass_of(const Mesh& mesh) {
  Mass mass;
  for (Eigen::Index face = 0; face < mesh.faces.rows(); ++face) {
    const Eigen::Matrix3d corners = corners_of(mesh, face);
    const Eigen::Vector3d a = corners.col(0), b = corners.col(1), c = corners.col(2);
    const double part = a.dot(b.cross(c)) / 6;  // of the tetrahedron to the origin
    mass.volume += part;
    mass.center += part * (a + b + c) / 4;
  }
  mass.center /= mass.volume;
  return mass;
}

/// The same of any mesh: what is open, or has faces inside, may have no sensible volume, and counts
/// as half of its box.
Mass mass_of_any(const Mesh& mesh) {
  constexpr double kLeast = 1e-3;  // of the box
  Eigen::AlignedBox3d box;
  for (const auto& point : mesh.points.rowwise()) box.extend(point.transpose().cast<double>());
  const Mass mass = mass_of(mesh);
  if (mass.volume > kLeast * box.volume() && mass.center.allFinite() && box.contains(mass.center))
    return mass;
  const double thinnest = kLeast * box.diagonal().maxCoeff();  // a plate of no thickness has some
  return {box.sizes().cwiseMax(thinnest).prod() / 2, box.center()};
}

/// The corners that reach farthest in any of the 26 directions of a cube's neighbours:
/// about their convex hull, of a size that collisions are found fast with.
std::set<std::uint32_t> extremes(const PointMatrix& points,
                                 const std::set<std::uint32_t>& corners) {
  std::set<std::uint32_t> found;
  for (int i = 0; i < 27; ++i) {
    const int x = i % 3 - 1, y = i / 3 % 3 - 1, z = i / 9 - 1;
    const Eigen::Vector3f direction(static_cast<float>(x), static_cast<float>(y),
                                    static_cast<float>(z));
    if (direction.isZero()) continue;
    found.insert(
        *std::max_element(corners.begin(), corners.end(), [&](std::uint32_t a, std::uint32_t b) {
          return points.row(a) * direction < points.row(b) * direction;
        }));
  }
  return found;
}

/// A body in Bullet, its frame at the centre of its mass.
class Solid {
 public:
  explicit Solid(const Mesh& mesh) : Solid(mesh, mass_of_any(mesh)) {}

  Solid(const Mesh& mesh, const Mass& whole)
      : center_(whole.center),
        reach_((mesh.points.cast<double>().rowwise() - center_.transpose())
                   .rowwise()
                   .norm()
                   .maxCoeff()) {
    const Pieces pieces = cut_up(mesh);
    for (const std::set<std::uint32_t>& piece : pieces.list) add_hull(pieces.points, piece);
    constexpr double kDensity = 300;  // [kg/m^3]
    const auto mass = static_cast<btScalar>(kDensity * whole.volume);
    btVector3 inertia(0, 0, 0);
    compound_.calculateLocalInertia(mass, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &compound_, inertia);
    info.m_friction = 0.7F;
    info.m_rollingFriction = 0.02F;
    info.m_spinningFriction = 0.02F;
    info.m_linearDamping = 0.05F;
    info.m_angularDamping = 0.3F;
    body_ = std::make_unique<btRigidBody>(info);
  }

  btRigidBody& body() { return *body_; }
  double reach() const { return reach_; }  ///< from the centre [m]

  void place(const Eigen::Vector3d& center, const Eigen::Quaterniond& q) {
    const btQuaternion rotation(static_cast<btScalar>(q.x()), static_cast<btScalar>(q.y()),
                                static_cast<btScalar>(q.z()), static_cast<btScalar>(q.w()));
    body_->setWorldTransform(btTransform(rotation, to_bullet(center)));
  }
  Eigen::Isometry3d pose() const {
    const btTransform& T = body_->getWorldTransform();
    const btQuaternion q = T.getRotation();
    Eigen::Isometry3d T_world_body(Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z()).normalized());
    const btVector3& t = T.getOrigin();
    T_world_body.pretranslate(Eigen::Vector3d(t.x(), t.y(), t.z()) / kUnits);
    return T_world_body * Eigen::Translation3d(-center_);
  }
  double top() const {
    btVector3 low, high;
    body_->getAabb(low, high);
    return high.z() / kUnits;
  }
  bool is_still() const {
    return !body_->isActive() || (body_->getLinearVelocity().length() < kStill * kUnits &&
                                  body_->getAngularVelocity().length() < kStillTurning);
  }

 private:
  void add_hull(const PointMatrix& points, const std::set<std::uint32_t>& corners) {
    auto hull = std::make_unique<btConvexHullShape>();
    for (const std::uint32_t i : extremes(points, corners))
      hull->addPoint(to_bullet(points.row(i).transpose().cast<double>() - center_), false);
    hull->recalcLocalAabb();
    hull->setMargin(static_cast<btScalar>(kMargin * kUnits));
    compound_.addChildShape(btTransform::getIdentity(), hull.get());
    hulls_.push_back(std::move(hull));
  }

  Eigen::Vector3d center_;
  double reach_;
  std::vector<std::unique_ptr<btConvexHullShape>> hulls_;
  btCompoundShape compound_;
  std::unique_ptr<btRigidBody> body_;
};

/// The ground, invisible walls that are asked for, and what has been dropped so far.
class World {
 public:
  World() {
    world_.setGravity(to_bullet({0, 0, -9.81}));
    world_.getSolverInfo().m_numIterations = 30;
    world_.getSolverInfo().m_splitImpulse = 1;
    add_plane({0, 0, 1}, 0);
  }
  ~World() {
    for (int i = world_.getNumCollisionObjects() - 1; i >= 0; --i)
      world_.removeCollisionObject(world_.getCollisionObjectArray()[i]);
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// What lies off the plane against its normal is solid; `offset`: of the plane along it [m].
  void add_plane(const Eigen::Vector3d& normal, double offset) {
    auto shape = std::make_unique<btStaticPlaneShape>(to_bullet(normal).normalized(),
                                                      static_cast<btScalar>(offset * kUnits));
    shape->setMargin(static_cast<btScalar>(kMargin * kUnits));
    auto plane = std::make_unique<btCollisionObject>();
    plane->setCollisionShape(shape.get());
    plane->setFriction(0.7F);
    world_.addCollisionObject(plane.get());
    shapes_.push_back(std::move(shape));
    planes_.push_back(std::move(plane));
  }
  void add(Solid& solid) { world_.addRigidBody(&solid.body()); }
  void step() { world_.stepSimulation(static_cast<btScalar>(kStep), 0); }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  std::vector<std::unique_ptr<btStaticPlaneShape>> shapes_;
  std::vector<std::unique_ptr<btCollisionObject>> planes_;
};

/// A place over the disc; inside of walls, if there are any, as far as the body's size allows.
Eigen::Vector3d place_over(double radius, bool walls, double reach, double height, Random& random) {
  const double free = walls ? std::max(0.0, radius - reach) : radius;
  Eigen::Vector3d place;
  do {
    place = {random.uniform(-free, free), random.uniform(-free, free), height};
  } while (!walls && place.head<2>().norm() > radius);
  return place;
}

}  // namespace

void settle(std::vector<Body>& bodies, double radius, bool walls, Random& random) {
  std::vector<std::unique_ptr<Solid>> solids;  // outlive the world
  World world;
  if (walls)
    for (const Eigen::Vector3d& inward : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-1, 0, 0),
                                          Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, -1, 0)})
      world.add_plane(inward, -radius);
  for (const Body& body : bodies) {
    double top = 0;
    for (const auto& solid : solids) top = std::max(top, solid->top());
    Solid& solid = *solids.emplace_back(std::make_unique<Solid>(*body.mesh));
    const double height = top + solid.reach() + kGap;
    solid.place(place_over(radius, walls, solid.reach(), height, random), random.rotation());
    world.add(solid);
    for (int i = 0; i < kFall; ++i) world.step();
  }
  const auto is_still = [](const auto& solid) { return solid->is_still(); };
  for (int i = 0; i < kLongest; ++i) {
    world.step();
    if (i > kFall && std::all_of(solids.begin(), solids.end(), is_still)) break;
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) bodies[i].T_world_body = solids[i]->pose();
}

}  // namespace posevote
