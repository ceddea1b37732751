// SPDX-License-Identifier: Apache-2.0
// A report as blocks, from top to bottom: headings, texts, callouts, tables, figures, code. Whoever fills it says what
// is to be read; how it looks is up to the writers: one HTML file, or pages of a PDF.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/job_context.h"
#include "core/reporting/drawing.h"

namespace spindrift {

/// A text in runs; small ones stand a size smaller and softer, such as the id of an effect beside its title.
struct ReportText {
  struct Run {
    std::string text;
    bool small = false;
  };
  std::vector<Run> runs;

  ReportText() = default;
  ReportText(std::string text);  // NOLINT: a plain text is a text
  ReportText(std::string_view text) : ReportText(std::string(text)) {}
  ReportText(const char* text) : ReportText(std::string(text)) {}
  [[nodiscard]] static ReportText smallPrint(std::string_view text);

  [[nodiscard]] bool empty() const { return runs.empty(); }
  [[nodiscard]] std::string plain() const;
  friend ReportText operator+(ReportText a, const ReportText& b) {
    a.runs.insert(a.runs.end(), b.runs.begin(), b.runs.end());
    return a;
  }
};

using ReportRow = std::vector<ReportText>;
/// Names and values.
using ReportFacts = std::vector<std::pair<std::string, ReportText>>;

struct HeadingBlock {
  int level = 1;  ///< 1: a section, 2: within one
  ReportText text;
};
struct TextBlock {
  ReportText text;
};
enum class CalloutKind { Note, Good, Attention, Bad };
/// A sentence that stands out.
struct CalloutBlock {
  CalloutKind kind = CalloutKind::Note;
  ReportText text;
};
/// The first column and columns of words are aligned to the left, numbers to the right and never broken.
struct TableBlock {
  ReportRow header;  ///< empty: names and values in two columns
  std::vector<ReportRow> rows;
  std::string caption;         ///< with its number; may be empty
  std::vector<bool> of_words;  ///< one a column
  [[nodiscard]] bool isFacts() const { return header.empty(); }
};
struct FigureBlock {
  Drawing drawing;
  std::string caption;  ///< with its number
};
/// What is typed or printed on a terminal: letters of one width, lines as they are.
struct CodeBlock {
  std::string text;
};
using ReportBlock = std::variant<HeadingBlock, TextBlock, CalloutBlock, TableBlock, FigureBlock, CodeBlock>;

class Report {
 public:
  Report(std::string_view title, std::string_view subtitle);

  Report& section(const ReportText& heading);
  Report& subsection(const ReportText& heading);
  Report& paragraph(const ReportText& text);
  Report& callout(CalloutKind kind, const ReportText& text);
  /// Without rows it says "none".
  Report& table(ReportRow header, std::vector<ReportRow> rows, std::string_view caption = {});
  Report& facts(const ReportFacts& rows);
  Report& figure(Drawing drawing, std::string_view caption);
  Report& code(std::string_view text);
  /// The blocks of another report at the end; their figures and tables keep their numbers.
  Report& append(const Report& other);
  /// Not to be signed: the manual.
  Report& withoutSignatures();
  /// All of it after `words`, each block by `block`, as a report in `language`; what writers add to it (the number of a
  /// page, where to sign) goes through `words` as well. To be used through inLanguage() (report_language.h).
  [[nodiscard]] Report translated(std::string_view language, std::function<std::string(const std::string&)> words,
                                  const std::function<ReportBlock(const ReportBlock&)>& block) const;

  [[nodiscard]] const std::string& title() const { return title_; }
  [[nodiscard]] const std::string& subtitle() const { return subtitle_; }
  [[nodiscard]] const std::vector<ReportBlock>& blocks() const { return blocks_; }
  [[nodiscard]] bool isSigned() const { return signed_; }
  /// ISO 639-1.
  [[nodiscard]] const std::string& language() const { return language_; }
  /// A text of a writer in the language of the report.
  [[nodiscard]] std::string word(const std::string& english) const { return words_ ? words_(english) : english; }
  [[nodiscard]] int figureCount() const { return figures_; }
  [[nodiscard]] int tableCount() const { return tables_; }

 private:
  std::string title_;
  std::string subtitle_;
  std::vector<ReportBlock> blocks_;
  int figures_ = 0;
  int tables_ = 0;
  bool signed_ = true;
  std::string language_ = "en";
  std::function<std::string(const std::string&)> words_;  ///< none: English
};

/// One self-contained HTML file: no scripts, nothing fetched, prints on A4.
[[nodiscard]] std::string htmlOf(const Report& report);

/// A report set on pages of A4, with a place to sign at its end unless it is not to be signed.
struct ReportPdf {
  std::string bytes;
  struct Section {
    std::string title;
    int page = 0;  ///< from 0
  };
  int pages = 0;
  std::vector<Section> sections;  ///< also the outline of the file
};
/// Headings stay with what follows, figures, callouts and short tables are never broken, a long table repeats its
/// header. Throws Cancelled between two pages.
[[nodiscard]] ReportPdf pdfOf(const Report& report, const JobContext& job = {});

}  // namespace spindrift
