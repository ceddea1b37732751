// SPDX-License-Identifier: Apache-2.0
// What a certificate says of an artefact, and how uncertain that is: places, expansion coefficient, temperature.
//
// Certified lengths hold at the reference temperature of the machine file (20 degC). At T they are longer by
// alpha (T - 20); between the first cycle and cycle k the artefact grows by g_k = alpha (T_k - T_1). Of machine.json,
// besides the keys of FORMATS.md: "expansion_uncertainty_um_per_m_K" and "temperature_uncertainty_K" (standard
// uncertainties; missing: taken as exact, and said). Temperature: a column T_<artefact>_degC of the log, or
// T_artefact_degC, else "temperature_degC". Readings of temperature err independently of each other, alpha is one
// number for all cycles: the uncertainty of the growth is a product of common factors, so that covariances between
// cycles are right by construction. Units: mm, strain, K. Failure: InputError for a key that is no number or negative.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/machine/machine_description.h"
#include "core/machine/operating_log.h"

namespace spindrift {

struct ArtefactCertificate {
  std::optional<double> expansion_per_K;  ///< strain per K
  double expansion_sigma_per_K = 0.0;
  double temperature_sigma_K = 0.0;
  double place_sigma_mm = 0.0;  ///< of one hole or ball, per coordinate
  double reference_degC = 20.0;
  std::vector<std::string>
      taken_as_exact;  ///< "the expansion coefficient", "the temperature": no uncertainty is stated

  /// A warning if something was taken as exact and lengths were corrected by `strain` for it; else empty.
  [[nodiscard]] std::string takenAsExact(const std::string& artefact, double strain) const;
  /// Warnings about lengths that were compared with the certificate while the artefact had these temperatures (missing:
  /// nothing tells it): not corrected, or taken as if it had the reference temperature.
  [[nodiscard]] std::vector<std::string> notCorrected(const std::string& artefact,
                                                      const std::vector<std::optional<double>>& temperature_degC) const;

  [[nodiscard]] static ArtefactCertificate of(const MachineDescription& machine, const Artefact& artefact);
};

/// Whether the log has a column of it (T_<id>_degC, T_artefact_degC). `log` may be null.
[[nodiscard]] bool temperatureIsLogged(const Artefact& artefact, const OperatingLog* log);
/// Temperature of the artefact at a time, if anything tells it. `log` may be null.
[[nodiscard]] std::optional<double> artefactTemperature(const Artefact& artefact, const OperatingLog* log,
                                                        double time_s);

/// Growth of an artefact since the first cycle.
struct ArtefactGrowth {
  std::vector<double> strain;            ///< per cycle; empty: not known
  std::vector<double> temperature_degC;  ///< per cycle
  /// cycles x causes, strain: one standard uncertainty of each cause (coefficient, first temperature, the temperature
  /// of every later cycle); the covariance of the strains is factors factors^T.
  Eigen::MatrixXd factors;
  bool measured = false;  ///< by a column of the log; else the machine file states one temperature for all cycles
};
[[nodiscard]] ArtefactGrowth artefactGrowth(const ArtefactCertificate& certificate, const Artefact& artefact,
                                            const OperatingLog* log, const std::vector<double>& cycle_time_s);

}  // namespace spindrift
