// SPDX-License-Identifier: Apache-2.0
#include "core/probing/cycle_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "core/base/text.h"
#include "core/probing/hole_cycle.h"

namespace spindrift {

ProgramDialect programDialect(std::string_view name) {
  if (name == "fanuc") return ProgramDialect::Fanuc;
  if (name == "generic") return ProgramDialect::Generic;
  throw InputError(fmt::format("control \"{}\" is not known; allowed: fanuc or generic.", name));
}

namespace {

/// The rotary axis that turns the artefact: letter of its word, 'C' if there is none.
char rotaryLetter(const MachineDescription& machine) {
  for (const ChainAxis& axis : machine.chain.axes()) {
    if (axis.rotary && axis.carries_workpiece && !axis.spindle && axis.direction.z() > 0.9) return axis.name.front();
  }
  return 'C';
}

std::string xyz(const Eigen::Vector3d& p) {
  const auto clean = [](double v) { return std::abs(v) < 5e-5 ? 0.0 : v; };
  return fmt::format("X{:.4f} Y{:.4f} Z{:.4f}", clean(p.x()), clean(p.y()), clean(p.z()));
}

int indexFrom1(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin()) + 1;
}

std::vector<std::string> stylusNames(const MachineDescription& machine) {
  std::vector<std::string> names;
  for (const Stylus& s : machine.styli) names.push_back(s.id);
  return names;
}

constexpr const char* fanuc_macros = R"(O8902(GUARDED MOVE: STOPS IF THE PROBE TRIGGERS)
G31 X#24 Y#25 Z#26 F#9
IF[[ABS[#5061-#24]+ABS[#5062-#25]+ABS[#5063-#26]]LE0.02]GOTO10
#3000=92(PROBE HIT SOMETHING ON ITS WAY)
N10 M99
O8903(TOUCH: A FEATURE B STYLUS C ANGLE D NUMBER I J K APPROACH)
G31 X#24 Y#25 Z#26 F#9
IF[[ABS[#5061-#24]+ABS[#5062-#25]+ABS[#5063-#26]]GT0.001]GOTO10
#3000=91(PROBE DID NOT TRIGGER)
N10 DPRNT[T*A#1[20]*B#2[20]*C#3[33]*D#7[20]*X#5061[44]*Y#5062[44]*Z#5063[44]*I#4[13]*J#5[13]*K#6[13]*S#3001[90]]
M99
)";

}  // namespace

std::string writeProgram(const CyclePlan& plan, const MachineDescription& machine, const Artefact& artefact,
                         const CyclePlanOptions& plan_options, const ProgramOptions& options) {
  SPINDRIFT_ASSERT(options.rotary_sign == 1 || options.rotary_sign == -1, "the sign of a rotary axis is +1 or -1");
  const bool fanuc = options.dialect == ProgramDialect::Fanuc;
  const char letter = rotaryLetter(machine);
  const std::vector<std::string> features = featureNames(artefact);
  const std::vector<std::string> styli = stylusNames(machine);
  std::string text = fanuc ? fmt::format("%\nO{}(SPINDRIFT CYCLE)\n", options.program_number) : "%\n";
  text += fmt::format("(ARTEFACT {}, {} TOUCHES)\n(POSITIONS OF THE SPINDLE REFERENCE IN MACHINE COORDINATES, MM)\n",
                      artefact.id, plan.touches);
  text += "(WORK OFFSET ZERO, NO TOOL LENGTH, PROBE SWITCHED ON, SPINDLE ORIENTED)\n";
  text += "G21 G90 G94 G40 G49 G80\n";
  if (fanuc) {
    text += "#500=#500+1\nPOPEN\nDPRNT[CYCLE*#500[50]]\n";
  } else {
    text += "#500=[#500+1]\n(LOGAPPEND,spindrift_touches.txt)\n(LOG,CYCLE #500)\n";
  }
  bool first = true;
  for (const PlannedMove& m : plan.moves) {
    const Stylus& stylus = *machine.findStylus(m.stylus);
    const Eigen::Vector3d reference = m.tip_mm - stylus.offset_mm;
    const double c = m.c_deg == 0.0 ? 0.0 : options.rotary_sign * m.c_deg;
    switch (m.kind) {
      case MoveKind::Turn:
        // The height first, whatever stood before; then the turn.
        text += fmt::format("G0 Z{:.4f}\n", reference.z());
        if (first) text += fmt::format("G0 X{:.4f} Y{:.4f}\n", reference.x(), reference.y());
        text += fmt::format("G0 {}{:.4f}\n", letter, c);
        break;
      case MoveKind::Rapid:
        if (first) text += fmt::format("G0 Z{:.4f}\n", reference.z());
        text += fmt::format("G0 {}\n", xyz(reference));
        break;
      case MoveKind::Guarded:
        text += fmt::format("{} {} F{:.0f}\n", fanuc ? "G65 P8902" : "G38.3", xyz(reference),
                            plan_options.guarded_feed_mm_min);
        if (!fanuc) text += "o100 if [#5070 EQ 1]\n(ABORT,probe hit something on its way)\no100 endif\n";
        break;
      case MoveKind::Retract:
        text += fmt::format("G1 {} F{:.0f}\n", xyz(reference), plan_options.guarded_feed_mm_min);
        break;
      case MoveKind::Touch: {
        const std::string label = fmt::format("A{} B{} C{} D{}", indexFrom1(features, m.feature),
                                              indexFrom1(styli, m.stylus), exactNumber(m.c_deg), m.touch);
        const std::string normal = fmt::format("I{} J{} K{}", exactNumber(m.approach.x() + 0.0),
                                               exactNumber(m.approach.y() + 0.0), exactNumber(m.approach.z() + 0.0));
        if (fanuc) {
          text += fmt::format("G65 P8903 {} F{:.0f} {} {}\n", xyz(reference), plan_options.touch_feed_mm_min, label,
                              normal);
        } else {
          text += fmt::format("G38.2 {} F{:.0f} (TOUCH {} {})\n", xyz(reference), plan_options.touch_feed_mm_min, label,
                              normal);
          text += fmt::format("(LOG,T {} X#5061 Y#5062 Z#5063 {})\n", label, normal);
        }
        break;
      }
    }
    first = false;
  }
  text += fanuc ? "PCLOS\nM30\n" : "(LOGCLOSE)\nM2\n";
  if (fanuc) text += fanuc_macros;
  return text + "%\n";
}

nlohmann::json printedTextTemplate(const MachineDescription& machine, const Artefact& artefact,
                                   const ProgramOptions& options) {
  nlohmann::json features = nlohmann::json::object();
  nlohmann::json styli = nlohmann::json::object();
  const std::vector<std::string> names = featureNames(artefact);
  for (std::size_t i = 0; i < names.size(); ++i) features[std::to_string(i + 1)] = names[i];
  for (std::size_t i = 0; i < machine.styli.size(); ++i) styli[std::to_string(i + 1)] = machine.styli[i].id;
  const bool fanuc = options.dialect == ProgramDialect::Fanuc;
  nlohmann::json out{{"format", "spindrift-printed-text"},
                     {"version", 1},
                     {"cycle_line", "CYCLE {cycle}"},
                     {"cycle_prefix", "M"},
                     {"touch_line", std::string("T A{feature} B{stylus} C{c_deg} D{touch} X{x} Y{y} Z{z} I{nx} J{ny} "
                                                "K{nz}") +
                                        (fanuc ? " S{time}" : "")},
                     {"values", {{"feature", features}, {"stylus", styli}}},
                     {"artefact", artefact.id},
                     {"position", "spindle_reference"},
                     {"mm_per_unit", 1.0}};
  if (fanuc) {
    out["s_per_unit"] = 0.001;
  } else {
    out["touch_interval_s"] = 3.0;
    out["cycle_interval_s"] = 600.0;
  }
  return out;
}

namespace {

/// Where material is, from the artefact alone.
class Obstacles {
 public:
  Obstacles(const MachineDescription& machine, const Artefact& artefact, const ProgramCheckOptions& options)
      : machine_(machine), artefact_(artefact), options_(options) {
    if (artefact.kind == "hole_bar") {
      setup_ = HoleBarSetup::of(machine, artefact);
      top_ = setup_.nominal_mm(0, 0.0).z();
      radius_ = 0.5 * artefact.hole_diameter_mm.value_or(0.0);
    } else {
      for (const ArtefactBall& b : artefact.balls) {
        top_ = std::max(top_, options.first_ball_mm.z() + b.certified_mm.z() + 0.5 * b.diameter_mm);
      }
    }
  }

  [[nodiscard]] bool holes() const { return artefact_.kind == "hole_bar"; }

  /// Feature (from 1) whose material the probe touches, 0 if free, -1 if other material.
  [[nodiscard]] int contact(const Eigen::Vector3d& reference, double c_deg) const {
    if (holes()) {
      const Stylus& s = machine_.styli.front();
      const Eigen::Vector3d tip = reference + s.offset_mm;
      if (tip.z() - s.radius_mm >= top_ - 1e-9) return 0;
      int nearest = -1;
      double best = 1e300;
      for (std::size_t h = 0; h < setup_.along_mm.size(); ++h) {
        const Eigen::Vector3d d = tip - setup_.nominal_mm(static_cast<int>(h), c_deg);
        const double distance = d.head<2>().norm();
        if (distance < best) {
          best = distance;
          nearest = static_cast<int>(h) + 1;
        }
      }
      if (best + s.radius_mm <= radius_ + 1e-9) return 0;
      return best < radius_ + 20.0 ? nearest : -1;
    }
    for (std::size_t b = 0; b < artefact_.balls.size(); ++b) {
      const Eigen::Vector3d centre = options_.first_ball_mm + artefact_.balls[b].certified_mm;
      const double ball = 0.5 * artefact_.balls[b].diameter_mm;
      for (const Stylus& s : machine_.styli) {
        const Eigen::Vector3d tip = reference + s.offset_mm;
        if ((tip - centre).norm() < ball + s.radius_mm - 1e-9) return static_cast<int>(b) + 1;
        // The shaft, thinner than the tip.
        const double length2 = s.offset_mm.squaredNorm();
        const double f = length2 > 0.0 ? std::clamp((centre - reference).dot(s.offset_mm) / length2, 0.0, 1.0) : 0.0;
        if ((reference + f * s.offset_mm - centre).norm() < ball + 0.6 * s.radius_mm) return static_cast<int>(b) + 1;
      }
    }
    return 0;
  }

  /// Height of the lowest point of the probe above the highest material, mm.
  [[nodiscard]] double heightAbove(const Eigen::Vector3d& reference) const {
    double lowest = 1e300;
    for (const Stylus& s : machine_.styli) {
      lowest = std::min(lowest, reference.z() + s.offset_mm.z() - s.radius_mm);
      if (holes()) break;
    }
    return lowest - top_;
  }

 private:
  const MachineDescription& machine_;
  const Artefact& artefact_;
  const ProgramCheckOptions& options_;
  HoleBarSetup setup_;
  double top_ = -1e300;
  double radius_ = 0.0;
};

/// Letters and numbers of a block; comments removed. False if it holds anything else.
bool blockWords(std::string line, std::multimap<char, double>& words, std::string& comment) {
  words.clear();
  comment.clear();
  for (std::size_t open = line.find('('); open != std::string::npos; open = line.find('(')) {
    const std::size_t close = line.find(')', open);
    const std::size_t length = close == std::string::npos ? std::string::npos : close - open + 1;
    comment = line.substr(open + 1, length == std::string::npos ? std::string::npos : length - 2);
    line.erase(open, length);
  }
  std::size_t i = 0;
  while (i < line.size()) {
    if (std::isspace(static_cast<unsigned char>(line[i])) != 0) {
      ++i;
      continue;
    }
    const char letter = line[i];
    if (letter < 'A' || letter > 'Z') return false;
    std::size_t end = ++i;
    while (end < line.size() && std::string_view("+-.0123456789eE").find(line[end]) != std::string_view::npos) ++end;
    double value = 0.0;
    if (!parseNumber(std::string_view(line).substr(i, end - i), value)) return false;
    words.emplace(letter, value);
    i = end;
  }
  return true;
}

}  // namespace

ProgramCheck checkProgram(std::string_view text, const MachineDescription& machine, const Artefact& artefact,
                          const ProgramCheckOptions& options) {
  ProgramCheck check;
  const Obstacles obstacles(machine, artefact, options);
  const char rotary = rotaryLetter(machine);
  int line_number = 0;
  bool ended = false;
  std::optional<Eigen::Vector3d> position;
  Eigen::Vector3d partial = Eigen::Vector3d::Constant(std::nan(""));
  double c_deg = 0.0;
  bool absolute = false;
  bool millimetres = false;
  bool after_touch = false;
  int motion = -1;
  const auto issue = [&](const std::string& what) { check.issues.push_back({line_number, what}); };
  const auto sweep = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to, MoveKind kind, int feature) {
    const double length = (to - from).norm();
    const int steps = std::max(1, static_cast<int>(std::ceil(length / 0.1)));
    for (int s = kind == MoveKind::Retract ? steps : 0; s <= steps; ++s) {
      const Eigen::Vector3d p = from + (to - from) * s / steps;
      const int contact = obstacles.contact(p, c_deg);
      if (contact == 0) continue;
      if (kind != MoveKind::Touch) {
        issue(fmt::format("the move goes through the artefact at X{:.2f} Y{:.2f} Z{:.2f}", p.x(), p.y(), p.z()));
      } else if (contact != feature) {
        issue(fmt::format("the touch meets feature {} instead of {}", contact, feature));
      } else if (s == 0) {
        issue("the touch starts inside material");
      } else if ((to - p).norm() > options.overtravel_mm + 0.11) {
        issue(fmt::format("the touch may search {:.2f} mm behind the surface; allowed: {:.2f} mm", (to - p).norm(),
                          options.overtravel_mm));
      }
      return;
    }
    if (kind == MoveKind::Touch) issue("the touch does not reach the artefact");
  };
  std::size_t begin = 0;
  while (begin < text.size() && !ended) {
    std::size_t end = text.find('\n', begin);
    if (end == std::string_view::npos) end = text.size();
    std::string line(trimmed(text.substr(begin, end - begin)));
    begin = end + 1;
    ++line_number;
    if (line.empty() || line == "%" || line.front() == '#' || line.front() == 'O' || line.front() == 'o') continue;
    if (line.starts_with("POPEN") || line.starts_with("PCLOS") || line.starts_with("DPRNT")) continue;
    std::multimap<char, double> words;
    std::string comment;
    if (!blockWords(line, words, comment)) {
      issue(fmt::format("\"{}\" cannot be read", line));
      continue;
    }
    const auto word = [&](char letter) -> std::optional<double> {
      const auto found = words.find(letter);
      return found == words.end() ? std::nullopt : std::optional(found->second);
    };
    bool touch = false;
    bool guarded = false;
    for (auto [g, last] = words.equal_range('G'); g != last; ++g) {
      const int code = static_cast<int>(std::lround(g->second * 10.0));
      if (code == 0 || code == 10) {
        motion = code / 10;
      } else if (code == 900) {
        absolute = true;
      } else if (code == 210) {
        millimetres = true;
      } else if (code == 910 || code == 200) {
        issue("incremental positions or inches are not allowed");
      } else if (code == 650 && word('P') == 8902.0) {
        guarded = true;
      } else if (code == 650 && word('P') == 8903.0) {
        touch = true;
      } else if (code == 383) {
        guarded = true;
      } else if (code == 382) {
        touch = true;
      } else if (code != 940 && code != 400 && code != 490 && code != 800) {
        issue(fmt::format("G{} is not known here", g->second));
      }
    }
    if (const auto m = word('M')) {
      if (*m == 30.0 || *m == 2.0) ended = true;
      continue;
    }
    if (touch && comment.starts_with("TOUCH ")) {
      std::multimap<char, double> more;
      std::string none;
      if (blockWords(comment.substr(6), more, none)) words.insert(more.begin(), more.end());
    }
    const bool moves = word('X') || word('Y') || word('Z');
    if (!touch && !guarded && word(rotary)) {
      // The table turns: the probe must be clear of everything.
      if (!position) {
        issue("the table turns before the probe stands anywhere known");
      } else if (obstacles.heightAbove(*position) < options.clearance_mm) {
        issue("the table turns while the probe is not above the artefact");
      }
      c_deg = options.rotary_sign * *word(rotary);
      check.moves.push_back({MoveKind::Turn, position.value_or(Eigen::Vector3d::Zero()), c_deg, 0, 0, line_number});
    }
    if (!moves) continue;
    if (!absolute || !millimetres) {
      issue("a move stands before G90 and G21");
      absolute = millimetres = true;
    }
    Eigen::Vector3d target = position.value_or(partial);
    for (int k = 0; k < 3; ++k) {
      if (const auto v = word("XYZ"[k])) target(k) = *v;
      const LinearAxis* axis = machine.findAxis(std::string(1, "XYZ"[k]));
      if (axis == nullptr || std::isnan(target(k))) continue;
      if (target(k) < std::min(axis->travel_mm[0], axis->travel_mm[1]) - 1e-9 ||
          target(k) > std::max(axis->travel_mm[0], axis->travel_mm[1]) + 1e-9) {
        issue(fmt::format("{}{:.3f} lies outside the travel {} to {} mm", axis->name, target(k), axis->travel_mm[0],
                          axis->travel_mm[1]));
      }
    }
    if (!target.allFinite()) {
      partial = target;  // the first blocks bring one axis after the other
      continue;
    }
    ParsedMove move;
    move.reference_mm = target;
    move.c_deg = c_deg;
    move.line = line_number;
    move.kind = touch         ? MoveKind::Touch
                : guarded     ? MoveKind::Guarded
                : motion == 1 ? MoveKind::Retract
                              : MoveKind::Rapid;
    if (!touch && !guarded && motion < 0) issue("a move without G0 or G1");
    if (touch) {
      move.feature = static_cast<int>(word('A').value_or(0.0));
      move.stylus = static_cast<int>(word('B').value_or(0.0));
      ++check.touches;
    }
    if (after_touch && move.kind != MoveKind::Retract) issue("there is no retract after a touch");
    if (move.kind == MoveKind::Retract && !after_touch) issue("a feed move that is no retract after a touch");
    if (position) {
      sweep(*position, target, move.kind, move.feature);
      const bool sideways = (target - *position).head<2>().norm() > 1e-6;
      if (move.kind == MoveKind::Rapid && sideways &&
          std::min(obstacles.heightAbove(*position), obstacles.heightAbove(target)) < options.clearance_mm) {
        issue("a rapid move sideways is not above the artefact");
      }
      if (move.kind == MoveKind::Rapid && target.z() < position->z() - 1e-6 &&
          obstacles.heightAbove(target) < options.clearance_mm) {
        issue("a rapid move goes down beside the artefact; allowed: guarded moves");
      }
    }
    after_touch = touch;
    position = target;
    check.moves.push_back(move);
  }
  if (!ended) issue("the programme has no end (M30 or M2)");
  if (after_touch) issue("there is no retract after the last touch");
  if (check.touches == 0) issue("the programme touches nothing");
  if (position && obstacles.heightAbove(*position) < options.clearance_mm) {
    issue("the programme ends with the probe not above the artefact");
  }
  return check;
}

}  // namespace spindrift
