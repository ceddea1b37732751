// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/program_reference.h"

#include <gmock/gmock.h>

#include "core/base/error.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

ProgramReference small() {
  ProgramReference reference;
  reference.version = "1.2";
  reference.summary = "a small program";
  reference.see_also = {"other"};
  reference.program = {"small-one", ".first line\nsecond line"};
  reference.program.options = {{{"-h", "--help"}, "", {}, "Print this"}};
  ProgramCommand command{"measure", "Measure a\\b and <c>"};
  command.arguments = {{{"FOLDER"}, "TEXT", {}, "Where", true}};
  command.options = {{{"--kind"}, "TEXT", {"one", "it's two"}, "What", true}, {{"--json"}, "FILE", {}, "To a file"}};
  reference.program.commands = {command};
  return reference;
}

// A dot at the start of a line is a macro, a backslash an escape, a hyphen is set as another character.
TEST(ProgramReference, ManPageIsWhatIsMeant) {
  const std::string page = manPage(small());
  EXPECT_THAT(page, HasSubstr(".TH SMALL\\-ONE 1 \"\" \"Spindrift 1.2\""));
  EXPECT_THAT(page, HasSubstr("small\\-one \\- a small program\n"));
  EXPECT_THAT(page, HasSubstr("\n\\&.first line\n.PP\nsecond line\n"));
  EXPECT_THAT(page, HasSubstr("Measure a\\(rsb and <c>"));
  EXPECT_THAT(page, HasSubstr("small\\-one measure \\-\\-kind one|it's two [OPTION ...] FOLDER"));
  EXPECT_THAT(page, HasSubstr("\\fB\\-\\-kind\\fR \\fIone|\\:it's two\\fR (required)"));
  EXPECT_THAT(page, HasSubstr("\\fBother\\fR(1)"));
}

TEST(ProgramReference, MarkdownKeepsWhatIsNoMarkup) {
  const std::string text = markdownReference(small());
  EXPECT_THAT(text, HasSubstr("# small-one\n\n.first line\n\nsecond line\n"));
  EXPECT_THAT(text, HasSubstr("## measure\n\nMeasure a\\\\b and \\<c\\>\n\n    small-one measure --kind"));
  EXPECT_THAT(text, HasSubstr("- `--json FILE`: To a file\n"));
}

TEST(ProgramReference, CompletionQuotesItsWords) {
  const std::string script = bashCompletion(small());
  EXPECT_THAT(script, HasSubstr("'measure:--kind') takes=1 values='one\nit'\\''s two' ;;"));
  EXPECT_THAT(script, HasSubstr("complete -o bashdefault -o default -F _small_one small-one\n"));
  EXPECT_THAT(script, Not(HasSubstr("'measure:-h'")));
}

TEST(ProgramReference, OtherFormatsAreRefused) {
  EXPECT_THROW((void)referenceText(small(), "troff"), InputError);
}

}  // namespace
}  // namespace spindrift
