// SPDX-License-Identifier: Apache-2.0
#include "core/machine/driver_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/text.h"
#include "core/base/unit_text.h"

namespace spindrift {
namespace {

/// A column of the log and the driver made from it. Between begin and end stands an axis or a place ("%1").
struct SignalWords {
  std::string_view column_begin, column_end;  ///< empty: no column of the log
  std::string_view driver_begin, driver_end;
  std::string_view as_column, as_driver;
  std::string_view unit;
};

constexpr std::array signal_words{
    SignalWords{"spindle_rpm", "", "spindle_rpm", "", "spindle speed", "spindle speed", "rpm"},
    SignalWords{"feed_", "_mm_min", "feed_", "", "feed %1", "feed %1", "mm/min"},
    SignalWords{"pos_", "_mm", "pos_", "", "position %1", "position %1", "mm"},
    SignalWords{"speed_", "_rpm", "speed_", "", "speed %1", "speed %1", "rpm"},
    SignalWords{"T_", "_degC", "T_", "_degC", "%1", "temperature of %1", "°C"},
    SignalWords{"coolant", "", "coolant", "", "coolant", "coolant", ""},
    SignalWords{"instrument_on", "", "instrument_on", "", "instrument switched on", "instrument switched on", ""},
    SignalWords{"instrument_on_assumed", "", "instrument_on_assumed", "", "instrument switched on (assumed)",
                "instrument switched on (assumed)", ""},
    SignalWords{"", "", "column_difference", "", "", "temperature difference front minus rear of the column", "K"},
    SignalWords{"", "", "column_side_difference", "", "", "temperature difference left minus right of the column",
                "K"}};

std::string capitals(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// What stands between begin and end; nothing where the name is another, or one of a wordless axis.
std::optional<std::string_view> between(std::string_view name, std::string_view begin, std::string_view end,
                                        bool with_subject) {
  if (begin.empty() || name.size() < begin.size() + end.size() || !name.starts_with(begin) || !name.ends_with(end))
    return std::nullopt;
  const std::string_view subject = name.substr(begin.size(), name.size() - begin.size() - end.size());
  return subject.empty() == with_subject ? std::nullopt : std::optional(subject);
}

std::string filled(std::string_view pattern, std::string_view subject) {
  std::string text(pattern);
  const std::size_t at = text.find("%1");
  if (at != std::string::npos)
    text.replace(at, 2, subject.size() == 1 ? capitals(std::string(subject)) : words(subject));
  return text;
}

/// "1.5" -> "¹·⁵", whatever the sign of decimals.
std::string raised(std::string_view number) {
  constexpr std::array<std::string_view, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out;
  for (const char c : number) {
    if (std::isdigit(static_cast<unsigned char>(c)) != 0)
      out += digits[static_cast<std::size_t>(c - '0')];
    else
      out += c == '.' || c == ',' ? "·" : c == '-' ? "⁻" : "";
  }
  return out;
}

/// One factor, with a power: "spindle_rpm^1.5".
std::string driverWord(std::string_view word, const TextTranslation& translation) {
  const std::size_t caret = std::min(word.find('^'), word.size());
  const std::string_view name = word.substr(0, caret);
  const std::string_view power = word.substr(std::min(caret + 1, word.size()));
  std::string text;
  for (const SignalWords& s : signal_words) {
    const bool with_subject = s.as_driver.find("%1") != std::string_view::npos;
    auto subject = between(name, s.driver_begin, s.driver_end, with_subject);
    // Axes have one letter: feed_override is a column of the user's.
    if (subject && with_subject && s.driver_end.empty() && subject->size() != 1) subject.reset();
    if (!subject) subject = between(name, s.column_begin, s.column_end, with_subject);
    if (!subject) continue;
    const std::string place = translation && subject->size() > 1 ? translation(words(*subject)) : std::string(*subject);
    text = filled(translation ? translation(s.as_driver) : std::string(s.as_driver), place);
    break;
  }
  if (text.empty()) text = signalTitle(name).name;
  return text + (power == "1" ? std::string() : raised(power));
}

bool isLetter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

bool isDigit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// Behind the number that begins at `from`, whatever its sign of decimals.
std::size_t numberEnd(std::string_view text, std::size_t from) {
  std::size_t end = from;
  while (end < text.size() && (isDigit(text[end]) || ((text[end] == '.' || text[end] == ',') && end + 1 < text.size() &&
                                                      isDigit(text[end + 1]))))
    ++end;
  return end;
}

/// "x0" -> "x₀", "ez" -> "EZ", "tau" -> "τ"; another word stays.
std::string symbolOf(std::string_view word) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 4> greek{
      {{"tau", "τ"}, {"pi", "π"}, {"alpha", "α"}, {"phi", "φ"}}};
  for (const auto& [name, sign] : greek)
    if (word == name) return std::string(sign);
  if (word.size() == 2 && word[0] == 'e' && std::string_view("xyzabc").find(word[1]) != std::string_view::npos)
    return capitals(std::string(word));
  if (word.size() == 2 && isLetter(word[0]) && isDigit(word[1])) {
    constexpr std::array<std::string_view, 10> below{"₀", "₁", "₂", "₃", "₄", "₅", "₆", "₇", "₈", "₉"};
    return std::string(1, word[0]) + std::string(below[static_cast<std::size_t>(word[1] - '0')]);
  }
  return std::string(word);
}

std::vector<std::string> partsOf(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find(separator, from), text.size());
    parts.emplace_back(text.substr(from, to - from));
    from = to + 1;
  }
  return parts;
}

