// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/template.hpp"

#include <stdexcept>

#include "tools/text.hpp"

namespace posevote::html {
namespace {

/// What of the template comes before `mark`, which is taken away with it.
std::string_view take_until(std::string_view& text, const std::string& mark) {
  const std::size_t at = text.find(mark);
  if (at == text.npos) throw std::logic_error("the template lacks " + mark);
  const std::string_view taken = text.substr(0, at);
  text.remove_prefix(at + mark.size());
  return taken;
}

template <class T>
const T& find(const std::map<std::string, T>& values, const std::string& name) {
  const auto found = values.find(name);
  if (found == values.end()) throw std::logic_error("nothing fills the slot " + name);
  return found->second;
}

}  // namespace

std::string fill(std::string_view text, const Slots& slots) {
  std::string out;
  while (text.find("{{") != text.npos) {
    out += take_until(text, "{{");
    const bool is_markup = text.starts_with('{'), is_list = text.starts_with('#');
    if (is_markup || is_list) text.remove_prefix(1);
    const std::string name(take_until(text, is_markup ? "}}}" : "}}"));
    if (is_list) {
      const std::string_view body = take_until(text, "{{/" + name + "}}");
      for (const Slots& entry : find(slots.lists, name)) out += fill(body, entry);
    } else {
      const std::string& value = find(slots.texts, name);
      out += is_markup ? value : escape_markup(value);
    }
  }
  return out.append(text);
}

}  // namespace posevote::html
