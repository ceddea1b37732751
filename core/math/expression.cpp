// SPDX-License-Identifier: Apache-2.0
#include "core/math/expression.h"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <mutex>
#include <numbers>

#include "core/base/error.h"
#include "core/base/text.h"

namespace spindrift {
namespace {

/// A parser with variables of its own.
struct Instance {
  mu::Parser parser;
  std::vector<double> values;

  Instance(const std::string& text, const std::vector<std::string>& variables) : values(variables.size(), 0.0) {
    for (std::size_t i = 0; i < variables.size(); ++i) parser.DefineVar(variables[i], &values[i]);
    parser.DefineConst("_pi", std::numbers::pi);  // the library's own has 12 digits
    parser.SetExpr(text);
  }
};

/// Position of "=" that assigns, or npos.
std::size_t assignment(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    if (i + 1 < text.size() && text[i + 1] == '=') {
      ++i;
      continue;
    }
    if (i > 0 && std::string("<>!").find(text[i - 1]) != std::string::npos) continue;
    return i;
  }
  return std::string::npos;
}

}  // namespace

struct Expression::Compiled {
  std::string text;
  std::vector<std::string> variables;
  std::vector<std::string> used;
  std::mutex mutex;
  std::vector<std::unique_ptr<Instance>> idle;  // one for each thread that evaluates at the same time

  std::unique_ptr<Instance> take() {
    {
      const std::scoped_lock lock(mutex);
      if (!idle.empty()) {
        std::unique_ptr<Instance> out = std::move(idle.back());
        idle.pop_back();
        return out;
      }
    }
    return std::make_unique<Instance>(text, variables);
  }
  void giveBack(std::unique_ptr<Instance> instance) {
    const std::scoped_lock lock(mutex);
    idle.push_back(std::move(instance));
  }
};

Expression::Expression(const std::string& text, const std::vector<std::string>& variables)
    : compiled_(std::make_shared<Compiled>()) {
  const auto allowed = [&] { return joinedList(variables) + ", _pi, _e and the functions of muParser"; };
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw InputError(fmt::format("is an empty expression; allowed: an expression in {}.", allowed()));
  }
  if (text.find_first_of("\"") != std::string::npos || assignment(text) != std::string::npos) {
    throw InputError(
        fmt::format("expression \"{}\" assigns a value or holds text; allowed: an expression in {} that has one value.",
                    text, allowed()));
  }
  compiled_->text = text;
  compiled_->variables = variables;
  try {
    auto instance = std::make_unique<Instance>(text, variables);
    int results = 0;
    (void)instance->parser.Eval(results);
    if (results != 1) {
      throw InputError(fmt::format(
          "expression \"{}\" has {} values; allowed: one (a comma separates values, it is not a decimal point).", text,
          results));
    }
    for (const auto& [name, address] : instance->parser.GetUsedVar()) compiled_->used.push_back(name);
    compiled_->giveBack(std::move(instance));
  } catch (const mu::Parser::exception_type& wrong) {
    if (wrong.GetCode() == mu::ecUNASSIGNABLE_TOKEN && !wrong.GetToken().empty()) {
      throw InputError(fmt::format(
          "expression \"{}\" holds \"{}\" at character {}, which is not a variable or function; allowed: {}.", text,
          wrong.GetToken(), wrong.GetPos() + 1, allowed()));
    }
    std::string reason = wrong.GetMsg();
    while (!reason.empty() && (reason.back() == '.' || reason.back() == ' ' || reason.back() == '\n'))
      reason.pop_back();
    throw InputError(
        fmt::format("expression \"{}\" cannot be read ({}); allowed: an expression in {}.", text, reason, allowed()));
  }
}

const std::string& Expression::text() const noexcept {
  return compiled_->text;
}

double Expression::operator()(std::span<const double> values) const {
  SPINDRIFT_ASSERT(values.size() == compiled_->variables.size(), "a value for every variable");
  std::unique_ptr<Instance> instance = compiled_->take();
  std::copy(values.begin(), values.end(), instance->values.begin());
  const double value = instance->parser.Eval();
  compiled_->giveBack(std::move(instance));
  return value;
}

bool Expression::uses(const std::string& variable) const {
  return std::find(compiled_->used.begin(), compiled_->used.end(), variable) != compiled_->used.end();
}

}  // namespace spindrift
