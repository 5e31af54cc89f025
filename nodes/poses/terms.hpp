// SPDX-License-Identifier: BSD-3-Clause
// Every constant by which poses are judged, refined and chosen, in one place. Each is a parameter
// for experts of segment_objects and segment_hypotheses; term_params.cpp says for each its unit,
// what it does, where its value comes from and what it costs to change. `posevote experiment
// ablation` measures what each brings.
#pragma once

#include "nodes/data/clues.hpp"
#include "nodes/density/refine_mode.hpp"
#include "nodes/geometry/contour_pairs.hpp"
#include "nodes/geometry/edge_pairs.hpp"
#include "nodes/geometry/icp.hpp"
#include "nodes/geometry/range_view.hpp"
#include "nodes/geometry/scan_surface.hpp"

namespace posevote::poses {

/// How many poses get how much attention (schedule.hpp).
struct ScheduleTerms {
  int glances = 600;
  int shortlist = 160, shortlist_again = 10, promising = 40, finalists = 4;
  int glance_points = 50, sketch_points = 300, look_points = 1000, close_points = 4000;
  double glance_reach = 2;
  double sketch_hopeless = 0.3, closer_hopeless = 0.1, hopeless = 0.4;
  double hopeless_odds = -11;
  double sure = 0.95;
};

/// Which poses are the same (pool.hpp).
struct PoolTerms {
  double proposed_fineness = 3;
  double proposed_angle = 30;
  int proposed_per_place = 6;
  double judged_angle = 60;
  int judged_per_place = 3;
};

/// What the scan says of a pose (measure_fit.hpp).
struct FitTerms {
  double clear_distance = 2;
  double mismatch_weight = 0.5;
  double bends_forgiven = 1;
  double convincing = 0.1;
  double outline_weight = 3;
  double few_ends = 0.02;
  double same_height = 2.5, goes_on_within = 0.5;
};

/// What else counts in its grades (score.hpp).
struct ScoreTerms {
  double sampled_residual = 0.05;
  double least_exactness = 0.6;
  double trust_in_support = 0.1;
  double trust_in_clues = 0.1;
  double trust_in_consensus = 0.15;
  double usual_votes = 30;
};

/// How probable it makes the pose (confidence.hpp): log odds for each clue, fitted on 368 images
/// (posevote calibrate; configs/calibration{,_more}_scenes.yaml); kVisible, kOverhang and the offset
/// once more by themselves. All but kGaps, which real sensors blur, then went three tenths of the way
/// to what fits 2273 detections of scans of 72 other objects, kOverhang stopped at six tenths of the
/// way to -17.9, as things are less like their models than simulated ones. kFilled and kOutside are
/// of their own, kStrangers and kCompany are Bayes' rule (tools/experiment/README.md).
struct ConfidenceTerms {
  double offset = -10.97;
  double doubtful = 0.4;  ///< x min_confidence: is an instance, but not a detection
  double kinds = 20, each_found = 2;
  Clues weights{1.887,  0.4017, 1.787,  -13.13, 0.3277, 0.6792, 4.022, 2.067,
                0.6542, -0.8,   0.4996, -14.03, -2,     1,      1};
};

/// What colours say of it (color_fit.hpp), where there are any. Offset and weights were fitted
/// (posevote calibrate --colors) on 83 images of the scenes of configs/calibration_scenes.yaml, painted.
struct ColorTerms {
  double lightness = 0.7;  ///< x chromaticity
  double noise = 3;        ///< units of CIELAB
  double patch = 0.06;     ///< x diagonal
  double err_alike = 8;    ///< points
  double step = 12;        ///< of turns about an axis [deg]
  int glance_points = 300, look_points = 1000;
  double usual_likeness = 0.6, likeness_spread = 0.25, plain = 8;
  double tint = 9, any_tint = 25;
  double offset = -2.354;  ///< log odds
  ColorClues weights{0.8346, 1.348};
  double doubt = 0.1;
};

/// How far it is refined (refinement.hpp).
struct RefinementTerms {
  int coarse_steps = 4;
  int coarse_points = 100, full_points = 1000, polish_points = 10000;
  double full_still = 0.02, polish_still = 5e-3;
};

/// How far it may be off (pose_covariance.hpp). inflation and floor were fitted on simulated scans
/// of eight objects, through five sensors at eight settings.
struct CovarianceTerms {
  double inflation = 2.5;
  double floor = 0.08;
  double patch = 0.125;
  double any_turn = 1.8, any_shift = 0.5;
};

/// When one of two look-alikes leads (twins.hpp). Of 1676 pairs of which one was right, in scans of 65
/// simulated and 17 real objects, 72 are decided wrongly (log loss 191); 81 (257) where confidences
/// counted however far they were apart, and not at all beside colours. telling may be 1.5, too.
struct TwinTerms {
  double telling = 2;
  double lead_odds = 1;
  double err_alike = 4;  ///< points
  double least_difference = 0.4;
};

struct Terms {
  ScheduleTerms schedule;
  PoolTerms pool;
  FitTerms fit;
  ScoreTerms score;
  ConfidenceTerms confidence;
  ColorTerms color;
  RefinementTerms refinement;
  CovarianceTerms covariance;
  TwinTerms twins;
  density::ShiftTerms shift;
  geometry::IcpTerms icp;
  geometry::EdgeTerms edges;
  geometry::ContourTerms contour;
  geometry::SurfaceTerms surface;
  geometry::ViewTerms view;
};

}  // namespace posevote::poses
