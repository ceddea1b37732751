// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reporting/markdown_report.h"

#include <gmock/gmock.h>

#include "core/base/error.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;

std::string bodyOf(const std::string& markdown, const FigureOfName& figures = {}) {
  Report report("title", "subtitle");
  addMarkdown(report, markdown, figures);
  const std::string html = htmlOf(report);
  const std::size_t from = html.find("</header>") + 10;
  return html.substr(from, html.find("</main>") - from);
}

TEST(MarkdownReport, BlocksAreWhatTheyAre) {
  EXPECT_EQ(bodyOf("# A *b*\n## C\nline one\nline two\n\nnext\n"),
            "<h2>A b</h2>\n<h3>C</h3>\n<p>line one line two</p>\n<p>next</p>\n");
  EXPECT_EQ(bodyOf("- one\n  goes on\n- two\n1. first\n"), "<p>• one goes on</p>\n<p>• two</p>\n<p>1. first</p>\n");
  EXPECT_EQ(bodyOf("> mind\n> this\n\nafter"), "<p class=\"verdict note\">mind this</p>\n<p>after</p>\n");
  EXPECT_EQ(bodyOf("text\n\n    a <b>\n\n      c\n\nend"), "<p>text</p>\n<pre>a &lt;b&gt;\n\n  c</pre>\n<p>end</p>\n");
  EXPECT_EQ(bodyOf("```console\n$ a\n\n# b\n```\nend"), "<pre>$ a\n\n# b</pre>\n<p>end</p>\n");
}

TEST(MarkdownReport, MarksAreTakenAway) {
  EXPECT_EQ(bodyOf("**bold**, `a*b_c`, [link](http://x), 2 * 3, \\*"), "<p>bold, a*b_c, link, 2 * 3, *</p>\n");
}

TEST(MarkdownReport, TablesAndFigures) {
  const std::string table = bodyOf("| a | b |\n|---|---|\n| 1 | x \\| y |\n");
  EXPECT_THAT(table, HasSubstr("<th>a</th>"));
  EXPECT_THAT(table, HasSubstr("<td>1</td>"));
  EXPECT_EQ(table.find("---"), std::string::npos);
  const auto figures = [](const std::string& name) {
    return name == "known" ? std::optional<Drawing>(Drawing(10, 10)) : std::nullopt;
  };
  EXPECT_THAT(bodyOf("![what](known)", figures), HasSubstr("<figcaption>Figure 1: what</figcaption>"));
  EXPECT_EQ(bodyOf("![what](other)", figures), "");
}

TEST(MarkdownReport, WhatIsBrokenIsRefused) {
  EXPECT_THROW((void)bodyOf("| a | b |\n| 1 |\n"), InputError);
  EXPECT_THROW((void)bodyOf("```\nno end"), InputError);
}

}  // namespace
}  // namespace spindrift
