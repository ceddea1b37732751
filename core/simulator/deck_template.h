// SPDX-License-Identifier: Apache-2.0
// A file for a program with places for numbers: {{name}} or an expression of parameters such as {{name*1e-6}}, and
// {{table:NAME}} for the lines "time, value" of a table.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "core/math/expression.h"
#include "core/simulator/simulator.h"

namespace spindrift {

class DeckTemplate {
 public:
  /// Throws InputError with file and line: what is neither an expression of the parameters nor one of the tables.
  DeckTemplate(const std::string& text, const std::filesystem::path& file, const std::vector<std::string>& parameters,
               const std::vector<std::string>& tables);

  /// The text with numbers of 12 digits (a field of 20 characters holds them). Throws SimulatorFailed for an expression
  /// without a finite value.
  [[nodiscard]] std::string filled(const ParameterValues& values,
                                   const std::map<std::string, std::string>& tables) const;

 private:
  struct Value {
    Expression expression;
    std::vector<std::string> parameters;  ///< its variables
    std::string text;                     ///< "h_air*1e-3"
    std::size_t line = 0;
  };
  struct Table {
    std::string name;
  };

  std::filesystem::path file_;
  std::vector<std::variant<std::string, Value, Table>> pieces_;
};

}  // namespace spindrift
