// SPDX-License-Identifier: Apache-2.0
#include "core/finite_elements/c_frame_run.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <thread>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/finite_elements/fe_deviation.h"

extern "C" char** environ;  // NOLINT(readability-redundant-declaration): not in every unistd.h

namespace spindrift {
namespace {

constexpr const char* program = "ccx";

/// A new folder among the temporary files, removed at the end.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "spindrift-fe-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) {
      throw InputError({pattern, ""}, fmt::format("cannot be made: {}.", std::strerror(errno)));
    }
    path_ = pattern;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
};

/// Last lines of what a program printed, in one line.
std::string endOf(const std::string& printed) {
  std::vector<std::string> lines = splitList(printed, '\n');
  std::string out;
  const auto error = std::find_if(lines.begin(), lines.end(),
                                  [](const std::string& line) { return line.find("*ERROR") != std::string::npos; });
  auto from = error != lines.end() ? error : lines.end() - std::min<std::ptrdiff_t>(3, std::ssize(lines));
  for (int i = 0; from != lines.end() && i < 3; ++from, ++i) out += (out.empty() ? "" : " ") + *from;
  return out;
}

/// Mean over (from, to] of f(signal), exact for a signal that holds between the rows, by the trapezium rule for one
/// that is interpolated.
template <typename Function>
double meanOver(const OperatingLog& log, const std::string& column, bool hold, double from, double to,
                const Function& f) {
  std::vector<double> cuts{from};
  for (const double t : log.time_s()) {
    if (t > from && t < to) cuts.push_back(t);
  }
  cuts.push_back(to);
  double sum = 0.0;
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    const double length = cuts[i] - cuts[i - 1];
    const double value =
        hold ? f(log.at(column, cuts[i - 1])) : 0.5 * (f(log.at(column, cuts[i - 1])) + f(log.at(column, cuts[i])));
    sum += length * value;
  }
  return sum / (to - from);
}

}  // namespace

bool calculixIsInstalled() {
  const char* folders = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): nobody sets it
  if (folders == nullptr) return false;
  for (const std::string& folder : splitList(folders, ':')) {
    if (access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) return true;
  }
  return false;
}

std::map<std::string, std::string> deckTables(const CFrameDeck& deck, const OperatingLog& log,
                                              const CFrameValues& values) {
  std::map<std::string, std::string> out;
  const double step = deck.options.increment_s;
  const auto increments = static_cast<long>(std::llround(deck.options.duration_s() / step));
  for (const auto& [name, table] : deck.simulator.at("tables").items()) {
    std::vector<double> at_end;  // of each increment; the first is the start
    if (table.contains("window")) {
      const double on = values.at(table["window"][0].get<std::string>());
      const double off = values.at(table["window"][1].get<std::string>());
      at_end.push_back(on <= 0.0 && off > 0.0 ? 1.0 : 0.0);
      for (long k = 1; k <= increments; ++k) {
        const double to = static_cast<double>(k) * step;
        at_end.push_back(std::max(0.0, std::min(to, off) - std::max(to - step, on)) / step);
      }
    } else {
      const auto column = table.at("column").get<std::string>();
      if (!log.has(column)) {
        throw InputError({log.file(), ""}, fmt::format("has no column \"{}\", which the simulation needs.", column));
      }
      const bool hold = table.at("between_rows") == "hold";
      const double divide_by = table.value("divide_by", 1.0);
      const double power = table.value("power", 1.0);
      const auto f = [&](double value) {
        return power == 1.0 ? value / divide_by : std::pow(value / divide_by, power);
      };
      at_end.push_back(f(log.at(column, 0.0)));
      for (long k = 1; k <= increments; ++k) {
        const double to = static_cast<double>(k) * step;
        at_end.push_back(table.value("mean_over_increment", false) ? meanOver(log, column, hold, to - step, to, f)
                                                                   : f(log.at(column, to)));
      }
      if (table.value("minus_first", false)) {
        const double first = at_end.front();
        for (double& value : at_end) value -= first;
      }
    }
    std::string& text = out[name];
    for (std::size_t k = 0; k < at_end.size(); ++k) {
      fmt::format_to(std::back_inserter(text), "{}{:.10g}, {:.10g}", k == 0 ? "" : "\n", static_cast<double>(k) * step,
                     at_end[k]);
    }
  }
  return out;
}

