// SPDX-License-Identifier: BSD-3-Clause
// Walks through the text formats line by line, and within a line word by word. Every complaint
// names its line. Numbers are read by std::from_chars: fast, and the same on every locale.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace posevote::formats {

class TextScanner {
 public:
  /// `comment`: a character that begins a comment, which ends with the line.
  explicit TextScanner(std::string_view text, char comment = '\0');

  /// Goes to the next line that is not blank; false at the end of the text.
  bool next_line();
  /// The next word of the line, "" where nothing is left.
  std::string_view word();
  /// The next word of the line, which must be a number: "+1", "1e-3", "nan", "-inf", "1.#QNAN" too.
  double number();
  bool line_done();
  /// What is left of the line, without blanks at its ends.
  std::string rest_of_line();

  /// Of the current line, from 1.
  std::size_t line() const { return line_; }
  /// Where the next line begins.
  std::size_t next_offset() const { return next_; }
  /// Throws std::runtime_error "line N: problem".
  [[noreturn]] void fail(const std::string& problem) const;

 private:
  void skip_blanks();
  double odd_number();

  std::string_view text_;
  char comment_;
  std::size_t next_ = 0;
  std::size_t line_ = 0;
  const char* at_ = nullptr;
  const char* end_ = nullptr;
};

/// The whole of `word` as an integer, or nothing.
std::optional<std::int64_t> to_integer(std::string_view word);
/// The next word of the line as a count, 0 to 2^32. `what` is for the complaint: "vertices".
std::uint64_t read_count(TextScanner& in, const std::string& what);

}  // namespace posevote::formats
