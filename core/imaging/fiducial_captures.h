// SPDX-License-Identifier: Apache-2.0
// captures/fiducials.csv: which image was taken when, of which fiducial, in which thermal state, where.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spindrift {

/// What an image is for: >= 3 spindle orientations, >= 3 positions along a machine axis, >= 5 heights.
enum class CaptureRole { Rotation, XAxis, YAxis, Focus };
[[nodiscard]] std::string_view toString(CaptureRole role) noexcept;
/// Of its name in a list; none if it is not known.
[[nodiscard]] std::optional<CaptureRole> captureRole(std::string_view name) noexcept;

/// One row. The position is the commanded tool position relative to the table, mm in MCF.
struct FiducialCapture {
  double time_s = 0.0;
  std::string state;
  std::string fiducial;
  CaptureRole role = CaptureRole::Rotation;
  int index = 0;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  double spindle_deg = 0.0;  ///< the camera turns with the spindle, positive about +Z
  std::string image;         ///< path relative to the campaign folder
};

struct FiducialCaptureList {
  std::vector<FiducialCapture> captures;
  std::filesystem::path file;

  /// In order of first appearance; the first state is the reference.
  [[nodiscard]] std::vector<std::string> states() const;
  [[nodiscard]] std::vector<std::string> fiducials() const;
};

/// Throws InputError with file, line, value and what is allowed: missing column, not a number (decimal comma), unknown
/// role, time that runs backwards for a fiducial, a row that stands twice. Does not look at the images.
[[nodiscard]] FiducialCaptureList readFiducialCaptures(const std::filesystem::path& file);

}  // namespace spindrift
