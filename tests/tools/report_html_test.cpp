// SPDX-License-Identifier: BSD-3-Clause
// What the page of `posevote report` is made of.
#include <catch2/catch.hpp>

#include "tests/support/temporary_folder.hpp"
#include "tools/quantiles.hpp"
#include "tools/report/html.hpp"
#include "tools/report/template.hpp"
#include "tools/text.hpp"

namespace posevote::report_html_test {

using namespace posevote::test;

TEST_CASE("base64 and the median are as everyone has them", "[report]") {
  CHECK(html::base64("") == "");
  CHECK(html::base64("f") == "Zg==");
  CHECK(html::base64("fo") == "Zm8=");
  CHECK(html::base64("foo") == "Zm9v");
  CHECK(html::base64("foobar") == "Zm9vYmFy");
  CHECK(html::base64(std::string("\x00\xff\xfe", 3)) == "AP/+");
  CHECK(median({}) == 0);
  CHECK(median({3, 1, 2}) == 2);
  CHECK(median({4, 1, 3, 2}) == 2.5);
  CHECK(quantile({}, 0.5) == 0);
  CHECK(quantile({4, 1, 3, 2}, 0) == 1);
  CHECK(quantile({4, 1, 3, 2}, 0.5) == 2);
  CHECK(quantile({4, 1, 3, 2}, 0.51) == 3);
  CHECK(quantile({4, 1, 3, 2}, 0.99) == 4);
}

TEST_CASE("text from elsewhere cannot become markup", "[report]") {
  CHECK(escape_markup("<a href=\"x\">&'\x01\t") == "&lt;a href=&quot;x&quot;&gt;&amp;'\t");
  CHECK(escape_markup("caf\xc3\xa9 \xff") == "caf\xc3\xa9 \xef\xbf\xbd");
  CHECK(split("a,,b,", ',') == std::vector<std::string>{"a", "", "b", ""});
  CHECK(html::path("a<b/c") == "a&lt;b/<wbr/>c");
}

TEST_CASE("a template: text is escaped, markup is not, lists repeat what they enclose",
          "[report]") {
  const html::Slots slots{
      {{"title", "a < b"}, {"markup", "<b>{{title}}</b>"}},
      {{"rows", {{{{"title", "1 & {{x}}"}}, {{"none", {}}}}, {{{"title", "2"}}, {{"none", {}}}}}}}};
  CHECK(html::fill("{{title}}|{{{markup}}}|", slots) == "a &lt; b|<b>{{title}}</b>|");
  CHECK(html::fill("[{{#rows}}<{{title}}>{{#none}}never{{/none}}{{/rows}}]", slots) ==
        "[<1 &amp; {{x}}><2>]");
  CHECK_THROWS_WITH(html::fill("{{other}}", slots), "nothing fills the slot other");
  CHECK_THROWS_WITH(html::fill("{{#rows}}", slots), "the template lacks {{/rows}}");
  CHECK_THROWS_WITH(html::fill("{{title", slots), "the template lacks }}");
}

TEST_CASE("the viewer is part of the program, with the licence of three.js", "[report]") {
  const std::string script(html::kViewerScript);
  CHECK(script.find("Permission is hereby granted, free of charge") != std::string::npos);
  CHECK(script.find("THREE.OrbitControls") != std::string::npos);
  for (const char* part : {"1_decode", "2_scene", "3_stage", "4_panel", "5_cards", "6_main"})
    CHECK(script.find(read_text(std::filesystem::path(POSEVOTE_SOURCE_DIR) / "tools/report/page" /
                                (std::string(part) + ".js"))) != std::string::npos);
  CHECK(script.find("</script") == std::string::npos);
}

TEST_CASE("the page's template is that of the source", "[report]") {
  CHECK(html::kPageTemplate ==
        read_text(std::filesystem::path(POSEVOTE_SOURCE_DIR) / "tools/report/page.html"));
}

}  // namespace posevote::report_html_test
