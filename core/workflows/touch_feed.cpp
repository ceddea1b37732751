// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>

#include "core/base/text.h"
#include "core/workflows/incoming.h"

namespace spindrift {
TouchFeed::TouchFeed(const MachineDescription& machine, const TouchList* there, std::optional<JsonNode> pattern)
    : machine_(machine), pattern_(std::move(pattern)), live_(machine) {
  if (there != nullptr) live_.seed(*there);
}

const char* TouchFeed::header() {
  return "time_s,cycle,artefact,feature,stylus,c_deg,touch,x_mm,y_mm,z_mm,nx,ny,nz";
}

std::size_t TouchFeed::update(const std::string& name, std::string_view text, bool anew, double first_s) {
  const bool csv = lowerCase(std::filesystem::path(name).extension().string()) == ".csv";
  auto at = sources_.find(name);
  if (at == sources_.end()) {
    at = sources_.emplace(name, Source{TouchStream(name, machine_, csv ? std::nullopt : pattern_), csv ? 0.0 : first_s})
             .first;
  } else if (anew) {
    at->second.stream.restart();
  }
  std::size_t fresh = 0;
  for (Touch& t : at->second.stream.update(text)) {
    t.time_s += at->second.first_s;
    if (live_.add(t)) ++fresh;
  }
  return fresh;
}

std::size_t TouchFeed::finish() {
  std::size_t fresh = 0;
  for (auto& [name, source] : sources_) {
    for (Touch& t : source.stream.finish()) {
      t.time_s += source.first_s;
      if (live_.add(t)) ++fresh;
    }
  }
  return fresh;
}

std::vector<std::string> TouchFeed::rowsOf(const std::vector<Touch>& touches) {
  TouchList list;
  list.touches = touches;
  std::vector<std::string> rows;
  const std::string text = list.csv();
  std::size_t begin = text.find('\n') + 1;
  while (begin < text.size()) {
    const std::size_t end = text.find('\n', begin);
    rows.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return rows;
}

std::vector<std::string> TouchFeed::problems() const {
  std::vector<std::string> sentences;
  for (const auto& [name, source] : sources_) {
    for (const StreamProblem& p : source.stream.problems()) sentences.push_back(p.sentence);
  }
  return sentences;
}

bool TouchFeed::waiting() const {
  return std::any_of(sources_.begin(), sources_.end(), [](const auto& s) { return s.second.stream.waiting(); });
}

}  // namespace spindrift
