// SPDX-License-Identifier: BSD-3-Clause
#include "graph/schema.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <utility>

namespace posevote::graph {
namespace {

std::string join(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string_view trimmed(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  return text;
}

/// Whole-text number; a leading zero ("010") is refused because YAML readers disagree about it.
template <class T>
std::optional<T> parse_number(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const std::string_view digits = text.substr(text.starts_with('-') ? 1 : 0);
  if (digits.size() > 1 && digits[0] == '0' && digits[1] >= '0' && digits[1] <= '9')
    return std::nullopt;
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row.back();
}

}  // namespace

Constraint anything() { return {}; }

Constraint greater_than(double low) {
  Constraint constraint;
  constraint.low = low;
  constraint.open_low = true;
  return constraint;
}

Constraint at_least(double low) {
  Constraint constraint;
  constraint.low = low;
  return constraint;
}

Constraint in_range(double low, double high) {
  Constraint constraint;
  constraint.low = low;
  constraint.high = high;
  return constraint;
}

Constraint one_of(std::vector<std::string> choices) {
  Constraint constraint;
  constraint.choices = std::move(choices);
  return constraint;
}

std::string Constraint::text() const {
  if (!choices.empty()) return "one of " + join(choices);
  if (std::isfinite(high))
    return "in [" + Scalar<double>::print(low) + ", " + Scalar<double>::print(high) + "]";
  if (std::isfinite(low)) return (open_low ? "> " : ">= ") + Scalar<double>::print(low);
  return "";
}

std::optional<std::string> Constraint::violated_by(double value) const {
  const bool fine =
      std::isfinite(value) && value <= high && (open_low ? value > low : value >= low);
  if (fine) return std::nullopt;
  return text().empty() ? "must be finite" : "must be " + text();
}

std::optional<std::string> Constraint::violated_by(const std::string& value) const {
  if (choices.empty() || std::find(choices.begin(), choices.end(), value) != choices.end())
    return std::nullopt;
  const std::string near = closest_name(value, choices);
  return "must be " + text() + (near.empty() ? "" : ", did you mean '" + near + "'?");
}

std::optional<std::string> violation(const Constraint& constraint, double value) {
  return constraint.violated_by(value);
}
std::optional<std::string> violation(const Constraint& constraint, const std::string& value) {
  return constraint.violated_by(value);
}

std::optional<std::vector<std::string>> split_list(std::string_view text) {
  if (!text.starts_with('[') || !text.ends_with(']') || text.size() < 2) return std::nullopt;
  text = trimmed(text.substr(1, text.size() - 2));
  std::vector<std::string> items;
  while (!text.empty()) {
    const std::size_t comma = text.find(',');
    const std::string_view item = trimmed(text.substr(0, comma));
    if (item.empty()) return std::nullopt;
    items.emplace_back(item);
    if (comma == std::string_view::npos) break;
    text = text.substr(comma + 1);
    if (trimmed(text).empty()) return std::nullopt;
  }
  return items;
}

std::string join_list(const std::vector<std::string>& items) { return "[" + join(items) + "]"; }

std::optional<bool> Scalar<bool>::parse(std::string_view text) {
  if (text == "true") return true;
  if (text == "false") return false;
  return std::nullopt;
}
std::string Scalar<bool>::print(bool value) { return value ? "true" : "false"; }

std::optional<int> Scalar<int>::parse(std::string_view text) { return parse_number<int>(text); }
std::string Scalar<int>::print(int value) { return std::to_string(value); }

std::optional<double> Scalar<double>::parse(std::string_view text) {
  return parse_number<double>(text);
}
std::string Scalar<double>::print(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return std::string(text, end);
}

std::optional<std::string> Scalar<std::string>::parse(std::string_view text) {
  return std::string(text);
}
std::string Scalar<std::string>::print(const std::string& value) { return value; }

std::string closest_name(const std::string& name, const std::vector<std::string>& known) {
  std::string best;
  std::size_t best_distance = name.size() / 3 + 2;  // farther is no misspelling but another word
  for (const std::string& candidate : known) {
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

}  // namespace posevote::graph
