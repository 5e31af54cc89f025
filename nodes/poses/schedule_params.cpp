// SPDX-License-Identifier: BSD-3-Clause
// What each term of ScheduleTerms is, as term_params.cpp says it of the others.
#include "nodes/poses/register_terms.hpp"

namespace posevote::poses {

using graph::in_range;

void add_schedule_terms(Node& node) {
  using G = ScheduleTerms;
  const Register<G> term{node, &Terms::schedule};
  term("glances", &G::glances, "poses",
       "Of more candidates those that the range image speaks for, by a peek, are glanced at. Time "
       "grows with it.",
       in_range(1, 10000));
  term("shortlist", &G::shortlist, "poses",
       "Improved and sketched; of an object that convinced nobody, glanced at. As many as keep the "
       "true pose of a "
       "thing hardly seen; time grows with it, by a neighbourhood query each.",
       in_range(1, 10000));
  term("shortlist_again", &G::shortlist_again, "poses",
       "Likewise, of an object that convinced nobody when more was in the scan. 0: it is not asked "
       "for again.",
       in_range(0, 10000));
  term("promising", &G::promising, "poses", "Brought closer by coarse ICP. Time grows with it.",
       in_range(0, 10000));
  term("finalists", &G::finalists, "poses",
       "Refined by ICP. Of more than four hardly any wins; time grows with it.", in_range(1, 1000));
  term("glance_points", &G::glance_points, "points",
       "Model points that judge a proposal as it came, by a peek and by a glance. Fewer are "
       "quicker, and lose true poses.",
       in_range(1, 1000000));
  term(
      "glance_reach", &G::glance_reach, "x inlier_distance",
      "How near these the scan must be: proposals lie off by part of a bandwidth. At 1, true poses "
      "are lost (LM-O: 3 of 8 instead of 4); far more, and any surface near does.",
      in_range(0.5, 10));
  term("sketch_points", &G::sketch_points, "points",
       "Model points that judge an improved one, and one brought closer.", in_range(1, 1000000));
  term("look_points", &G::look_points, "points",
       "Model points that judge what may be a finalist, and what ICP must not lose.",
       in_range(1, 1000000));
  term("close_points", &G::close_points, "points", "Model points that judge a refined pose.",
       in_range(1, 1000000));
  term("sketch_hopeless", &G::sketch_hopeless, "x best",
       "Poses of lower rank than this share of the best at a glance are not sketched: where a scan "
       "tells an object clearly, most. Of 1000 detections of nine sets 4 had less, 18 less than "
       "0.4. "
       "0 sketches the whole shortlist.",
       in_range(0, 1));
  term("closer_hopeless", &G::closer_hopeless, "x best",
       "Poses of lower rank than this share of the best sketch are not brought closer. 0: as many "
       "as "
       "are promising.",
       in_range(0, 1));
  term("hopeless", &G::hopeless, "x needed",
       "Poses of lower rank than this share of the best, or of min_score, are not refined: ICP "
       "seldom more than doubles a quality. 0 refines all finalists, at their cost.",
       in_range(0, 1));
  term("hopeless_odds", &G::hopeless_odds, "log odds",
       "Nor, but for the first, those that clues put so far below the usual.", in_range(-1e6, 0));
  term("sure", &G::sure, "",
       "Of a pose that is right with at least this probability no other object is asked, nor what "
       "else was proposed in its place.",
       in_range(0, 1));
}

}  // namespace posevote::poses
