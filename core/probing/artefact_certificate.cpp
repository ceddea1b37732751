// SPDX-License-Identifier: Apache-2.0
#include "core/probing/artefact_certificate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/json_reader.h"
#include "core/base/text.h"
#include "core/base/units.h"

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
      certificate.expansion_sigma_per_K = sigma->nonNegativeNumber() / um_per_m_per_unit;
      expansion_stated = true;
    }
    if (const auto sigma = node.find("temperature_uncertainty_K")) {
      certificate.temperature_sigma_K = sigma->nonNegativeNumber();
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
