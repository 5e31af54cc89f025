// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "nodes/poses/color_fit.hpp"
#include "nodes/poses/memory.hpp"
#include "nodes/poses/scan_state.hpp"
#include "nodes/poses/terms.hpp"

namespace posevote::poses {

struct Candidate;

/// Sees the candidates of an object after a step of its search, the best first. Searches run side by
/// side: so may calls for different objects.
using Watch = std::function<void(const char* step, const std::vector<Candidate>& candidates)>;

/// The rules for one object; lengths in m.
struct InstanceParams {
  int max_instances = 1;
  std::size_t candidates = 1;  ///< poses that are judged
  double min_score = 0, min_confidence = 0;
  float nms_radius = 0;          ///< between the centres of instances [m]
  double overlap = 1;            ///< share of the surface that may lie in instances before
  bool refine = true;            ///< by ICP
  int icp_iterations = 40;       ///< at most
  float icp_distance = 0;        ///< search radius of the first iteration [m]
  float tolerance = 0;           ///< of support [m]
  double max_residual = 0;       ///< x usual; what leaves more is less exact. 0: nothing is
  float explained_distance = 0;  ///< scan points this near to an instance are taken out [m]
};

/// How far the model's surface and the ends of it reach from its centre [m], and a trifle for
/// rounding.
double reach_of(const Model& model);

/// `radius`: that is asked for most [m].
inline std::shared_ptr<const geometry::SurfaceIndex> index_of(const Model& model, float radius) {
  return std::make_shared<const geometry::SurfaceIndex>(model.cloud.points, radius);
}

/// What is looked for, where, and by which rules.
struct Sought {
  const Model& model;
  const ScanState& scan;
  InstanceParams params;
  const Terms& terms;
  /// How many votes a correspondence casts, if a pose's support is their density: then it counts in
  /// the score. 0: rivals' own measures differ in scale, and the quality alone makes their score.
  std::uint32_t votes_per_correspondence = 0;
  /// Rows of the scan's features whose scale the model was described at; they alone can vote.
  std::vector<Octave> voters = {};
  double most_support = 1;  ///< of the poses that are compared
  Watch watch = {};         ///< empty: nobody wants to see
  double reach = reach_of(model);
  std::shared_ptr<const geometry::SurfaceIndex> model_index = index_of(model, params.tolerance);
  std::shared_ptr<Memory> memory = std::make_shared<Memory>();
  /// Null where the scan has no colours to compare with.
  std::shared_ptr<const LookOf> look = scan.look.lab.rows() > 0
                                           ? std::make_shared<const LookOf>(model.cloud)
                                           : nullptr;
};

}  // namespace posevote::poses
