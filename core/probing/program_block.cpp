// SPDX-License-Identifier: Apache-2.0
#include "core/probing/program_block.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>

#include "core/base/text.h"

namespace spindrift {
namespace {

struct Line {
  int number = 0;
  std::string text;
};

std::vector<Line> linesOf(std::string_view text) {
  std::vector<Line> lines;
  int number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = text.find('\n', begin);
    if (end == std::string_view::npos) end = text.size();
    ++number;
    const std::string_view line = trimmed(text.substr(begin, end - begin));
    if (!line.empty()) lines.push_back({number, std::string(line)});
    begin = end + 1;
  }
  return lines;
}

/// Letters and numbers of a block without comments. False if it holds anything else.
bool readWords(std::string_view line, std::multimap<char, double>& words) {
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
    std::string_view digits = line.substr(i, end - i);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    double value = 0.0;
    if (!parseNumber(digits, value)) return false;
    words.emplace(letter, value);
    i = end;
  }
  return true;
}

/// Takes comments in brackets out of a line.
void takeComments(std::string& line) {
  for (std::size_t open = line.find('('); open != std::string::npos; open = line.find('(')) {
    const std::size_t close = line.find(')', open);
    line.erase(open, close == std::string::npos ? std::string::npos : close - open + 1);
  }
}

/// Takes `token` out of a line. False if it is not there.
bool take(std::string& line, std::string_view token) {
  const std::size_t at = line.find(token);
  if (at == std::string::npos) return false;
  line.erase(at, token.size());
  return true;
}

std::string unreadable(const std::string& line) {
  return fmt::format("\"{}\" cannot be read", line);
}

/// G codes that all dialects of G code share. False if the code is another one.
bool readCommonCode(int code, ProgramBlock& block) {
  if (code == 0 || code == 10) {
    block.motion = code / 10;
  } else if (code == 900) {
    block.absolute = true;
  } else if (code == 910) {
    block.issues.emplace_back("incremental positions or inches are not allowed");
  } else if (code != 940 && code != 400) {
    return false;
  }
  return true;
}

/// A measuring programme moves and probes. Whatever else a block may command (spindle, coolant, tool change) starts
/// something that the check does not know.
void refuseOthers(ProgramBlock& block) {
  constexpr std::string_view known = "ABCDFGIJKMNPXYZ";
  for (const auto& [letter, value] : block.words) {
    if (known.find(letter) == std::string_view::npos || (letter == 'M' && value != 30.0 && value != 2.0))
      block.issues.push_back(fmt::format("{}{:g} is not known here", letter, value));
  }
}

/// What a touch will print, from the line that writes it or from the parameters that are set for it.
void labelled(std::multimap<char, double> label, ProgramBlock& block) {
  for (const char letter : {'A', 'B', 'C', 'I', 'J', 'K'}) {
    if (label.find(letter) != label.end()) continue;
    block.issues.push_back(
        fmt::format("the touch does not print its {}; allowed: A feature, B stylus, C angle, I J K approach", letter));
  }
  block.printed = std::move(label);
}

/// The line of a log "T A1 B1 C0 D1 X<where> ... <where> I0 J1 K0", taken apart at where the control puts the place.
/// False if it cannot be read.
bool readPrinted(std::string_view line, std::string_view place, std::string_view end,
                 std::multimap<char, double>& label) {
  const std::size_t begin = line.find("T A");
  const std::size_t at = line.find(place);
  if (begin == std::string_view::npos || at == std::string_view::npos || at < begin) return false;
  const std::string_view behind = line.substr(at + place.size());
  return readWords(line.substr(begin + 2, at - begin - 2), label) &&
         readWords(behind.substr(0, behind.find(end)), label);
}

