// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/units.hpp"

#include <stdexcept>

namespace posevote::formats {
namespace {

struct Unit {
  const char* name;
  double metres;
};
constexpr Unit kUnits[] = {{"mm", 0.001}, {"cm", 0.01}, {"m", 1}, {"in", 0.0254}};

}  // namespace

const std::vector<std::string>& length_units() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Unit& unit : kUnits) all.emplace_back(unit.name);
    return all;
  }();
  return names;
}

double metres_per(const std::string& unit) {
  for (const Unit& known : kUnits)
    if (unit == known.name) return known.metres;
  throw std::invalid_argument("'" + unit + "' is no unit of length");
}

}  // namespace posevote::formats
