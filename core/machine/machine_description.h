// SPDX-License-Identifier: Apache-2.0
// machine.json: what the machine is, as FORMATS.md writes it. Positions mm in MCF, expansion um/(m K), temperatures
// degC.
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/json_reader.h"
#include "core/machine/kinematic_chain.h"
#include "core/machine/sensor_role.h"

namespace spindrift {

/// A linear axis.
struct LinearAxis {
  std::string name;  ///< "X", "Y", "Z" (perhaps with a number)
  std::array<double, 2> travel_mm{};
  std::optional<double> resolution_um;
  std::string drive_type;  ///< "ball_screw", "linear_motor", ... or empty
  std::optional<double> pitch_mm;
  std::optional<double> fixed_bearing_mm;
  std::string scale;  ///< "rotary_encoder", "linear_scale" or empty
  std::optional<double> datum_mm;
};

struct Spindle {
  std::string axis = "Z";
  std::optional<double> max_rpm;
  Eigen::Vector3d nose_offset_mm = Eigen::Vector3d::Zero();
};

struct RotaryAxis {
  std::string name;  ///< as in the chain, "C" or "C2"
  Eigen::Vector3d centre_mm = Eigen::Vector3d::Zero();
};

struct TemperatureSensor {
  std::string name;  ///< column of the log, "T_column_degC"
  std::string place;
  std::optional<SensorRole> role;  ///< as stated; nothing: read from name and place (readSensor)
  std::string unread_role{};       ///< stated in words that tell no role
};

/// A place where the deviation is measured.
struct MachinePoint {
  std::string id;
  std::string kind;  ///< "fiducial", "hole", "ball", "surface"
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
};

struct ArtefactBall {
  std::string id;
  double diameter_mm = 0.0;
  Eigen::Vector3d certified_mm = Eigen::Vector3d::Zero();  ///< from the first ball
};

struct Artefact {
  std::string id;
  std::string kind;  ///< "hole_bar" or "balls"
  // hole bar
  std::vector<double> nominal_positions_mm;  ///< along the bar; features are H1, H2, ... in this order
  std::string reference_hole = "H1";
  Eigen::Vector3d reference_in_table_mm = Eigen::Vector3d::Zero();  ///< from the C centre at c = 0
  Eigen::Vector3d direction_at_c0 = Eigen::Vector3d::UnitX();
  std::optional<double> hole_diameter_mm;
  // balls
  std::vector<ArtefactBall> balls;
  // both
  std::optional<double> expansion_um_per_m_K;
  std::optional<double> temperature_degC;
  std::optional<double> certificate_uncertainty_um;
};

struct Stylus {
  std::string id;
  double radius_mm = 0.0;
  Eigen::Vector3d offset_mm = Eigen::Vector3d::Zero();  ///< tip minus spindle reference
};

struct ProfilerDescription {
  std::string scan_model = "rigid";  ///< "rigid" or "push_broom"
  std::string axis = "Y";
  double lift_mm = 0.0;
  Eigen::Vector3d lever_mm = Eigen::Vector3d::Zero();  ///< slide origin to tool frame
  std::optional<int> profile_points;
  std::optional<double> profile_interval_mm;
  std::string calibration_cloud;                               ///< relative to the campaign folder; may be empty
  std::optional<std::array<double, 4>> calibration_circle_mm;  ///< x, y, z, r in the tool frame
};

struct Crossbeam {
  std::string axis = "Y";
  double from_mm = 0.0;
  double to_mm = 0.0;
};

/// A machine tool. Ids are unique within their list. `source` is the whole document, kept with unknown keys, for
/// reports.
struct MachineDescription {
  std::string name;
  KinematicChain chain;
  std::vector<LinearAxis> axes;
  std::optional<Spindle> spindle;
  std::vector<RotaryAxis> rotary;
  std::vector<TemperatureSensor> temperature_sensors;
  std::vector<MachinePoint> points;
  std::vector<Artefact> artefacts;
  std::vector<Stylus> styli;
  std::optional<ProfilerDescription> profiler;
  std::optional<Eigen::Vector2d> table_centre_mm;
  std::optional<double> column_base_mm;
  std::optional<Eigen::Vector2d> column_overhang_mm;  ///< spindle minus column, X and Y
  std::optional<Crossbeam> crossbeam;
  double reference_temperature_degC = 20.0;
  nlohmann::json source;
  std::filesystem::path file;

  /// Throws InputError with file and JSON path for anything FORMATS.md forbids.
  [[nodiscard]] static MachineDescription read(const std::filesystem::path& file);
  [[nodiscard]] static MachineDescription parse(const JsonNode& root, const std::filesystem::path& file);

  [[nodiscard]] const LinearAxis* findAxis(std::string_view name) const noexcept;
  [[nodiscard]] const RotaryAxis* findRotary(std::string_view name) const noexcept;
  [[nodiscard]] const MachinePoint* findPoint(std::string_view id) const noexcept;
  [[nodiscard]] const Artefact* findArtefact(std::string_view id) const noexcept;
  [[nodiscard]] const Stylus* findStylus(std::string_view id) const noexcept;
};

}  // namespace spindrift
