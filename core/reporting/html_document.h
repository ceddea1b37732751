// SPDX-License-Identifier: Apache-2.0
// A self-contained HTML document in the look of a measurement report: one file, no scripts, nothing fetched, prints on
// A4.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace spindrift {

/// Builds a document from top to bottom. Texts are escaped and their units printed as people write them (um as µm);
/// what smallPrint marks is set small. `figure` takes ready SVG. Numbers come formatted (withUncertainty); a table's
/// first column and columns of text are left-aligned, numbers right-aligned and never broken. A short table stays on
/// one page, a long one repeats its header.
class HtmlDocument {
 public:
  HtmlDocument(std::string title, std::string subtitle);

  HtmlDocument& section(std::string_view heading);
  HtmlDocument& subsection(std::string_view heading);
  HtmlDocument& paragraph(std::string_view text);
  /// A sentence that stands out: `kind` is "good", "attention", "bad" or "note".
  HtmlDocument& verdict(std::string_view kind, std::string_view text);
  HtmlDocument& table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows,
                      std::string_view caption = {});
  /// Names and values in two columns.
  HtmlDocument& facts(const std::vector<std::pair<std::string, std::string>>& rows);
  HtmlDocument& figure(std::string_view svg, std::string_view caption);
  /// A PNG or JPEG, embedded. `mime` is "image/png" or "image/jpeg".
  HtmlDocument& picture(std::string_view bytes, std::string_view mime, std::string_view caption);

  [[nodiscard]] std::string html() const;

 private:
  std::string title_;
  std::string subtitle_;
  std::string body_;
  int figures_ = 0;
  int tables_ = 0;
};

[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace spindrift
