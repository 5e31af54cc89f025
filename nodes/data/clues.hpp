// SPDX-License-Identifier: BSD-3-Clause
// What speaks for and against a detection, as its confidence is made from it.
#pragma once

#include <array>
#include <cstddef>

namespace posevote {

/// Numbers of clues that do not depend on units, the object's size or the sensor, each so that the
/// log odds of a true pose are about linear in it (poses/confidence.hpp).
enum Clue : std::size_t {
  kAgreement,  ///< log odds of the points that take a side being for the pose
  kRelief,     ///< log of how differently the supported normals point
  kOutline,    ///< log of how much of the model's outline the scan's meets
  kOverhang,   ///< share of the outline beyond which the scan goes on, times kSupport
  kVotes,      ///< log of votes per feature on the pose
  kLead,       ///< log of its support over that of the best proposal elsewhere
  kExactness,  ///< log of the systematic residual of the scan's other instances over its own,
               ///< at most 0
  kSupport,    ///< log of how many model points are supported
  kGaps,       ///< log of how much of the model's gaps and outline the scan's meets, looked at
               ///< closely
  kFilled,     ///< log odds of the scan having a surface in its holes and slots, as far as these
               ///< are looked into
  kVisible,    ///< log of the share of what faces the sensor that nothing hides, times -kRelief
  kSunk,       ///< share of its surface that lies in the ground
  kOutside,  ///< share of what faces the sensor that lies beside the image, times what kLead lacks
             ///< of a clear lead
  kStrangers,  ///< log of how well the things in the scan are known, at most 0: of few kinds that
               ///< are looked for, and little that was found, it may be another's look-alike
  kCompany,    ///< log odds that the scan's other instances give: one that repeats a kind where
               ///< all else is there once is doubted, one that completes what is looked for is not
  kClueCount
};

constexpr std::array<const char*, kClueCount> kClueNames{
    "agreement", "relief", "outline", "overhang", "votes",   "lead",      "exactness", "support",
    "gaps",      "filled", "visible", "sunk",     "outside", "strangers", "company"};

using Clues = std::array<double, kClueCount>;

/// Log odds by Bayes' rule, whose weight is 1; the others' weights are found by regression.
constexpr bool is_by_bayes(std::size_t clue) { return clue == kStrangers || clue == kCompany; }

/// What colours say of a detection, where the scan and the model have any: log odds, as far as one
/// knows, of them being the object's and not anybody's (poses/color_fit.hpp).
struct ColorClues {
  double likeness = 0;  ///< of how they vary over the object
  double tint = 0;      ///< of what they are on the mean
};

}  // namespace posevote
