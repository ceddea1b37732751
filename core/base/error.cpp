// SPDX-License-Identifier: Apache-2.0
#include "core/base/error.h"

#include <fmt/format.h>

#include "core/base/untrusted_text.h"

namespace spindrift {

std::string SourcePlace::prefix() const {
  if (file.empty() && place.empty()) return {};
  if (file.empty()) return place + ": ";
  if (place.empty()) return file.string() + ": ";
  return file.string() + ", " + place + ": ";
}

InputError::InputError(const SourcePlace& where, std::string_view sentence)
    : std::runtime_error(printable(where.prefix() + std::string(sentence))), where_(where) {}

std::string_view toString(FitStatus status) noexcept {
  switch (status) {
    case FitStatus::NotRun:
      return "not run";
    case FitStatus::Converged:
      return "converged";
    case FitStatus::Degenerate:
      return "degenerate";
    case FitStatus::NoConvergence:
      return "no convergence";
    case FitStatus::Rejected:
      return "rejected";
  }
  return "unknown";
}

void assertionFailed(const char* condition, const char* explanation, const char* file, int line) {
  throw InternalError(
      fmt::format("{} ({}) at {}:{}", explanation, condition, std::filesystem::path(file).filename().string(), line));
}

}  // namespace spindrift
