// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "core/base/error.h"
#include "core/base/inside_folder.h"
#include "core/base/text.h"
#include "core/finite_elements/fe_result.h"

namespace spindrift {
namespace {

class MeshReader {
 public:
  void read(const std::filesystem::path& file, int depth) {
    if (depth > 8) throw InputError({file, ""}, "is included by itself; allowed: at most 8 files within each other.");
    std::ifstream stream(file);
    if (!stream) throw InputError({file, ""}, "cannot be read; allowed: an input file of CalculiX or Abaqus.");
    std::string text;
    std::size_t line = 0;
    const auto reject = [&](std::string_view what) {
      throw InputError(SourcePlace::atLine(file, line), fmt::format("\"{}\" {}.", trimmed(text), what));
    };
    while (std::getline(stream, text)) {
      ++line;
      const std::string_view content = trimmed(text);
      if (content.empty() || content.starts_with("**")) continue;
      if (content.front() == '*') {
        begin(content);
        if (keyword_ == "*INCLUDE") {
          const auto input = options_.find("INPUT");
          if (input == options_.end()) reject("names no file; allowed: *INCLUDE, INPUT=mesh.inp");
          const std::string outer = keyword_;
          read(InsideFolder(file.parent_path()).path(trimmed(input->second), SourcePlace::atLine(file, line)),
               depth + 1);
          keyword_ = outer;
        }
        if (keyword_ == "*NSET" && !options_.contains("NSET")) reject("names no set; allowed: *NSET, NSET=NAME");
        continue;
      }
      const std::vector<std::string> fields = splitList(content);
      if (keyword_ == "*NODE") {
        double id = 0.0;
        Eigen::Vector3d place = Eigen::Vector3d::Zero();
        bool whole = fields.size() >= 2 && parseNumber(fields[0], id) && id >= 1.0 && id <= largest_node;
        for (std::size_t i = 1; i < fields.size() && i < 4; ++i) {
          whole = whole && parseNumber(fields[i], place[static_cast<Eigen::Index>(i - 1)]);
        }
        if (!whole) reject("is not a node with its place; allowed: number, x, y, z");
        mesh_.nodes[static_cast<NodeId>(id)] = place;
        if (!set_.empty()) mesh_.sets[set_].push_back(static_cast<NodeId>(id));
      } else if (keyword_ == "*NSET") {
        addMembers(fields, reject);
      }
    }
  }

  [[nodiscard]] FeMesh take() { return std::move(mesh_); }

 private:
  /// "*NSET, NSET=TOP, GENERATE" into keyword and options.
  void begin(std::string_view content) {
    options_.clear();
    const std::vector<std::string> parts = splitList(content);
    keyword_ = setName(parts.front());
    for (std::size_t i = 1; i < parts.size(); ++i) {
      const std::size_t equals = parts[i].find('=');
      options_[setName(parts[i].substr(0, equals))] = equals == std::string::npos ? "" : parts[i].substr(equals + 1);
    }
    const auto name = options_.find("NSET");
    set_ = name == options_.end() ? "" : setName(name->second);
    if (!set_.empty() && (keyword_ == "*NSET" || keyword_ == "*NODE")) mesh_.sets[set_];
    // Elsewhere NSET=... only refers to a set.
    if (keyword_ != "*NSET" && keyword_ != "*NODE") set_.clear();
  }

  /// Before they are added: a few lines of sets of sets name any number of nodes.
  template <typename Reject>
  void count(double more, const Reject& reject) {
    constexpr double most_members = 2e7;
    members_ += more;
    if (members_ > most_members) reject("brings the sets to more than 20 million nodes; allowed: at most that");
  }

  template <typename Reject>
  void addMembers(const std::vector<std::string>& fields, const Reject& reject) {
    std::vector<NodeId>& members = mesh_.sets[set_];
    if (options_.contains("GENERATE")) {
      double range[3] = {0.0, 0.0, 1.0};
      bool whole = fields.size() >= 2 && fields.size() <= 3;
      for (std::size_t i = 0; whole && i < fields.size(); ++i) whole = parseNumber(fields[i], range[i]);
      if (!whole || range[0] < 1.0 || range[1] < range[0] || range[2] < 1.0 || range[1] > largest_node) {
        reject("is not a range of nodes; allowed: first, last, step");
      }
      count((range[1] - range[0]) / range[2] + 1.0, reject);
      for (auto id = static_cast<NodeId>(range[0]); id <= static_cast<NodeId>(range[1]);
           id += static_cast<NodeId>(range[2])) {
        members.push_back(id);
      }
      return;
    }
    for (const std::string& field : fields) {
      double id = 0.0;
      if (parseNumber(field, id)) {
        if (id < 1.0 || id > largest_node) reject("holds an invalid node number");
        count(1.0, reject);
        members.push_back(static_cast<NodeId>(id));
        continue;
      }
      const auto other = mesh_.sets.find(setName(field));
      if (other == mesh_.sets.end()) reject("holds neither numbers of nodes nor names of sets that stand above");
      const std::vector<NodeId> copy = other->second;
      count(static_cast<double>(copy.size()), reject);
      members.insert(members.end(), copy.begin(), copy.end());
    }
  }

  FeMesh mesh_;
  std::string keyword_;
  std::string set_;
  double members_ = 0.0;  ///< of all sets
  std::map<std::string, std::string> options_;
};

}  // namespace

FeMesh readAbaqusMesh(const std::filesystem::path& file) {
  MeshReader reader;
  reader.read(file, 0);
  return reader.take();
}

}  // namespace spindrift
