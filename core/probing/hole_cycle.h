// SPDX-License-Identifier: Apache-2.0
// The measurement cycle with a bar of holes on a rotary table (P1): thermal errors of one linear and one rotary axis
// and the growth of the bar, separated by turning the table.
//
// Per cycle, relative to the first (FORMATS.md, "Hole artefact"), for a linear axis X and a rotary axis C (any names):
//   EXX   deviation of the linear axis per metre from the centre of the rotary axis
//   EX0C EY0C EZ0T, EA0C EB0C EC0C   displacement and rotation of the table in MCF about the centre of the rotary axis
//   ER0T  radial growth of the table at the reference hole (the bar moves along the radius of that hole)
//   EME   growth of the bar per metre from its reference hole
// Linear model through the kinematic chain of the machine: a touch along u reads
//   -u . [ deviation(EXX, E.0C)(p) - R(c) (ER0T radial + EME s direction) ]   (a probe reads true minus deviation)
// solved for all cycles at once by core/probing/cycle_fit.h.
// It rests on: no thermal slope of the other axes. A second axis that expands puts the blame on EXX, ER0T and EME; with
// a bar of known growth (`stable_length`) a tenth parameter takes it (the paper's future work). `secondAxisBias` shows
// the bias.
// What the certificate says enters: its distances are what EME counts per metre of (their uncertainty times the growth
// is a cause common to all cycles); coefficient and measured temperature say EME a second time, with errors common to
// the cycles (coefficient, first temperature), and both are combined by their covariances, which tightens EXX too;
// against the certificate at 20 degC the linear axis has an absolute slope beside EXX, which counts from the first
// cycle (`CertifiedLengths`).
// Source: P1 (1)-(5) as PAPERS.md corrects them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/machine/operating_log.h"
#include "core/probing/cycle_evaluation.h"
#include "core/probing/touch.h"

namespace spindrift {

/// Which axes the bar measures and where it lies, from the machine file.
struct HoleBarSetup {
  std::string artefact;
  std::string linear;                         ///< "X": the axis along the bar at c = 0
  std::string second;                         ///< "Y": the other linear axis in the plane of the table
  std::string rotary;                         ///< "C2"
  Eigen::Vector3d rotary_direction{0, 0, 1};  ///< unit
  Eigen::Vector3d centre_mm{0, 0, 0};         ///< of the rotary axis
  Eigen::Vector3d reference_in_table_mm{0, 0, 0};
  Eigen::Vector3d direction_at_c0{1, 0, 0};
  std::vector<double> along_mm;  ///< of each hole from the reference hole
  std::optional<double> hole_diameter_mm;

  /// Throws InputError: no rotary table, centre missing, bar along the rotary axis.
  [[nodiscard]] static HoleBarSetup of(const MachineDescription& machine, const Artefact& artefact);
  /// EXX_um_per_m, EX0C_um, EY0C_um, EZ0T_um, ER0T_um, EA0C_urad, EB0C_urad, EC0C_urad, EME_um_per_m; names follow the
  /// axes. With `second_axis` one more: EYY_um_per_m.
  [[nodiscard]] std::vector<std::string> parameterNames(bool second_axis = false) const;
  /// Rotation of the table by c about the rotary axis.
  [[nodiscard]] Eigen::Matrix3d tableRotation(double c_deg) const;
  /// Nominal position of a hole (index from 0) in MCF.
  [[nodiscard]] Eigen::Vector3d nominal_mm(int hole, double c_deg) const;
  /// Index of "H3": 2.
  [[nodiscard]] static int holeIndex(const std::string& feature);
  /// d(deviation of the tip relative to the bar)/d(parameters) at a tip position: 3 x 9 (or 10), mm per strain, mm,
  /// rad.
  [[nodiscard]] Eigen::MatrixXd deviationJacobian(const std::string& feature, double c_deg,
                                                  const Eigen::Vector3d& tip_mm, bool second_axis = false) const;

