// SPDX-License-Identifier: BSD-3-Clause
// Which stage a verdict names, by made-up figures.
#include <catch2/catch.hpp>

#include "tools/explain/attempts.hpp"
#include "tools/explain/misses.hpp"
#include "tools/explain/sentences.hpp"
#include "tools/explain/verdict.hpp"

namespace posevote::explain_verdict_test {

using namespace posevote::explain;

namespace {

/// A pose that all stages let pass: seen, described, matched, voted for, sure.
Standing good() {
  Standing at;
  at.seen.supported = 0.8;
  at.seen.hidden = 0.1;
  at.features = 200;
  at.matched = 60;
  at.agreeing = 30;
  at.pairs = 5;
  at.density = 20;
  at.highest = 25;
  at.rank = 2;
  at.peaks = 500;
  at.way = {{"propose", 2, 500}, {"glance", 1, 160}, {"look", 1, 20}, {"refine", 1, 4}};
  at.judged.confidence = at.left.confidence = 0.9;
  return at;
}

Case missed(const Standing& at, bool is_true = true) {
  Case of;
  of.diagonal = 0.1;
  of.scan_size = 1;
  of.usual_size = 0.12;
  of.matches = 100;
  of.nms_radius = 0.01;
  of.is_true = is_true;
  of.pose = at;
  return of;
}

Cause cause_of(const Standing& at, bool is_true = true) {
  return judge_case(missed(at, is_true)).cause;
}

/// Nobody looked at it closely.
Standing lost_at(const std::string& step) {
  Standing at = good();
  at.way = {{"propose", 2, 500}, {step, 0, 160}};
  return at;
}

/// No vote made a proposal near it.
Standing never_proposed() {
  Standing at = good();
  at.rank = 0;
  at.way = {{"propose", 0, 500}};
  return at;
}

}  // namespace

TEST_CASE("a found object needs no cause", "[explain]") {
  Case of = missed(good());
  of.is_found = true;
  CHECK(judge_case(of).cause == Cause::kFound);
}

TEST_CASE("what is not seen is not seen, and why", "[explain]") {
  Standing at = never_proposed();
  at.seen = {};
  at.seen.supported = 0.02;
  at.seen.hidden = 0.9;
  CHECK(cause_of(at) == Cause::kNotSeen);
  CHECK(judge_case(missed(at)).detail == "hidden");
  at.seen.hidden = 0.05;
  at.seen.outside = 0.9;
  CHECK(judge_case(missed(at)).detail == "outside");
  at.seen.outside = 0.05;
  at.seen.unmeasured = 0.9;
  CHECK(judge_case(missed(at)).detail == "unmeasured");
}

TEST_CASE("what is seen of a pose may be little, and yet do: then the search lost it",
          "[explain]") {
  Standing at = lost_at("glance");
  at.seen = {};
  at.seen.supported = 0.12;
  at.seen.hidden = 0.85;
  CHECK(cause_of(at) == Cause::kOutranked);
  at.left.confidence = 0.2;
  CHECK(cause_of(at) == Cause::kNotSeen);
}

TEST_CASE("each stage before the search is named by its figures", "[explain]") {
  Standing at = never_proposed();
  at.agreeing = at.pairs = 0;
  CHECK(cause_of(at) == Cause::kDisagree);
  at.matched = 1;
  at.other = "carton";
  CHECK(cause_of(at) == Cause::kNotMatched);
  CHECK(judge_case(missed(at)).stage == "carton");
  at.features = 3;
  CHECK(cause_of(at) == Cause::kFewFeatures);
  at.rank = 40;  // few as they are, they were enough for a proposal
  at.way = lost_at("glance").way;
  CHECK(cause_of(at) == Cause::kOutranked);
}

TEST_CASE("a pose that would be sure, but was not looked at, was outranked where it went",
          "[explain]") {
  const explain::Verdict verdict = judge_case(missed(lost_at("sketch")));
  CHECK(verdict.cause == Cause::kOutranked);
  CHECK(verdict.stage == "sketch");
}

TEST_CASE("ICP that leaves a good proposal is named", "[explain]") {
  Standing at = lost_at("refine");
  at.stayed = false;
  CHECK(cause_of(at) == Cause::kMoved);
}

TEST_CASE("a pose that was judged: refused by a clue, robbed, too near, or in another",
          "[explain]") {
  Standing at = good();
  at.judged.confidence = at.left.confidence = 0.3;
  at.judged.against[kOutline] = 2;
  CHECK(cause_of(at) == Cause::kRefused);
  CHECK(judge_case(missed(at)).stage == "outline");
  at.judged.confidence = 0.9;  // less sure beside the scan's other instances
  at.left.score = 0.5;
  at.left.against[kExactness] = 3;
  CHECK(judge_case(missed(at)).stage == "exactness");
  at.left.confidence = 0.9;
  CHECK(cause_of(at) == Cause::kMoved);
  at.left.confidence = 0.3;
  at.taken = 0.7;
  at.taker = "plate";
  CHECK(cause_of(at) == Cause::kTaken);
  CHECK(judge_case(missed(at)).stage == "plate");
  at.near_same = 0.005;
  CHECK(cause_of(at) == Cause::kTooNear);
  at.near_same = 0.5;
  CHECK(cause_of(at) == Cause::kTaken);
  Case of = missed(at);
  of.pose->inside = 0.4;
  of.overlap = 0.1;
  CHECK(judge_case(of).cause == Cause::kInside);
}

TEST_CASE("a model of another unit is named before anything else", "[explain]") {
  Case of = missed(good());
  of.diagonal = 100;
  CHECK(judge_case(of).cause == Cause::kUnit);
  of.diagonal = 0.0001;
  CHECK(judge_case(of).cause == Cause::kUnit);
  of.usual_size = 0;  // one object alone: only the scan tells
  of.diagonal = 100;
  CHECK(judge_case(of).cause == Cause::kUnit);
}

TEST_CASE("what the true poses do not have is absent", "[explain]") {
  Case of = missed(good(), false);
  of.is_absent = true;
  CHECK(judge_case(of).cause == Cause::kAbsent);
}

TEST_CASE("without a candidate the matches tell", "[explain]") {
  Case of = missed(good(), false);
  of.pose.reset();
  CHECK(judge_case(of).cause == Cause::kNoTrace);
  of.matches = 0;
  CHECK(judge_case(of).cause == Cause::kNotMatched);
}

TEST_CASE("without the true pose a doubtful candidate is refused, a hopeless one is none",
          "[explain]") {
  Standing at = good();
  at.judged.confidence = at.left.confidence = 0.3;
  CHECK(cause_of(at, false) == Cause::kRefused);
  at.judged.confidence = at.left.confidence = 0.01;
  CHECK(cause_of(at, false) == Cause::kNoTrace);
  at.left.confidence = 0.3;  // what spoke against it was another instance
  CHECK(cause_of(at, false) == Cause::kRefused);
  at.judged.confidence = at.left.confidence = 0.9;  // what was refined near it was not
  CHECK(cause_of(at, false) == Cause::kMoved);
  at.way = lost_at("glance").way;  // a deeper search found it
  CHECK(cause_of(at, false) == Cause::kOutranked);
  at.rank = at.agreeing = at.pairs = 0;  // and nothing speaks for it but that it fits
  CHECK(cause_of(at, false) == Cause::kNoTrace);
}

TEST_CASE("what would be sure but for one clue is refused for it, where votes say it is there",
          "[explain]") {
  Standing at = good();
  at.judged.confidence = at.left.confidence = 0.01;
  at.judged.against[kOverhang] = 7;
  at.judged.against[kVotes] = 1;
  CHECK(at.judged.forgiven() == Approx(0.917).margin(0.001));
  CHECK(cause_of(at, false) == Cause::kRefused);
  CHECK(judge_case(missed(at, false)).stage == "overhang");
  at.judged.colors_against = 8;
  CHECK(judge_case(missed(at, false)).stage == "colors");
  Standing disproved = at;
  disproved.judged.confidence = 1e-5;
  disproved.judged.against[kOverhang] = 14;
  CHECK(cause_of(disproved, false) == Cause::kNoTrace);
  at.agreeing = at.pairs = 4;
  CHECK(cause_of(at, false) == Cause::kNoTrace);
  at = good();
  at.judged.confidence = at.left.confidence = 0.01;
  at.judged.against[kOverhang] = 7;
  at.density = 0.4 * at.highest;  // other places have more
  CHECK(cause_of(at, false) == Cause::kNoTrace);
}

TEST_CASE("a cause that is named without the true pose is held against it", "[explain]") {
  Explained one;
  one.guess = {Cause::kRefused, "overhang", ""};
  one.verdict = {Cause::kRefused, "votes", ""};
  CHECK_FALSE(is_confirmed(one));
  one.best_is_true = true;  // of one pose, whichever clue is the worst of two alike
  CHECK(is_confirmed(one));
  one.guess = {Cause::kNoTrace, "overhang", ""};
  CHECK_FALSE(is_confirmed(one));
  one.verdict = {Cause::kNotSeen, "", "hidden"};
  CHECK(is_confirmed(one));
  one.verdict = {Cause::kRefused, "overhang", ""};  // of the object itself, and with its reason
  CHECK(is_confirmed(one));
  one.verdict.stage = "votes";
  CHECK_FALSE(is_confirmed(one));
  one.verdict.stage = "overhang";
  one.best_is_true = false;
  CHECK_FALSE(is_confirmed(one));
}

TEST_CASE("sentences hold the figures", "[explain]") {
  Explained one;
  one.model = "plate";
  Standing at = lost_at("sketch");
  at.judged.against[kVotes] = 1.5;
  one.best = at;
  const Case of = missed(at);
  one.verdict = judge_case(of);
  std::string text;
  for (const std::string& sentence : sentences(one, of)) text += sentence + "\n";
  INFO(text);
  for (const char* part : {"80 % lie on the scan", "200 of the scan's", "60 of them", "30 corresp",
                           "20.0 there", "lost at 'sketch'", "confidence 0.90", "votes (-1.5)"})
    CHECK(text.find(part) != std::string::npos);
}

TEST_CASE("only settings that act on the stage are tried", "[explain]") {
  Explained one;
  const auto settings = [&one](Cause cause, const std::string& stage) {
    one.verdict = {cause, stage, ""};
    return settings_for(one, {}, 0.004);
  };
  CHECK(settings(Cause::kNotSeen, "").empty());
  CHECK(settings(Cause::kOutranked, "peek").front() == "segment_objects.glances=2400");
  CHECK(settings(Cause::kOutranked, "glance").front() == "segment_objects.shortlist=640");
  CHECK(settings(Cause::kOutranked, "refine").front() == "segment_objects.finalists=20");
  CHECK(settings(Cause::kDisagree, "").at(3) == "scan_octaves.finest=0.002");
  one.best = good();
  one.best->left.confidence = 0.3;
  CHECK(settings(Cause::kRefused, "votes") ==
        std::vector<std::string>{"segment_objects.min_confidence=0.30"});
  CHECK(settings(Cause::kRefused, "exactness").front() == "segment_objects.max_residual=2");
  one.best->left.confidence = 0.01;  // nothing makes that one right
  CHECK(settings(Cause::kRefused, "votes").empty());
}

}  // namespace posevote::explain_verdict_test
