// SPDX-License-Identifier: BSD-3-Clause
// The search for one object in a scan: of many proposed poses the one that agrees best with what is
// left of the scan, refined by ICP. README.md in this folder tells the whole story.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "nodes/poses/pool.hpp"
#include "nodes/poses/schedule.hpp"

namespace posevote::poses {

/// Where poses come from.
struct Proposals {
  /// Poses to judge of the scan as it is now, the best supported first; many may be alike.
  std::function<std::vector<Hypothesis>()> propose;
  Improve improve;
};

/// An object to look for. Searches of different objects may go on side by side.
class ObjectSearch {
 public:
  /// Keeps what `sought` refers to.
  ObjectSearch(const Sought& sought, Proposals proposals);

  const Model& model() const { return sought_.model; }
  const geometry::SurfaceIndex& model_index() const { return *sought_.model_index; }
  const InstanceParams& params() const { return sought_.params; }
  const Terms& terms() const { return sought_.terms; }
  /// The best pose when last asked for; none where all were below the threshold. Its `seconds`: how
  /// long this search has worked since its instance before.
  const std::optional<Candidate>& best() const { return best_; }
  /// The best poses of those that were looked at closely and missed a threshold; one for each choice
  /// that came to nothing.
  const Candidates& refused() const { return refused_; }
  /// Whether `best` is of the scan as it is now. If not, its quality is about an upper bound,
  /// because points that were taken out support nothing any more; but a pose that a twin displaced
  /// may return.
  bool is_current() const { return chosen_at_ == sought_.scan.takes; }
  /// Whether all instances that may be are found.
  bool is_full() const { return accepted_ == sought_.params.max_instances; }
  /// Whether other poses may be proposed for the scan as it is now.
  bool may_propose() const;

  /// Has poses proposed for the scan as it is now, and chooses.
  void propose();
  /// Chooses among the poses that are left of those that were proposed.
  void choose();
  /// Poses that would be detections of the scan as it is now, proposed with their centres within
  /// `distance` of a point [m] and refined. `best` stays what it is.
  Candidates look_near(const Eigen::Vector3d& point, double distance);
  /// Makes one of them `best`, unless it convinces no more when it is exact.
  bool prefer(Candidate other);
  /// Makes `best` an instance, whose neighbourhood is closed to others of this object. To be called
  /// before what it explains is taken out of the scan.
  void accept();
  /// The same of an instance that is known without a search, before the first is proposed.
  void accept(const Candidate& known);

 private:
  /// Whether nothing was found of what was proposed; what others uncovered is sought among few.
  bool convinced_nobody() const;
  void choose_best();
  bool settle(Candidate& chosen) const;
  std::optional<Candidate> best_finalist();
  std::optional<Candidate> best_of(Candidates::const_iterator begin,
                                   Candidates::const_iterator end) const;
  Candidate best_of_place(const Candidate& best) const;

  Sought sought_;
  Proposals proposals_;
  std::vector<Hypothesis> proposed_;  ///< all that were, but for those at instances
  Candidates pool_;                   ///< the best first, as far as they were judged
  std::optional<Candidate> best_;
  Candidates refused_;
  TakenPlaces taken_;
  double least_support_ = std::numeric_limits<double>::infinity();  ///< of its instances
  int accepted_ = 0;
  int proposed_at_ = -1, chosen_at_ = -1;  ///< ScanState::takes then
  double seconds_ = 0;                     ///< of work since the last instance
};

}  // namespace posevote::poses
