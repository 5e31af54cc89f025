// SPDX-License-Identifier: BSD-3-Clause
// What each term is, where its value comes from, and what it costs to change. The values stand in
// terms.hpp and where that points to. Where no origin is said, the value was found by trying it on
// simulated and real scans (laser scans of UWA and Queen's, RGB-D of bins and households).
#include "nodes/poses/register_terms.hpp"

namespace posevote::poses {
namespace {

using graph::at_least;
using graph::greater_than;
using graph::in_range;

void add_pool(Node& node) {
  using G = PoolTerms;
  const Register<G> term{node, &Terms::pool};
  term("proposed_fineness", &G::proposed_fineness, "",
       "Poses are proposed this many times as densely as instances may lie (nms).",
       greater_than(0));
  term("proposed_angle", &G::proposed_angle, "deg",
       "And turned by at least this, unless they lie apart.", in_range(0, 180));
  term("proposed_per_place", &G::proposed_per_place, "poses", "And this many of a place, at most.",
       in_range(1, 1000));
  term("judged_angle", &G::judged_angle, "deg",
       "Once judged, poses of a place are the same unless turned by more. What "
       "is seen of a true pose never is off by as much after ICP.",
       in_range(0, 180));
  term("judged_per_place", &G::judged_per_place, "poses", "And this many of a place stay, at most.",
       in_range(1, 1000));
}

void add_fit(Node& node) {
  using G = FitTerms;
  const Register<G> term{node, &Terms::fit};
  term("clear_distance", &G::clear_distance, "x inlier_distance",
       "A surface this far before or behind a model point hides or contradicts it. Smaller lets "
       "noise contradict true poses, larger lets wrong ones pass.",
       at_least(0));
  term("mismatch_weight", &G::mismatch_weight, "points",
       "What a model point counts against a pose where another surface, or none, was "
       "measured. Noise, clutter in contact and drop-outs do that to true poses: half.",
       at_least(0));
  term(
      "bends_forgiven", &G::bends_forgiven, "of mismatches",
      "Where a model bends, the scan's normals are those of neither face, so another surface there "
      "does not speak against a pose: this share of it, times the share of what is seen that does "
      "not bend. 0 loses small parts that are seen coarsely.",
      in_range(0, 1));
  term("convincing", &G::convincing, "inliers x clues",
       "Inlier fraction times clues at which evidence is 63 %. False poses on flat ground reach "
       "0.0024, true ones 0.1 to 0.35 in bins; on laser scans 0.045 and 0.12 to 0.37. Larger asks "
       "more of what is hidden or flat.",
       greater_than(0));
  term("outline_weight", &G::outline_weight, "x relief",
       "What the outline counts as a clue, beside relief. All that shows the pose "
       "of a flat side.",
       at_least(0));
  term("few_ends", &G::few_ends, "of all looks",
       "An outline shorter than this says less against a pose.", greater_than(0));
  term("same_height", &G::same_height, "x residual",
       "Beside a pose a surface goes on that is at most so much lower or higher than it, and a "
       "tenth of the tolerance; another is the ground under its edge.",
       at_least(0));
  term("goes_on_within", &G::goes_on_within, "x inlier_distance",
       "Beside a pose a surface goes on where the scan has a point so near to the place that is "
       "asked "
       "for. 1: things that are a little larger than their models seem to go on.",
       greater_than(0));
}

void add_score(Node& node) {
  using G = ScoreTerms;
  const Register<G> term{node, &Terms::score};
  term("sampled_residual", &G::sampled_residual, "x inlier_distance",
       "Of patches, which the points' own distances leave where there is no noise.", at_least(0));
  term("least_exactness", &G::least_exactness, "",
       "No residual costs more of the quality: a model that is worse than the others leaves more, "
       "too.",
       in_range(0, 1));
  term("trust_in_support", &G::trust_in_support, "exponent",
       "Of relative support in the rank: at 0.1 a pose of a hundredth of the best one's needs a "
       "quality 1.6 times as high. True instances differ much in how much is seen of them.",
       in_range(0, 10));
  term(
      "trust_in_clues", &G::trust_in_clues, "exponent",
      "Of the odds that the confidence's clues give, in the rank. Quality alone puts a wall before "
      "a bracket that is half hidden. At 0.25 clues that hold for refined poses decide too early.",
      in_range(0, 10));
  term("trust_in_consensus", &G::trust_in_consensus, "exponent",
       "Of the consensus in the score. Measured on simulated and real RGB-D scans: support per "
       "feature on the posed model is 0.2 to 1.2 for true poses, seldom below 0.05, and 0.02 to "
       "0.1 for shapes that only look alike from one side.",
       in_range(0, 10));
  term("usual_votes", &G::usual_votes, "votes",
       "Per correspondence, for which the consensus was measured: a rotation every "
       "12 deg.",
       greater_than(0));
}

void add_confidence(Node& node) {
  for (std::size_t i = 0; i < kClueCount; ++i)
    node.expert_param(
        std::string("confidence_") + kClueNames[i],
        [i](SegmentParams& params) -> double& { return params.terms.confidence.weights[i]; },
        "log odds",
        is_by_bayes(i) ? "Weight of that clue in the confidence: 1 by Bayes' rule."
                       : "Weight of that clue in the confidence. Found by posevote calibrate, and "
                         "moved (terms.hpp).",
        in_range(-1e6, 1e6));
  const Register<ConfidenceTerms> term{node, &Terms::confidence};
  term("doubtful", &ConfidenceTerms::doubtful, "x min_confidence",
       "Poses from this confidence up take the points that they explain, so that others are looked "
       "for elsewhere; they are no detections below min_confidence. 1: true poses that are found "
       "behind a doubtful one are lost (YCB-Video: 42 of 51 instead of 44).",
       in_range(0, 1));
  term("kinds", &ConfidenceTerms::kinds, "",
       "Before one looks, a thing in a scan is of any of so many kinds, each as likely. The fewer "
       "of them are looked for, the more probably a pose that fits is another's look-alike. 1: "
       "nothing else lies there.",
       at_least(1));
  term("each_found", &ConfidenceTerms::each_found, "kinds",
       "An instance that was found counts for so many that are looked for: where one is, there are "
       "more.",
       at_least(0));
  node.expert_param(
      "confidence_offset",
      [](SegmentParams& params) -> double& { return params.terms.confidence.offset; }, "log odds",
      "Confidence of a pose whose clues are all 0. Found by posevote calibrate, and moved "
      "(terms.hpp).",
      in_range(-1e6, 1e6));
}

void add_refinement(Node& node) {
  using G = RefinementTerms;
  const Register<G> term{node, &Terms::refinement};
  term("coarse_steps", &G::coarse_steps, "steps",
       "Of the ICP that brings promising poses closer. Shows which of them get better.",
       in_range(0, 1000));
  term("coarse_points", &G::coarse_points, "points",
       "Model points of that ICP. Time grows with it.", in_range(10, 1000000));
  term("full_points", &G::full_points, "points",
       "Model points of the ICP of finalists. Time grows with it.", in_range(10, 1000000));
  term("full_still", &G::full_still, "x inlier_distance", "A shorter step ends that ICP.",
       at_least(0));
  term("polish_points", &G::polish_points, "points",
       "Model points of the last ICP: how exactly a detection lies. Time grows with it.",
       in_range(10, 10000000));
  term("polish_still", &G::polish_still, "x inlier_distance", "A shorter step ends that ICP.",
       at_least(0));
}

void add_covariance(Node& node) {
  using G = CovarianceTerms;
  const Register<G> term{node, &Terms::covariance};
  term(
      "covariance_inflation", &G::inflation, "x variance",
      "Of residuals, in the covariance: what patches do not tell of how alike they err. Fitted, so "
      "that 95 of 100 true errors lie within the 95 % ellipsoid; changes nothing else.",
      greater_than(0));
  term("covariance_floor", &G::floor, "x residual",
       "Standard deviation that remains however many points there are, in each direction.",
       at_least(0));
  term("covariance_patch", &G::patch, "x diagonal", "Edge of the patches that may err alike.",
       in_range(0.001, 1));
  term("covariance_any_turn", &G::any_turn, "rad",
       "Standard deviation of a turn that nothing holds: that of any turn at all.",
       greater_than(0));
  term("covariance_any_shift", &G::any_shift, "x diagonal",
       "Standard deviation of a shift that nothing holds.", greater_than(0));
}

void add_twins(Node& node) {
  const Register<TwinTerms> term{node, &Terms::twins};
  term("telling", &TwinTerms::telling, "standard deviations",
       "By which one of two look-alikes leads to tell; of points and of confidences more is no "
       "surer.",
       at_least(0));
  term("lead_odds", &TwinTerms::lead_odds, "log odds", "Of each deviation of that lead.",
       at_least(0));
  term("err_alike", &TwinTerms::err_alike, "points",
       "Of the scan that count for one where they lie off the surfaces of two look-alikes by "
       "different lengths.",
       at_least(1));
  term("least_difference", &TwinTerms::least_difference, "x tolerance",
       "Lengths that differ by less do not count: facets, and what samples leave between them.",
       in_range(0.01, 1));
}

void add_shift(Node& node) {
  using S = density::ShiftTerms;
  const Register<S> term{node, &Terms::shift};
  term(
      "most_shifts", &S::most_shifts, "steps",
      "Of mean shift, by which modes leave the raster of the votes; a neighbourhood query each. 0: "
      "they stay.",
      in_range(0, 1000));
}

void add_surface(Node& node) {
  using F = geometry::SurfaceTerms;
  const Register<F> term{node, &Terms::surface};
  term("least_facing_cosine", &F::least_facing_cosine, "",
       "Between a model point's normal and its ray: sensors measure more grazing surfaces badly or "
       "not at all.",
       in_range(0, 0.99));
  term("least_normal_cosine", &F::least_normal_cosine, "",
       "Between the normals of model and scan where they agree: 45 deg.", in_range(-1, 0.99));
}

void add_icp(Node& node) {
  using G = geometry::IcpTerms;
  const Register<G> term{node, &Terms::icp};
  term("icp_fewest_pairs", &G::fewest_pairs, "pairs",
       "Fewer points with a partner end ICP: six hold a pose, if they lie well.",
       in_range(6, 1000000));
  term("icp_shrink", &G::shrink, "",
       "Of the search radius, per iteration. Slower finds poses from farther "
       "away, and takes longer.",
       in_range(0.01, 1));
  term("icp_damping", &G::damping, "of the weight",
       "Added to eigenvalues (Levenberg) as long as chance partners are many.", at_least(0));
  term("icp_final_damping", &G::final_damping, "of the weight",
       "Once the search radius is the last.", at_least(0));
}

void add_edges(Node& node) {
  using G = geometry::EdgeTerms;
  const Register<G> term{node, &Terms::edges};
  term("edge_ends", &G::ends, "ends",
       "Of the model's faces that hold the last ICP where planes do not, at most; fewer do before. "
       "0: none; a flat face then stays where its votes saw it. Time grows with it.",
       in_range(0, 100000));
  term("edge_reach", &G::reach, "x resolution",
       "How far from the model's end the scan's may be: what votes and ICP leave, which along a "
       "flat face is several points' spacings.",
       in_range(0.5, 100));
  term("edge_spread", &G::spread, "x resolution",
       "By which an end is off, one deviation: the less, the more ends count against planes.",
       greater_than(0));
}

void add_contour(Node& node) {
  using G = geometry::ContourTerms;
  const Register<G> term{node, &Terms::contour};
  term("contour_points", &G::points, "points",
       "Of the model, among which its contour is, which moves what was seen through. 0: none.",
       in_range(0, 1000000));
  term("contour_reach", &G::reach, "x resolution",
       "How far off the scan's contour may be: farther, and it is another's.", in_range(0.5, 100));
  term("contour_spread", &G::spread, "x resolution",
       "By which a contour is off, one deviation: the less, the more it counts against planes.",
       greater_than(0));
}

void add_view(Node& node) {
  using G = geometry::ViewTerms;
  const Register<G> term{node, &Terms::view};
  term("view_trusted", &G::trusted, "of the points",
       "So many must face the sensor and lie in its image, or the scan is no single view and free "
       "space is unknown.",
       in_range(0, 1));
  term("view_least_mean_cosine", &G::least_mean_cosine, "",
       "Of the rays to their mean; less, and it is no single view.", in_range(0, 1));
  term("view_least_axis_cosine", &G::least_axis_cosine, "", "A plane image ends there: 75 deg.",
       in_range(0.01, 1));
  term("view_footprint", &G::footprint, "x resolution",
       "Half-width that a point covers in the range image: neighbours overlap. "
       "Smaller leaves holes, larger widens silhouettes.",
       at_least(0));
  term("view_most_cells", &G::most_cells, "cells", "Of the range image, per side. Bounds memory.",
       in_range(1, 20000));
  term("view_most_half_cells", &G::most_half_cells, "cells",
       "Half-width of a point in it, at most: one right before the sensor does not fill it. Bounds "
       "time.",
       in_range(0, 1000));
}

}  // namespace

void add_terms(graph::Registration<SegmentParams>& node) {
  add_schedule_terms(node);
  add_pool(node);
  add_fit(node);
  add_score(node);
  add_confidence(node);
  add_color_terms(node);
  add_refinement(node);
  add_covariance(node);
  add_twins(node);
  add_shift(node);
  add_surface(node);
  add_icp(node);
  add_edges(node);
  add_contour(node);
  add_view(node);
}

}  // namespace posevote::poses
