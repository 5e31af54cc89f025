// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/text_scanner.hpp"

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "nodes/formats/file_bytes.hpp"

namespace posevote::formats {
namespace {

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// What from_chars does not take as it stands: a plus sign, values beyond double, and how the C
/// library of Windows printed NaN and infinity.
std::optional<double> parse_odd(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  double value = 0;
  const char* end = word.data() + word.size();
  const auto [next, error] = std::from_chars(word.data(), end, value);
  if (error == std::errc::invalid_argument) return std::nullopt;
  if (next != end) {
    const std::string_view rest(next, static_cast<std::size_t>(end - next));
    if (rest.starts_with("#INF")) return std::copysign(HUGE_VAL, value);
    if (rest.starts_with('#')) return std::numeric_limits<double>::quiet_NaN();
    return std::nullopt;
  }
  if (error == std::errc()) return value;
  const bool tiny = word.find("e-") != word.npos || word.find("E-") != word.npos;
  return tiny ? 0.0 : std::copysign(HUGE_VAL, word[0] == '-' ? -1.0 : 1.0);
}

}  // namespace

TextScanner::TextScanner(std::string_view text, char comment) : text_(text), comment_(comment) {}

bool TextScanner::next_line() {
  while (next_ < text_.size()) {
    ++line_;
    at_ = text_.data() + next_;
    const std::size_t left = text_.size() - next_;
    const void* newline = std::memchr(at_, '\n', left);
    end_ = newline ? static_cast<const char*>(newline) : at_ + left;
    next_ = static_cast<std::size_t>(end_ - text_.data()) + (newline ? 1 : 0);
    if (comment_ != '\0') {
      const void* comment = std::memchr(at_, comment_, static_cast<std::size_t>(end_ - at_));
      if (comment) end_ = static_cast<const char*>(comment);
    }
    if (!line_done()) return true;
  }
  at_ = end_;
  return false;
}

void TextScanner::skip_blanks() {
  while (at_ != end_ && is_blank(*at_)) ++at_;
}

bool TextScanner::line_done() {
  skip_blanks();
  return at_ == end_;
}

std::string_view TextScanner::word() {
  skip_blanks();
  const char* begin = at_;
  while (at_ != end_ && !is_blank(*at_)) ++at_;
  return {begin, static_cast<std::size_t>(at_ - begin)};
}

std::string TextScanner::rest_of_line() {
  skip_blanks();
  const char* begin = at_;
  at_ = end_;
  const char* last = end_;
  while (last != begin && is_blank(*(last - 1))) --last;
  return {begin, last};
}

double TextScanner::number() {
  skip_blanks();
  double value = 0;
  const auto [next, error] = std::from_chars(at_, end_, value);
  if (error != std::errc() || (next != end_ && !is_blank(*next))) return odd_number();
  at_ = next;
  return value;
}

double TextScanner::odd_number() {
  const std::string_view text = word();
  if (text.empty()) fail("ends where a number was expected");
  const std::optional<double> value = parse_odd(text);
  if (!value) fail("expected a number, found " + in_quotes(text));
  return *value;
}

void TextScanner::fail(const std::string& problem) const {
  throw std::runtime_error("line " + std::to_string(line_) + ": " + problem);
}

std::optional<std::int64_t> to_integer(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  std::int64_t value = 0;
  const char* end = word.data() + word.size();
  const auto [next, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || next != end) return std::nullopt;
  return value;
}

std::uint64_t read_count(TextScanner& in, const std::string& what) {
  const std::string_view text = in.word();
  const std::optional<std::int64_t> count = to_integer(text);
  if (!count || *count < 0 || *count > (std::int64_t{1} << 32))
    in.fail("expected the number of " + what + ", 0 to 2^32, found " + in_quotes(text));
  return static_cast<std::uint64_t>(*count);
}

}  // namespace posevote::formats