std::vector<ProgramBlock> readGCode(const std::vector<Line>& lines) {
  std::vector<ProgramBlock> blocks;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Line& l = lines[i];
    std::string line = l.text;
    if (line == "%" || line.front() == '#' || line.front() == 'O' || line.front() == 'o') continue;
    if (line.starts_with("POPEN") || line.starts_with("PCLOS") || line.starts_with("DPRNT")) continue;
    ProgramBlock block;
    block.line = l.number;
    takeComments(line);
    if (!readWords(line, block.words)) {
      block.issues.push_back(unreadable(line));
      blocks.push_back(std::move(block));
      continue;
    }
    const auto p = block.word('P');
    for (auto [g, last] = block.words.equal_range('G'); g != last; ++g) {
      const int code = static_cast<int>(std::lround(g->second * 10.0));
      if (readCommonCode(code, block)) continue;
      if (code == 210) {
        block.millimetres = true;
      } else if (code == 200) {
        block.issues.emplace_back("incremental positions or inches are not allowed");
      } else if ((code == 650 && p == 8902.0) || code == 383) {
        block.guarded = true;
      } else if ((code == 650 && p == 8903.0) || code == 382) {
        block.touch = true;
      } else if (code != 490 && code != 800) {
        block.issues.push_back(fmt::format("G{} is not known here", g->second));
      }
    }
    refuseOthers(block);
    const auto m = block.word('M');
    block.ends = m == 30.0 || m == 2.0;
    if (block.touch) {
      // A macro prints what it is called with; LinuxCNC what the next line says.
      std::multimap<char, double> label;
      const std::string next = i + 1 < lines.size() ? lines[i + 1].text : std::string();
      if (p) {
        label = block.words;
      } else if (next.starts_with("(LOG,") && !readPrinted(next, " X#5061 Y#5062 Z#5063 ", ")", label)) {
        block.issues.push_back(unreadable(next));
      }
      labelled(std::move(label), block);
    }
    blocks.push_back(std::move(block));
  }
  return blocks;
}

std::vector<ProgramBlock> readSiemens(const std::vector<Line>& lines) {
  std::vector<ProgramBlock> blocks;
  bool ended = false;
  for (std::size_t i = 0; i < lines.size() && !ended; ++i) {
    const std::string_view whole = lines[i].text;
    std::string line(trimmed(whole.substr(0, whole.find(';'))));
    const auto starts = [&](std::string_view with) { return line.starts_with(with); };
    if (line.empty() || starts("%_N_") || starts("DEF ") || starts("WRITE(") || starts("R99=") || starts("_SPD_S=") ||
        starts("MSG("))
      continue;
    ProgramBlock block;
    block.line = lines[i].number;
    if (starts("_SPD_HIT:") || starts("_SPD_MISSED:")) {
      block.issues.emplace_back("the program runs into its own alarm; allowed: M30 before it");
      blocks.push_back(std::move(block));
      continue;
    }
    const bool measures = take(line, "MEAS=1");
    const bool machine = take(line, "SUPA");
    if (starts("IF ") || !readWords(line, block.words)) {
      block.issues.push_back(unreadable(line));
      blocks.push_back(std::move(block));
      continue;
    }
    for (auto [g, last] = block.words.equal_range('G'); g != last; ++g) {
      const int code = static_cast<int>(std::lround(g->second * 10.0));
      if (readCommonCode(code, block)) continue;
      if (code == 7100) {
        block.millimetres = true;
      } else if (code == 7000 || code == 700) {
        block.issues.emplace_back("incremental positions or inches are not allowed");
      } else if (code != 5000) {
        block.issues.push_back(fmt::format("G{} is not known here", g->second));
      }
    }
    refuseOthers(block);
    block.ends = ended = block.word('M') == 30.0;
    if (block.motion >= 0 && !machine) block.issues.emplace_back("a move without SUPA is not in machine coordinates");
    if (measures) {
      // The block behind it decides: MEAS with a contact that is wanted, or one that stops the programme.
      const std::string next = i + 1 < lines.size() ? lines[i + 1].text : std::string();
      if (next == "IF $AC_MEA[1]==0 GOTOF _SPD_MISSED") {
        block.touch = true;
        std::multimap<char, double> label;
        for (std::size_t k = i + 2; k < lines.size() && k < i + 5; ++k) {
          if (!lines[k].text.starts_with("WRITE(")) continue;
          if (!readPrinted(lines[k].text, " X\"<<$AA_MM[X]<<\" Y\"<<$AA_MM[Y]<<\" Z\"<<$AA_MM[Z]<<\" ", " S\"<<",
                           label))
            block.issues.push_back(unreadable(lines[k].text));
          break;
        }
        labelled(std::move(label), block);
      } else if (next == "IF $AC_MEA[1]==1 GOTOF _SPD_HIT") {
        block.guarded = true;
      } else {
        block.issues.emplace_back("nothing asks whether the probe triggered");
      }
      ++i;
    }
    blocks.push_back(std::move(block));
  }
  return blocks;
}

