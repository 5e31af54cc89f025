// SPDX-License-Identifier: BSD-3-Clause
// The search for one object in a scan: of many proposed poses the one that agrees best with what is
// left of the scan, refined by ICP. Whatever proposes poses (votes, RANSAC, a Hough space) is
// judged by the same rules.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "nodes/geometry/icp.hpp"
#include "nodes/segment/find_modes.hpp"
#include "nodes/segment/measure_fit.hpp"
#include "nodes/segment/scan_state.hpp"

namespace posevote::segment {

struct InstanceParams {
  int max_instances = 1;
  std::size_t candidates = 1;  ///< modes that are judged
  double min_score = 0;
  float nms_radius = 0;          ///< between the centres of instances [m]
  bool refine = true;            ///< by ICP
  int icp_iterations = 40;       ///< at most
  float icp_distance = 0;        ///< search radius of the first iteration [m]
  float tolerance = 0;           ///< of support [m]
  double max_residual = 0;       ///< x usual; what leaves more is less exact. 0: nothing is
  float explained_distance = 0;  ///< scan points this near to an instance are taken out [m]
};

/// Where poses come from.
struct Proposals {
  /// Poses to judge of the scan as it is now, the best supported first; many may be alike.
  std::function<std::vector<PoseMode>()> propose;
  /// Makes the pose of a proposal on the short list better, before ICP; its support stays.
  std::function<PoseMode(const PoseMode& mode)> improve;
  /// How many votes a correspondence casts, if a mode's support is their density: then it counts in
  /// the score. 0: rivals' own measures differ in scale, and the fit alone makes their score.
  std::uint32_t votes_per_correspondence = 0;
};

/// A pose of the object, and how it fits.
struct Candidate {
  PoseMode mode;  ///< before ICP
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  Fit fit;
  double score = 0;               ///< of the fit, and of its exactness when refined
  double consensus = 1;           ///< in [0, 1], of votes, for the best of a search
  bool is_refined = false;        ///< by all steps of ICP
  std::size_t near_symmetry = 0;  ///< for twins: which of the model's made them
  double rank = 0;  ///< by which poses are chosen: the score, a little lower for less support
  double confidence() const { return score * consensus; }  ///< that of the detection
};

/// An object to look for. Searches of different objects may go on side by side.
class ObjectSearch {
 public:
  /// Keeps references to model and scan.
  ObjectSearch(const Model& model, Proposals proposals, const InstanceParams& params,
               const ScanState& scan);

  const Model& model() const { return model_; }
  const InstanceParams& params() const { return params_; }
  /// The best pose when last asked for; none where all were below the threshold.
  const std::optional<Candidate>& best() const { return best_; }
  /// Whether `best` is of the scan as it is now. If not, its score is about an upper bound, because
  /// points that were taken out support nothing any more; but a pose that a twin displaced may
  /// return.
  bool is_current() const { return chosen_at_ == scan_.takes; }
  /// Whether all instances that may be are found.
  bool is_full() const { return accepted_ == params_.max_instances; }
  /// Whether other poses may be proposed for the scan as it is now.
  bool may_propose() const { return !is_full() && proposed_at_ != scan_.takes; }

  /// Has poses proposed for the scan as it is now, and chooses.
  void propose();
  /// Chooses among the poses that are left of those that were proposed.
  void choose();
  /// Makes `best` an instance, whose neighbourhood is closed to others of this object. To be called
  /// before what it explains is taken out of the scan.
  void accept();

 private:
  void judge(std::size_t begin, std::size_t end, Eigen::Index samples);
  void leave_out_likes();
  void bring_closer();
  void judge_again();
  std::optional<Candidate> best_finalist();
  bool is_convincing(Candidate& candidate) const;
  void refine(Candidate& candidate) const;
  void polish(Candidate& candidate) const;
  void run_icp(Candidate& candidate, const geometry::IcpParams& params) const;
  std::vector<Candidate>::iterator refine_best(std::vector<Candidate>& sorted) const;
  Candidate best_alike(const Candidate& candidate) const;
  double lead_over(const Candidate& origin, const Candidate& other) const;
  void set_mode(Candidate& candidate, const PoseMode& mode) const;
  void set_score(Candidate& candidate) const;
  double exactness(const Candidate& candidate) const;
  double consensus(const Candidate& candidate) const;
  Fit measure(const Eigen::Isometry3d& T_scene_model, Eigen::Index samples) const;
  Eigen::Vector3f center_of(const Candidate& candidate) const;
  bool is_clear(const Eigen::Vector3f& center) const;

  const Model& model_;
  Proposals proposals_;
  InstanceParams params_;
  const ScanState& scan_;
  std::vector<Candidate> pool_;  ///< the best first, as far as they were judged
  double most_support_ = 1;      ///< in the pool as it was proposed
  std::optional<Candidate> best_;
  std::vector<Eigen::Vector3f> taken_;  ///< centres of what was found
  int accepted_ = 0;
  int proposed_at_ = -1, chosen_at_ = -1;  ///< ScanState::takes then
};

}  // namespace posevote::segment
