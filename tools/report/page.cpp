// SPDX-License-Identifier: BSD-3-Clause
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
  return fill(kPageTemplate, whole);
}

}  // namespace posevote::html
