// SPDX-License-Identifier: Apache-2.0
// CalculiX .dat: printed tables. "displacements (vx,vy,vz) for set TOP and time  0.9000000E+03", a blank line, then
// "node v v v". Tables of several sets at one time are one state. Other tables are passed over.
#include <fmt/format.h>

#include <fstream>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/finite_elements/fe_result.h"

namespace spindrift {
namespace {

class DatReader : public FeResultReader {
 public:
  explicit DatReader(std::filesystem::path file) : file_(std::move(file)) {}

  [[nodiscard]] FeMesh mesh() const override {
    FeMesh mesh;
    std::map<std::string, std::set<NodeId>> members;
    read([&](const Table& table) { members[table.set]; },
         [&](const Table& table, NodeId id, const Eigen::Vector3d&) { members[table.set].insert(id); });
    for (const auto& [name, nodes] : members) mesh.sets[name].assign(nodes.begin(), nodes.end());
    return mesh;
  }

  [[nodiscard]] std::vector<FeState> states(const std::set<NodeId>& wanted) const override {
    std::vector<FeState> out;
    std::set<std::string> of_state;
    read(
        [&](const Table& table) {
          if (out.empty() || out.back().time != table.time || !of_state.insert(table.set).second) {
            out.emplace_back();
            out.back().time = table.time;
            of_state = {table.set};
          }
        },
        [&](const Table&, NodeId id, const Eigen::Vector3d& u) {
          if (wanted.contains(id)) out.back().displacement[id] = u;
        });
    if (out.empty()) {
      throw InputError({file_, ""},
                       "holds no displacements; allowed: at least one table, from *NODE PRINT, NSET=... with U.");
    }
    return out;
  }

 private:
  struct Table {
    std::string set;
    double time = 0.0;
  };

  template <typename Begin, typename Row>
  void read(const Begin& begin, const Row& row) const {
    std::ifstream stream(file_);
    if (!stream) throw InputError({file_, ""}, "cannot be read; allowed: a .dat of CalculiX.");
    std::string text;
    std::size_t line = 0;
    bool wanted = false;
    Table table;
    const auto reject = [&](std::string_view what) {
      throw InputError(SourcePlace::atLine(file_, line),
                       fmt::format("\"{}\" {}; allowed: a .dat of CalculiX.", trimmed(text), what));
    };
    while (std::getline(stream, text)) {
      ++line;
      const std::string_view content = trimmed(text);
      if (content.empty()) continue;
      const std::size_t at = content.rfind(" time ");
      if (at != std::string_view::npos) {
        wanted = content.starts_with("displacements");
        if (!wanted) continue;
        const std::size_t set = content.find("for set ");
        const std::size_t end = content.find(" and time");
        if (set == std::string_view::npos || end == std::string_view::npos || end < set + 8) {
          reject("names no set");
        }
        table.set = setName(content.substr(set + 8, end - set - 8));
        if (!parseNumber(trimmed(content.substr(at + 6)), table.time)) reject("names no time");
        begin(table);
        continue;
      }
      if (!wanted) continue;
      const std::vector<std::string> fields = splitList(content, ' ');
      double id = 0.0;
      Eigen::Vector3d u = Eigen::Vector3d::Zero();
      const bool whole = fields.size() == 4 && parseNumber(fields[0], id) && parseNumber(fields[1], u[0]) &&
                         parseNumber(fields[2], u[1]) && parseNumber(fields[3], u[2]) && id >= 1.0 &&
                         id <= largest_node;
      if (!whole) {
        // A title of another table.
        if (!fields.empty() && !parseNumber(fields[0], id)) {
          wanted = false;
          continue;
        }
        reject("is not a node with three displacements");
      }
      row(table, static_cast<NodeId>(id), u);
    }
  }

  std::filesystem::path file_;
};

}  // namespace

std::unique_ptr<FeResultReader> openDat(const std::filesystem::path& file) {
  return std::make_unique<DatReader>(file);
}

}  // namespace spindrift
