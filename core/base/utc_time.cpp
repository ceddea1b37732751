// SPDX-License-Identifier: Apache-2.0
#include "core/base/utc_time.h"

#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <cmath>

#include "core/base/text.h"

namespace spindrift {
namespace {

/// A number of exactly `digits` digits at `at`, or -1.
int digitsAt(std::string_view text, std::size_t at, std::size_t digits) {
  if (at + digits > text.size()) return -1;
  int value = 0;
  for (std::size_t i = at; i < at + digits; ++i) {
    if (text[i] < '0' || text[i] > '9') return -1;
    value = 10 * value + (text[i] - '0');
  }
  return value;
}

bool has(std::string_view text, std::size_t at, std::string_view any_of) {
  return at < text.size() && any_of.find(text[at]) != std::string_view::npos;
}

}  // namespace

std::optional<double> parseUtc(std::string_view text) {
  text = trimmed(text);
  const int year = digitsAt(text, 0, 4), month = digitsAt(text, 5, 2), day = digitsAt(text, 8, 2);
  const int hour = digitsAt(text, 11, 2), minute = digitsAt(text, 14, 2), second = digitsAt(text, 17, 2);
  if (year < 0 || month < 0 || day < 0 || hour < 0 || minute < 0 || second < 0) return std::nullopt;
  if (!has(text, 4, "-") || !has(text, 7, "-") || !has(text, 10, "Tt ") || !has(text, 13, ":") || !has(text, 16, ":"))
    return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok() || hour > 23 || minute > 59 || second > 60) return std::nullopt;
  double seconds = second;
  std::size_t at = 19;
  if (has(text, at, ".,")) {
    double unit = 0.1;
    for (++at; digitsAt(text, at, 1) >= 0; ++at, unit *= 0.1) seconds += unit * digitsAt(text, at, 1);
  }
  int zone_min = 0;
  if (has(text, at, "+-")) {
    const int zone_h = digitsAt(text, at + 1, 2);
    const std::size_t rest = at + 3 + (has(text, at + 3, ":") ? 1 : 0);
    const int zone_rest = digitsAt(text, rest, 2);
    if (zone_h < 0 || zone_rest < 0) return std::nullopt;
    zone_min = (text[at] == '-' ? -1 : 1) * (60 * zone_h + zone_rest);
    at = rest + 2;
  } else if (has(text, at, "Zz")) {
    ++at;
  }
  if (at < text.size() && text[at] != '@') return std::nullopt;
  const auto days = std::chrono::sys_days(date).time_since_epoch().count();
  return 86400.0 * static_cast<double>(days) + 3600.0 * hour + 60.0 * (minute - zone_min) + seconds;
}

std::string utcText(double utc_s) {
  const auto ms = static_cast<std::int64_t>(std::llround(utc_s * 1e3));
  const auto day = std::chrono::floor<std::chrono::days>(
      std::chrono::sys_time<std::chrono::milliseconds>(std::chrono::milliseconds(ms)));
  const std::chrono::year_month_day date(day);
  const std::int64_t rest = ms - std::chrono::milliseconds(day.time_since_epoch()).count();
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), rest / 3600000,
                     rest / 60000 % 60, rest / 1000 % 60, rest % 1000);
}

std::string utcDay(double utc_s) {
  return utcText(utc_s).substr(0, 10);
}

}  // namespace spindrift
