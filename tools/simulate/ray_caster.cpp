// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/ray_caster.hpp"

#include <embree3/rtcore.h>

#include <limits>
#include <stdexcept>
#include <string>

namespace posevote {

struct RayCaster::Geometry {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<std::vector<Eigen::Vector3f>> vertices;  // one list a body, sensor frame
  std::vector<std::shared_ptr<const Mesh>> meshes;

  Geometry() {
    // One instruction set for all machines: its rounding would decide which triangle of two that
    // share an edge a ray meets.
    device = rtcNewDevice("isa=sse2,threads=1");
    if (device) scene = rtcNewScene(device);
    check("starting Embree");
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);  // no ray slips through between triangles
  }
  ~Geometry() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
  Geometry(const Geometry&) = delete;
  Geometry& operator=(const Geometry&) = delete;

  void check(const char* what) const {
    const RTCError error = rtcGetDeviceError(device);
    if (error != RTC_ERROR_NONE || !device)
      throw std::runtime_error(std::string(what) + ": Embree error " + std::to_string(error));
  }
  void attach(const Body& body, const Eigen::Isometry3d& T_sensor_world);
};

void RayCaster::Geometry::attach(const Body& body, const Eigen::Isometry3d& T_sensor_world) {
  const Eigen::Isometry3d T_sensor_body = T_sensor_world * body.T_world_body;
  const Mesh& mesh = *body.mesh;
  std::vector<Eigen::Vector3f> moved;
  for (Eigen::Index i = 0; i < mesh.points.rows(); ++i) {
    const Eigen::Vector3d point = mesh.points.row(i).transpose().cast<double>();
    moved.emplace_back((T_sensor_body * point).cast<float>());
  }
  const RTCGeometry triangles = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(
      triangles, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), moved.size()));
  auto* index = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(unsigned), static_cast<std::size_t>(mesh.faces.rows())));
  if (vertex && index) {
    for (const Eigen::Vector3f& point : moved)
      for (int axis = 0; axis < 3; ++axis) *vertex++ = point[axis];
    std::copy(mesh.faces.data(), mesh.faces.data() + mesh.faces.size(), index);
    rtcCommitGeometry(triangles);
    rtcAttachGeometryByID(scene, triangles, static_cast<unsigned>(vertices.size()));
  }
  rtcReleaseGeometry(triangles);
  check("giving a mesh to Embree");
  vertices.push_back(std::move(moved));
  meshes.push_back(body.mesh);
}

RayCaster::RayCaster(const std::vector<Body>& bodies, const Eigen::Isometry3d& T_sensor_world)
    : geometry_(std::make_unique<Geometry>()) {
  for (const Body& body : bodies) geometry_->attach(body, T_sensor_world);
  rtcCommitScene(geometry_->scene);
  geometry_->check("building Embree's scene");
}

RayCaster::~RayCaster() = default;

const std::vector<Eigen::Vector3f>& RayCaster::vertices(std::size_t body) const {
  return geometry_->vertices.at(body);
}

std::optional<RayCaster::Hit> RayCaster::first_hit(const Eigen::Vector3d& direction) const {
  RTCRayHit query{};
  query.ray.dir_x = static_cast<float>(direction.x());
  query.ray.dir_y = static_cast<float>(direction.y());
  query.ray.dir_z = static_cast<float>(direction.z());
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.mask = ~0U;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(geometry_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const std::size_t body = query.hit.geomID;
  const auto corner = [&](int k) -> Eigen::Vector3d {
    const std::uint32_t i = geometry_->meshes[body]->faces(query.hit.primID, k);
    return geometry_->vertices[body][i].cast<double>();
  };
  // Embree says which triangle; where in it is computed here, in double.
  const Eigen::Vector3d a = corner(0);
  const Eigen::Vector3d normal = (corner(1) - a).cross(corner(2) - a).normalized();
  const double along = normal.dot(direction);
  const double cosine = std::abs(along) / direction.norm();
  const double distance = cosine > 1e-3 ? normal.dot(a) / along : double{query.ray.tfar};
  return Hit{body, distance, cosine, normal};
}

}  // namespace posevote
