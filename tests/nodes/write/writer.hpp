// SPDX-License-Identifier: BSD-3-Clause
// What the tests of writers share: running one, a scan and a library to write, a full disk.
#pragma once

#include <sys/resource.h>

#include <csignal>

#include "graph/registry.hpp"
#include "nodes/data/detections.hpp"
#include "nodes/data/model.hpp"

namespace posevote::test {

/// Runs a node that only writes, into `frame.out`.
template <class... In>
void run_writer(const std::string& name, const std::string& every, const graph::FrameContext& frame,
                In... in) {
  const graph::NodeSpec* spec = graph::find_node(name);
  if (!spec) throw std::logic_error("no node is called " + name);
  const std::shared_ptr<void> params = spec->make_params();
  for (const graph::ParamSpec& param : spec->params)
    if (param.name == "every") param.set(params.get(), every);
  const std::vector<graph::Value> inputs{graph::StreamTraits<In>::wrap(std::move(in))...};
  spec->call(inputs, frame, params.get());
}

/// side x side points, `step` apart, in the plane z = `depth` around the z axis, facing the origin.
inline Cloud make_patch(int side, float step, float depth) {
  Cloud patch;
  patch.points.resize(side * side, 3);
  patch.normals.resize(side * side, 3);
  const float half = 0.5F * step * static_cast<float>(side - 1);
  for (int i = 0; i < side * side; ++i) {
    patch.points.row(i) << step * static_cast<float>(i % side) - half,
        step * static_cast<float>(i / side) - half, depth;
    patch.normals.row(i) << 0, 0, -1;
  }
  return patch;
}

/// One model, obj_id 1, called "patch": 6 cm across, in its own plane z = 0.
inline ModelLibrary make_library() {
  auto model = std::make_shared<Model>();
  model->name = "patch";
  model->cloud = make_patch(31, 0.002F, 0);
  ModelLibrary library;
  library.models = {model};
  library.octaves.push_back({0.002F, nullptr, {}});
  return library;
}

inline Detection make_detection(const Eigen::Vector3d& place) {
  Detection found;
  found.obj_id = 1;
  found.model = "patch";
  found.confidence = 0.75;
  found.T_scene_model.translation() = place;
  return found;
}

/// While it lives, no file grows beyond `bytes`: writes fail as on a full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() { setrlimit(RLIMIT_FSIZE, &before_); }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
};

}  // namespace posevote::test