/// Numbers of TCH PROBE 4: blocks 4.0 to 4.3 from line `i` on.
bool readProbing(const std::vector<Line>& lines, std::size_t i, const auto& bare, ProgramBlock& block) {
  if (i + 3 >= lines.size() || bare(i + 1) != "TCH PROBE 4.1 Q1") return false;
  std::string direction = bare(i + 2);
  std::string distance = bare(i + 3);
  if (!take(direction, "TCH PROBE 4.2 ") || !take(distance, "TCH PROBE 4.3 DIST ")) return false;
  std::array<double, 3> unit{};
  double norm2 = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t at = direction.find(std::string{'I', "XYZ"[k]});
    if (at == std::string::npos) return false;
    std::string_view digits = std::string_view(direction).substr(at + 2);
    digits = digits.substr(0, digits.find(' '));
    if (digits.starts_with('+')) digits.remove_prefix(1);
    if (!parseNumber(digits, unit[k])) return false;
    norm2 += unit[k] * unit[k];
  }
  std::string_view digits = std::string_view(distance).substr(0, distance.find(' '));
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double length = 0.0;
  if (!parseNumber(digits, length) || !(norm2 > 0.0)) return false;
  if (distance.find("REFERENCE SYSTEM:1") == std::string::npos)
    block.issues.emplace_back("the touch is not measured in machine coordinates (REFERENCE SYSTEM:1)");
  for (double& u : unit) u *= length / std::sqrt(norm2);
  block.towards_mm = unit;
  return true;
}

std::vector<ProgramBlock> readHeidenhain(const std::vector<Line>& lines) {
  // Every line begins with its number.
  const auto bare = [&](std::size_t i) {
    std::string_view line = lines[i].text;
    while (!line.empty() && std::isdigit(static_cast<unsigned char>(line.front())) != 0) line.remove_prefix(1);
    line = trimmed(line);
    return std::string(trimmed(line.substr(0, line.find(';'))));
  };
  std::vector<ProgramBlock> blocks;
  bool ended = false;
  for (std::size_t i = 0; i < lines.size() && !ended; ++i) {
    std::string line = bare(i);
    if (line.empty() || line.starts_with("FN 0:") || line.starts_with("FN 16:") || line.starts_with("FN 18:")) continue;
    ProgramBlock block;
    block.line = lines[i].number;
    if (line.starts_with("BEGIN PGM ")) {
      block.absolute = true;
      block.millimetres = line.ends_with(" MM");
      if (!block.millimetres) block.issues.emplace_back("incremental positions or inches are not allowed");
    } else if (line == "M30") {
      block.ends = ended = true;
    } else if (line.starts_with("TCH PROBE 4.0")) {
      block.touch = true;
      if (!readProbing(lines, i, bare, block)) {
        block.issues.push_back(unreadable(line));
        blocks.push_back(std::move(block));
        continue;
      }
      i += 3;
      if (i + 1 >= lines.size() || bare(i + 1) != "FN 9: IF +Q4 EQU -1 GOTO LBL 99") {
        block.issues.emplace_back("nothing asks whether the probe triggered");
      } else {
        ++i;
      }
      std::multimap<char, double> label;
      for (std::size_t k = i + 1; k < lines.size() && bare(k).starts_with("FN "); ++k) {
        // Of TOUCH.A; Q14 numbers the touches.
        constexpr std::string_view letters = "ABCDIJK";
        for (std::size_t n = 0; n < letters.size(); ++n) {
          const char letter = letters[n];
          std::string set = bare(k);
          double value = 0.0;
          if (!take(set, fmt::format("FN 0: Q{} = ", 11 + n))) continue;
          if (set.starts_with('+')) set.erase(0, 1);
          if (parseNumber(set, value)) label.emplace(letter, value);
        }
      }
      labelled(std::move(label), block);
    } else if (line.starts_with("L ")) {
      take(line, "L ");
      take(line, "R0");
      const bool rapid = take(line, "FMAX");
      const bool machine = take(line, "M91");
      const bool unwatched = take(line, "M141");
      block.motion = rapid ? 0 : 1;
      // The control itself stops at a contact unless M141 takes its watch away for a retract.
      block.guarded = !rapid && !unwatched;
      if (!machine) block.issues.emplace_back("a move without M91 is not in machine coordinates");
      if (!readWords(line, block.words)) block.issues.push_back(unreadable(lines[i].text));
      refuseOthers(block);
    } else {
      block.issues.push_back(unreadable(line));
    }
    blocks.push_back(std::move(block));
  }
  return blocks;
}

}  // namespace

std::vector<ProgramBlock> readProgramBlocks(std::string_view text) {
  const std::vector<Line> lines = linesOf(text);
  if (text.find("BEGIN PGM ") != std::string_view::npos) return readHeidenhain(lines);
  if (text.find("%_N_") != std::string_view::npos) return readSiemens(lines);
  return readGCode(lines);
}

}  // namespace spindrift
