// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/occluder.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace posevote::geometry {
namespace {

constexpr float kOnFace = 1e-5F;  ///< x diagonal

}  // namespace

struct Occluder::Scene {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  Eigen::RowVector3f center = Eigen::RowVector3f::Zero();  ///< rays near 0 keep their digits
  float near = 0;

  Scene() {
    // One instruction set for all machines: the same rounding, the same library. No number of
    // threads: Embree would limit that of the whole process by it (tbb::global_control), down to none
    // for the flow graph.
    device = rtcNewDevice("isa=sse2");
    if (device) scene = rtcNewScene(device);
    check("starting Embree");
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);  // no ray slips through between triangles
  }
  ~Scene() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  void check(const char* what) const {
    const RTCError error = rtcGetDeviceError(device);
    if (error != RTC_ERROR_NONE || !device)
      throw std::runtime_error(std::string(what) + ": Embree error " + std::to_string(error));
  }
};

Occluder::Occluder(const PointMatrix& points, const FaceMatrix& faces)
    : scene_(std::make_unique<Scene>()) {
  if (faces.rows() == 0) throw std::runtime_error("there are no faces");
  const Eigen::RowVector3f low = points.colwise().minCoeff(), high = points.colwise().maxCoeff();
  scene_->center = 0.5F * (low + high);
  scene_->near = kOnFace * (high - low).norm();
  const auto count = static_cast<std::size_t>(points.rows());
  const RTCGeometry triangles = rtcNewGeometry(scene_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(
      triangles, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), count));
  auto* index = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(unsigned), static_cast<std::size_t>(faces.rows())));
  if (vertex && index) {
    for (Eigen::Index i = 0; i < points.rows(); ++i)
      for (int axis = 0; axis < 3; ++axis) *vertex++ = points(i, axis) - scene_->center[axis];
    std::copy(faces.data(), faces.data() + faces.size(), index);
    rtcCommitGeometry(triangles);
    rtcAttachGeometry(scene_->scene, triangles);
  }
  rtcReleaseGeometry(triangles);
  rtcCommitScene(scene_->scene);
  scene_->check("giving a mesh to Embree");
}

Occluder::~Occluder() = default;

bool Occluder::escapes(const Eigen::Vector3f& point, const Eigen::Vector3f& direction) const {
  const Eigen::Vector3f origin = point - scene_->center.transpose();
  RTCRay ray{};
  ray.org_x = origin.x();
  ray.org_y = origin.y();
  ray.org_z = origin.z();
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tnear = scene_->near;
  ray.tfar = std::numeric_limits<float>::infinity();
  ray.mask = ~0U;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_->scene, &context, &ray);
  return ray.tfar > 0;  // what is met makes it minus infinity
}

}  // namespace posevote::geometry
