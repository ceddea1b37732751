// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/answer_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iterator>
#include <tuple>

#include "core/base/atomic_file.h"
#include "core/base/csv.h"
#include "core/base/error.h"
#include "core/base/text.h"

namespace spindrift {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::hours kept_for{24 * 90};

fs::path variable(const char* name) {
  const char* text = std::getenv(name);
  return text == nullptr ? fs::path() : fs::path(text);
}

fs::path storeFolder() {
  if (const fs::path own = variable("SPINDRIFT_CACHE"); !own.empty()) return own / "simulator";
  if (const fs::path cache = variable("XDG_CACHE_HOME"); cache.is_absolute()) return cache / "spindrift" / "simulator";
  if (const fs::path home = variable("HOME"); home.is_absolute()) return home / ".cache" / "spindrift" / "simulator";
  return {};
}

void removeOld(const fs::path& folder) {
  std::error_code ignored;
  const auto now = fs::file_time_type::clock::now();
  for (fs::directory_iterator it(folder, ignored), end; !ignored && it != end; it.increment(ignored)) {
    std::error_code failed;
    const auto written = fs::last_write_time(it->path(), failed);
    if (!failed && it->path().extension() == ".csv" && now - written > kept_for) fs::remove(it->path(), failed);
  }
}

std::string headOf(std::size_t rows) {
  return fmt::format("# spindrift-simulator-answer 1: {} rows\n", rows);
}

}  // namespace

AnswerStore::AnswerStore() : folder_(storeFolder()) {
  if (!folder_.empty()) removeOld(folder_);
}

std::optional<ProgramAnswer> AnswerStore::load(const std::string& key) const {
  if (folder_.empty()) return std::nullopt;
  const fs::path file = folder_ / (key + ".csv");
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return std::nullopt;
  try {
    const std::string text = readFile(file);
    ProgramAnswer answer = readAnswer(text, file);
    if (!text.starts_with(headOf(answer.rows.size()))) return std::nullopt;
    fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);
    return answer;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

void AnswerStore::save(const std::string& key, const ProgramAnswer& answer) const {
  if (folder_.empty()) return;
  std::string text = headOf(answer.rows.size());
  text += answer.by_place ? "time_s,x_mm,y_mm,z_mm,component,predicted\n" : "time_s,point,component,predicted\n";
  for (const SimulationRow& row : answer.rows) {
    const std::string place = answer.by_place
                                  ? fmt::format("{},{},{}", exactNumber(row.position_mm.x()),
                                                exactNumber(row.position_mm.y()), exactNumber(row.position_mm.z()))
                                  : csvField(row.point);
    text += fmt::format("{},{},{},{}\n", exactNumber(row.time_s), place, toString(row.component),
                        exactNumber(row.predicted));
  }
  try {
    writeFileAtomically(folder_ / (key + ".csv"), text);
  } catch (const InputError&) {
    // A full or read-only disk: the answer is made again when it is needed.
  }
}

ProgramAnswer readAnswer(std::string text, const fs::path& name) {
  const CsvTable table = CsvTable::parse(std::move(text), name);
  ProgramAnswer answer;
  answer.by_place = !table.hasColumn("point") && table.hasColumn("x_mm");
  const std::size_t time = table.column("time_s");
  const std::size_t component = table.column("component");
  const std::size_t predicted = table.column("predicted");
  const std::size_t first = table.column(answer.by_place ? "x_mm" : "point");
  const std::size_t y = answer.by_place ? table.column("y_mm") : 0;
  const std::size_t z = answer.by_place ? table.column("z_mm") : 0;
  for (std::size_t i = 0; i < table.rowCount(); ++i) {
    SimulationRow row;
    row.time_s = table.number(i, time);
    row.predicted = table.number(i, predicted);
    const auto parsed = componentFromString(table.text(i, component));
    if (!parsed) throw InputError(table.place(i, component), "is not a component; allowed: EX, EY, EZ, EA, EB or EC.");
    row.component = *parsed;
    if (answer.by_place) {
      row.position_mm = {table.number(i, first), table.number(i, y), table.number(i, z)};
    } else {
      row.point = table.requiredText(i, first);
    }
    answer.rows.push_back(std::move(row));
  }
  const auto key = [](const SimulationRow& r) {
    return std::tuple(std::string_view(r.point), r.position_mm.x(), r.position_mm.y(), r.position_mm.z(), r.time_s);
  };
  std::stable_sort(answer.rows.begin(), answer.rows.end(),
                   [&](const SimulationRow& a, const SimulationRow& b) { return key(a) < key(b); });
  return answer;
}

}  // namespace spindrift
