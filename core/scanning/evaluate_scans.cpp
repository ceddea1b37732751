// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/evaluate_scans.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/json_reader.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/scanning/calibration_report.h"
#include "core/scanning/scan_evaluation.h"
#include "core/scanning/scan_noise.h"

namespace spindrift {
namespace {

double unitFactor(Component k) {
  return isRotation(k) ? urad_per_rad : um_per_mm;
}

/// A change of shape: heights over a lattice of the surface, profiler's frame, rows along y.
nlohmann::json freeFormJson(const FreeForm& form) {
  constexpr int nodes = 9;
  nlohmann::json out = {{"rms_um", jsonNumber(um_per_mm * form.rms_mm())},
                        {"log_evidence", jsonNumber(form.log_evidence)},
                        {"misfit_ratio_without", jsonNumber(form.misfit_ratio_without)}};
  nlohmann::json& motion = out["motion_standard_uncertainty"];
  for (const Component k : all_components) {
    const int i = static_cast<int>(k);
    motion[fmt::format("{}_{}", toString(k), unitOf(k))] =
        jsonNumber(unitFactor(k) * std::sqrt(form.motion_covariance(i, i)));
  }
  const Eigen::Vector2d step = (form.high_mm - form.low_mm) / (nodes - 1);
  for (int r = 0; r < nodes; ++r) {
    const double y = form.low_mm.y() + r * step.y();
    out["y_mm"].push_back(y);
    out["x_mm"].push_back(form.low_mm.x() + r * step.x());
    nlohmann::json heights, sigmas;
    for (int c = 0; c < nodes; ++c) {
      const FreeForm::Value v = form.shape(form.low_mm.x() + c * step.x(), y);
      heights.push_back(jsonNumber(um_per_mm * v.mm));
      sigmas.push_back(jsonNumber(um_per_mm * v.standard_uncertainty_mm));
    }
    out["height_um"].push_back(std::move(heights));
    out["standard_uncertainty_um"].push_back(std::move(sigmas));
  }
  return out;
}

nlohmann::json scanJson(const ScanResult& s, const std::string& axis) {
  nlohmann::json parameters = nlohmann::json::object();
  nlohmann::json at_artefact = nlohmann::json::object();
  nlohmann::json not_observed = nlohmann::json::array();
  for (const Component k : all_components) {
    const int i = static_cast<int>(k);
    const double f = unitFactor(k);
    const bool known = s.axis.determined(i);
    parameters[fmt::format("{}{}_{}", toString(k), axis, unitOf(k))] = {
        {"value", known ? nlohmann::json(valueOf(s.axis.error, k)) : nlohmann::json(nullptr)},
        {"standard_uncertainty", known ? jsonNumber(f * std::sqrt(s.axis.covariance(i, i))) : nlohmann::json(nullptr)}};
    const bool seen = std::isfinite(s.registration.covariance(i, i));
    const SmallError near{s.registration.translation_mm, s.registration.rotation_rad};
    at_artefact[fmt::format("{}_{}", toString(k), unitOf(k))] = {
        {"value", seen ? nlohmann::json(valueOf(near, k)) : nlohmann::json(nullptr)},
        {"standard_uncertainty", seen ? jsonNumber(f * s.standardUncertaintyAtArtefact(i)) : nlohmann::json(nullptr)},
        {"of_registration", seen ? jsonNumber(f * s.registration.standardUncertainty(i)) : nlohmann::json(nullptr)},
        {"white_noise_bound",
         seen ? jsonNumber(f * std::sqrt(s.registration.white_covariance(i, i))) : nlohmann::json(nullptr)}};
  }
  for (const auto& [k, reason] : s.not_observed)
    not_observed.push_back({{"component", toString(k)}, {"reason", reason}});
  return {{"cycle", s.capture.cycle},
          {"artefact", s.capture.artefact},
          {"time_s", s.capture.time_s},
          {"y_mm", s.capture.y_mm},
          {"reference", s.reference},
          {"parameters", parameters},
          {"at_artefact", at_artefact},
          {"not_observed", not_observed},
          {"free_form", s.registration.free_form ? freeFormJson(*s.registration.free_form) : nlohmann::json(nullptr)},
          {"rms_um", jsonNumber(um_per_mm * s.registration.rms_mm)},
          {"misfit_ratio", jsonNumber(s.registration.misfit_ratio)},
          {"noise_correlation", jsonNumber(s.registration.noise_correlation)},
          {"overlap", jsonNumber(s.registration.overlap)},
          {"points_used", s.registration.points_used},
          {"elapsed_ms", s.registration.elapsed_ms}};
}

}  // namespace

InstrumentEvaluation evaluateScans(const Campaign& campaign, const std::string& scan_model, JobContext& job) {
  return observationsOfScans(campaign, evaluateScanCampaign(campaign, scan_model, job));
}

InstrumentEvaluation observationsOfScans(const Campaign& campaign, const ScanEvaluation& evaluation) {
  InstrumentEvaluation out;
  out.instrument = "profiler";
  out.rejected = evaluation.rejected;
  out.warnings = evaluation.warnings;

  std::vector<ScanRow> rows;
  std::set<std::string> placed_by_scan;
  nlohmann::json cycles = nlohmann::json::array();
  for (std::size_t n = 0; n < evaluation.scans.size(); ++n) {
    const ScanResult& s = evaluation.scans[n];
    for (const Component k : all_components) {
      const int i = static_cast<int>(k);
      if (!std::isfinite(s.registration.covariance(i, i))) continue;
      Observation o;
      o.time_s = s.capture.time_s;
      o.state = s.capture.cycle;
      o.point = s.capture.artefact;
      o.component = k;
      if (const MachinePoint* point = campaign.machine.findPoint(s.capture.artefact)) {
        o.position_mm = point->position_mm;
      } else {
        o.position_mm =
            evaluation.machine_from_scan * Eigen::Vector3d(0.0, s.capture.y_mm + s.registration.centroid_mm.y(), 0.0);
        placed_by_scan.insert(s.capture.artefact);
      }
      o.value = valueOf(SmallError{s.registration.translation_mm, s.registration.rotation_rad}, k);
      o.instrument = "profiler";
      out.observations.rows.push_back(o);
      rows.push_back({n, i});
    }
    cycles.push_back(scanJson(s, evaluation.axis));
  }
  ScanNoise noise = noiseOfScans(evaluation.scans, rows);
  out.observations.shared = std::move(noise.shared);
  double worst = 0.0;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    out.observations.rows[r].sigma = noise.sigma[r];
    if (rows[r].component < 3 && !evaluation.scans[rows[r].scan].reference) worst = std::max(worst, noise.sigma[r]);
  }
  if (!placed_by_scan.empty())
    out.warnings.push_back(fmt::format(
        "machine.json has no point for {}: the position is taken from the scan, 0 across {}.",
        joinedList(std::vector<std::string>(placed_by_scan.begin(), placed_by_scan.end())), evaluation.axis));
  out.details["cycles"] = cycles;
  out.details["axis"] = evaluation.axis;
  out.details["scan_model"] = toString(evaluation.scan_model);
  out.details["calibration"] = calibrationJson(evaluation.mounting.calibration);
  std::size_t compared = 0;
  std::set<std::string> artefacts;
  for (const ScanResult& s : evaluation.scans) {
    compared += s.reference ? 0U : 1U;
    artefacts.insert(s.capture.artefact);
  }
  out.summary = fmt::format("Profiler ({}): {} scans of {} artefacts compared with their first, {} rejected\n",
                            printedName(evaluation.scan_model), compared, artefacts.size(), out.rejected.size());
  constexpr std::size_t most_lines = 24;
  std::size_t lines = 0;
  for (const ScanResult& s : evaluation.scans) {
    if (s.reference || ++lines > most_lines) continue;
    std::string line;
    for (const Observation& o : out.observations.rows) {
      if (o.state != s.capture.cycle || o.point != s.capture.artefact) continue;
      line += fmt::format("  {} {}", toString(o.component), withUncertainty(o.value, o.sigma, unitOf(o.component)));
    }
    out.summary += fmt::format("{:<6}{:<6}{}\n", s.capture.artefact, s.capture.cycle, line);
  }
  if (lines > most_lines) out.summary += fmt::format("and {} more\n", lines - most_lines);
  if (compared == 0) {
    out.good_enough = false;
    out.warnings.push_back(
        "No scan could be compared with a reference: at least two usable scans of one artefact are needed.");
  } else {
    out.summary += fmt::format("largest standard uncertainty of a displacement at an artefact {:.3g} µm\n", worst);
  }
  return out;
}

}  // namespace spindrift