/// A unit as it stands in names of parameters and drivers; empty for another word.
std::string_view unitInName(std::string_view word) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 16> units{{{"um", "µm"},
                                                                                 {"urad", "µrad"},
                                                                                 {"m", "m"},
                                                                                 {"m2", "m²"},
                                                                                 {"mm", "mm"},
                                                                                 {"K", "K"},
                                                                                 {"s", "s"},
                                                                                 {"h", "h"},
                                                                                 {"min", "min"},
                                                                                 {"rpm", "rpm"},
                                                                                 {"krpm", "(1000 rpm)"},
                                                                                 {"krpm1.5", "(1000 rpm)¹·⁵"},
                                                                                 {"krpm2", "(1000 rpm)²"},
                                                                                 {"W", "W"},
                                                                                 {"percent", "%"},
                                                                                 {"degC", "°C"}}};
  for (const auto& [name, printed] : units)
    if (word == name) return printed;
  return {};
}

/// The units of a name above and below "per", and the words that are none.
struct NameWithUnit {
  std::vector<std::string> title, above, below;

  explicit NameWithUnit(std::string_view name, bool starts_with_unit) {
    constexpr std::string_view feed = "_per_m_per_min";
    if (name.ends_with(feed)) {
      below.emplace_back("(m/min)");
      name.remove_suffix(feed.size());
    }
    bool per = false;
    for (const std::string& part : partsOf(name, '_')) {
      const std::string_view unit = title.empty() && !starts_with_unit ? std::string_view() : unitInName(part);
      if (part == "per") {
        per = true;
      } else if (unit.empty()) {
        title.push_back(part == "tau" ? "time constant" : part);
      } else {
        (per ? below : above).emplace_back(unit);
      }
    }
  }
  [[nodiscard]] bool hasUnit() const { return !above.empty() || !below.empty(); }
  [[nodiscard]] std::string unit() const {
    std::string text = above.empty() ? std::string("1") : fmt::format("{}", fmt::join(above, " "));
    if (below.size() == 1) text += "/" + below.front();
    if (below.size() > 1) text += fmt::format("/({})", fmt::join(below, " "));
    return text;
  }
};

}  // namespace

SignalTitle signalTitle(std::string_view column) {
  for (const SignalWords& s : signal_words) {
    const auto subject =
        between(column, s.column_begin, s.column_end, s.as_column.find("%1") != std::string_view::npos);
    if (subject) return {filled(s.as_column, *subject), std::string(s.unit)};
  }
  for (const auto& [ending, unit] : {std::pair<std::string_view, std::string_view>{"_um_per_m", "µm/m"},
                                     {"_urad", "µrad"},
                                     {"_um", "µm"},
                                     {"_degC", "°C"}}) {
    if (column.size() > ending.size() && column.ends_with(ending))
      return {words(column.substr(0, column.size() - ending.size())), std::string(unit)};
  }
  return {words(column), ""};
}

