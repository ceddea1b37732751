// SPDX-License-Identifier: GPL-3.0-or-later
// What captures and touches cost that arrive in a watched folder one after the other, in CPU time, so that it shows
// whether the next one costs more when many have come before: over one long run, tenth by tenth, or beside another
// folder in which few have come, batch by batch in turn, so that what else the computer does slows both alike.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/session/session.h"
#include "core/workflows/capture_watch.h"
#include "tests/core/probing/probing_machines.h"

namespace spindrift::testing {

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

/// What one batch cost from when it lay in the folder until it was stored (us).
struct BatchCost {
  double cpu_us = 0.0;
  double wall_us = 0.0;
};

/// What `taken` costs.
template <typename Taken>
BatchCost costOf(const Taken& taken) {
  const double cpu = cpuNow_us();
  const double wall = wallNow_us();
  taken();
  return {cpuNow_us() - cpu, wallNow_us() - wall};
}

/// Small scans that arrive; what was taken is removed from the watched folder, as from a camera.
class ArrivingCaptures {
 public:
  /// Room for `most` of them in the plan.
  ArrivingCaptures(const std::filesystem::path& folder, std::size_t most)
      : watched_(folder / "watched"), session_(Session::create(folder / "session")) {
    constexpr std::size_t artefacts = 100;
    std::string machine = R"({"format":"spindrift-machine","version":1,"name":"mill","chain":"V [w-X'-Y'-b-Z-(C)-t]",
"axes":[{"name":"X","travel_mm":[0,300]},{"name":"Y","travel_mm":[0,200]},{"name":"Z","travel_mm":[0,150]}],"points":[)";
    for (std::size_t i = 0; i < artefacts; ++i)
      machine += fmt::format(R"({}{{"id":"A{}","kind":"surface","x_mm":0,"y_mm":50,"z_mm":0}})", i == 0 ? "" : ",", i);
    const std::int64_t id = session_.newCampaign("many", "2026-01-31T08:00:00Z", machine + "]}");
    PlanOptions options;
    options.kind = PlannedKind::Scan;
    options.states = static_cast<int>((most + artefacts - 1) / artefacts);
    storePlan(session_, id, makePlan(Campaign::read(session_.campaign(id).folder).machine, options));
    std::filesystem::create_directories(watched_);
    watch_.emplace(session_, id, watched_, std::nullopt, FolderWatchOptions{0.0, true});
  }

  BatchCost arrive(std::size_t batch) {
    for (std::size_t k = 0; k < batch; ++k) {
      std::ofstream out(watched_ / fmt::format("s{}.csv", arrived_ + k));
      out << "x_mm,y_mm,z_mm\n";
      for (int j = 0; j < 12; ++j) {
        for (int i = 0; i < 12; ++i)
          out << i << ',' << j << ','
              << fmt::format("{:.6f}", 0.1 * std::sin(i + 0.7 * j + 1e-5 * static_cast<double>(arrived_ + k))) << '\n';
      }
    }
    std::size_t accepted = 0;
    std::string sentence;
    const BatchCost cost = costOf([&] {
      for (int look = 0; look < 2; ++look) {
        for (const IncomingItem& item : watch_->turn(now_s_)) {
          accepted += item.state == IncomingState::Accepted ? 1 : 0;
          sentence = item.sentence;
        }
        now_s_ += 1.0;
      }
    });
    if (accepted != batch)
      throw InternalError(fmt::format("{} of {} scans were accepted: {}", accepted, batch, sentence));
    arrived_ += batch;
    for (const auto& entry : std::filesystem::directory_iterator(watched_)) std::filesystem::remove(entry.path());
    return cost;
  }

 private:
  std::filesystem::path watched_;
  Session session_;
  std::optional<CaptureWatch> watch_;
  double now_s_ = 0.0;
  std::size_t arrived_ = 0;
};

/// Touches of a bar of holes that arrive, cycle after cycle, in one list that grows.
class ArrivingTouches {
 public:
  explicit ArrivingTouches(const std::filesystem::path& folder)
      : watched_(folder / "watched"),
        cycle_(
            probing_test::runCycles(probing_test::machineFrom(probing_test::holeMachineText()), 1, {}, 7).list.touches),
        session_(Session::create(folder / "session")) {
    const std::int64_t id = session_.newCampaign("many", "2026-01-31T08:00:00Z", probing_test::holeMachineText());
    std::filesystem::create_directories(watched_);
    watch_.emplace(session_, id, watched_, std::nullopt, FolderWatchOptions{0.0, true});
    out_.open(watched_ / "touches.csv");
    out_ << TouchFeed::header() << '\n';
  }

  BatchCost arrive(std::size_t batch) {
    TouchList list;
    for (std::size_t k = 0; k < batch; ++k, ++arrived_) {
      Touch t = cycle_[arrived_ % cycle_.size()];
      const std::size_t number = arrived_ / cycle_.size();
      t.cycle = fmt::format("M{}", number);
      t.time_s += (cycle_.back().time_s + 10.0) * static_cast<double>(number);
      list.touches.push_back(std::move(t));
    }
    const std::string text = list.csv();
    out_ << text.substr(text.find('\n') + 1) << std::flush;
    const BatchCost cost = costOf([&] { (void)watch_->turn(now_s_); });
    now_s_ += 1.0;
    if (watch_->touches() != arrived_)
      throw InternalError(fmt::format("{} of {} touches were taken in", watch_->touches(), arrived_));
    return cost;
  }

 private:
  std::filesystem::path watched_;
  std::vector<Touch> cycle_;
  Session session_;
  std::optional<CaptureWatch> watch_;
  std::ofstream out_;
  double now_s_ = 0.0;
  std::size_t arrived_ = 0;
};

using Told = std::function<void(std::size_t arrived, const BatchCost& each)>;

/// How much more one arrival costs (CPU time) in the last tenth of `count` than in the second one; the first still
/// warms up.
template <typename Arriving>
double growthOver(Arriving& arriving, std::size_t count, std::size_t batch, const Told& told) {
  double second_us = 0.0;
  double last_us = 0.0;
  std::size_t arrived = 0;
  for (std::size_t tenth = 1; tenth <= 10; ++tenth) {
    const std::size_t begun = arrived;
    BatchCost sum;
    for (; arrived < count * tenth / 10; arrived += batch) {
      const BatchCost cost = arriving.arrive(batch);
      sum = {sum.cpu_us + cost.cpu_us, sum.wall_us + cost.wall_us};
    }
    const auto n = static_cast<double>(arrived - begun);
    told(arrived, {sum.cpu_us / n, sum.wall_us / n});
    last_us = sum.cpu_us / n;
    if (tenth == 2) second_us = last_us;
  }
  return last_us / second_us;
}

/// How much more a batch costs (CPU time) where `before` have arrived than where a tenth of that has: the median over
/// `rounds` batches, taken in turn.
template <typename Arriving>
double growthBeside(Arriving& many, Arriving& few, std::size_t before, std::size_t batch, std::size_t rounds) {
  for (std::size_t arrived = 0; arrived < before; arrived += batch) (void)many.arrive(batch);
  for (std::size_t arrived = 0; arrived < before / 10; arrived += batch) (void)few.arrive(batch);
  std::vector<double> growth;
  for (std::size_t i = 0; i < rounds; ++i) {
    const double many_us = many.arrive(batch).cpu_us;
    growth.push_back(many_us / few.arrive(batch).cpu_us);
  }
  std::nth_element(growth.begin(), growth.begin() + static_cast<std::ptrdiff_t>(rounds / 2), growth.end());
  return growth[rounds / 2];
}

}  // namespace spindrift::testing
