// SPDX-License-Identifier: BSD-3-Clause
// Text that comes from elsewhere: file names, tables, messages.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

namespace posevote {

/// As printf writes it, 319 characters at most.
template <class... Values>
std::string format(const char* pattern, Values... values) {
  char text[320];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

/// The parts between separators: one more than there are separators, none of an empty text.
std::vector<std::string> split(const std::string& text, char separator);

/// File names may hold any bytes: those that are no UTF-8 become U+FFFD.
std::string mend_utf8(const std::string& text);

/// For HTML and SVG, between tags and within quoted attributes: < > & " become entities, UTF-8 is
/// mended, control characters but tabs and line ends go.
std::string escape_markup(const std::string& text);

/// For terminals: a control character becomes its number in hexadecimal (\x1b), so that no file name
/// can steer the terminal; UTF-8 is mended.
std::string printable(const std::string& text);

/// One word of a command line for a POSIX shell: as it is, or in single quotes.
std::string quote_for_shell(const std::string& word);

/// "12 s", "4 min 40 s", "2 h 05 min".
std::string duration_text(double seconds);

}  // namespace posevote
