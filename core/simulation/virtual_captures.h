// SPDX-License-Identifier: Apache-2.0
// Images and clouds of a virtual campaign. They are too large to keep, so they are rendered while the campaign is
// written: every shot and every scan sees the machine as it is bent at its own time.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/simulation/scenario_instruments.h"
#include "core/simulation/virtual_machine.h"

namespace spindrift {

class VirtualCaptures {
 public:
  /// `settings` with sizes as resolved. The plant is kept alive.
  VirtualCaptures(std::shared_ptr<const VirtualMachine> plant, const PlantEffectSettings& settings,
                  std::optional<MicroscopeOptions> microscope, std::optional<ProfilerOptions> profiler,
                  std::uint64_t image_seed, std::uint64_t scan_seed);

  /// Writes `captures/` into the campaign folder and completes the "profiler" entry of `machine`. Throws InputError.
  void write(const std::filesystem::path& folder, nlohmann::json& machine, JobContext& job) const;

  /// What the captures should lead to: [{"state","point","component","value"}], deviation from the first state (um; for
  /// surfaces urad too). EX and EY hold when the plane of the point is captured, EZ when its height is; those of a
  /// surface at its centroid (rigid: by the error of the carriage where the scan starts).
  [[nodiscard]] nlohmann::json truth() const;

  [[nodiscard]] std::size_t images() const;
  [[nodiscard]] std::size_t scans() const;

 private:
  [[nodiscard]] SmallError deviation(double time_s, const Eigen::Vector3d& position_mm, const std::string& point) const;
  [[nodiscard]] double seconds_per_fiducial() const;
  void writeImages(const std::filesystem::path& folder, JobContext& job) const;
  void writeScans(const std::filesystem::path& folder, nlohmann::json& machine, JobContext& job) const;

  std::shared_ptr<const VirtualMachine> plant_;
  std::vector<std::pair<double, PlantEffectFunction>> effects_;
  std::optional<MicroscopeOptions> microscope_;
  std::optional<ProfilerOptions> profiler_;
  std::uint64_t image_seed_;
  std::uint64_t scan_seed_;
};

}  // namespace spindrift
