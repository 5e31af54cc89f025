// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/units.hpp"

#include <cstdio>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace posevote::formats {
namespace {

struct Unit {
  const char* name;
  double metres;
};
/// The more common first: of two mistakes that explain a size alike the earlier is believed.
constexpr Unit kUnits[] = {{"mm", 0.001}, {"m", 1}, {"cm", 0.01}, {"in", 0.0254}};

constexpr double kSmallestModel = 0.001, kLargestModel = 20;  ///< beyond, the unit is in doubt [m]
constexpr double kUsualModel[] = {0.01, 2};                   ///< what people look for [m]

}  // namespace

const std::vector<std::string>& length_units() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Unit& unit : kUnits) all.emplace_back(unit.name);
    return all;
  }();
  return names;
}

const std::vector<std::string>& units_or_auto() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = length_units();
    all.insert(all.begin(), "auto");
    return all;
  }();
  return names;
}

LikelyUnit likely_unit(double size, double least_mm) {
  constexpr double kClear = 3;
  LikelyUnit likely{size < least_mm ? "m" : "mm", ""};
  if (size > least_mm / kClear && size < least_mm * kClear) {
    char text[96];
    std::snprintf(text, sizeof text, "nobody says its unit, and %.4g could be mm or m: read as %s",
                  size, likely.unit.c_str());
    likely.doubt = text;
  }
  return likely;
}

double metres_per(const std::string& unit) {
  for (const Unit& known : kUnits)
    if (unit == known.name) return known.metres;
  throw std::invalid_argument("'" + unit + "' is no unit of length");
}

std::optional<UnitMistake> unit_mistake(double size, double low, double high,
                                        const std::string& read_as) {
  if (size >= low && size <= high) return std::nullopt;
  const std::size_t count = std::size(kUnits);
  for (std::size_t later = 1; later < count; ++later)  // pairs of common units first
    for (std::size_t earlier = 0; earlier < later; ++earlier)
      for (const auto& [is, read] : {std::pair(earlier, later), std::pair(later, earlier)}) {
        if (!read_as.empty() && read_as != kUnits[read].name) continue;
        const double right = size / kUnits[read].metres * kUnits[is].metres;
        if (right >= low && right <= high) return UnitMistake{kUnits[is].name, kUnits[read].name};
      }
  return std::nullopt;
}

std::string odd_model_size(double diagonal, const std::string& unit) {
  if (diagonal >= kSmallestModel && diagonal <= kLargestModel) return "";
  const std::string read = "its diagonal is " + in_metres(diagonal) + ", read as " + unit;
  const auto mistake = unit_mistake(diagonal, kUsualModel[0], kUsualModel[1], unit);
  return mistake ? read + ": is it in " + mistake->is + "? Say --model-unit " + mistake->is +
                       " (load_models.unit)"
                 : read + ": check --model-unit (load_models.unit)";
}

std::string in_metres(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g m", length);
  return text;
}

}  // namespace posevote::formats
