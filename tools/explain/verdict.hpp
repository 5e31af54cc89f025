// SPDX-License-Identifier: BSD-3-Clause
// Which stage lost an object, by figures alone.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/explain/standing.hpp"

namespace posevote::explain {

constexpr double kMuchTaken = 0.3;  ///< share of a pose's points, by others

/// In the order of the stages.
enum class Cause {
  kFound,
  kScanFailed,   ///< the scan could not be read or prepared
  kLeftOut,      ///< the model could not be used
  kUnit,         ///< the model's size fits neither the others' nor the scan's
  kNotSeen,      ///< hidden, beside the image, or not measured
  kFewFeatures,  ///< the scan has hardly a feature on it
  kNotMatched,   ///< its features are matched to other objects
  kDisagree,     ///< matches there are, but they do not agree on the pose
  kOutranked,    ///< wrong poses had more support or a better first look
  kMoved,        ///< ICP carried it away, or ended beside it
  kTaken,        ///< another instance took its points
  kTooNear,      ///< another instance of its kind closed its place
  kInside,       ///< too much of it lies in instances that were found
  kRefused,      ///< it was judged, and found not sure enough
  kNoTrace,      ///< no candidate that may be it, and nobody says where it is
  kAbsent,       ///< the true poses say that it is not in the scan
};

/// "not seen", "refused" ...
const char* name_of(Cause cause);

/// What a verdict rests on.
struct Case {
  bool is_found = false;
  double diagonal = 0;      ///< of the object [m]
  double scan_size = 0;     ///< diagonal of the scan [m]
  double usual_size = 0;    ///< median of the other objects' diagonals [m]; 0: no others
  double resolution = 0;    ///< of the scan as it was prepared [m]
  std::size_t matches = 0;  ///< of the object in the whole scan
  double min_confidence = 0.5, min_score = 0.1;
  double nms_radius = 0;         ///< [m]
  double overlap = 1;            ///< share of a surface that may lie in other instances
  bool is_absent = false;        ///< known not to be there
  bool is_true = false;          ///< whether the pose is known to be right
  std::optional<Standing> pose;  ///< that is looked at; none: there is no candidate
};

struct Verdict {
  Cause cause = Cause::kRefused;
  std::string stage;   ///< the step or clue that lost it: "glance", "votes"
  std::string detail;  ///< of kNotSeen: "hidden", "outside", "unmeasured"
};

Verdict judge_case(const Case& of);

/// What a refusal rests on: the whole scan, or, where that would do, what other instances left, whose
/// residual counts, too.
const Judged& deciding(const Standing& at, const Case& of);

/// A setting that was tried.
struct Attempt {
  std::string setting;  ///< "node.param=value"
  bool is_found = false;
  double confidence = 0;
  std::size_t detections = 0, before = 0;  ///< of the whole scan, with it and without
};

}  // namespace posevote::explain
