// SPDX-License-Identifier: BSD-3-Clause
// The frame of the page and its looks: light or dark as the reader's system is, black on paper.
#include <spdlog/fmt/fmt.h>

#include "tools/report/html.hpp"
#include "tools/text.hpp"

namespace posevote::html {
namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --back: #fff; --text: #1c1e21; --faint: #686d73;
  --line: #dcdfe3; --plate: #f4f5f7; --accent: #0072b2; }
@media (prefers-color-scheme: dark) {
  :root { --back: #16181b; --text: #e3e5e8; --faint: #9aa0a8; --line: #33373d; --plate: #202327;
    --accent: #56b4e9; }
  img.plot { filter: invert(0.9) hue-rotate(180deg); }
}
body { margin: 0 auto; padding: 1.5rem; max-width: 76rem; background: var(--back);
  color: var(--text); font: 15px/1.45 system-ui, sans-serif; }
h1 { font-size: 1.5rem; margin: 0 0 1rem; overflow-wrap: anywhere; }
h2 { font-size: 1.2rem; margin: 2.2rem 0 0.8rem; padding-bottom: 0.3rem;
  border-bottom: 1px solid var(--line); overflow-wrap: anywhere; }
h3 { font-size: 1rem; margin: 1.5rem 0 0.4rem; }
p, footer { margin: 0.4rem 0; color: var(--faint); max-width: 60rem; overflow-wrap: anywhere; }
a { color: var(--accent); }
nav ul { margin: 0; padding: 0; list-style: none; display: flex; flex-wrap: wrap; }
nav li { margin: 0 1.2rem 0.3rem 0; }
.wide { overflow-x: auto; margin: 0.4rem 0; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: 0.92rem; }
th, td { text-align: left; vertical-align: top; padding: 0.25rem 0.8rem 0.25rem 0; }
th { color: var(--faint); font-weight: 600; border-bottom: 1px solid var(--line);
  vertical-align: bottom; }
.long { max-width: 22rem; min-width: 11rem; overflow-wrap: anywhere; }
.number { text-align: right; white-space: nowrap; }
tbody + tbody, tbody tr + tr { border-top: 1px solid var(--line); }
.frames tbody tr + tr { border-top: 0; }
dl { display: flex; flex-wrap: wrap; margin: 0.6rem 0; }
dl div { background: var(--plate); border-radius: 6px; padding: 0.5rem 0.9rem;
  margin: 0 0.6rem 0.6rem 0; }
dt { color: var(--faint); font-size: 0.82rem; }
dd { margin: 0; font-size: 1.2rem; font-variant-numeric: tabular-nums; }
details { margin: 0.4rem 0; }
summary { cursor: pointer; color: var(--accent); }
pre { background: var(--plate); border-radius: 6px; padding: 0.8rem; overflow-x: auto;
  font-size: 0.85rem; }
svg.bars { display: block; fill: var(--accent); stroke: var(--line); }
svg.bars rect { stroke: none; }
img { max-width: none; }
img.thumbnail { width: 11rem; margin-top: 0.3rem; border-radius: 4px; cursor: zoom-in;
  display: block; }
img.thumbnail:focus { position: fixed; inset: 2vmin; margin: auto; width: auto; max-width: 96vw;
  max-height: 96vh; z-index: 1; cursor: default; box-shadow: 0 0 0 100vmax rgb(0 0 0 / 0.7); }
footer { margin-top: 2.5rem; font-size: 0.85rem; }
@media print {
  :root { --back: #fff; --text: #000; --faint: #444; --line: #bbb; --plate: #f4f4f4;
    --accent: #0072b2; }
  body { max-width: none; padding: 0; font-size: 10pt; }
  img.plot { max-width: 100%; filter: none; }
  .wide, pre { overflow: visible; }
  pre { white-space: pre-wrap; }
  tr, dl div { break-inside: avoid; }
  h2, h3 { break-after: avoid; }
}
)";

std::string links(const std::vector<Section>& sections) {
  std::string text = "<nav><ul>\n";
  for (std::size_t i = 0; i < sections.size(); ++i)
    text +=
        fmt::format("<li><a href=\"#part{}\">{}</a></li>\n", i, escape_markup(sections[i].title));
  return text + "</ul></nav>\n";
}

}  // namespace

std::string page(const std::string& title, const std::vector<Section>& sections) {
  const std::string safe = escape_markup(title);
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
      "<title>{0} - posevote</title>\n<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n",
      safe, kStyle);
  if (sections.size() > 1) text += links(sections);
  for (std::size_t i = 0; i < sections.size(); ++i)
    text +=
        fmt::format("<section>\n<h2 id=\"part{}\">{}</h2>\n", i, escape_markup(sections[i].title)) +
        sections[i].markup + "</section>\n";
  return text + "<footer>Made by <code>posevote report</code>.</footer>\n</body>\n</html>\n";
}

}  // namespace posevote::html
