// SPDX-License-Identifier: GPL-3.0-or-later
// Which page a step shows for which campaign. The first line of a step that applies is taken.
#include "widgets/pages/capture/new_capture_page.h"
#include "widgets/pages/common/message_page.h"
#include "widgets/pages/compensate/compensate_page.h"
#include "widgets/pages/compensate/log_compensate_page.h"
#include "widgets/pages/discrepancy/discrepancy_page.h"
#include "widgets/pages/imaging/fiducial_calibrate_page.h"
#include "widgets/pages/imaging/fiducial_capture_page.h"
#include "widgets/pages/kinematics/nine_parameter_page.h"
#include "widgets/pages/machine/machine_page.h"
#include "widgets/pages/page.h"
#include "widgets/pages/probing/cycle_model_page.h"
#include "widgets/pages/probing/touch_capture_page.h"
#include "widgets/pages/probing/touch_evaluation_page.h"
#include "widgets/pages/report/report_page.h"
#include "widgets/pages/review/review_page.h"
#include "widgets/pages/scanning/axis_errors_page.h"
#include "widgets/pages/scanning/profiler_calibration_page.h"
#include "widgets/pages/scanning/scan_capture_page.h"
#include "widgets/pages/thermal/thermal_model_page.h"
#include "widgets/pages/thermal/warm_up_page.h"
#include "widgets/pages/verify/verify_page.h"

namespace spindrift::gui {

void registerPages(PageRegistry& registry) {
  const auto always = [](const SessionModel&) { return true; };
  const auto microscope = [](const SessionModel& s) { return s.has(Instrument::Microscope); };
  // Nine parameters: for deviations of points in one or a few thermal states.
  const auto points = [](const SessionModel& s) {
    return s.has(Instrument::Microscope) || (s.campaign() != nullptr && s.campaign()->observations.has_value());
  };
  registry.add(
      StepId::Model, [](const SessionModel& s) { return s.modelOverTime(); },
      [](PageContext c) { return new ThermalModelPage(std::move(c)); }, "model-over-time");
  registry.add(
      StepId::Machine, always, [](PageContext c) { return new MachinePage(std::move(c)); }, "machine");
  registry.add(
      StepId::WarmUp, always, [](PageContext c) { return new WarmUpPage(std::move(c)); }, "warm-up");
  registry.add(
      StepId::Capture, microscope, [](PageContext c) { return new FiducialCapturePage(std::move(c)); },
      "capture-fiducials");
  registry.add(
      StepId::Calibrate, microscope, [](PageContext c) { return new FiducialCalibratePage(std::move(c)); },
      "calibrate-fiducials");
  const auto touches = [](const SessionModel& s) { return s.has(Instrument::TouchProbe); };
  registry.add(
      StepId::Capture, touches, [](PageContext c) { return new TouchCapturePage(std::move(c)); }, "capture-touches");
  registry.add(
      StepId::Calibrate, touches, [](PageContext c) { return new TouchEvaluationPage(std::move(c)); },
      "evaluate-touches");
  registry.add(
      StepId::Model, touches, [](PageContext c) { return new CycleModelPage(std::move(c)); }, "model-cycles");
  const auto scans = [](const SessionModel& s) { return s.has(Instrument::Profiler); };
  registry.add(
      StepId::Capture, scans, [](PageContext c) { return new ScanCapturePage(std::move(c)); }, "capture-scans");
  registry.add(
      StepId::Calibrate, scans, [](PageContext c) { return new ProfilerCalibrationPage(std::move(c)); },
      "calibrate-profiler");
  registry.add(
      StepId::Model, scans, [](PageContext c) { return new AxisErrorsPage(std::move(c)); }, "model-axis-errors");
  // A new measurement: nothing is there yet, and it is about to arrive.
  const auto nothing = [](const SessionModel& s) {
    return s.campaign() != nullptr && !s.campaign()->observations && !s.campaign()->log;
  };
  registry.add(
      StepId::Capture, nothing, [](PageContext c) { return new NewCapturePage(std::move(c)); }, "capture-new");
  registry.add(
      StepId::Model, points, [](PageContext c) { return new NineParameterPage(std::move(c)); }, "model-nine-parameter");
  registry.add(
      StepId::Discrepancy, always, [](PageContext c) { return new DiscrepancyPage(std::move(c)); }, "discrepancy");
  registry.add(
      StepId::Compensate, [](const SessionModel& s) { return s.isLogOnly(); },
      [](PageContext c) { return new LogCompensatePage(std::move(c)); }, "compensate-log");
  registry.add(
      StepId::Compensate, always, [](PageContext c) { return new CompensatePage(std::move(c)); }, "compensate");
  const auto more_than_a_log = [](const SessionModel& s) { return !s.isLogOnly(); };
  registry.add(
      StepId::Verify, more_than_a_log, [](PageContext c) { return new VerifyPage(std::move(c)); }, "verify");
  registry.add(
      StepId::Review, more_than_a_log, [](PageContext c) { return new ReviewPage(std::move(c)); }, "review");
  registry.add(
      StepId::Report, always, [](PageContext c) { return new ReportPage(std::move(c)); }, "report");
  for (const StepId step : all_steps) {
    registry.add(
        step, always, [step](PageContext c) { return new MessagePage(std::move(c), step); }, "message");
  }
}

}  // namespace spindrift::gui
