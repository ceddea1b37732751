// SPDX-License-Identifier: GPL-3.0-or-later
// The measuring cycle of the page: artefact, touches and path in 3D, and the programme for the control.
#include <QCheckBox>
#include <QComboBox>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/probing/printed_text.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/pages/probing/touch_capture_page.h"
#include "widgets/panels/common/probing_scene.h"
#include "widgets/services/touch_results.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {

void TouchCapturePage::showScene() {
  const auto campaign = session().campaign();
  const Artefact* a = artefact();
  if (campaign == nullptr || a == nullptr) return;
  const auto list = results_.touches();
  const std::vector<TouchVerdict> verdicts = verdictsOf(cycle_);
  const QStringList chosen = selectedTouches();
  const TouchVerdict* selected = nullptr;
  for (const TouchVerdict& v : verdicts) {
    if (!chosen.isEmpty() && fromCore(v.touch.id()) == chosen.front()) selected = &v;
  }
  const double c_deg = selected != nullptr ? selected->touch.c_deg : 0.0;
  const Eigen::Vector3d first_ball =
      firstBallPosition(*a, list.get(), evaluation_.get()).value_or(Eigen::Vector3d::Zero());
  std::vector<ViewShape> shapes;
  try {
    addArtefact(shapes, campaign->machine, *a, first_ball, c_deg);
    addTouches(shapes, verdicts, c_deg);
    if (machine_->isChecked()) addTravel(shapes, campaign->machine);
    if (path_->isChecked() && program_) addPath(shapes, program_->plan, c_deg);
    if (selected != nullptr) {
      addStyli(shapes, campaign->machine, selected->touch.stylus, selected->touch.position_mm);
    } else if (!verdicts.empty()) {
      addStyli(shapes, campaign->machine, verdicts.front().touch.stylus, verdicts.front().touch.position_mm);
    }
    view_->setPoints(featureLabels(campaign->machine, *a, first_ball, c_deg));
  } catch (const InputError& e) {
    program_verdict_->show(Tone::Bad, coreSentence(e.what()));
  }
  view_->setShapes(std::move(shapes));
  QString caption = tr("Cycle %1").arg(cycle_);
  if (a->kind == "hole_bar") caption += tr(", table at %1°").arg(decimalText(c_deg, 'g', 4));
  view_->setCaption(caption);
}

void TouchCapturePage::makeProgram() {
  const auto campaign = session().campaign();
  const Artefact* a = artefact();
  if (campaign == nullptr || a == nullptr) return;
  CyclePlanOptions plan;
  const auto ball = firstBallPosition(*a, results_.touches().get(), evaluation_.get());
  if (a->kind == "balls") {
    if (!ball) {
      program_verdict_->show(
          Tone::Attention,
          tr("The position of the first ball is not known. Probe it once by hand; then the program can be planned."));
      return;
    }
    plan.first_ball_mm = *ball;
  }
  ProgramOptions options;
  options.dialect = programDialect(control_->currentData().toString().toStdString());
  run(tr("Planning the measuring cycle"),
      [this, campaign, artefact = *a, plan, options](JobContext&) -> std::function<void()> {
        auto made = std::make_shared<std::optional<CheckedProgram>>();
        std::string failure;
        try {
          *made = makeCheckedProgram(campaign->machine, artefact, plan, options);
        } catch (const InputError& e) {
          failure = e.what();
        }
        return [this, made, failure, machine = campaign->machine.source] {
          program_ = std::move(*made);
          program_machine_ = machine;
          if (forgetOldProgram()) return;
          if (!program_) {
            program_verdict_->show(Tone::Bad, tr("No program: %1").arg(coreSentence(failure.c_str())));
          } else if (!program_->check.good()) {
            const ProgramIssue& first = program_->check.issues.front();
            program_verdict_->show(Tone::Bad, tr("Program not exported, issues found by the check: %1. Line %2: %3")
                                                  .arg(program_->check.issues.size())
                                                  .arg(first.line)
                                                  .arg(fromCore(first.what)));
          } else {
            QString verdict =
                tr("Program checked: %n touches in %1 moves inside the travel, none through the artefact, a "
                   "retract after each, safe height %2 mm. Export (Ctrl+E) writes it.",
                   nullptr, static_cast<int>(program_->check.touches))
                    .arg(program_->check.moves.size())
                    .arg(decimalText(program_->plan.safe_height_mm, 'f', 1));
            if (program_->plan.left_out_below > 0)
              verdict += QLatin1Char(' ') + tr("%n touches from below are left out, where the stem of a ball may be.",
                                               nullptr, program_->plan.left_out_below);
            program_verdict_->show(Tone::Good, verdict);
          }
          showScene();
        };
      });
}

bool TouchCapturePage::forgetOldProgram() {
  if (!program_ || program_machine_ == session().campaign()->machine.source) return false;
  program_.reset();
  program_verdict_->show(Tone::Outdated, tr("The machine has changed since the program was planned. Plan it again."));
  return true;
}

std::vector<Exportable> TouchCapturePage::exportables() {
  std::vector<Exportable> items{exportableOf(tr("Cycles"), cycles_), exportableOf(tr("Touches"), touches_),
                                exportableOf(tr("Measuring cycle"), view_)};
  const Artefact* a = session().campaign() == nullptr ? nullptr : artefact();
  if (program_ && program_->check.good() && a != nullptr) {
    items.push_back({tr("Measuring program"), {QStringLiteral("nc")}, [text = program_->text](const QString& file) {
                       writeFileAtomically(file.toStdString(), text);
                     }});
    ProgramOptions options;
    options.dialect = programDialect(control_->currentData().toString().toStdString());
    const std::string pattern = printedTextTemplate(session().campaign()->machine, *a, options).dump(1) + "\n";
    items.push_back({tr("Template of what it prints"), {QStringLiteral("json")}, [pattern](const QString& file) {
                       writeFileAtomically(file.toStdString(), pattern);
                     }});
  }
  return items;
}

}  // namespace spindrift::gui
