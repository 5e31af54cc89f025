// SPDX-License-Identifier: BSD-3-Clause
// Where a pose of an object stands in a scan, stage by stage: what is seen of it, features, matches,
// votes, its place in the search, and how it is judged.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/explain/search_watch.hpp"

namespace posevote::explain {

/// What the sensor saw of a posed model, as shares of its points that face the sensor.
struct Seen {
  double supported = 0, contradicted = 0, mismatched = 0, unmeasured = 0;
  double hidden = 0;            ///< behind another surface
  double outside = 0;           ///< beside the image
  std::size_t scan_points = 0;  ///< of the prepared scan, on the model
};

/// How a pose is judged once it is refined.
struct Judged {
  double confidence = 0, score = 0;
  double agreement = 0, relief = 0, outline = 0, votes_per_feature = 0, rmse = 0;
  Clues clues{}, against{};
  double colors_against = 0;  ///< what colours take from the log odds, where there are any

  /// What takes how much from the log odds, the most first.
  std::vector<std::pair<std::string, double>> reasons() const;
  /// The confidence that it would have, were the first of these as of right detections; of what is
  /// all but disproved by it, it forgives a part.
  double forgiven() const;
};

/// Of a candidate that is refined.
Judged judged_as(const poses::Candidate& candidate, const poses::Terms& terms);

struct Standing {
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  double range = 0;  ///< of its centre from the sensor [m]
  Seen seen;
  std::size_t features = 0;  ///< of the scan, on the model, at the object's octaves
  std::size_t matched = 0;   ///< of them, to this object
  std::string other;         ///< the other object that most are matched to
  std::size_t matched_other = 0;
  std::size_t agreeing = 0;  ///< correspondences with a vote near the pose
  std::size_t pairs = 0;     ///< votes of point pairs near it
  double density = 0;        ///< of votes at the pose, or of the best vote near it
  double highest = 0;        ///< of any of the object's votes
  std::size_t rank = 0;      ///< of that best vote among separate peaks, from 1; 0: none is near
  std::size_t peaks = 0;
  std::vector<Place> way;  ///< through the search
  Judged judged;           ///< in the whole scan
  Judged left;             ///< in what the scan's other instances left
  Eigen::Isometry3d T_refined = Eigen::Isometry3d::Identity();
  double moved = 0, turned = 0;     ///< by that refinement [m], [rad]
  bool stayed = true;               ///< near where it began
  std::string taker;                ///< the instance that took most of its points
  double taken = 0;                 ///< share of the supported points that others took
  double inside = 0;                ///< share of its surface that lies in instances found
  std::optional<double> near_same;  ///< distance of the next found one of its kind [m]
  Eigen::Isometry3d T_near_same = Eigen::Isometry3d::Identity();  ///< that one, if there is any

  /// In the whole scan and in what other instances left.
  double sureness() const { return std::min(judged.confidence, left.confidence); }
  /// In the better of the two: what others are found to be may speak against a pose in the whole
  /// scan, and what they took for nothing is missing in the rest.
  double likelihood() const { return std::max(judged.confidence, left.confidence); }
};

/// Judges poses of a scan as it was at the beginning, and as the found instances left it.
class Bench {
 public:
  /// Keeps references.
  Bench(const Taps& taps, const SearchWatch& search);

  Standing stand(std::size_t object, const Eigen::Isometry3d& T_scene_model) const;
  /// Takes what the found instances explain out of a scan.
  void take_out_found(poses::ScanState& scan) const;
  /// What others have of a pose: `taker`, `taken` and `near_same`.
  void compare_found(std::size_t object, const Alike& alike, Standing& standing) const;

  const Taps& taps;
  const SearchWatch& search;
  const poses::SegmentParams& params;
  std::vector<segment::LiveVotes> objects;
  poses::ScanState whole;

 private:
  Judged judge(std::size_t object, const Alike& alike, const poses::ScanState& scan,
               const Standing& standing, Eigen::Isometry3d& T_refined) const;
  /// What is known of the scan's things, but for the instance at that pose.
  poses::Acquaintance others_than(std::size_t object, const Alike& alike) const;
  void count_features(std::size_t object, const poses::Sought& sought, Standing& standing) const;
  void count_votes(std::size_t object, const Alike& alike, Standing& standing) const;
  void take_out_doubtful(std::size_t object, const Alike& alike, poses::ScanState& scan) const;
  void take_out(const poses::Instance& one, poses::ScanState& scan) const;
  /// Of the scan's points, 1 for those so near the posed model.
  std::vector<char> rows_near(std::size_t object, const Eigen::Isometry3d& T_scene_model,
                              float poses::InstanceParams::*distance) const;

  std::vector<std::vector<char>> explained_;  ///< by found instance: of the scan's points, 1
};

}  // namespace posevote::explain
