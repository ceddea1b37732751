// SPDX-License-Identifier: Apache-2.0
// Touches from a file that is still being written: touches.csv that is appended to, or what a control prints.
//
// Each update gets the whole text as it is now. Only complete lines count: a last line without its end is waited for.
// A line that cannot be read is a sentence, and the lines after it are read all the same.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/json_reader.h"
#include "core/probing/touch.h"

namespace spindrift {

struct StreamProblem {
  std::size_t line = 0;
  std::string sentence;
};

class TouchStream {
 public:
  /// `name` stands for the file in messages. `pattern`: template of printed text (printed_text.h); without one the text
  /// is that of touches.csv.
  TouchStream(std::filesystem::path name, const MachineDescription& machine,
              std::optional<JsonNode> pattern = std::nullopt);

  /// Touches of lines that have been completed since the last update. A text that no longer begins as before (the file
  /// was written anew) is read from its start; the receiver knows which touches it has. Throws InputError only if the
  /// header or the template is unusable.
  [[nodiscard]] std::vector<Touch> update(std::string_view text);
  /// Lines that could not be read, in order.
  [[nodiscard]] const std::vector<StreamProblem>& problems() const { return problems_; }
  /// True if the last line is not complete yet.
  [[nodiscard]] bool waiting() const { return waiting_; }

 private:
  [[nodiscard]] std::vector<Touch> readCsv(std::string_view complete);
  [[nodiscard]] std::vector<Touch> readPrinted(std::string_view complete);

  std::filesystem::path name_;
  MachineDescription machine_;
  std::optional<JsonNode> pattern_;
  std::string done_;  ///< complete lines read so far
  std::string header_;
  std::size_t lines_ = 0;    ///< of done_
  std::size_t printed_ = 0;  ///< touches given out so far
  std::vector<StreamProblem> problems_;
  bool waiting_ = false;
};

}  // namespace spindrift
