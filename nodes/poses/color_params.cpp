// SPDX-License-Identifier: BSD-3-Clause
// What each term of ColorTerms is, as term_params.cpp says it of the others.
#include "nodes/poses/register_terms.hpp"

namespace posevote::poses {

using graph::at_least;
using graph::greater_than;
using graph::in_range;

void add_color_terms(Node& node) {
  using G = ColorTerms;
  const Register<G> term{node, &Terms::color};
  term("color_lightness", &G::lightness, "x chromaticity",
       "What a difference of lightness counts beside one of chromaticity: shading changes it, too.",
       at_least(0));
  term("color_noise", &G::noise, "CIELAB",
       "Deviation that says nothing, so that a plain surface is like no other.", greater_than(0));
  term("color_patch", &G::patch, "x diagonal",
       "Edge of the places whose colours count as one, because neighbours are alike.",
       in_range(0.001, 1));
  term("color_err_alike", &G::err_alike, "points",
       "So many points of twins' shapes count for one beside colours, in how probable the other "
       "twin "
       "is: what patches of a speckle sensor's residuals tell (pose_covariance.hpp), 5 to 10.",
       at_least(1));
  term("color_step", &G::step, "deg",
       "Of the turns about an axis of symmetry that are tried. Finer ones find narrow labels and "
       "take longer.",
       in_range(1, 180));
  term("color_glance_points", &G::glance_points, "points",
       "Model points that judge such a turn. Time grows with it.", in_range(20, 1000000));
  term("color_look_points", &G::look_points, "points",
       "Model points that judge the colours of a pose.", in_range(20, 1000000));
  term("color_usual_likeness", &G::usual_likeness, "correlation",
       "Of what is seen and expected, of true poses of objects of much contrast: 0.3 to 0.85 on "
       "RGB-D images of packages.",
       in_range(0.01, 0.99));
  term("color_likeness_spread", &G::likeness_spread, "z",
       "Deviation of Fisher's z of the likeness beside what so few places scatter by: gloss, "
       "shadows, a print that changed.",
       greater_than(0));
  term("color_plain", &G::plain, "CIELAB",
       "Deviation of an object's colours at which half of that likeness is to be expected.",
       greater_than(0));
  term("color_tint", &G::tint, "CIELAB",
       "Deviation of the mean chromaticity, of true poses: light and camera.", greater_than(0));
  term("color_any_tint", &G::any_tint, "CIELAB", "And of any surface's.", greater_than(0));
  term("confidence_color_offset", &G::offset, "log odds",
       "Confidence that colours add whatever they say. Found by posevote calibrate --colors.",
       in_range(-1e6, 1e6));
  term("confidence_color_doubt", &G::doubt, "",
       "Share of detections of which colours say nothing: the picture is of another moment, the "
       "print of another year. The logarithm is the most that colours can take from the log odds.",
       in_range(1e-6, 1));
  const auto weight = [&](const char* name, double ColorClues::*clue) {
    node.expert_param(
        name, [clue](SegmentParams& params) -> double& { return params.terms.color.weights.*clue; },
        "log odds", "Weight of that clue in the confidence. Found by posevote calibrate --colors.",
        in_range(-1e6, 1e6));
  };
  weight("confidence_color_likeness", &ColorClues::likeness);
  weight("confidence_color_tint", &ColorClues::tint);
}

}  // namespace posevote::poses
