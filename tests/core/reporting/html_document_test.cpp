// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reporting/html_document.h"

#include <gmock/gmock.h>

namespace spindrift {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(HtmlDocument, IsOneFileThatFetchesNothing) {
  HtmlDocument document("Report <1>", "mill & lathe");
  document.section("Results").paragraph("a < b").table({"name", "value"}, {{"EX", "1 ± 0.1 um"}}, "Parameters");
  document.verdict("good", "fine").facts({{"Machine", "mill"}}).figure("<svg></svg>", "A plot");
  document.picture("PNG", "image/png", "A picture");
  const std::string html = document.html();
  EXPECT_THAT(html, HasSubstr("<title>Report &lt;1&gt;</title>"));
  EXPECT_THAT(html, HasSubstr("mill &amp; lathe"));
  EXPECT_THAT(html, HasSubstr("a &lt; b"));
  EXPECT_THAT(html, HasSubstr("Table 1: Parameters"));
  EXPECT_THAT(html, HasSubstr("Figure 2: A picture"));
  EXPECT_THAT(html, HasSubstr("data:image/png;base64,UE5H"));
  EXPECT_THAT(html, Not(HasSubstr("http")));
  EXPECT_THAT(html, Not(HasSubstr("<script")));
}

TEST(HtmlDocument, Base64KnownValues) {  // RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

}  // namespace
}  // namespace spindrift