std::string driversInWords(std::string_view drivers, const TextTranslation& translation) {
  std::string out;
  for (std::size_t i = 0; i < drivers.size();) {
    const std::size_t end = std::min(drivers.find_first_of(" *()", i), drivers.size());
    const std::string_view word = drivers.substr(i, end - i);
    double seconds = 0.0;
    // The seconds of an uncertainty stay those of its value.
    if (parseNumber(word, seconds) && drivers.substr(end).starts_with(" s") && !out.ends_with("± ")) {
      out += spanOfTime(seconds);
      i = end + 2;
      continue;
    }
    if (!word.empty()) out += driverWord(word, translation);
    if (end < drivers.size()) out += drivers[end] == '*' ? std::string(" × ") : std::string(1, drivers[end]);
    i = end + 1;
  }
  return out;
}

std::string driversInWords(const std::vector<std::vector<std::string>>& alternatives,
                           const TextTranslation& translation) {
  std::vector<std::string> out;
  for (const std::vector<std::string>& inputs : alternatives) {
    std::vector<std::string> together;
    for (const std::string& input : inputs) together.push_back(driversInWords(input, translation));
    out.push_back(fmt::format("{}", fmt::join(together, " + ")));
  }
  return joinedList(out, translation ? translation("or") : std::string("or"));
}

std::string_view dynamicsInWords(std::string_view dynamics) {
  if (dynamics == "lag") return "first-order time constant";
  if (dynamics == "asymmetric_lag") return "first-order time constant, another one while it cools";
  if (dynamics == "step") return "step at an unknown time";
  if (dynamics == "pulse") return "pulse at an unknown time";
  return "none (follows at once)";
}

std::string formulaInSymbols(std::string_view formula) {
  const auto letterAt = [&](std::size_t i) { return i < formula.size() && isLetter(formula[i]); };
  std::string out;
  for (std::size_t i = 0; i < formula.size();) {
    const std::string_view rest = formula.substr(i);
    if (isLetter(formula[i])) {
      std::size_t end = i;
      while (end < formula.size() && (isLetter(formula[end]) || isDigit(formula[end]) || formula[end] == '_')) ++end;
      const std::string_view word = formula.substr(i, end - i);
      // A cross product stands between two blanks and is followed by a bracket.
      const bool cross =
          word == "x" && out.ends_with(' ') && formula.substr(end).starts_with(" (") && i >= 2 && letterAt(i - 2);
      out += cross ? std::string("×") : symbolOf(word);
      i = end;
    } else if (formula[i] == '^' && i + 1 < formula.size() && isDigit(formula[i + 1])) {
      const std::size_t end = numberEnd(formula, i + 1);
      out += raised(formula.substr(i + 1, end - i - 1));
      i = end;
    } else if (isDigit(formula[i])) {
      const std::size_t end = numberEnd(formula, i);
      out += formula.substr(i, end - i);
      i = end;
    } else {
      const bool between_letters = i > 0 && letterAt(i - 1) && letterAt(i + 1);
      if (rest.starts_with(" * ")) {
        out += "·";
        i += 3;
        continue;
      }
      if (formula[i] == '*')
        out += "·";
      else if (formula[i] == '\'')
        out += "′";
      else if (formula[i] == '-' && !between_letters)
        out += "−";
      else
        out += formula[i];
      ++i;
    }
  }
  return out;
}

std::string gainUnit(std::string_view unit) {
  const NameWithUnit parts(unit, true);
  return parts.hasUnit() ? parts.unit() : printedUnit(unit);
}

std::string parameterTitle(std::string_view name) {
  const NameWithUnit parts(name, false);
  if (!parts.hasUnit()) return words(name);
  const std::string unit = parts.unit();
  const bool composed = unit.find('/') != std::string::npos;
  return fmt::format("{} / {}", fmt::join(parts.title, " "), composed ? "(" + unit + ")" : unit);
}

std::string spanOfTime(double seconds) {
  if (!std::isfinite(seconds)) return "not determined";
  if (seconds < 90.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 5400.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

std::string words(std::string_view key) {
  std::string text(key);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

}  // namespace spindrift
