// SPDX-License-Identifier: BSD-3-Clause
// What reaches the terminal: lines, and below them one live line that is redrawn in place.
//
// Everything passes through here, so that no line smears the live one and no file name steers the
// terminal: control characters are written as their numbers.
#pragma once

#include <string>

namespace posevote::console {

/// To be called once, first of all: opens what of standard input, output and error is closed (else
/// the next file would take its place and its text), and sends std::cout, std::cerr and the log
/// through here.
void begin();

/// Whether standard error is a terminal that can redraw a line: not with TERM=dumb or none.
bool is_live();

/// Draws the live line anew; "" takes it away. Only where is_live().
void draw(const std::string& text);

/// A line to standard error.
void complain(const std::string& line);

/// Seconds since anything but the live line was written.
double silence();

/// What fits into `columns`, cut at a character; those that are no ASCII count as two columns.
std::string cut_to_width(const std::string& text, std::size_t columns);

}  // namespace posevote::console
