// SPDX-License-Identifier: Apache-2.0
// What every instrument ends in and every model predicts: one component of the deviation, at a position, at a time.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "core/machine/component.h"
#include "core/machine/shared_noise.h"

namespace spindrift {

class CsvTable;

/// How an observation may be used. `Holdout` only reports: it never selects and is never fitted.
enum class ObservationUse { Fit, Holdout, Exclude };

[[nodiscard]] std::string_view toString(ObservationUse use) noexcept;

/// One row of observations.csv. `value` and `sigma` in um (EX, EY, EZ) or urad (EA, EB, EC); deviation = actual minus
/// commanded position of the tool relative to the table, up to an unknown constant per point and component.
struct Observation {
  double time_s = 0.0;
  std::string state;                                      ///< thermal state or cycle: M0, M1, ...
  std::string point;                                      ///< id of the point
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();  ///< where the deviation holds, MCF
  double c_deg = 0.0;                                     ///< rotation of the table about +Z
  Component component = Component::EX;
  double value = 0.0;
  double sigma = 0.0;  ///< one standard uncertainty with all that is shared, > 0
  std::string instrument;
  ObservationUse use = ObservationUse::Fit;
  Eigen::Vector3d approach = Eigen::Vector3d::Zero();        ///< direction of approach, -1, 0 or +1 per axis
  Eigen::Vector3d tool_offset_mm = Eigen::Vector3d::Zero();  ///< tool point minus spindle reference
};

struct ObservationSet {
  std::vector<Observation> rows;
  /// What rows have in common of their noise; part of their sigma. The exchange format observations.cov.csv states the
  /// covariances of pairs of rows instead (row, column from 1; um^2, um urad or urad^2); it is split when it is read.
  SharedNoise shared;
  std::filesystem::path file;
  /// Values are deviations as they stand (the campaign says "reference": "absolute"); false: up to a constant for each
  /// point and component, and the first state is the reference.
  bool absolute = false;

  /// Reads observations.csv and, if it stands beside it, <stem>.cov.csv. Throws InputError: missing column, unknown
  /// component or use, sigma that is not positive, time that runs backwards for a point, a duplicate row, a variance in
  /// the covariances that is not positive.
  [[nodiscard]] static ObservationSet read(const std::filesystem::path& file);
  /// The same from text in memory, without covariances; `name` stands for the file in errors.
  [[nodiscard]] static ObservationSet parse(std::string text, const std::filesystem::path& name);
  /// Writes observations.csv, and <stem>.cov.csv with the covariances of all pairs if any is shared. Exact numbers,
  /// atomic.
  void write(const std::filesystem::path& file) const;
  /// The text `write` puts into observations.csv.
  [[nodiscard]] std::string csv() const;

  /// Takes covariances of pairs of rows for the shared noise, in place of what there was (see split_covariance.h): a
  /// diagonal entry (> 0) replaces sigma^2, of mirrored entries the first counts. Covariances that are not positive
  /// semidefinite together stay as they are stated: whoever needs them to be has to look.
  void setCovariances(const std::vector<CovarianceEntry>& entries);
  /// Appends rows with what they share among themselves.
  void append(const ObservationSet& other);

  /// States in order of first appearance.
  [[nodiscard]] std::vector<std::string> states() const;
  /// Points in order of first appearance.
  [[nodiscard]] std::vector<std::string> points() const;

 private:
  [[nodiscard]] static ObservationSet fromTable(const CsvTable& table);
};

}  // namespace spindrift