std::string fillDeck(std::string_view text, const CFrameValues& values,
                     const std::map<std::string, std::string>& tables) {
  constexpr std::string_view table_mark = "table:";
  std::string out;
  while (true) {
    const std::size_t open = text.find("{{");
    out += text.substr(0, open);
    if (open == std::string_view::npos) return out;
    const std::size_t close = text.find("}}", open);
    SPINDRIFT_ASSERT(close != std::string_view::npos, "a place to fill ends");
    const std::string_view inside = text.substr(open + 2, close - open - 2);
    text.remove_prefix(close + 2);
    if (inside.starts_with(table_mark)) {
      const auto table = tables.find(std::string(inside.substr(table_mark.size())));
      SPINDRIFT_ASSERT(table != tables.end(), "a deck names tables that it has");
      out += table->second;
      continue;
    }
    const std::size_t times = inside.find('*');
    double factor = 1.0;
    SPINDRIFT_ASSERT(times == std::string_view::npos || parseNumber(inside.substr(times + 1), factor),
                     "a factor is a number");
    const auto value = values.find(std::string(inside.substr(0, times)));
    SPINDRIFT_ASSERT(value != values.end(), "a deck names parameters that it has");
    out += fmt::format("{:.12g}", value->second * factor);
  }
}

void runCalculix(const std::filesystem::path& folder, const std::string& job_name, double time_limit_s,
                 const JobContext& job) {
  const std::filesystem::path printed_file = folder / (job_name + ".out");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, printed_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  std::string threads = "OMP_NUM_THREADS=1";  // equal digits in every run
  std::vector<char*> environment;
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    if (!std::string_view(*entry).starts_with("OMP_NUM_THREADS=")) environment.push_back(*entry);
  }
  environment.push_back(threads.data());
  environment.push_back(nullptr);
  std::string name = program;
  std::string option = "-i";
  std::string deck = job_name;
  std::array<char*, 4> arguments{name.data(), option.data(), deck.data(), nullptr};
  pid_t child = 0;
  const int status_of_spawn = posix_spawnp(&child, program, &actions, nullptr, arguments.data(), environment.data());
  posix_spawn_file_actions_destroy(&actions);
  if (status_of_spawn != 0) {
    throw InputError(fmt::format("The finite-element program CalculiX ({}) cannot be run ({}): install calculix-ccx.",
                                 program, std::strerror(status_of_spawn)));
  }
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(time_limit_s);
  int status = 0;
  while (true) {
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) break;
    SPINDRIFT_ASSERT(ended == 0 || errno == EINTR, "a program that was started can be waited for");
    const bool late = std::chrono::steady_clock::now() > end;
    if (late || job.cancelled()) {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      job.throwIfCancelled();
      throw InputError(
          fmt::format("CalculiX ({} -i {}) did not end within {:.0f} s.", program, job_name, time_limit_s));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  const std::string printed = readFile(printed_file);
  const bool failed = !WIFEXITED(status) || WEXITSTATUS(status) != 0;
  if (failed || printed.find("*ERROR") != std::string::npos) {
    throw InputError(fmt::format(
        "CalculiX ({} -i {}) failed with {} and said: {}", program, job_name,
        WIFEXITED(status) ? fmt::format("status {}", WEXITSTATUS(status)) : fmt::format("signal {}", WTERMSIG(status)),
        endOf(printed)));
  }
}

std::vector<SimulationRow> runDeck(const CFrameDeck& deck, const OperatingLog& log, const CFrameValues& changes,
                                   const JobContext& job) {
  CFrameValues values = deck.values();
  for (const auto& [name, value] : changes) {
    SPINDRIFT_ASSERT(values.contains(name), "a change names a parameter of the deck");
    values[name] = value;
  }
  const std::map<std::string, std::string> tables = deckTables(deck, log, values);
  const ScratchFolder folder;
  writeFileAtomically(folder.path() / "mesh.inp", deck.mesh);
  writeFileAtomically(folder.path() / "observe.csv", deck.observe);
  writeFileAtomically(folder.path() / "heat.inp", fillDeck(deck.heat_template, values, tables));
  writeFileAtomically(folder.path() / "mech.inp", fillDeck(deck.mech_template, values, tables));
  const auto limit_s = deck.simulator.at("time_limit_s").get<double>();
  job.report(0.0, "temperatures");
  runCalculix(folder.path(), "heat", limit_s, job);
  job.report(0.2, "displacements");
  runCalculix(folder.path(), "mech", limit_s, job);

  FeMap map;
  map.result = folder.path() / "mech.dat";
  map.unit_of_displacement = "mm";
  map.observe = folder.path() / "observe.csv";
  map.first_state_s = 0.0;
  map.state_interval_s = deck.options.state_interval_s;
  JobContext reading = job.part(0.95, 1.0);
  const FeDeviation deviation = feDeviation(map, openDat, reading);
  const auto wanted = static_cast<std::size_t>(deck.options.states);
  if (deviation.states != wanted) {
    throw InputError(fmt::format("CalculiX left displacements of {} states; allowed: {}.", deviation.states, wanted));
  }
  return deviation.rows;
}

}  // namespace spindrift
