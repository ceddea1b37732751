// SPDX-License-Identifier: GPL-3.0-or-later
// What captures and touches cost that arrive in a watched folder one after the other, in CPU time, so that it shows
// whether the next one costs more when many have come before.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/session/session.h"
#include "core/workflows/capture_watch.h"
#include "tests/core/probing/probing_machines.h"

namespace spindrift::testing {

/// Mean CPU time of one arrival (us) in each tenth of all.
struct ArrivalCosts {
  std::vector<double> cpu_us;
  std::vector<double> wall_us;
  /// Of the last tenth over the second one (the first one still warms up).
  [[nodiscard]] double growth() const { return cpu_us.back() / cpu_us.at(1); }
};

/// A folder in memory where there is one: what a disk takes to keep a file does not depend on how many there are.
class FolderWithoutDisk {
 public:
  FolderWithoutDisk() {
    std::error_code none;
    const std::filesystem::path memory = "/dev/shm";
    const auto place = std::filesystem::is_directory(memory, none) ? memory : std::filesystem::temp_directory_path();
    std::string name = (place / "spindrift-arrivals-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw InternalError("no temporary folder");
    path_ = name;
  }
  FolderWithoutDisk(const FolderWithoutDisk&) = delete;
  FolderWithoutDisk& operator=(const FolderWithoutDisk&) = delete;
  ~FolderWithoutDisk() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline double cpuNow_us() {
  return 1e6 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

inline double wallNow_us() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

using Told = std::function<void(std::size_t arrived, double cpu_us, double wall_us)>;

/// `count` small scans, `batch` at a time; what was taken is removed from the watched folder, as from a camera.
inline ArrivalCosts costsOfCaptures(const std::filesystem::path& folder, std::size_t count, std::size_t batch,
                                    const Told& told = {}) {
  constexpr std::size_t artefacts = 100;
  std::string machine = R"({"format":"spindrift-machine","version":1,"name":"mill","chain":"V [w-X'-Y'-b-Z-(C)-t]",
"axes":[{"name":"X","travel_mm":[0,300]},{"name":"Y","travel_mm":[0,200]},{"name":"Z","travel_mm":[0,150]}],"points":[)";
  for (std::size_t i = 0; i < artefacts; ++i)
    machine += fmt::format(R"({}{{"id":"A{}","kind":"surface","x_mm":0,"y_mm":50,"z_mm":0}})", i == 0 ? "" : ",", i);
  Session session = Session::create(folder / "session");
  const std::int64_t id = session.newCampaign("many", "2026-01-31T08:00:00Z", machine + "]}");
  PlanOptions options;
  options.kind = PlannedKind::Scan;
  options.states = static_cast<int>((count + artefacts - 1) / artefacts);
  storePlan(session, id, makePlan(Campaign::read(session.campaign(id).folder).machine, options));
  const std::filesystem::path watched = folder / "watched";
  std::filesystem::create_directories(watched);
  CaptureWatch watch(session, id, watched, std::nullopt, {0.0, true});
  ArrivalCosts costs;
  double now_s = 0.0;
  std::size_t arrived = 0;
  for (std::size_t tenth = 1; tenth <= 10; ++tenth) {
    const std::size_t begun = arrived;
    double cpu_us = 0.0;
    double wall_us = 0.0;
    while (arrived < count * tenth / 10) {
      for (std::size_t k = 0; k < batch; ++k) {
        std::ofstream out(watched / fmt::format("s{}.csv", arrived + k));
        out << "x_mm,y_mm,z_mm\n";
        for (int j = 0; j < 12; ++j) {
          for (int i = 0; i < 12; ++i)
            out << i << ',' << j << ','
                << fmt::format("{:.6f}", 0.1 * std::sin(i + 0.7 * j + 1e-5 * static_cast<double>(arrived + k))) << '\n';
        }
      }
      const double cpu = cpuNow_us();
      const double wall = wallNow_us();
      std::size_t accepted = 0;
      std::string sentence;
      for (int look = 0; look < 2; ++look) {
        for (const IncomingItem& item : watch.turn(now_s)) {
          accepted += item.state == IncomingState::Accepted ? 1 : 0;
          sentence = item.sentence;
        }
        now_s += 1.0;
      }
      cpu_us += cpuNow_us() - cpu;
      wall_us += wallNow_us() - wall;
      if (accepted != batch)
        throw InternalError(fmt::format("{} of {} scans were accepted: {}", accepted, batch, sentence));
      arrived += batch;
      for (const auto& entry : std::filesystem::directory_iterator(watched)) std::filesystem::remove(entry.path());
    }
    costs.cpu_us.push_back(cpu_us / static_cast<double>(arrived - begun));
    costs.wall_us.push_back(wall_us / static_cast<double>(arrived - begun));
    if (told) told(arrived, costs.cpu_us.back(), costs.wall_us.back());
  }
  return costs;
}

/// `count` touches of a bar of holes, cycle after cycle, in one list that grows by `batch` touches at a time.
inline ArrivalCosts costsOfTouches(const std::filesystem::path& folder, std::size_t count, std::size_t batch,
                                   const Told& told = {}) {
  const MachineDescription machine = probing_test::machineFrom(probing_test::holeMachineText());
  const std::vector<Touch> cycle = probing_test::runCycles(machine, 1, {}, 7).list.touches;
  Session session = Session::create(folder / "session");
  const std::int64_t id = session.newCampaign("many", "2026-01-31T08:00:00Z", probing_test::holeMachineText());
  const std::filesystem::path watched = folder / "watched";
  std::filesystem::create_directories(watched);
  CaptureWatch watch(session, id, watched, std::nullopt, {0.0, true});
  std::ofstream out(watched / "touches.csv");
  out << TouchFeed::header() << '\n';
  ArrivalCosts costs;
  double now_s = 0.0;
  std::size_t arrived = 0;
  for (std::size_t tenth = 1; tenth <= 10; ++tenth) {
    const std::size_t begun = arrived;
    double cpu_us = 0.0;
    double wall_us = 0.0;
    while (arrived < count * tenth / 10) {
      TouchList list;
      for (std::size_t k = 0; k < batch; ++k, ++arrived) {
        Touch t = cycle[arrived % cycle.size()];
        const std::size_t number = arrived / cycle.size();
        t.cycle = fmt::format("M{}", number);
        t.time_s += (cycle.back().time_s + 10.0) * static_cast<double>(number);
        list.touches.push_back(std::move(t));
      }
      const std::string text = list.csv();
      out << text.substr(text.find('\n') + 1) << std::flush;
      const double cpu = cpuNow_us();
      const double wall = wallNow_us();
      (void)watch.turn(now_s);
      cpu_us += cpuNow_us() - cpu;
      wall_us += wallNow_us() - wall;
      now_s += 1.0;
      if (watch.touches() != arrived)
        throw InternalError(fmt::format("{} of {} touches were taken in", watch.touches(), arrived));
    }
    costs.cpu_us.push_back(cpu_us / static_cast<double>(arrived - begun));
    costs.wall_us.push_back(wall_us / static_cast<double>(arrived - begun));
    if (told) told(arrived, costs.cpu_us.back(), costs.wall_us.back());
  }
  watch.finish();
  return costs;
}

}  // namespace spindrift::testing
