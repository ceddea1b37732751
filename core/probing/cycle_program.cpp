// SPDX-License-Identifier: Apache-2.0
#include "core/probing/cycle_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/base/text.h"
#include "core/probing/hole_cycle.h"
#include "core/probing/program_block.h"

namespace spindrift {

ProgramDialect programDialect(std::string_view name) {
  if (name == "fanuc") return ProgramDialect::Fanuc;
  if (name == "generic") return ProgramDialect::Generic;
  if (name == "siemens") return ProgramDialect::Siemens;
  if (name == "heidenhain") return ProgramDialect::Heidenhain;
  throw InputError(fmt::format("control \"{}\" is not known; allowed: fanuc, generic, siemens or heidenhain.", name));
}

namespace {

/// The rotary axis that turns the artefact: letter of its word, 'C' if there is none.
char rotaryLetter(const MachineDescription& machine) {
  for (const ChainAxis& axis : machine.chain.axes()) {
    if (axis.rotary && axis.carries_workpiece && !axis.spindle && axis.direction.z() > 0.9) return axis.name.front();
  }
  return 'C';
}

double clean(double v) {
  return std::abs(v) < 5e-5 ? 0.0 : v;
}

std::string xyz(const Eigen::Vector3d& p) {
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

/// A name inside a comment: it must not end the comment, nor hold what a control cannot show or has no room for.
std::string commentText(std::string_view name) {
  constexpr std::size_t most = 40;
  std::string text;
  for (const char c : name.substr(0, most)) {
    const bool plain = (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == ' ' ||
                       c == '-' || c == '.' || c == '_';
    text += plain ? c : '_';
  }
  return text;
}

/// What one planned move needs to be written in any language.
struct WrittenMove {
  const PlannedMove& plan;
  Eigen::Vector3d reference_mm;
  double rotary_deg = 0.0;  ///< as the control counts
  int feature = 0;          ///< from 1
  int stylus = 0;
  bool first = false;
};

std::vector<WrittenMove> movesOf(const CyclePlan& plan, const MachineDescription& machine, const Artefact& artefact,
                                 const ProgramOptions& options) {
  const std::vector<std::string> features = featureNames(artefact);
  const std::vector<std::string> styli = stylusNames(machine);
  std::vector<WrittenMove> moves;
  for (const PlannedMove& m : plan.moves) {
    const double c = m.c_deg == 0.0 ? 0.0 : options.rotary_sign * m.c_deg;
    moves.push_back({m, m.tip_mm - machine.findStylus(m.stylus)->offset_mm, c, indexFrom1(features, m.feature),
                     indexFrom1(styli, m.stylus), moves.empty()});
  }
  return moves;
}

std::string writeSiemens(const std::vector<WrittenMove>& moves, char letter, const Artefact& artefact, int touches,
                         const CyclePlanOptions& options) {
  std::string text = fmt::format(
      "%_N_SPINDRIFT_CYCLE_MPF\n; SPINDRIFT CYCLE, ARTEFACT {}, {} TOUCHES\n"
      "; POSITIONS OF THE SPINDLE REFERENCE IN MACHINE COORDINATES, MM\n"
      "; NO TOOL OFFSET (D0), PROBE ON MEASURING INPUT 1 AND SWITCHED ON, SPINDLE ORIENTED\n"
      "DEF INT _SPD_E\nDEF REAL _SPD_S\nG710 G90 G94 G40 G500 D0\nR99=R99+1\n"
      "WRITE(_SPD_E,\"_N_SPINDRIFT_MPF\",\"CYCLE \"<<R99)\n",
      commentText(artefact.id), touches);
  for (const WrittenMove& m : moves) {
    const std::string place = xyz(m.reference_mm);
    switch (m.plan.kind) {
      case MoveKind::Turn:
        text += fmt::format("SUPA G0 Z{:.4f}\n", clean(m.reference_mm.z()));
        if (m.first)
          text += fmt::format("SUPA G0 X{:.4f} Y{:.4f}\n", clean(m.reference_mm.x()), clean(m.reference_mm.y()));
        text += fmt::format("SUPA G0 {}{:.4f}\n", letter, m.rotary_deg);
        break;
      case MoveKind::Rapid:
        if (m.first) text += fmt::format("SUPA G0 Z{:.4f}\n", clean(m.reference_mm.z()));
        text += fmt::format("SUPA G0 {}\n", place);
        break;
      case MoveKind::Guarded:
        text += fmt::format("MEAS=1 SUPA G1 {} F{:.0f}\nIF $AC_MEA[1]==1 GOTOF _SPD_HIT\n", place,
                            options.guarded_feed_mm_min);
        break;
      case MoveKind::Retract:
        text += fmt::format("SUPA G1 {} F{:.0f}\n", place, options.guarded_feed_mm_min);
        break;
      case MoveKind::Touch:
        text += fmt::format(
            "MEAS=1 SUPA G1 {} F{:.0f}\nIF $AC_MEA[1]==0 GOTOF _SPD_MISSED\n"
            "_SPD_S=(($A_DAY*24+$A_HOUR)*60+$A_MINUTE)*60+$A_SECOND\n"
            "WRITE(_SPD_E,\"_N_SPINDRIFT_MPF\",\"T A{} B{} C{} D{} X\"<<$AA_MM[X]<<\" Y\"<<$AA_MM[Y]<<\" "
            "Z\"<<$AA_MM[Z]<<\" I{} J{} K{} S\"<<_SPD_S)\n",
            place, options.touch_feed_mm_min, m.feature, m.stylus, exactNumber(m.plan.c_deg), m.plan.touch,
            exactNumber(m.plan.approach.x() + 0.0), exactNumber(m.plan.approach.y() + 0.0),
            exactNumber(m.plan.approach.z() + 0.0));
        break;
    }
  }
  return text +
         "M30\n_SPD_HIT: MSG(\"PROBE HIT SOMETHING ON ITS WAY\")\nM0\nM30\n"
         "_SPD_MISSED: MSG(\"PROBE DID NOT TRIGGER\")\nM0\nM30\n";
}

std::string writeHeidenhain(const std::vector<WrittenMove>& moves, char letter, const Artefact& artefact, int touches,
                            const CyclePlanOptions& options) {
  std::string text;
  int number = 0;
  const auto add = [&](const std::string& block) { text += fmt::format("{} {}\n", number++, block); };
  const auto place = [](const Eigen::Vector3d& p) {
    return fmt::format("X{:+.4f} Y{:+.4f} Z{:+.4f}", clean(p.x()), clean(p.y()), clean(p.z()));
  };
  add("BEGIN PGM SPINDRIFT MM");
  add(fmt::format("; ARTEFACT {}, {} TOUCHES", commentText(artefact.id), touches));
  add("; POSITIONS OF THE SPINDLE REFERENCE IN MACHINE COORDINATES, MM");
  add("; PROBE IN THE SPINDLE WITH LENGTH 0 IN ITS TABLE, SWITCHED ON, SPINDLE ORIENTED");
  add("; TOUCH.A AND CYCLE.A STAND IN TNC:\\SPINDRIFT");
  add("FN 18: SYSREAD Q20 = ID320 NR1");
  add("FN 16: F-PRINT TNC:\\SPINDRIFT\\CYCLE.A / TNC:\\SPINDRIFT\\TOUCHES.TXT");
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  for (const WrittenMove& m : moves) {
    switch (m.plan.kind) {
      case MoveKind::Turn:
        add(fmt::format("L Z{:+.4f} R0 FMAX M91", clean(m.reference_mm.z())));
        if (m.first)
          add(fmt::format("L X{:+.4f} Y{:+.4f} R0 FMAX M91", clean(m.reference_mm.x()), clean(m.reference_mm.y())));
        add(fmt::format("L {}{:+.4f} R0 FMAX M91", letter, m.rotary_deg));
        break;
      case MoveKind::Rapid:
        if (m.first) add(fmt::format("L Z{:+.4f} R0 FMAX M91", clean(m.reference_mm.z())));
        add(fmt::format("L {} R0 FMAX M91", place(m.reference_mm)));
        break;
      case MoveKind::Guarded:
        add(fmt::format("L {} R0 F{:.0f} M91", place(m.reference_mm), options.guarded_feed_mm_min));
        break;
      case MoveKind::Retract:
        add(fmt::format("L {} R0 F{:.0f} M91 M141", place(m.reference_mm), options.guarded_feed_mm_min));
        break;
      case MoveKind::Touch: {
        const Eigen::Vector3d way = m.reference_mm - before;
        const Eigen::Vector3d unit = way.normalized();
        add("TCH PROBE 4.0 MEASURING IN 3-D");
        add("TCH PROBE 4.1 Q1");
        add(fmt::format("TCH PROBE 4.2 IX{:+.6f} IY{:+.6f} IZ{:+.6f}", clean(unit.x()), clean(unit.y()),
                        clean(unit.z())));
        add(fmt::format("TCH PROBE 4.3 DIST {:+.4f} F{:.0f} MB+0 REFERENCE SYSTEM:1", way.norm(),
                        options.touch_feed_mm_min));
        add("FN 9: IF +Q4 EQU -1 GOTO LBL 99");
        const std::array<double, 7> values = {static_cast<double>(m.feature),
                                              static_cast<double>(m.stylus),
                                              m.plan.c_deg,
                                              static_cast<double>(m.plan.touch),
                                              m.plan.approach.x(),
                                              m.plan.approach.y(),
                                              m.plan.approach.z()};
        for (std::size_t k = 0; k < values.size(); ++k)
          add(fmt::format("FN 0: Q{} = {}{}", 11 + k, values[k] < 0.0 ? "" : "+", exactNumber(values[k] + 0.0)));
        add("FN 18: SYSREAD Q20 = ID320 NR1");
        add("FN 16: F-PRINT TNC:\\SPINDRIFT\\TOUCH.A / TNC:\\SPINDRIFT\\TOUCHES.TXT");
        break;
      }
    }
    before = m.reference_mm;
  }
  add("M30");
  add("LBL 99");
  add("; THE PROBE DID NOT TRIGGER");
  add("STOP");
  add("M30");
  add("LBL 0");
  add("END PGM SPINDRIFT MM");
  return text;
}

}  // namespace

std::string writeProgram(const CyclePlan& plan, const MachineDescription& machine, const Artefact& artefact,
                         const CyclePlanOptions& plan_options, const ProgramOptions& options) {
  SPINDRIFT_ASSERT(options.rotary_sign == 1 || options.rotary_sign == -1, "the sign of a rotary axis is +1 or -1");
  const bool fanuc = options.dialect == ProgramDialect::Fanuc;
  const char letter = rotaryLetter(machine);
  const std::vector<WrittenMove> moves = movesOf(plan, machine, artefact, options);
  if (options.dialect == ProgramDialect::Siemens)
    return writeSiemens(moves, letter, artefact, plan.touches, plan_options);
  if (options.dialect == ProgramDialect::Heidenhain)
    return writeHeidenhain(moves, letter, artefact, plan.touches, plan_options);
  std::string text = fanuc ? fmt::format("%\nO{}(SPINDRIFT CYCLE)\n", options.program_number) : "%\n";
  text += fmt::format("(ARTEFACT {}, {} TOUCHES)\n(POSITIONS OF THE SPINDLE REFERENCE IN MACHINE COORDINATES, MM)\n",
                      commentText(artefact.id), plan.touches);
  text += "(WORK OFFSET ZERO, NO TOOL LENGTH, PROBE SWITCHED ON, SPINDLE ORIENTED)\n";
  text += "G21 G90 G94 G40 G49 G80\n";
  if (fanuc) {
    text += "#500=#500+1\nPOPEN\nDPRNT[CYCLE*#500[50]]\n";
  } else {
    text += "#500=[#500+1]\n(LOGAPPEND,spindrift_touches.txt)\n(LOG,CYCLE #500)\n";
  }
  for (const WrittenMove& move : moves) {
    const PlannedMove& m = move.plan;
    const Eigen::Vector3d& reference = move.reference_mm;
    switch (m.kind) {
      case MoveKind::Turn:
        // The height first, whatever stood before; then the turn.
        text += fmt::format("G0 Z{:.4f}\n", reference.z());
        if (move.first) text += fmt::format("G0 X{:.4f} Y{:.4f}\n", reference.x(), reference.y());
        text += fmt::format("G0 {}{:.4f}\n", letter, move.rotary_deg);
        break;
      case MoveKind::Rapid:
        if (move.first) text += fmt::format("G0 Z{:.4f}\n", reference.z());
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
        const std::string label =
            fmt::format("A{} B{} C{} D{}", move.feature, move.stylus, exactNumber(m.c_deg), m.touch);
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
  }
  text += fanuc ? "PCLOS\nM30\n" : "(LOGCLOSE)\nM2\n";
  if (fanuc) text += fanuc_macros;
  return text + "%\n";
}

std::vector<CompanionFile> companionFiles(ProgramDialect dialect) {
  if (dialect != ProgramDialect::Heidenhain) return {};
  return {{"CYCLE.A", "\"CYCLE %.0LF\",Q20;\nM_APPEND;\n"},
          {"TOUCH.A",
           "\"T A%.0LF B%.0LF C%.3LF D%.0LF X%.4LF Y%.4LF Z%.4LF I%.3LF J%.3LF K%.3LF S%.0LF\","
           "Q11,Q12,Q13,Q14,Q1,Q2,Q3,Q15,Q16,Q17,Q20;\nM_APPEND;\n"}};
}

nlohmann::json printedTextTemplate(const MachineDescription& machine, const Artefact& artefact,
                                   const ProgramOptions& options) {
  nlohmann::json features = nlohmann::json::object();
  nlohmann::json styli = nlohmann::json::object();
  const std::vector<std::string> names = featureNames(artefact);
  for (std::size_t i = 0; i < names.size(); ++i) features[std::to_string(i + 1)] = names[i];
  for (std::size_t i = 0; i < machine.styli.size(); ++i) styli[std::to_string(i + 1)] = machine.styli[i].id;
  const bool fanuc = options.dialect == ProgramDialect::Fanuc;
  const bool timed = options.dialect != ProgramDialect::Generic;
  nlohmann::json out{{"format", "spindrift-printed-text"},
                     {"version", 1},
                     {"cycle_line", "CYCLE {cycle}"},
                     {"cycle_prefix", "M"},
                     {"touch_line", std::string("T A{feature} B{stylus} C{c_deg} D{touch} X{x} Y{y} Z{z} I{nx} J{ny} "
                                                "K{nz}") +
                                        (timed ? " S{time}" : "")},
                     {"values", {{"feature", features}, {"stylus", styli}}},
                     {"artefact", artefact.id},
                     {"position", "spindle_reference"},
                     {"mm_per_unit", 1.0}};
  if (timed) {
    out["s_per_unit"] = fanuc ? 0.001 : 1.0;
    if (options.dialect == ProgramDialect::Siemens) out["clock"] = "day_of_month";
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
      const auto [nearest, best] = nearestHole(tip, c_deg);
      if (best + s.radius_mm > radius_ + 1e-9) return best < radius_ + 20.0 ? nearest : -1;
      // The shaft, thinner than the tip, where it enters the hole.
      const double length = reference.z() - tip.z();
      const double inside = std::clamp(length > 0.0 ? (top_ - tip.z()) / length : 0.0, 0.0, 1.0);
      const Eigen::Vector3d rim = tip - inside * s.offset_mm;
      return nearestHole(rim, c_deg).second + 0.6 * s.radius_mm > radius_ + 1e-9 ? -1 : 0;
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

  /// Height of the spindle reference above a bar that would have to give way to the spindle, mm; nothing for balls,
  /// beside which it may stand.
  [[nodiscard]] std::optional<double> spindleAbove(const Eigen::Vector3d& reference) const {
    if (!holes()) return std::nullopt;
    return reference.z() - top_;
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
  /// Index (from 1) of the hole whose axis is nearest, and how far it is.
  [[nodiscard]] std::pair<int, double> nearestHole(const Eigen::Vector3d& at, double c_deg) const {
    std::pair<int, double> nearest{-1, 1e300};
    for (std::size_t h = 0; h < setup_.along_mm.size(); ++h) {
      const double distance = (at - setup_.nominal_mm(static_cast<int>(h), c_deg)).head<2>().norm();
      if (distance < nearest.second) nearest = {static_cast<int>(h) + 1, distance};
    }
    return nearest;
  }

  const MachineDescription& machine_;
  const Artefact& artefact_;
  const ProgramCheckOptions& options_;
  HoleBarSetup setup_;
  double top_ = -1e300;
  double radius_ = 0.0;
};

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
  for (const ProgramBlock& block : readProgramBlocks(text)) {
    if (ended) break;
    line_number = block.line;
    for (const std::string& what : block.issues) issue(what);
    absolute = absolute || block.absolute;
    millimetres = millimetres || block.millimetres;
    if (block.motion >= 0) motion = block.motion;
    ended = block.ends;
    const bool touch = block.touch;
    const bool guarded = block.guarded;
    const auto word = [&](char letter) { return block.word(letter); };
    const bool moves = word('X') || word('Y') || word('Z') || block.towards_mm;
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
    if (block.towards_mm) target += Eigen::Vector3d(block.towards_mm->data());
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
    if (const auto above = obstacles.spindleAbove(target); above && *above < options.clearance_mm - 1e-6) {
      issue(fmt::format("the spindle reference goes to {:.2f} mm above the top of the bar; allowed: {:.2f} mm", *above,
                        options.clearance_mm));
    }
    if (touch) {
      move.feature = static_cast<int>(block.print('A').value_or(0.0));
      move.stylus = static_cast<int>(block.print('B').value_or(0.0));
      ++check.touches;
      constexpr double rounding_deg = 1e-3;
      if (const auto c = block.print('C'); c && std::abs(std::remainder(*c - c_deg, 360.0)) > rounding_deg)
        issue(fmt::format("the touch prints C{:g} while the table stands at {:g}", *c, c_deg));
      const Eigen::Vector3d approach(block.print('I').value_or(0.0), block.print('J').value_or(0.0),
                                     block.print('K').value_or(0.0));
      constexpr double rounding = 1e-3;  // positions of 0.1 um over some millimetres, directions of three decimals
      if (position && (target - *position).norm() > 0.0 &&
          (approach - (target - *position).normalized()).norm() > 2.0 * rounding) {
        const Eigen::Vector3d way = (target - *position).normalized();
        issue(fmt::format("the touch prints the approach I{:g} J{:g} K{:g} but moves along {:.3f}, {:.3f}, {:.3f}",
                          approach.x(), approach.y(), approach.z(), way.x(), way.y(), way.z()));
      }
    }
    if (after_touch && move.kind != MoveKind::Retract) issue("there is no retract after a touch");
    if (move.kind == MoveKind::Retract && !after_touch) issue("a feed move that is not a retract after a touch");
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
  if (!ended) issue("the program has no end (M30 or M2)");
  if (after_touch) issue("there is no retract after the last touch");
  if (check.touches == 0) issue("the program touches nothing");
  if (position && obstacles.heightAbove(*position) < options.clearance_mm) {
    issue("the program ends with the probe not above the artefact");
  }
  return check;
}

}  // namespace spindrift
