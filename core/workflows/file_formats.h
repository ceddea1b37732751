// SPDX-License-Identifier: Apache-2.0
// The text of the table of files (file_reference.h), as it is written: one line a key.
#pragma once

#include <span>
#include <string_view>

namespace spindrift {

struct FileFormatText {
  std::string_view id;
  std::string_view file;
  std::string_view format;
  std::string_view what;
  std::string_view example;
  /// Lines "path {unit} | without it | allowed | meaning"; the unit only where the name does not say it.
  std::string_view keys;
};

[[nodiscard]] std::span<const FileFormatText> fileFormatTexts();
/// What holds for all of them, as Markdown with the title of the chapter.
[[nodiscard]] std::string_view filesIntroduction();

}  // namespace spindrift
