// SPDX-License-Identifier: Apache-2.0
#include "core/probing/artefact_certificate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/json_reader.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/machine/artefact_ranges.h"

namespace spindrift {

ArtefactCertificate ArtefactCertificate::of(const MachineDescription& machine, const Artefact& artefact) {
  ArtefactCertificate certificate;
  certificate.reference_degC = machine.reference_temperature_degC;
  certificate.place_sigma_mm = artefact.certificate_uncertainty_um.value_or(0.0) * mm_per_um;
  if (artefact.expansion_um_per_m_K) certificate.expansion_per_K = *artefact.expansion_um_per_m_K / um_per_m_per_unit;
  bool expansion_stated = false;
  bool temperature_stated = false;
  const JsonNode root = JsonNode::parse(machine.source.dump(), machine.file.string());
  const auto artefacts = root.find("artefacts");
  for (const JsonNode& node : artefacts ? artefacts->items() : std::vector<JsonNode>{}) {
    if (node.stringOr("id", "") != artefact.id) continue;
    if (const auto sigma = node.find("expansion_uncertainty_um_per_m_K")) {
      const double value = sigma->nonNegativeNumber();
      if (value != 0.0 &&
          !(value >= least_artefact_expansion_um_per_m_K && value <= most_artefact_expansion_uncertainty_um_per_m_K)) {
        sigma->reject(fmt::format("0, or a number from {:g} to {:g}: µm/(m·K), not 1/K",
                                  least_artefact_expansion_um_per_m_K, most_artefact_expansion_uncertainty_um_per_m_K));
      }
      certificate.expansion_sigma_per_K = value / um_per_m_per_unit;
      expansion_stated = true;
    }
    if (const auto sigma = node.find("temperature_uncertainty_K")) {
      certificate.temperature_sigma_K = sigma->nonNegativeNumber();
      if (certificate.temperature_sigma_K > most_artefact_temperature_uncertainty_K)
        sigma->reject(fmt::format("a number from 0 to {:g}", most_artefact_temperature_uncertainty_K));
      temperature_stated = true;
    }
  }
  if (certificate.expansion_per_K.value_or(0.0) != 0.0) {
    if (!expansion_stated) certificate.taken_as_exact.emplace_back("the expansion coefficient");
    if (!temperature_stated) certificate.taken_as_exact.emplace_back("the temperature");
  }
  return certificate;
}

std::string ArtefactCertificate::takenAsExact(const std::string& artefact, double strain) const {
  if (taken_as_exact.empty() || !(strain > 0.0)) return {};
  return fmt::format(
      "The machine file states no uncertainty of {} of {}: taken as exact, though lengths were corrected by up to "
      "{:.1f} µm/m.",
      joinedList(taken_as_exact), artefact, strain * um_per_m_per_unit);
}

std::vector<std::string> ArtefactCertificate::notCorrected(
    const std::string& artefact, const std::vector<std::optional<double>>& temperature_degC) const {
  std::vector<std::string> warnings;
  double warmest_K = 0.0;
  bool unknown = false;
  for (const std::optional<double>& temperature : temperature_degC) {
    unknown = unknown || !temperature;
    warmest_K = std::max(warmest_K, std::abs(temperature.value_or(reference_degC) - reference_degC));
  }
  if (!expansion_per_K && warmest_K > 0.0) {
    warnings.push_back(
        fmt::format("The expansion coefficient of {} is not stated: its lengths against the certificate are not "
                    "corrected for {:.1f} K.",
                    artefact, warmest_K));
  }
  const double um_per_m_K = std::abs(expansion_per_K.value_or(0.0)) * um_per_m_per_unit;
  constexpr double negligible_um_per_m_K = 0.5;
  if (unknown && um_per_m_K > negligible_um_per_m_K) {
    warnings.push_back(fmt::format(
        "The temperature of {} is not known: its lengths are compared with the certificate as if it were at "
        "{:g} °C; with every kelvin they are {:.1f} µm/m off, beyond the stated uncertainty.",
        artefact, reference_degC, um_per_m_K));
  }
  return warnings;
}

namespace {
/// Empty: there is none.
std::string temperatureColumn(const Artefact& artefact, const OperatingLog* log) {
  if (log != nullptr && !log->empty()) {
    for (const std::string& name : {fmt::format("T_{}_degC", artefact.id), std::string("T_artefact_degC")}) {
      const std::vector<double>* values = log->signal(name);
      if (values != nullptr && std::any_of(values->begin(), values->end(), [](double v) { return std::isfinite(v); }))
        return name;
    }
  }
  return {};
}

/// What the log says, if it can be the temperature of an artefact in a workshop.
double loggedTemperature(const std::string& column, const OperatingLog& log, double time_s) {
  constexpr double least_degC = -20.0;  // as machine.json
  constexpr double most_degC = 80.0;
  constexpr double longest_hold_s = 1800.0;
  const SourcePlace place{log.file(), fmt::format("column {}", column)};
  const double beyond_s = std::max(log.time_s().front() - time_s, time_s - log.time_s().back());
  if (beyond_s > longest_hold_s) {
    throw InputError(place, fmt::format("the log runs from {:.6g} to {:.6g} s, but the artefact was touched at {:.6g} "
                                        "s; allowed: a log of that time (a clock offset moves it).",
                                        log.time_s().front(), log.time_s().back(), time_s));
  }
  const double value_degC = log.at(column, time_s);
  if (value_degC >= least_degC && value_degC <= most_degC) return value_degC;
  throw InputError(place, fmt::format("the temperature of the artefact is {:g} °C at {:.6g} s; allowed: {:g} to {:g} "
                                      "°C (kelvin, degrees Fahrenheit, or the value of a broken sensor?).",
                                      value_degC, time_s, least_degC, most_degC));
}
}  // namespace

bool temperatureIsLogged(const Artefact& artefact, const OperatingLog* log) {
  return !temperatureColumn(artefact, log).empty();
}

std::optional<double> artefactTemperature(const Artefact& artefact, const OperatingLog* log, double time_s) {
  const std::string column = temperatureColumn(artefact, log);
  return column.empty() ? artefact.temperature_degC : loggedTemperature(column, *log, time_s);
}

ArtefactGrowth artefactGrowth(const ArtefactCertificate& certificate, const Artefact& artefact, const OperatingLog* log,
                              const std::vector<double>& cycle_time_s) {
  ArtefactGrowth growth;
  if (!certificate.expansion_per_K || cycle_time_s.empty()) return growth;
  for (const double time : cycle_time_s) {
    const auto temperature = artefactTemperature(artefact, log, time);
    if (!temperature) return growth;
    growth.temperature_degC.push_back(*temperature);
  }
  const auto cycles = static_cast<Eigen::Index>(cycle_time_s.size());
  const double alpha = *certificate.expansion_per_K;
  // A temperature that the machine file states once is the same error in all cycles, and no growth.
  growth.measured = temperatureIsLogged(artefact, log);
  growth.factors = Eigen::MatrixXd::Zero(cycles, cycles + 1);
  for (Eigen::Index k = 0; k < cycles; ++k) {
    const double warmer = growth.temperature_degC[static_cast<std::size_t>(k)] - growth.temperature_degC.front();
    growth.strain.push_back(alpha * warmer);
    growth.factors(k, 0) = warmer * certificate.expansion_sigma_per_K;
    if (k == 0 || !growth.measured) continue;
    growth.factors(k, 1) = -alpha * certificate.temperature_sigma_K;
    growth.factors(k, 1 + k) = alpha * certificate.temperature_sigma_K;
  }
  return growth;
}

}  // namespace spindrift
