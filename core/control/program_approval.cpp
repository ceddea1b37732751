// SPDX-License-Identifier: Apache-2.0
#include "core/control/program_approval.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <set>
#include <sstream>

#include "core/base/error.h"
#include "core/base/text.h"

namespace spindrift {
namespace {

struct Word {
  char letter;
  double number;
};

/// The words of a line without its comments; nothing if there is anything else in it.
std::optional<std::vector<Word>> wordsOf(const std::string& line) {
  std::vector<Word> out;
  bool comment = false;
  std::string code;
  for (const char c : line) {
    if (c == '(') comment = true;
    if (c == ';') break;
    if (!comment && std::isspace(static_cast<unsigned char>(c)) == 0) code += static_cast<char>(std::toupper(c));
    if (c == ')') comment = false;
  }
  if (comment) return std::nullopt;
  for (std::size_t i = 0; i < code.size();) {
    const char letter = code[i++];
    std::size_t end = i;
    while (end < code.size() && (std::isdigit(static_cast<unsigned char>(code[end])) != 0 || code[end] == '.' ||
                                 code[end] == '-' || code[end] == '+'))
      ++end;
    double number = 0.0;
    std::string text = code.substr(i, end - i);
    if (text.starts_with('+')) text.erase(0, 1);
    if (text.ends_with('.')) text += '0';
    if (std::isalpha(static_cast<unsigned char>(letter)) == 0 || !parseNumber(text, number)) return std::nullopt;
    out.push_back({letter, number});
    i = end;
  }
  return out;
}

void addIssue(DryRun& run, int line, const std::string& what) {
  ProgramIssue& issue = run.issues.emplace_back();
  issue.line = line;
  issue.what = what;
}

}  // namespace

DryRun dryRun(std::string_view program, const MachineDescription& machine, const Eigen::Vector3d& start_mm) {
  static const std::set<double> settings{17.0, 21.0, 40.0, 49.0, 54.0, 64.0, 80.0, 90.0, 94.0};
  static const std::set<double> switches{2.0, 3.0, 4.0, 5.0, 7.0, 8.0, 9.0, 30.0};
  DryRun run;
  run.lowest_mm = run.highest_mm = start_mm;
  Eigen::Vector3d at = start_mm;
  double motion = -1.0, feed_mm_min = 0.0;
  int number = 0;
  bool ended = false;
  std::istringstream lines{std::string(program)};
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const auto issue = [&](const std::string& what) { addIssue(run, number, what); };
    const std::string text(trimmed(line));
    if (text.empty() || text == "%") continue;
    const std::optional<std::vector<Word>> words = wordsOf(text);
    if (!words) {
      issue(fmt::format("\"{}\" cannot be foreseen; allowed: plain words such as G1 X10 F100", text));
      continue;
    }
    if (ended && !words->empty()) {
      issue("stands after the end of the program");
      continue;
    }
    Eigen::Vector3d target = at;
    bool moves = false, dwell = false;
    for (const Word& word : *words) {
      const double n = word.number;
      switch (word.letter) {
        case 'N':
          break;
        case 'G':
          if (n == 0.0 || n == 1.0 || (n > 38.1 && n < 38.6)) {
            motion = n;
          } else if (n == 4.0) {
            dwell = true;
          } else if (!settings.contains(n)) {
            issue(fmt::format("G{:g} is not allowed here", n));
          }
          break;
        case 'M':
          if (!switches.contains(n)) issue(fmt::format("M{:g} is not allowed here", n));
          ended = ended || n == 2.0 || n == 30.0;
          break;
        case 'X':
        case 'Y':
        case 'Z':
          target[word.letter - 'X'] = n;
          moves = true;
          break;
        case 'F':
          feed_mm_min = n;
          if (n <= 0.0) issue("a feed that is not above zero");
          break;
        case 'S':
          run.largest_rpm = std::max(run.largest_rpm, n);
          if (n < 0.0 || (machine.spindle && machine.spindle->max_rpm && n > *machine.spindle->max_rpm))
            issue(fmt::format("{:g} rpm is beyond the spindle's limit, {:g} rpm", n,
                              machine.spindle ? machine.spindle->max_rpm.value_or(0.0) : 0.0));
          break;
        case 'P':
          if (dwell && n >= 0.0) {
            run.estimated_s += n;
            break;
          }
          [[fallthrough]];
        default:
          issue(fmt::format("the word {}{:g} is not allowed here", word.letter, n));
      }
    }
    if (!moves) continue;
    if (motion < 0.0) {
      issue("a move before G0, G1 or G38");
      continue;
    }
    if (motion != 0.0 && feed_mm_min <= 0.0) issue("a feed move without F");
    for (int axis = 0; axis < 3; ++axis) {
      const std::string name(1, "XYZ"[axis]);
      const LinearAxis* linear = machine.findAxis(name);
      if (target[axis] == at[axis] && linear == nullptr) continue;
      if (linear == nullptr || target[axis] < linear->travel_mm[0] || target[axis] > linear->travel_mm[1])
        issue(fmt::format("{}{:g} is outside the travel{}", name, target[axis],
                          linear == nullptr
                              ? std::string()
                              : fmt::format(", {:g} to {:g} mm", linear->travel_mm[0], linear->travel_mm[1])));
    }
    const bool probing = motion > 38.0;
    run.moves.push_back({number, probing, motion == 0.0, at, target});
    run.touches += probing ? 1 : 0;
    const double speed_mm_min = motion == 0.0 ? 10000.0 : std::max(1.0, feed_mm_min);
    run.estimated_s += (target - at).norm() / speed_mm_min * 60.0;
    run.lowest_mm = run.lowest_mm.cwiseMin(target);
    run.highest_mm = run.highest_mm.cwiseMax(target);
    at = target;
  }
  if (!ended) addIssue(run, number, "the program has no end (M2 or M30)");
  return run;
}

std::string DryRun::summary() const {
  std::string out = fmt::format("{} moves", moves.size());
  if (!moves.empty()) {
    out += " within";
    for (int axis = 0; axis < 3; ++axis)
      out += fmt::format("{} {} {:g} to {:g}", axis == 0 ? "" : ",", "XYZ"[axis], lowest_mm[axis], highest_mm[axis]);
    out += " mm";
  }
  if (touches > 0) out += fmt::format(", {} touches", touches);
  if (largest_rpm > 0.0) out += fmt::format(", spindle up to {:g} rpm", largest_rpm);
  return out + fmt::format(", about {:.0f} s", estimated_s);
}

ApprovedProgram ApprovedProgram::approve(std::string text, const MachineDescription& machine,
                                         const Eigen::Vector3d& start_mm, const Confirm& confirm,
                                         const Artefact* artefact, const ProgramCheckOptions& options) {
  DryRun run = dryRun(text, machine, start_mm);
  if (artefact != nullptr) {
    const ProgramCheck check = checkProgram(text, machine, *artefact, options);
    run.issues.insert(run.issues.end(), check.issues.begin(), check.issues.end());
  }
  if (!run.good())
    throw InputError(
        fmt::format("The program is not run: line {}: {}.", run.issues.front().line, run.issues.front().what));
  if (!confirm || !confirm(run))
    throw InputError(fmt::format("The program is not run: it was not confirmed ({}).", run.summary()));
  return {std::move(text), std::move(run)};
}

}  // namespace spindrift
