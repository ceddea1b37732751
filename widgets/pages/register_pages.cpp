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
      [](PageContext c, QWidget* place) { return new ThermalModelPage(std::move(c), place); }, "model-over-time");
  registry.add(
      StepId::Machine, always, [](PageContext c, QWidget* place) { return new MachinePage(std::move(c), place); },
      "machine");
  registry.add(
      StepId::WarmUp, always, [](PageContext c, QWidget* place) { return new WarmUpPage(std::move(c), place); },
      "warm-up");
  registry.add(
      StepId::Capture, microscope,
      [](PageContext c, QWidget* place) { return new FiducialCapturePage(std::move(c), place); }, "capture-fiducials");
  registry.add(
      StepId::Calibrate, microscope,
      [](PageContext c, QWidget* place) { return new FiducialCalibratePage(std::move(c), place); },
      "calibrate-fiducials");
  const auto touches = [](const SessionModel& s) { return s.has(Instrument::TouchProbe); };
  registry.add(
      StepId::Capture, touches, [](PageContext c, QWidget* place) { return new TouchCapturePage(std::move(c), place); },
      "capture-touches");
  registry.add(
      StepId::Calibrate, touches,
      [](PageContext c, QWidget* place) { return new TouchEvaluationPage(std::move(c), place); }, "evaluate-touches");
  registry.add(
      StepId::Model, touches, [](PageContext c, QWidget* place) { return new CycleModelPage(std::move(c), place); },
      "model-cycles");
  const auto scans = [](const SessionModel& s) { return s.has(Instrument::Profiler); };
  registry.add(
      StepId::Capture, scans, [](PageContext c, QWidget* place) { return new ScanCapturePage(std::move(c), place); },
      "capture-scans");
  registry.add(
      StepId::Calibrate, scans,
      [](PageContext c, QWidget* place) { return new ProfilerCalibrationPage(std::move(c), place); },
      "calibrate-profiler");
  registry.add(
      StepId::Model, scans, [](PageContext c, QWidget* place) { return new AxisErrorsPage(std::move(c), place); },
      "model-axis-errors");
  // A new measurement: nothing is there yet, and it is about to arrive.
  const auto nothing = [](const SessionModel& s) {
    return s.campaign() != nullptr && !s.campaign()->observations && !s.campaign()->log;
  };
  registry.add(
      StepId::Capture, nothing, [](PageContext c, QWidget* place) { return new NewCapturePage(std::move(c), place); },
      "capture-new");
  registry.add(
      StepId::Model, points, [](PageContext c, QWidget* place) { return new NineParameterPage(std::move(c), place); },
      "model-nine-parameter");
  registry.add(
      StepId::Discrepancy, always,
      [](PageContext c, QWidget* place) { return new DiscrepancyPage(std::move(c), place); }, "discrepancy");
  registry.add(
      StepId::Compensate, [](const SessionModel& s) { return s.isLogOnly(); },
      [](PageContext c, QWidget* place) { return new LogCompensatePage(std::move(c), place); }, "compensate-log");
  registry.add(
      StepId::Compensate, always, [](PageContext c, QWidget* place) { return new CompensatePage(std::move(c), place); },
      "compensate");
  const auto more_than_a_log = [](const SessionModel& s) { return !s.isLogOnly(); };
  registry.add(
      StepId::Verify, more_than_a_log,
      [](PageContext c, QWidget* place) { return new VerifyPage(std::move(c), place); }, "verify");
  registry.add(
      StepId::Review, more_than_a_log,
      [](PageContext c, QWidget* place) { return new ReviewPage(std::move(c), place); }, "review");
  registry.add(
      StepId::Report, always, [](PageContext c, QWidget* place) { return new ReportPage(std::move(c), place); },
      "report");
  for (const StepId step : all_steps) {
    registry.add(
        step, always, [step](PageContext c, QWidget* place) { return new MessagePage(std::move(c), step, place); },
        "message");
  }
}

}  // namespace spindrift::gui
