// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "tools/report/html.hpp"
#include "tools/report/template.hpp"

namespace posevote::html {

std::string page(const std::string& title, const std::vector<Section>& sections) {
  Slots whole{{{"title", title}}, {}};
  std::vector<Slots>& parts = whole.lists["sections"];
  std::vector<Slots> links;
  for (const Section& section : sections) {
    links.push_back({{{"number", std::to_string(parts.size())}, {"title", section.title}}, {}});
    parts.push_back(links.back());
    parts.back().texts["markup"] = section.markup;
  }
  whole.lists["contents"].resize(sections.size() > 1 ? 1 : 0);
  for (Slots& contents : whole.lists["contents"]) contents.lists["links"] = links;
  const bool shows_runs = std::any_of(sections.begin(), sections.end(), [](const Section& section) {
    return section.markup.find("<div class=\"run\"") != std::string::npos;
  });
  if (shows_runs) whole.lists["viewer"] = {{{{"script", std::string(kViewerScript)}}, {}}};
  whole.lists.try_emplace("viewer");
  return fill(kPageTemplate, whole);
}

}  // namespace posevote::html
