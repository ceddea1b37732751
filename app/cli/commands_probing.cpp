// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <memory>

#include "app/cli/command.h"
#include "core/base/atomic_file.h"
#include "core/base/count_text.h"
#include "core/base/error.h"
#include "core/base/printed_number.h"
#include "core/base/text.h"
#include "core/base/unit_text.h"
#include "core/base/units.h"
#include "core/machine/parameter_meanings.h"
#include "core/probing/checked_program.h"
#include "core/probing/cycle_studies.h"
#include "core/probing/evaluate_touches.h"
#include "core/probing/printed_text.h"
#include "core/probing/probe_health.h"

namespace spindrift::cli {
namespace {

const Artefact& chosenArtefact(const MachineDescription& machine, const std::string& id) {
  if (machine.artefacts.empty()) {
    throw InputError({machine.file, "$.artefacts"}, "is missing or empty; allowed: a hole bar or a ball artefact.");
  }
  if (id.empty()) {
    if (machine.artefacts.size() == 1) return machine.artefacts.front();
    throw InputError({machine.file, "$.artefacts"}, "describes several artefacts; name one with --artefact.");
  }
  const Artefact* artefact = machine.findArtefact(id);
  if (artefact == nullptr) {
    throw InputError({machine.file, "$.artefacts"}, fmt::format("holds no artefact \"{}\".", id));
  }
  return *artefact;
}

TouchList touchesOf(const Campaign& campaign) {
  const auto file = campaign.captureList("touches.csv");
  if (!file) throw InputError({campaign.path("captures/touches.csv"), ""}, "is missing; these commands need touches.");
  return TouchList::read(*file);
}

/// The evaluation of one artefact of a campaign, whatever its kind.
CycleEvaluation evaluationOf(const Campaign& campaign, const std::string& id, JobContext& job) {
  TouchEvaluation all = evaluateTouchList(campaign, touchesOf(campaign), {}, {}, job);
  for (const HoleCycleResult& r : all.hole_cycles) {
    if (id.empty() || r.artefact == id) return r;
  }
  for (const BallCycleResult& r : all.ball_cycles) {
    if (id.empty() || r.artefact == id) return r;
  }
  throw InputError(fmt::format("no touches of artefact \"{}\" in this campaign.", id));
}

struct CycleArguments {
  std::string machine, artefact, nc, template_file, control = "fanuc";
  std::vector<double> first_ball;
  CyclePlanOptions plan;
  ProgramOptions program;
};

void addCycle(CLI::App& app, CommandLine& line) {
  auto a = std::make_shared<CycleArguments>();
  CLI::App* command = addCommand(
      app, line, "cycle", "Write a measuring cycle for the machine's control, read it back and check it",
      [a](JobContext&) {
        const MachineDescription machine = MachineDescription::read(a->machine);
        const Artefact& artefact = chosenArtefact(machine, a->artefact);
        CyclePlanOptions plan_options = a->plan;
        if (!a->first_ball.empty()) plan_options.first_ball_mm = Eigen::Vector3d(a->first_ball.data());
        if (artefact.kind == "balls" && a->first_ball.empty()) {
          throw InputError("where the first ball stands is not known; allowed: --first-ball X,Y,Z in mm.");
        }
        ProgramOptions program = a->program;
        program.dialect = programDialect(a->control);
        const CheckedProgram checked = makeCheckedProgram(machine, artefact, plan_options, program);
        const auto& [plan, text, check] = checked;
        CommandResult result;
        result.json = {{"artefact", artefact.id},     {"touches", check.touches},
                       {"moves", check.moves.size()}, {"safe_height_mm", plan.safe_height_mm},
                       {"control", a->control},       {"good", check.good()}};
        nlohmann::json issues = nlohmann::json::array();
        for (const ProgramIssue& i : check.issues) {
          issues.push_back({{"line", i.line}, {"what", i.what}});
          result.summary += fmt::format("line {}: {}\n", i.line, i.what);
        }
        result.json["issues"] = issues;
        if (!check.good()) {
          result.summary += "the program was not written because its check found the above\n";
          result.exit_status = NotGoodEnough;
          return result;
        }
        if (!a->nc.empty()) {
          writeFileAtomically(a->nc, text);
          for (const CompanionFile& file : companionFiles(program.dialect)) {
            const std::filesystem::path beside = std::filesystem::path(a->nc).parent_path() / file.name;
            writeFileAtomically(beside, file.content);
            result.summary += fmt::format("{} belongs to it: copy it to TNC:\\SPINDRIFT\n", beside.string());
          }
        }
        if (!a->template_file.empty()) {
          writeFileAtomically(a->template_file, printedTextTemplate(machine, artefact, program).dump(1) + "\n");
        }
        result.summary += fmt::format(
            "{} touches on {} in {} moves; read back and checked: all inside the travel, none through the artefact, a "
            "retract after every touch, safe height {:.1f} mm\n",
            check.touches, artefact.id, check.moves.size(), plan.safe_height_mm);
        if (plan.left_out_below > 0)
          result.summary +=
              fmt::format("{} from below left out, where the stem of a ball may be; --from-below includes them\n",
                          countOf(plan.left_out_below, "touch", "touches"));
        return result;
      });
  command->add_option("MACHINE", a->machine, "machine.json")->required();
  command->add_option("--nc", a->nc, "Write the program to this file")->type_name("FILE");
  command->add_option("--template", a->template_file, "Write the template that reads what the program prints (JSON)")
      ->type_name("FILE");
  command
      ->add_option("--control", a->control,
                   "Dialect: fanuc (G65, G31, DPRNT), generic (G38.2, LOG), siemens (MEAS, WRITE) or heidenhain (TCH "
                   "PROBE 4, FN 16)")
      ->check(oneOf({"fanuc", "generic", "siemens", "heidenhain"}))
      ->capture_default_str();
  command->add_option("--artefact", a->artefact, "Id of the artefact, if the machine file has several");
  command->add_option("--first-ball", a->first_ball, "Position of the first ball in machine coordinates, mm")
      ->delimiter(',')
      ->expected(3)
      ->type_name("X,Y,Z");
  command->add_option("--clearance", a->plan.clearance_mm, "Clearance around material, mm")->capture_default_str();
  command->add_option("--retract", a->plan.retract_mm, "Retract height above the highest material, mm")
      ->capture_default_str();
  command
      ->add_option("--overtravel", a->plan.overtravel_mm,
                   "Overtravel: how far a touch may search beyond the nominal surface, mm")
      ->capture_default_str();
  command->add_option("--depth", a->plan.depth_mm, "Depth of the touches in a hole, mm")->capture_default_str();
  command->add_option("--beside", a->plan.surface_offset_mm, "Distance of the surface touch from the hole, mm")
      ->capture_default_str();
  command->add_option("--touch-feed", a->plan.touch_feed_mm_min, "Probing feed, mm/min")->capture_default_str();
  command->add_option("--feed", a->plan.guarded_feed_mm_min, "Feed of protected positioning moves, mm/min")
      ->capture_default_str();
  command->add_option("--program-number", a->program.program_number, "Program number (fanuc)")
      ->check(numberBetween(1, 9999))
      ->capture_default_str();
  command
      ->add_option("--rotary-sign", a->program.rotary_sign, "-1 if the control counts the table clockwise from above")
      ->check(oneOf({"-1", "1"}))
      ->capture_default_str();
  command->add_flag("--from-below", a->plan.touch_from_below, "Probe balls from below as well (no stem underneath)");
}

struct PrintedArguments {
  std::string printed, machine, pattern, out;
};

void addImport(CLI::App& app, CommandLine& line) {
  auto a = std::make_shared<PrintedArguments>();
  CLI::App* command = addCommand(
      app, line, "import-touches", "Convert the printed output of a measuring program into touches.csv",
      [a](JobContext&) {
        const MachineDescription machine = MachineDescription::read(a->machine);
        const JsonNode pattern = JsonNode::read(a->pattern);
        const PrintedText printed = readPrintedText(readFile(a->printed), a->printed, pattern, machine);
        printed.touches.checkAgainst(machine);
        const std::string text = printed.touches.csv();
        (void)TouchList::parse(text, a->printed);  // only what every command can read is written
        writeFileAtomically(a->out, text);
        CommandResult result;
        result.json = {{"touches", printed.touches.touches.size()},
                       {"cycles", printed.touches.cycles()},
                       {"ignored_lines", printed.ignored_lines},
                       {"cut_lines", printed.cut_lines}};
        if (printed.cut_lines > 0)
          result.warnings.push_back(
              fmt::format("{}: {} as a touch but {} cut short, the first in line {}: what they printed is lost.",
                          a->printed, countOf(printed.cut_lines, "line begins", "lines begin"),
                          printed.cut_lines == 1 ? "is" : "are", printed.first_cut_line));
        result.summary =
            fmt::format("{} in {}, {} skipped\n", countOf(printed.touches.touches.size(), "touch", "touches"),
                        countOf(printed.touches.cycles().size(), "cycle"), countOf(printed.ignored_lines, "line"));
        return result;
      });
  command->add_option("PRINTED", a->printed, "Text file as printed by the control")->required();
  command->add_option("--machine", a->machine, "machine.json")->required()->type_name("FILE");
  command->add_option("--template", a->pattern, "Template (JSON); `cycle --template` writes one to start from")
      ->required()
      ->type_name("FILE");
  command->add_option("--out", a->out, "touches.csv to write")->required()->type_name("FILE");
}

struct HealthArguments {
  std::string campaign;
  ProbeHealthOptions options;
};

void addHealth(CLI::App& app, CommandLine& line) {
  auto a = std::make_shared<HealthArguments>();
  CLI::App* command = addCommand(
      app, line, "probe-health",
      "Qualify styli on a sphere: pre-travel by direction, repeatability, detection of a loose stylus",
      [a](JobContext&) {
        const Campaign campaign = Campaign::read(a->campaign);
        const std::vector<StylusHealth> all = checkProbeHealth(touchesOf(campaign), campaign.machine, a->options);
        CommandResult result;
        result.json["styli"] = nlohmann::json::array();
        for (const StylusHealth& h : all) {
          nlohmann::json directions = nlohmann::json::array();
          for (const PreTravel& p : h.directions) {
            directions.push_back({{"approach", {p.approach.x(), p.approach.y(), p.approach.z()}},
                                  {"pre_travel_um", p.pre_travel_um},
                                  {"standard_uncertainty_um", jsonNumber(p.standard_uncertainty_um)},
                                  {"repeatability_um", jsonNumber(p.repeatability_um)},
                                  {"touches", p.touches}});
          }
          result.json["styli"].push_back(
              {{"stylus", h.stylus},
               {"feature", h.feature},
               {"status", toString(h.status)},
               {"message", h.message},
               {"healthy", h.healthy},
               {"loose", h.loose},
               {"movement", toString(h.movement.kind)},
               {"compared_with_other_styli", h.compared},
               {"effective_radius_mm", h.effective_radius_mm},
               {"effective_radius_standard_uncertainty_mm", jsonNumber(h.effective_radius_sigma_mm)},
               {"pre_travel_range_um", h.pre_travel_range_um},
               {"repeatability_um", jsonNumber(h.repeatability_um)},
               {"largest_step_um", h.largest_step_um},
               {"directions", directions}});
          result.summary += fmt::format("{} on {}: {}\n", h.stylus, h.feature, h.message);
          if (h.status == FitStatus::Converged) {
            result.summary += fmt::format(
                "  effective radius {}, pre-travel range {:.2f} µm, repeatability {}\n",
                withUncertainty(h.effective_radius_mm, h.effective_radius_sigma_mm, "mm"), h.pre_travel_range_um,
                std::isfinite(h.repeatability_um) ? fmt::format("{:.2f} µm", h.repeatability_um)
                                                  : std::string("not determined"));
          }
          if (!h.healthy) result.exit_status = NotGoodEnough;
        }
        return result;
      });
  command->add_option("CAMPAIGN", a->campaign, "Folder of the campaign with touches on a sphere")->required();
  command
      ->add_option("--healthy", a->options.healthy_sigma_um,
                   "Repeatability of a sound probe, µm (one standard deviation)")
      ->check(positiveNumber())
      ->capture_default_str();
}

struct CycleStudyArguments {
  std::string campaign, artefact, parameter, reference;
  RepeatabilityOptions options;
  std::vector<double> growth;
  double trust_um_per_m = 0.1;
};

void addStudies(CLI::App& app, CommandLine& line) {
  auto a = std::make_shared<CycleStudyArguments>();
  CLI::App* repeatability = addCommand(
      app, line, "repeatability-study", "Repeatability of a probing cycle from many cycles after removing slow drift",
      [a](JobContext& job) {
        const Campaign campaign = Campaign::read(a->campaign);
        const RepeatabilityStudy study = studyRepeatability(evaluationOf(campaign, a->artefact, job), a->options);
        CommandResult result;
        result.json["status"] = toString(study.status);
        result.json["message"] = study.message;
        result.json["parameters"] = nlohmann::json::object();
        for (const Repeatability& r : study.parameters) {
          result.json["parameters"][r.name] = {{"repeatability", r.repeatability},
                                               {"standard_uncertainty", r.standard_uncertainty},
                                               {"expected_from_touch_noise", r.expected},
                                               {"cycles", r.cycles}};
          const ErrorParameter parameter = describedParameter(r.name);
          result.summary += fmt::format(
              "{:<10} {:<18} (k = {:g}; touch noise alone: {:.2g} {}) {}\n", parameter.symbolWithIso(),
              withUncertainty(r.repeatability, r.standard_uncertainty, parameter.unit), a->options.coverage_factor,
              printed(r.expected), printedUnit(parameter.unit), parameter.meaning);
        }
        if (study.status != FitStatus::Converged) {
          result.summary = study.message + "\n";
          result.exit_status = NotGoodEnough;
        }
        return result;
      });
  repeatability->add_option("CAMPAIGN", a->campaign, "Folder of the campaign")->required();
  repeatability->add_option("--artefact", a->artefact, "Id of the artefact");
  repeatability
      ->add_option("--high-pass", a->options.high_pass_cycles,
                   "Window of the running mean that is subtracted, in cycles (odd)")
      ->capture_default_str();
  repeatability->add_option("-k,--coverage", a->options.coverage_factor, "Coverage factor")->capture_default_str();

  auto b = std::make_shared<CycleStudyArguments>();
  CLI::App* compare = addCommand(
      app, line, "compare-reference", "Compare a parameter of the cycles with a reference instrument (grid encoder)",
      [b](JobContext& job) {
        const Campaign campaign = Campaign::read(b->campaign);
        const ReferenceComparison c =
            compareWithReference(evaluationOf(campaign, b->artefact, job), b->parameter, b->reference);
        CommandResult result;
        nlohmann::json points = nlohmann::json::array();
        for (const auto& p : c.points) {
          points.push_back({{"time_s", p.time_s},
                            {"probe", p.probe},
                            {"reference", p.reference},
                            {"difference", p.difference},
                            {"standard_uncertainty", p.standard_uncertainty}});
        }
        result.json = {{"parameter", c.name},
                       {"status", toString(c.status)},
                       {"message", c.message},
                       {"offset", c.offset},
                       {"offset_standard_uncertainty", c.offset_sigma},
                       {"slope", jsonNumber(c.slope)},
                       {"slope_standard_uncertainty", jsonNumber(c.slope_sigma)},
                       {"line_rms", c.line_rms},
                       {"agrees", c.agrees},
                       {"verdict", c.verdict},
                       {"rms", c.rms},
                       {"largest", c.largest},
                       {"correlation", c.correlation},
                       {"fit_percent", jsonNumber(c.fit_percent)},
                       {"within_two_sigma", jsonNumber(c.within_two_sigma)},
                       {"points", points}};
        if (c.status != FitStatus::Converged) {
          result.summary = c.message + "\n";
          result.exit_status = NotGoodEnough;
        } else {
          const ErrorParameter parameter = describedParameter(c.name);
          const std::string unit = printedUnit(parameter.unit);
          result.summary = fmt::format(
              "{} ({}): rms difference {:.3g} {}, largest {:.3g} {}, {} within two standard uncertainties, correlation "
              "{:.4f}\n",
              parameter.symbolWithIso(), parameter.meaning, printed(c.rms), unit, printed(c.largest), unit,
              c.judged > 0 ? fmt::format("{:.0f} % of {}", 100.0 * c.within_two_sigma, countOf(c.judged, "cycle"))
                           : std::string("no cycle"),
              printed(c.correlation));
          result.summary +=
              fmt::format("slope {}, mean difference {}: {}\n", withUncertainty(c.slope, c.slope_sigma, ""),
                          withUncertainty(c.offset, c.offset_sigma, parameter.unit), c.verdict);
          if (!c.agrees) result.exit_status = NotGoodEnough;
        }
        return result;
      });
  compare->add_option("CAMPAIGN", b->campaign, "Folder of the campaign")->required();
  compare
      ->add_option("--reference", b->reference,
                   "Record of the reference instrument: time_s,value[,sigma] in the unit of the parameter")
      ->required()
      ->type_name("CSV");
  compare->add_option("--parameter", b->parameter, "Parameter, for example EXX_um_per_m")->required();
  compare->add_option("--artefact", b->artefact, "Id of the artefact");

  auto s = std::make_shared<CycleStudyArguments>();
  CLI::App* second = addCommand(
      app, line, "second-axis", "Hole bar: effect of an expanding second axis, and an evaluation that eliminates it",
      [s](JobContext& job) {
        const Campaign campaign = Campaign::read(s->campaign);
        HoleCycleOptions plain;
        const TouchEvaluation base = evaluateTouchList(campaign, touchesOf(campaign), plain, {}, job);
        CommandResult result;
        if (base.hole_cycles.empty()) throw InputError({campaign.folder, ""}, "holds no touches of a hole bar.");
        const SecondAxisBias bias = secondAxisBias(base.hole_cycles.front(), base.touches);
        nlohmann::json per = nlohmann::json::object();
        result.summary = fmt::format("an unnoticed expansion of {} by 1 µm/m changes\n", bias.second);
        for (std::size_t p = 0; p < bias.names.size(); ++p) {
          const double value = bias.bias_per_um_per_m[p];
          per[bias.names[p]] = jsonNumber(value);
          const ErrorParameter parameter = describedParameter(bias.names[p]);
          result.summary +=
              std::isfinite(value)
                  ? fmt::format("  {:<10} by {:+7.3f} {:<4}  {}\n", parameter.symbolWithIso(), printed(value),
                                printedUnit(parameter.unit), parameter.meaning)
                  : fmt::format("  {:<10} not determined  {}\n", parameter.symbolWithIso(), parameter.meaning);
        }
        if (std::none_of(bias.bias_per_um_per_m.begin(), bias.bias_per_um_per_m.end(),
                         [](double value) { return std::isfinite(value); })) {
          result.warnings.emplace_back(
              "No cycle after the first determines the parameters: measure a second one, the bar at several angles.");
          result.exit_status = NotGoodEnough;
        }
        result.json["bias_per_um_per_m"] = per;
        if (!s->growth.empty()) {
          HoleCycleOptions extended;
          extended.second_axis = true;
          StableLength length;
          length.uncertainty_um_per_m = s->trust_um_per_m;
          if (s->growth.size() == 1) {
            length.growth_um_per_m = s->growth.front();
          } else {
            length.growth_of_cycle_um_per_m = s->growth;
          }
          extended.stable_length = length;
          const TouchEvaluation more = evaluateTouchList(campaign, touchesOf(campaign), extended, {}, job);
          result.json["with_stable_length"] = cyclesJson(more.hole_cycles.front());
          const HoleCycleResult& r = more.hole_cycles.front();
          const CycleParameter& last = r.parameters.back().back();
          result.summary += fmt::format("with the bar as stable length, {} in {}: {}\n",
                                        describedParameter(r.names.back()).symbolWithIso(), r.cycles.back(),
                                        withUncertainty(last.value, last.standard_uncertainty, "um/m"));
        }
        return result;
      });
  second->add_option("CAMPAIGN", s->campaign, "Folder of the campaign")->required();
  second
      ->add_option("--stable-growth", s->growth,
                   "Known growth of the bar since the first cycle, µm/m: one number, or one per cycle")
      ->delimiter(',')
      ->check(CLI::Range(-10000.0, 10000.0));
  second->add_option("--trust", s->trust_um_per_m, "Standard uncertainty of that growth, µm/m")
      ->check(positiveNumber())
      ->capture_default_str();

  auto g = std::make_shared<CycleStudyArguments>();
  auto count = std::make_shared<int>(0);
  CLI::App* groups = addCommand(
      app, line, "sensor-groups", "Group temperature sensors by the size of their change", [g, count](JobContext&) {
        const OperatingLog log = OperatingLog::read(g->campaign);
        CommandResult result;
        result.json["groups"] = nlohmann::json::array();
        for (const SensorGroup& group : groupSensors(log, *count)) {
          result.json["groups"].push_back({{"label", group.label},
                                           {"smallest_change_K", group.smallest_change_K},
                                           {"largest_change_K", group.largest_change_K},
                                           {"sensors", group.sensors}});
          result.summary += fmt::format("{} ({:.2f} to {:.2f} K): {}\n", group.label, group.smallest_change_K,
                                        group.largest_change_K, joinedList(group.sensors));
        }
        return result;
      });
  groups->add_option("LOG", g->campaign, "log.csv")->required();
  groups->add_option("--groups", *count, "Number of groups; 0: chosen by the data")->capture_default_str();
}

}  // namespace

void addProbingCommands(CLI::App& app, CommandLine& line) {
  addCycle(app, line);
  addImport(app, line);
  addHealth(app, line);
  addStudies(app, line);
}

}  // namespace spindrift::cli
