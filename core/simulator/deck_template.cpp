// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/deck_template.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "core/simulator/simulator_file.h"

namespace spindrift {
namespace {

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

bool startsName(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool isIn(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// An expression of parameters as muParser reads it: parameters are v0, v1, ..., since theirs may hold dots or be names
/// of functions.
struct Renamed {
  std::string text;
  std::vector<std::string> parameters;
  std::string unknown;  ///< a name that is neither parameter nor function; empty: none
};

Renamed renamed(const std::string& text, const std::vector<std::string>& parameters) {
  Renamed out;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i + 1;
    if (isDigit(text[i]) || text[i] == '.') {
      while (end < text.size() && (isDigit(text[end]) || text[end] == '.')) ++end;
      if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
        std::size_t digits = end + 1;
        if (digits < text.size() && (text[digits] == '+' || text[digits] == '-')) ++digits;
        if (digits < text.size() && isDigit(text[digits])) {
          end = digits;
          while (end < text.size() && isDigit(text[end])) ++end;
        }
      }
      out.text += text.substr(i, end - i);
    } else if (startsName(text[i])) {
      while (end < text.size() && (startsName(text[end]) || isDigit(text[end]) || text[end] == '.')) ++end;
      const std::string name = text.substr(i, end - i);
      const std::size_t next = text.find_first_not_of(" \t", end);
      if (isIn(parameters, name)) {
        auto at = std::find(out.parameters.begin(), out.parameters.end(), name);
        if (at == out.parameters.end()) at = out.parameters.insert(at, name);
        out.text += fmt::format("v{}", at - out.parameters.begin());
      } else {
        const bool function = next != std::string::npos && text[next] == '(';
        if (!function && name != "_pi" && name != "_e" && out.unknown.empty()) out.unknown = name;
        out.text += name;
      }
    } else {
      out.text += text[i];
    }
    i = end;
  }
  return out;
}

}  // namespace

DeckTemplate::DeckTemplate(const std::string& text, const std::filesystem::path& file,
                           const std::vector<std::string>& parameters, const std::vector<std::string>& tables)
    : file_(file) {
  std::size_t line = 1;
  std::size_t at = 0;
  for (;;) {
    const std::size_t open = text.find("{{", at);
    const std::string literal = text.substr(at, open == std::string::npos ? open : open - at);
    pieces_.emplace_back(literal);
    line += static_cast<std::size_t>(std::count(literal.begin(), literal.end(), '\n'));
    if (open == std::string::npos) return;
    const SourcePlace place = SourcePlace::atLine(file, line);
    const std::size_t close = text.find("}}", open);
    const std::string_view between =
        close == std::string::npos ? std::string_view() : std::string_view(text).substr(open + 2, close - open - 2);
    if (close == std::string::npos || between.find_first_of("{}\n") != std::string_view::npos) {
      throw InputError(place, "\"{{\" is not closed on its line; allowed: {{name}}, {{expression}} or {{table:NAME}}.");
    }
    const std::string inner(trimmed(between));
    at = close + 2;
    if (inner.starts_with("table:")) {
      const std::string name(trimmed(std::string_view(inner).substr(6)));
      if (!isIn(tables, name)) {
        throw InputError(place, fmt::format("{{{{{}}}}} names no table of simulator.json; allowed: {}.", inner,
                                            tables.empty() ? "no table, there is none" : joinedList(tables, "or")));
      }
      pieces_.emplace_back(Table{name});
      continue;
    }
    const Renamed r = renamed(inner, parameters);
    if (!r.unknown.empty()) {
      throw InputError(
          place, fmt::format("{{{{{}}}}} names \"{}\", which is not a parameter of simulator.json; allowed: {}.", inner,
                             r.unknown, joinedList(parameters, "or")));
    }
    std::vector<std::string> variables;
    for (std::size_t i = 0; i < r.parameters.size(); ++i) variables.push_back(fmt::format("v{}", i));
    try {
      pieces_.emplace_back(Value{Expression(r.text, variables), r.parameters, inner, line});
    } catch (const InputError&) {
      throw InputError(
          place,
          fmt::format("{{{{{}}}}} is not an expression; allowed: one value from {} with the functions of muParser.",
                      inner, joinedList(parameters, "or")));
    }
  }
}

std::string DeckTemplate::filled(const ParameterValues& values,
                                 const std::map<std::string, std::string>& tables) const {
  std::string out;
  for (const auto& piece : pieces_) {
    if (const auto* literal = std::get_if<std::string>(&piece)) {
      out += *literal;
    } else if (const auto* table = std::get_if<Table>(&piece)) {
      out += tables.at(table->name);
    } else {
      const auto& value = std::get<Value>(piece);
      std::vector<double> numbers;
      for (const std::string& name : value.parameters) numbers.push_back(values.at(name));
      const double number = value.expression(numbers);
      if (!std::isfinite(number)) {
        ParameterValues of;
        for (const std::string& name : value.parameters) of[name] = values.at(name);
        throw SimulatorFailed(fmt::format("{}, line {}: {{{{{}}}}} has no finite value with {}.",
                                          file_.filename().string(), value.line, value.text, valuesText(of)));
      }
      out += fmt::format("{:.12g}", number);
    }
  }
  return out;
}

}  // namespace spindrift