  /// The part of the chain: slope of the linear axis, table translation X Y Z, table rotation A B C, slope of the
  /// second axis; at the origin and its change per mm along X, Y, Z (the chain is affine in the tip position).
  std::array<Eigen::Matrix<double, 3, 8>, 4> chain;
};

struct StableLength {
  double growth_um_per_m = 0.0;  ///< known growth of the bar per metre relative to the first cycle
  double uncertainty_um_per_m = 0.1;
  std::vector<double> growth_of_cycle_um_per_m;  ///< instead, one per cycle (expansion coefficient times temperature)
};

struct HoleCycleOptions {
  CycleFitOptions fit;
  /// Adds the slope of the second axis as a parameter; determined only with `stable_length`.
  bool second_axis = false;
  std::optional<StableLength> stable_length;
  /// Touches further from where they belong are on another feature, mm.
  double misplaced_mm = 1.0;
};

/// Part of the measured position that a straight line does not explain: per hole at c = 0, along the bar.
struct LinearityDeviation {
  std::string feature;
  double rms_um = 0.0;
  double largest_um = 0.0;  ///< signed
  std::string largest_cycle;
  double sigma_um = 0.0;  ///< noise of the largest
};

/// The bar against its certificate in one cycle at c = 0: what the linear axis reads of lengths that are known.
///   measured - certified (1 + alpha (T - 20 degC)) = -slope s + e,  s along the bar from the reference hole
/// slope: deviation of the linear axis per metre, absolute (EXX counts from the first cycle). e: touches, certificate
/// of each hole and of the reference hole (common), coefficient and temperature (common, growing with s).
struct CertifiedLengths {
  struct Hole {
    std::string feature;
    double certified_mm = 0.0;  ///< from the reference hole, at the temperature of the bar
    double error_um = 0.0;      ///< measured minus certified
    double standard_uncertainty_um = 0.0;
  };
  std::string cycle;
  std::vector<Hole> holes;
  double slope_um_per_m = 0.0;
  double standard_uncertainty_um_per_m = 0.0;
  double chi2 = 0.0;  ///< of the holes about the slope
  int degrees_of_freedom = 0;
  std::optional<double> temperature_degC;  ///< of the bar; nothing: taken as that of the certificate
};

/// Growth of the bar since the first cycle as its coefficient and temperature say, beside the EME of the touches alone.
struct ExpectedGrowth {
  std::string cycle;
  double expected_um_per_m = 0.0;
  double expected_sigma_um_per_m = 0.0;
  double measured_um_per_m = 0.0;
  double measured_sigma_um_per_m = 0.0;
};

/// What an unmodelled expansion of the second axis by 1 um/m does to each parameter (in its unit), for the touches of
/// one cycle; `with_stable_length` gives the same for the extended evaluation (zero up to the trust in the length).
struct SecondAxisBias {
  std::string second;
  std::vector<std::string> names;
  std::vector<double> bias_per_um_per_m;  ///< NaN: the touches of no cycle but the first determine it
};

struct HoleCycleResult : CycleEvaluation {
  HoleBarSetup setup;
  std::vector<CertifiedLengths> against_certificate;  ///< empty without "certificate_uncertainty_um"
  std::vector<ExpectedGrowth> growth;                 ///< empty without coefficient or temperature
  /// Both of them state EME: `parameters` are the best combination. Only where coefficient and temperature come with
  /// their uncertainties and do not contradict the touches.
  bool growth_combined = false;
  std::vector<LinearityDeviation> linearity;
  double largest_nonlinearity_um = 0.0;
  SecondAxisBias bias;
};

/// Touches of one hole bar over all cycles. `log` (may be null) tells the temperature of the bar. Throws InputError if
/// the machine file lacks what is needed; missing touches and bad touches are handled and told.
[[nodiscard]] HoleCycleResult evaluateHoleCycles(const TouchList& list, const MachineDescription& machine,
                                                 const Artefact& artefact, const HoleCycleOptions& options = {},
                                                 const OperatingLog* log = nullptr);

/// Of an evaluation and the touches that it is of.
[[nodiscard]] SecondAxisBias secondAxisBias(const HoleCycleResult& result, const TouchList& list);

}  // namespace spindrift
