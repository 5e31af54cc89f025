// SPDX-License-Identifier: BSD-3-Clause
// Fills templates: a subset of Mustache. What fills a slot is never read as a template itself.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace posevote::html {

/// The frame of the page and its looks: tools/report/page.html, part of the program.
extern const std::string_view kPageTemplate;
/// What shows scans in 3D, for a <script>: three.js with its licence, and tools/report/page/*.js.
extern const std::string_view kViewerScript;

struct Slots {
  std::map<std::string, std::string> texts;         ///< by name
  std::map<std::string, std::vector<Slots>> lists;  ///< by name
};

/// `{{name}}` gives way to the text of that name, escaped; `{{{name}}}` to the text as it is, which
/// must be markup; what stands between `{{#name}}` and `{{/name}}` is there once for each entry of
/// the list of that name, filled from the entry alone. Throws std::logic_error naming a slot that
/// has nothing to fill it, or a list that does not end.
std::string fill(std::string_view text, const Slots& slots);

}  // namespace posevote::html
