// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/simulation_update_report.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/text.h"
#include "core/discrepancy/discrepancy_numbers.h"
#include "core/reporting/discrepancy_figures.h"

namespace spindrift {

std::vector<DiscrepancyReportRow> simulationUpdateRows(const DiscrepancyInput& input, const SimulationUpdate& update) {
  const auto& rows = input.observations.rows;
  std::vector<std::size_t> fitted;
  std::vector<double> change(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    change[i] = update.after[i] - update.before[i];
    if (rows[i].use == ObservationUse::Fit && std::isfinite(change[i])) fitted.push_back(i);
  }
  const RowResult before = evaluateRows(input, fitted, {}, std::vector<double>(rows.size(), 0.0));
  const RowResult after = evaluateRows(input, fitted, {}, change);
  std::vector<DiscrepancyReportRow> out;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Observation& o = rows[i];
    if (o.use == ObservationUse::Exclude) continue;
    out.push_back({o.time_s, o.point, o.component, o.position_mm, o.sigma,
                   o.value - update.before[i] - before.constant[i], o.value - update.after[i] - after.constant[i],
                   o.use == ObservationUse::Holdout, o.value});
    out.back().c_deg = o.c_deg;
  }
  return out;
}

void addSimulationUpdate(Report& document, const SimulationUpdate& update,
                         const std::vector<DiscrepancyReportRow>& rows, const std::optional<FieldGrid>& table) {
  document.subsection("Put into the simulation");
  const CalloutKind kind = update.status != FitStatus::Converged ? CalloutKind::Bad
                           : update.as_well_as_fitted_term       ? CalloutKind::Good
                                                                 : CalloutKind::Attention;
  document.callout(kind, update.message);
  if (!update.parameters.empty()) {
    std::vector<ReportRow> lines;
    for (const FittedSimulatorParameter& p : update.parameters) {
      const SimulatorParameter& was = p.parameter;
      std::string note = p.put_in ? "put in" : "adjusted within its uncertainty";
      if (p.no_influence) note = "changes no prediction";
      if (p.at_bound) note += ", at its bound";
      const std::string before = was.standard_uncertainty > 0.0 && !p.put_in
                                     ? withUncertainty(was.value, was.standard_uncertainty, was.printedUnit())
                                     : withUncertainty(was.value, 0.0, was.printedUnit());
      lines.push_back({was.name, was.what, before,
                       p.no_influence ? "\u2013" : withUncertainty(p.value, p.standard_uncertainty, was.printedUnit()),
                       note});
    }
    document.table({"Parameter", "What", "Before", "After", ""}, lines,
                   "Parameters of the simulation; after: value \u00b1 one standard uncertainty");
  }
  if (update.status == FitStatus::Converged || update.status == FitStatus::Rejected) {
    const auto text = [](double value) { return std::isfinite(value) ? fmt::format("{:.2f}", value) : "\u2013"; };
    document.table({"", "Simulation before", "Simulation after", "Fitted term instead", "Noise"},
                   {{"Fitted states, rms / µm", text(update.rms_before_um), text(update.rms_after_um),
                     text(update.rms_fitted_term_um), text(update.noise_um)},
                    {"Held-out states, rms / µm", text(update.heldout_rms_before_um), text(update.heldout_rms_after_um),
                     text(update.heldout_rms_fitted_term_um), text(update.noise_um)},
                    {"Fitted states, peak-to-peak / µm", text(update.p2p_before_um), text(update.p2p_after_um),
                     "\u2013", "\u2013"}},
                   "Measured minus the simulation's own runs, before and after");
    if (table) addDiscrepancyMaps(document, rows, *table, "new simulation");
    addTimeHistories(document, rows, "new simulation");
  }
  for (const std::string& warning : update.warnings) document.paragraph("Note: " + warning);
  document.paragraph(fmt::format("{} runs of the simulation to search, {} to fit ({:.0f} s).", update.runs_to_search,
                                 update.runs, update.elapsed_s));
}

}  // namespace spindrift
