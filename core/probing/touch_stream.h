// SPDX-License-Identifier: Apache-2.0
// Touches from a file that is still being written: touches.csv that is appended to, or what a control prints.
//
// Each update gets what the file grew by. Only complete lines count: a last line without its end is waited for. A line
// that cannot be read is a sentence, and the lines after it are read all the same.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/json_reader.h"
#include "core/probing/printed_text.h"
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

  /// Touches of lines that `more` completes. Throws InputError only if the template is unusable.
  [[nodiscard]] std::vector<Touch> update(std::string_view more);
  /// The touch of a last line without its end, where nothing more comes.
  [[nodiscard]] std::vector<Touch> finish() { return rest_.empty() ? std::vector<Touch>() : update("\n"); }
  /// The file was written anew: the next update brings its beginning. The receiver knows which touches it has.
  void restart();
  /// Lines that could not be read, in order; of a header that cannot be used, once for the list.
  [[nodiscard]] const std::vector<StreamProblem>& problems() const { return problems_; }
  /// True if the last line is not complete yet.
  [[nodiscard]] bool waiting() const { return !rest_.empty(); }

 private:
  void readLine(std::string_view line, std::vector<Touch>& fresh);

  std::filesystem::path name_;
  MachineDescription machine_;
  std::optional<JsonNode> pattern_;
  std::unique_ptr<PrintedTextReader> printed_;  ///< of printed text
  std::string rest_;                            ///< of the last line, as far as it has come
  std::string header_;
  std::size_t lines_ = 0;  ///< read so far
  std::vector<StreamProblem> problems_;
};

}  // namespace spindrift
