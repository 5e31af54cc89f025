// SPDX-License-Identifier: BSD-3-Clause
// A pose of an object on its way from proposal to detection, and the words for its grades:
//
//   support  what speaks for it before anything is judged: the density of its votes, or what a
//            rival counts
//   quality  in [0, 1]: how well the scan agrees with it: fit (measure_fit.hpp), times exactness
//            once it is refined (usual_residual.hpp)
//   rank     its quality, a little lower for less support than others and for what clues say
//            against it: who goes first among the poses of one object
//   score    in [0, 1]: quality x consensus, the share of the features on it that had voted for it;
//            what min_score asks for
//   confidence  in [0, 1]: how probable it is that it is right, from all clues (confidence.hpp);
//            what min_confidence asks for, and who goes first among refined poses
#pragma once

#include <optional>
#include <vector>

#include "nodes/data/clues.hpp"
#include "nodes/data/hypotheses.hpp"
#include "nodes/geometry/twist.hpp"
#include "nodes/poses/color_fit.hpp"
#include "nodes/poses/measure_fit.hpp"

namespace posevote::poses {

constexpr double kSomeSupport = 1e-9;  ///< at least, where support divides

struct Candidate {
  Hypothesis proposed;   ///< before ICP
  double elsewhere = 0;  ///< support of the best proposal whose centre lies elsewhere
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  Fit fit;
  double quality = 0;
  double rank = 0;
  double consensus = 1;              ///< in [0, 1], of votes, for the best of a search
  Clues clues{};                     ///< of refined poses, as is the next
  std::optional<ColorFit> colors{};  ///< of refined poses, where scan and model have colours
  std::optional<ColorClues> color_clues{};
  double confidence = 0;
  bool is_refined = false;                         ///< by all steps of ICP
  std::optional<geometry::Matrix6d> covariance{};  ///< of what may be a detection
  std::optional<Symmetries> symmetries{};          ///< likewise (color_turns.hpp)
  std::vector<LookAlike> look_alikes{};            ///< likewise (twins.hpp)
  double identity = 1;                             ///< of instances (data/detections.hpp)
  double seconds = 0;                              ///< that its search took (object_search.hpp)
  std::size_t near_symmetry = 0;                   ///< for twins: which of the model's made them
  double of_twin = 0;  ///< for twins: log odds that the pose has more which they outdid (twins.hpp)
  double score() const { return quality * consensus; }
};

using Candidates = std::vector<Candidate>;

/// The best first, equals in their order.
void sort_by_rank(Candidates::iterator begin, Candidates::iterator end);

}  // namespace posevote::poses
