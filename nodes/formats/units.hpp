// SPDX-License-Identifier: BSD-3-Clause
// Units of length that files may be in, and how to tell that one was mistaken for another.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace posevote::formats {

/// "mm", "cm", "m" and "in".
const std::vector<std::string>& length_units();

/// "auto" and these.
const std::vector<std::string>& units_or_auto();

/// The unit that lengths are likely in of which the largest is `size` in the file's own: millimetres
/// from `least_mm` up, else metres. `doubt`: words for the user where it is within three times of
/// that either way, else "".
struct LikelyUnit {
  std::string unit, doubt;
};
LikelyUnit likely_unit(double size, double least_mm);

/// Metres per one of length_units(). Throws std::invalid_argument for any other.
double metres_per(const std::string& unit);

/// One unit taken for another.
struct UnitMistake {
  std::string is;       ///< of the file
  std::string read_as;  ///< what it was taken for
};

/// The likeliest mistake by which a length was read as `size` [m] that ought to lie in [low, high]
/// [m]; nothing where it lies there, or none explains it. `read_as`: the unit it was read in, ""
/// where that is not known.
std::optional<UnitMistake> unit_mistake(double size, double low, double high,
                                        const std::string& read_as = "");

/// What is evidently wrong with the diagonal of a model [m] that was read in `unit`, and which unit
/// would fit; "" for sizes that objects have: from 1 mm to 20 m.
std::string odd_model_size(double diagonal, const std::string& unit);

/// For messages: "0.1 m", four digits.
std::string in_metres(double length);

}  // namespace posevote::formats
