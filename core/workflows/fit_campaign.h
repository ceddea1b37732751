// SPDX-License-Identifier: Apache-2.0
// Fitting one thermal state of a campaign, its heat maps, and where to measure: one function per user action, called by
// the command line and by the pages.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/machine/campaign.h"
#include "core/machine/field.h"
#include "core/machine/measuring_points.h"
#include "core/machine/nine_parameter_model.h"
#include "core/machine/table_polynomial.h"

namespace spindrift {

/// JSON of `fit` (FORMATS.md): parameters, residuals, rms_fit_um, rms_validation_um, condition_number; status, message,
/// state, reference_state, undetermined, chi2, degrees_of_freedom, p_value, covariance, warnings beside them. What is
/// not determined is null.
[[nodiscard]] nlohmann::json toJson(const NineParameterFit& fit);
/// A few lines for people.
[[nodiscard]] std::string summaryOf(const NineParameterFit& fit);

/// The same with the key `higher_order`: what the evidence says of terms beyond the nine parameters
/// (core/machine/table_polynomial.h).
[[nodiscard]] nlohmann::json toJson(const NineParameterFit& fit, const TableOrderChoice& choice);
[[nodiscard]] std::string summaryOf(const NineParameterFit& fit, const TableOrderChoice& choice);

[[nodiscard]] nlohmann::json toJson(const NineParameterComparison& comparison);
[[nodiscard]] std::string summaryOf(const NineParameterComparison& comparison);

struct HeatmapOptions {
  NineParameterOptions fit;
  Component component = Component::EX;
  int nx = 61;  ///< nodes, >= 2
  int ny = 41;
  bool higher_order = false;  ///< with the terms in x and y that the evidence asks for (chooseTableOrder)
  /// Throws InputError.
  void validate() const;
};

/// The table of a machine: travels of X and Y. Throws InputError if it has no X or Y axis.
[[nodiscard]] FieldGrid tableGrid(const MachineDescription& machine, int nx, int ny, double z_mm);

/// The same with cells that are about square, `nodes` (>= 2) along the longer side; empty if there is no X or Y axis,
/// so that pages and reports go without a map.
[[nodiscard]] std::optional<FieldGrid> mapTable(const MachineDescription& machine, double z_mm, int nodes);

/// Field of a model over the table, with the measured points of the fit on top. The region spanned by the points that
/// were fitted is not extrapolated.
[[nodiscard]] Field tableField(const NineParameterFit& fit, const ErrorModel& model, const FieldGrid& grid,
                               Component component);

struct HeatmapResult {
  NineParameterFit fit;
  Field field;
  bool determined = true;  ///< false: the fitted points do not determine the component over the table; field is empty
  std::string message;
  std::optional<TableOrderChoice> order;  ///< of the higher order, where it was asked for

  [[nodiscard]] nlohmann::json json() const;
  /// Texts for the picture.
  [[nodiscard]] std::string title() const;
  [[nodiscard]] std::string subtitle() const;
};

[[nodiscard]] HeatmapResult heatmapOf(const Campaign& campaign, const ObservationSet& observations,
                                      const HeatmapOptions& options);

/// Optimal positions: among the points of the machine (kind fiducial, or all) or, with lattice_nx > 0, a lattice over
/// the table that keeps `margin_mm` from its border.
struct PlacementRequest {
  int lattice_nx = 0;
  int lattice_ny = 0;
  double margin_mm = 15.0;
  std::vector<std::string> fixed;  ///< ids of points that are measured anyway
  PlacementOptions options;        ///< region is set from the machine
};

struct PlacementAnswer {
  std::vector<std::string> ids;  ///< of the candidates
  std::vector<Eigen::Vector3d> candidates_mm;
  PlacementResult result;

  [[nodiscard]] nlohmann::json json() const;
  [[nodiscard]] std::string summary() const;
};

[[nodiscard]] PlacementAnswer placeFiducials(const MachineDescription& machine, PlacementRequest request,
                                             const JobContext& job);

}  // namespace spindrift
