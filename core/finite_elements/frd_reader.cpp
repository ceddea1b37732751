// SPDX-License-Identifier: Apache-2.0
// CalculiX .frd, ASCII: a node block (2C), element blocks (3C), result blocks (100CL), each ended by " -3". Rows have
// fixed columns (no blank stands before a minus sign): " -1", the node in 10 columns (5 in the short format), values in
// 12 columns each. Source: CalculiX GraphiX manual, "Result Format".
#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <optional>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/finite_elements/fe_result.h"

namespace spindrift {
namespace {

class FrdReader : public FeResultReader {
 public:
  explicit FrdReader(std::filesystem::path file) : file_(std::move(file)) {}

  [[nodiscard]] FeMesh mesh() const override {
    FeMesh mesh;
    Lines lines(file_);
    while (lines.next()) {
      if (lines.key() != "2C") continue;
      const int width = nodeWidth(lines);
      while (row(lines, "its block of nodes")) {
        mesh.nodes[node(lines, width)] = {value(lines, width, 0), value(lines, width, 1), value(lines, width, 2)};
      }
      return mesh;
    }
    throw InputError({file_, ""}, "holds no block of nodes (2C); allowed: an ASCII .frd of CalculiX.");
  }

  [[nodiscard]] std::vector<FeState> states(const std::set<NodeId>& wanted) const override {
    std::vector<FeState> out;
    std::set<std::string> others;
    Lines lines(file_);
    while (lines.next()) {
      if (lines.key() != "100C") continue;
      const int width = nodeWidth(lines);
      const std::optional<double> time = number(lines.text.substr(std::min<std::size_t>(12, lines.text.size()), 12));
      if (!time) reject(lines, "has no time of its state in columns 13 to 24");
      if (!lines.next() || !lines.text.starts_with(" -4")) reject(lines, "is not a name of a result (-4)");
      const std::string name(trimmed(lines.text.substr(std::min<std::size_t>(5, lines.text.size()), 8)));
      if (name != "DISP") {
        others.insert(name);
        continue;
      }
      FeState state;
      state.time = *time;
      const std::string block = fmt::format("the block of displacements at {}", *time);
      while (row(lines, block)) {
        const NodeId id = node(lines, width);
        if (!wanted.contains(id)) continue;
        state.displacement[id] = {value(lines, width, 0), value(lines, width, 1), value(lines, width, 2)};
      }
      out.push_back(std::move(state));
    }
    if (out.empty()) {
      const std::vector<std::string> list(others.begin(), others.end());
      throw InputError({file_, ""},
                       fmt::format("holds no displacements (DISP){}; allowed: at least one state, from *NODE FILE with "
                                   "U.",
                                   list.empty() ? "" : ", only " + joinedList(list)));
    }
    return out;
  }

 private:
  struct Lines {
    explicit Lines(const std::filesystem::path& file) : stream(file) {
      if (!stream) throw InputError({file, ""}, "cannot be read; allowed: an ASCII .frd of CalculiX.");
    }
    bool next() {
      if (!std::getline(stream, text)) return false;
      if (!text.empty() && text.back() == '\r') text.pop_back();
      ++line;
      return true;
    }
    /// "2C", "100C" of a line that begins a block.
    [[nodiscard]] std::string_view key() const {
      if (text.size() < 6 || text[0] != ' ' || text[1] != ' ') return {};
      return trimmed(std::string_view(text).substr(0, 6));
    }
    std::ifstream stream;
    std::string text;
    std::size_t line = 0;
  };

  [[noreturn]] void reject(const Lines& lines, std::string_view what) const {
    throw InputError(SourcePlace::atLine(file_, lines.line),
                     fmt::format("\"{}\" {}; allowed: an ASCII .frd of CalculiX.", trimmed(lines.text), what));
  }

  [[nodiscard]] static std::optional<double> number(std::string_view text) {
    double value = 0.0;
    if (!parseNumber(trimmed(text), value)) return std::nullopt;
    return value;
  }

  /// Columns of a node's number, from the last figure of the head of a block.
  [[nodiscard]] int nodeWidth(const Lines& lines) const {
    const std::string_view head = trimmed(lines.text);
    switch (head.empty() ? ' ' : head.back()) {
      case '0':
        return 5;
      case '1':
        return 10;
      case '2':
      case '3':
        throw InputError(SourcePlace::atLine(file_, lines.line),
                         "the block is binary; allowed: ASCII (without *NODE OUTPUT to binary files).");
      default:
        reject(lines, "names no format");
    }
  }

  /// The next row of a block into `lines`; false at its end.
  [[nodiscard]] bool row(Lines& lines, const std::string& block) const {
    while (lines.next()) {
      if (lines.text.starts_with(" -3")) return false;
      if (lines.stream.eof()) break;  // a row without its end
      if (lines.text.starts_with(" -1")) return true;
      if (lines.text.starts_with(" -5") || lines.text.starts_with(" -2")) continue;
      reject(lines, "stands in " + block);
    }
    throw InputError(SourcePlace::atLine(file_, lines.line),
                     fmt::format("the file ends in {}; allowed: a whole file (is the program still running?).", block));
  }

  [[nodiscard]] NodeId node(const Lines& lines, int width) const {
    const auto id = number(std::string_view(lines.text).substr(3, static_cast<std::size_t>(width)));
    if (!id || *id < 1.0 || *id > largest_node) reject(lines, "has no number of a node");
    return static_cast<NodeId>(*id);
  }

  [[nodiscard]] double value(const Lines& lines, int width, int which) const {
    const std::size_t from = 3 + static_cast<std::size_t>(width) + 12 * static_cast<std::size_t>(which);
    const auto found = from < lines.text.size() ? number(std::string_view(lines.text).substr(from, 12)) : std::nullopt;
    if (!found) reject(lines, "lacks a number");
    return *found;
  }

  std::filesystem::path file_;
};

}  // namespace

std::unique_ptr<FeResultReader> openFrd(const std::filesystem::path& file) {
  return std::make_unique<FrdReader>(file);
}

}  // namespace spindrift
