// SPDX-License-Identifier: Apache-2.0
#include "core/base/error.h"

#include <fmt/format.h>

#include <utility>

#include "core/base/untrusted_text.h"

namespace spindrift {

SourcePlace SourcePlace::atLine(std::filesystem::path file, std::size_t line, std::string place) {
  return {std::move(file), std::move(place), line};
}

std::string SourcePlace::words() const {
  if (line == 0) return place;
  return place.empty() ? fmt::format("line {}", line) : fmt::format("line {}, {}", line, place);
}

std::string SourcePlace::prefix() const {
  const std::string within = words();
  if (file.empty() && within.empty()) return {};
  if (file.empty()) return within + ": ";
  if (within.empty()) return file.string() + ": ";
  return file.string() + ", " + within + ": ";
}

InputError::InputError(std::string_view sentence) : InputError(SourcePlace(), sentence) {}

InputError::InputError(const SourcePlace& where, std::string_view sentence)
    : std::runtime_error(printable(where.prefix() + std::string(sentence))),
      where_(where),
      sentence_(printable(sentence)) {}

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
