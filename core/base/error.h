// SPDX-License-Identifier: Apache-2.0
// The three kinds of failure.
//
//   our bug                 SPINDRIFT_ASSERT       -> InternalError, exit status 3
//   the user's data         throw InputError       -> one sentence with file, place, value, allowed; exit status 2
//   a fit that fails        FitStatus in a result  -> a status with its reason, never an exception
//
// A job that the user cancelled leaves through Cancelled.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace spindrift {

/// Where in the user's data something is wrong: a file and a line (CSV, from 1) or a JSON path ("$.axes[0].name").
struct SourcePlace {
  std::filesystem::path file;  ///< empty: the data did not come from a file
  std::string place;           ///< "column time_s", "$.axes[0]", "" if the whole line or file is meant
  std::size_t line = 0;        ///< of the file, from 1; 0: no line of it

  [[nodiscard]] static SourcePlace atLine(std::filesystem::path file, std::size_t line, std::string place = {});
  /// "line 12, column time_s", "" if the whole file is meant.
  [[nodiscard]] std::string words() const;
  /// "observations.csv, line 12: " or an empty text.
  [[nodiscard]] std::string prefix() const;
};

/// The user's data or options cannot be used. `what()` is one whole sentence for the user: what it quotes of the data
/// is made printable (untrusted_text.h).
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::string_view sentence);
  InputError(const SourcePlace& where, std::string_view sentence);

  [[nodiscard]] const SourcePlace& where() const noexcept { return where_; }
  /// What is wrong, without the place.
  [[nodiscard]] const std::string& sentence() const noexcept { return sentence_; }

 private:
  SourcePlace where_;
  std::string sentence_;
};

/// A mistake of the program. Carries the condition and the place in the source.
class InternalError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// The user cancelled a job; nothing of its result has been applied.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled") {}
};

/// How a fit ended. Every result of a fit starts as `NotRun` and carries a sentence beside it.
enum class FitStatus {
  NotRun,         ///< nothing was computed yet
  Converged,      ///< the result may be used
  Degenerate,     ///< the data do not determine all parameters; the message names which
  NoConvergence,  ///< the iteration did not settle
  Rejected,       ///< the data contradict the model (for example most points are outliers)
};

/// "converged", "degenerate", ... for reports and JSON.
[[nodiscard]] std::string_view toString(FitStatus status) noexcept;

[[noreturn]] void assertionFailed(const char* condition, const char* explanation, const char* file, int line);

}  // namespace spindrift

/// States what the program itself guarantees; violated only by a bug. Stays active in release builds.
#define SPINDRIFT_ASSERT(condition, explanation) \
  ((condition) ? void(0) : ::spindrift::assertionFailed(#condition, explanation, __FILE__, __LINE__))
