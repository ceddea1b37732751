// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/shell/tour_details.h"

#include <QAction>
#include <QDir>
#include <QElapsedTimer>
#include <QEventLoop>
#include <QImage>
#include <QLineEdit>
#include <QTabWidget>
#include <QTimer>
#include <cmath>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/random.h"
#include "core/base/text.h"
#include "widgets/common/parts.h"
#include "widgets/jobs/activity_dialog.h"
#include "widgets/pages/capture/new_capture_page.h"
#include "widgets/pages/discrepancy/discrepancy_page.h"
#include "widgets/pages/verify/verify_page.h"
#include "widgets/panels/capture/arriving_panel.h"
#include "widgets/panels/capture/plan_panel.h"
#include "widgets/panels/discrepancy/effect_editor.h"
#include "widgets/panels/discrepancy/effects_panel.h"
#include "widgets/panels/discrepancy/gap_panel.h"
#include "widgets/panels/discrepancy/next_panel.h"
#include "widgets/panels/discrepancy/noise_panel.h"
#include "widgets/panels/discrepancy/remainder_panel.h"
#include "widgets/panels/discrepancy/simulation_panel.h"
#include "widgets/panels/discrepancy/what_panel.h"
#include "widgets/panels/probing/reference_panel.h"
#include "widgets/services/incoming_service.h"
#include "widgets/shell/command_palette.h"
#include "widgets/shell/main_window.h"
#include "widgets/shell/new_measurement_dialog.h"
#include "widgets/shell/notes_dialog.h"
#include "widgets/shell/preferences_dialog.h"
#include "widgets/shell/tour.h"
#include "widgets/teaching/exercise_dialog.h"
#include "widgets/teaching/what_if_window.h"

namespace spindrift::gui {
namespace {

constexpr double left_after_compensation = 0.2;
constexpr int search_seconds = 120;

/// The tab of the page that holds `panel` to the front.
void bringToFront(const QWidget* panel) {
  for (QWidget* w = panel->parentWidget(); w != nullptr; w = w->parentWidget()) {
    auto* tabs = qobject_cast<QTabWidget*>(w);
    if (tabs == nullptr) continue;
    for (int i = 0; i < tabs->count(); ++i) {
      if (tabs->widget(i) == panel || tabs->widget(i)->isAncestorOf(panel)) tabs->setCurrentIndex(i);
    }
  }
}

template <class Panel>
Panel* panelOf(MainWindow& window) {
  return window.currentPage()->findChild<Panel*>();
}

void firstTab(MainWindow& window) {
  if (auto* tabs = window.currentPage()->findChild<QTabWidget*>()) tabs->setCurrentIndex(0);
}

QWidget* showTab(MainWindow& window, int index) {
  if (auto* tabs = window.currentPage()->findChild<QTabWidget*>()) tabs->setCurrentIndex(index);
  return nullptr;
}

/// A record of an instrument beside the probe: the probe's own values, read at the cycles.
QWidget* showReference(MainWindow& window, const QString& scratch) {
  auto* panel = panelOf<ReferencePanel>(window);
  if (panel == nullptr) return nullptr;
  bringToFront(panel);
  if (!panel->comparison().points.empty()) return nullptr;
  const std::string file = QDir(scratch).filePath(QStringLiteral("grid encoder.csv")).toStdString();
  writeFileAtomically(file, "time_s,value\n0,0\n1000000,0\n");
  panel->load(QString::fromStdString(file));
  std::string record = "time_s,value\n";
  Random random(1);
  for (const ReferenceComparison::Point& p : panel->comparison().points) {
    record +=
        exactNumber(p.time_s) + "," + exactNumber(p.probe + random.normal(0.0, 0.3 * p.standard_uncertainty)) + "\n";
  }
  writeFileAtomically(file, record);
  panel->load(QString::fromStdString(file));
  return nullptr;
}

/// The campaign at hand as it could be after compensation: a fifth of every deviation is left, and the log says that
/// the control was compensating.
std::filesystem::path writeCompensated(MainWindow& window, const QString& scratch) {
  const std::filesystem::path folder = std::filesystem::path(scratch.toStdString()) / "compensated";
  std::filesystem::create_directories(folder);
  const auto campaign = window.session().campaign();
  const auto measured = window.session().observations();
  if (!measured || !campaign->log) throw InputError("the demo has no observations to verify.");
  ObservationSet observations = *measured;
  for (Observation& o : observations.rows) o.value *= left_after_compensation;
  observations.write(folder / "observations.csv");
  writeFileAtomically(folder / "machine.json", campaign->machine.source.dump(1));
  const nlohmann::json head{{"format", "spindrift-campaign"},
                            {"version", 1},
                            {"name", "compensation on"},
                            {"start_utc", campaign->start_utc}};
  writeFileAtomically(folder / "campaign.json", head.dump(1));
  std::string log;
  for (const QString& line :
       QString::fromStdString(readFile(campaign->path("log.csv"))).split(QLatin1Char('\n'), Qt::SkipEmptyParts)) {
    log += line.trimmed().toStdString() + (log.empty() ? ",compensation_on\n" : ",1\n");
  }
  writeFileAtomically(folder / "log.csv", log);
  return folder;
}

QWidget* showVerify(MainWindow& window, const QString& scratch) {
  auto* page = qobject_cast<VerifyPage*>(window.currentPage());
  if (page == nullptr || page->result() != nullptr) return nullptr;
  page->setAfter(QString::fromStdString(writeCompensated(window, scratch).string()));
  page->runAll();
  return nullptr;
}

/// Puts all effects that the search proposes into the model, one after the other, or takes them out again.
void setEffectsAdded(MainWindow& window, const DiscrepancyPage& page, bool added) {
  constexpr int most_presses = 6;
  for (int press = 0; press < most_presses && page.story() != nullptr; ++press) {
    const bool done = added ? page.story()->nextProposal() == nullptr : page.story()->added.empty();
    if (done) return;
    (added ? page.addButton() : page.removeButton())->click();
    (void)waitForJobs(window, search_seconds);
  }
}

/// A tab of the page Discrepancy, with the effects found added to the model or not.
TourDetail discrepancyTab(const char* name, QWidget* (*tab)(const DiscrepancyPage&), bool added) {
  const auto show = [tab, added](MainWindow& window) -> QWidget* {
    auto* page = qobject_cast<DiscrepancyPage*>(window.currentPage());
    if (page == nullptr) return nullptr;
    setEffectsAdded(window, *page, added);
    page->tabs()->setCurrentWidget(tab(*page));
    if (page->story() != nullptr && !page->story()->outliers.empty()) page->noise()->showReadings(true);
    return nullptr;
  };
  return {StepId::Discrepancy, name, show, {}};
}

void waitForEffects(const EffectsPanel& panel) {
  QElapsedTimer timer;
  timer.start();
  while (panel.busy() && timer.elapsed() < 1000LL * search_seconds) {
    QEventLoop loop;
    QTimer::singleShot(20, &loop, &QEventLoop::quit);
    loop.exec();
  }
}

QWidget* showEffects(MainWindow& window) {
  auto* page = qobject_cast<DiscrepancyPage*>(window.currentPage());
  if (page == nullptr) return nullptr;
  page->showEffects(true);
  waitForEffects(*page->effects());
  page->effects()->choose("column.bending.a");
  return nullptr;
}

/// An effect of the user's while it is written, with a function that does not exist.
QWidget* showEffectEditor(MainWindow& window) {
  showEffects(window);
  auto* page = qobject_cast<DiscrepancyPage*>(window.currentPage());
  if (page == nullptr) return nullptr;
  EffectsPanel& panel = *page->effects();
  panel.newEffect();
  EffectEditor& editor = *panel.editor();
  editor.id()->setText(QStringLiteral("bed.twist.x"));
  editor.title()->setText(QStringLiteral("twist of the bed about X"));
  editor.expression(0, Component::EY)->setText(QStringLiteral("-0.001 * x * z"));
  editor.expression(0, Component::EZ)->setText(QStringLiteral("0.001 * x * y"));
  Q_EMIT editor.edited();
  waitForEffects(panel);
  editor.expression(0, Component::EA)->setFocus();
  editor.expression(0, Component::EA)->setText(QStringLiteral("x * cosine(c)"));
  Q_EMIT editor.edited();
  waitForEffects(panel);
  return nullptr;
}

/// The tab in which the simulation itself is changed, after its search; `closed`: after what was found has been put in.
SimulationPanel* showSimulation(MainWindow& window, bool closed, int view) {
  auto* page = qobject_cast<DiscrepancyPage*>(window.currentPage());
  if (page == nullptr || page->simulation() == nullptr) return nullptr;
  SimulationPanel& panel = *page->simulation();
  page->tabs()->setCurrentWidget(&panel);
  const auto settle = [&] {
    QElapsedTimer timer;
    timer.start();
    (void)waitForJobs(window, search_seconds);
    while (panel.busy() && timer.elapsed() < 1000LL * search_seconds) {
      QEventLoop loop;
      QTimer::singleShot(20, &loop, &QEventLoop::quit);
      loop.exec();
    }
  };
  settle();
  if (!closed && panel.update() != nullptr) {
    const auto campaign = window.session().campaign();
    panel.chooseSimulator(QString::fromStdString(campaign->path(campaign->simulator.string()).string()));
  }
  if (panel.story() == nullptr) {
    panel.search();
    settle();
  }
  if (closed && panel.update() == nullptr) {
    const QString version = panel.versionMade();
    if (version.isEmpty()) {
      panel.putInto(panel.proposedFolder());
    } else {
      panel.chooseSimulator(version);
    }
    settle();
  }
  if (closed && panel.update() != nullptr) panel.views()->button(view)->click();
  settle();
  return &panel;
}

TourDetail simulationTab(const char* name, bool closed, int view) {
  return {StepId::Discrepancy,
          name,
          [closed, view](MainWindow& window) -> QWidget* {
            (void)showSimulation(window, closed, view);
            return nullptr;
          },
          {}};
}

/// Every tab behind the first; the gap before and after the effects found are added. The page is left as it was.
std::vector<TourDetail> discrepancyTabs() {
  std::vector<TourDetail> tabs{
      discrepancyTab(
          "what", [](const DiscrepancyPage& page) -> QWidget* { return page.what(); }, false),
      discrepancyTab(
          "noise", [](const DiscrepancyPage& page) -> QWidget* { return page.noise(); }, false),
      discrepancyTab(
          "remains", [](const DiscrepancyPage& page) -> QWidget* { return page.remainder(); }, false),
      discrepancyTab(
          "gap-before", [](const DiscrepancyPage& page) -> QWidget* { return page.gap(); }, false),
      discrepancyTab(
          "gap-after", [](const DiscrepancyPage& page) -> QWidget* { return page.gap(); }, true),
      discrepancyTab(
          "next", [](const DiscrepancyPage& page) -> QWidget* { return page.next(); }, true)};
  tabs.back().leave = [](MainWindow& window) {
    if (auto* page = qobject_cast<DiscrepancyPage*>(window.currentPage())) {
      setEffectsAdded(window, *page, false);
      page->tabs()->setCurrentIndex(0);
    }
  };
  tabs.push_back(simulationTab("simulation-found", false, 0));
  tabs.push_back(simulationTab("simulation-closed", true, 0));
  tabs.push_back(simulationTab("simulation-over-time", true, 1));
  tabs.push_back(simulationTab("simulation-over-table", true, 2));
  tabs.back().leave = [](MainWindow& window) {
    if (auto* page = qobject_cast<DiscrepancyPage*>(window.currentPage())) page->tabs()->setCurrentIndex(0);
  };
  tabs.push_back({StepId::Discrepancy, "effects", showEffects, {}});
  tabs.push_back({StepId::Discrepancy, "effect-editor", showEffectEditor, [](MainWindow& window) {
                    if (auto* page = qobject_cast<DiscrepancyPage*>(window.currentPage())) {
                      page->effects()->leaveEditor();
                      page->showEffects(false);
                    }
                  }});
  return tabs;
}

QWidget* showNotes(MainWindow& window) {
  if (window.session().notes().empty()) {
    window.session().addNote({0, "Model", "Coolant was off while M1 was measured.", utcNow(), {}});
    window.session().addNote(
        {0, "Capture", "Table washed before the first state; the probe was calibrated after it.", utcNow(), {}});
  }
  return window.openNotes();
}

void blur(const QString& from, const QString& to) {
  const QImage sharp(from);
  sharp.scaledToWidth(sharp.width() / 12, Qt::SmoothTransformation)
      .scaled(sharp.size(), Qt::IgnoreAspectRatio, Qt::SmoothTransformation)
      .save(to);
}

}  // namespace

std::vector<std::pair<const char*, std::function<QWidget*(MainWindow&)>>> tourWindows() {
  return {{"what-if",
           [](MainWindow& window) -> QWidget* {
             WhatIfWindow* shown = window.openWhatIf();
             shown->set("EC0Y_urad", 20.0);
             return shown;
           }},
          {"exercise", [](MainWindow& window) -> QWidget* { return window.openExercise(); }},
          {"jobs", [](MainWindow& window) -> QWidget* { return window.openActivity(); }},
          {"preferences",
           [](MainWindow& window) -> QWidget* {
             window.openPreferences();
             return window.findChild<PreferencesDialog*>();
           }},
          {"find-a-command",
           [](MainWindow& window) -> QWidget* {
             window.findCommand();
             return window.findChild<CommandPalette*>();
           }},
          {"new-measurement",
           [](MainWindow& window) -> QWidget* {
             auto* dialog = new NewMeasurementDialog(std::nullopt, &window);
             dialog->setAttribute(Qt::WA_DeleteOnClose);
             dialog->show();
             return dialog;
           }},
          {"plant",
           [](MainWindow& window) -> QWidget* {
             window.openPlant();
             return nullptr;
           }},
          {"compensate-live", [](MainWindow& window) -> QWidget* {
             window.openLiveCompensation();
             return nullptr;
           }}};
}

std::vector<TourDetail> tourDetails(const QString& demo, const QString& scratch) {
  const auto close_help = [](MainWindow& window) { window.helpAction()->trigger(); };
  if (demo == QLatin1String("balls"))
    return {{StepId::Calibrate, "closed-forms", [](MainWindow& window) { return showTab(window, 3); }, firstTab}};
  if (demo == QLatin1String("fiducials")) {
    return {{StepId::Model, "help",
             [](MainWindow& window) -> QWidget* {
               if (!window.helpAction()->isChecked()) window.helpAction()->trigger();
               return nullptr;
             },
             close_help}};
  }
  if (demo == QLatin1String("holes")) {
    return {{StepId::Machine, "artefacts",
             [](MainWindow& window) -> QWidget* {
               auto* tabs = window.currentPage()->findChild<QTabWidget*>();
               if (tabs != nullptr) tabs->setCurrentIndex(1);
               return nullptr;
             },
             firstTab},
            {StepId::Calibrate, "certificate", [](MainWindow& window) { return showTab(window, 3); }, firstTab},
            {StepId::Calibrate, "reference", [scratch](MainWindow& window) { return showReference(window, scratch); },
             firstTab},
            {StepId::Model, "notes", showNotes, [](MainWindow& window) {
               for (NotesDialog* dialog : window.findChildren<NotesDialog*>()) dialog->close();
             }}};
  }
  if (demo == QLatin1String("discrepancy")) {
    std::vector<TourDetail> details = discrepancyTabs();
    details.push_back({StepId::Machine, "sensors",
                       [](MainWindow& window) -> QWidget* {
                         auto* tabs = window.currentPage()->findChild<QTabWidget*>();
                         if (tabs != nullptr) tabs->setCurrentIndex(2);
                         return nullptr;
                       },
                       firstTab});
    details.push_back(
        {StepId::Verify, "compared", [scratch](MainWindow& window) { return showVerify(window, scratch); }, {}});
    return details;
  }
  return {};
}

QString startArriving(MainWindow& window, const QString& scratch) {
  const auto campaign = window.session().campaign();
  const QDir images(QString::fromStdString(campaign->path("captures/images").string()));
  const QStringList names = images.entryList(QDir::Files, QDir::Name).mid(0, 3);
  if (names.size() < 3) return QStringLiteral("the demo has no images that could arrive.");
  QDir(scratch).mkpath(QStringLiteral("watched"));
  const QDir watched(QDir(scratch).filePath(QStringLiteral("watched")));
  for (const QString& name : names) QFile::copy(images.filePath(name), watched.filePath(name));
  blur(images.filePath(names.back()), watched.filePath(QStringLiteral("z blurred.png")));

  auto session =
      std::make_unique<Session>(Session::create(std::filesystem::path(scratch.toStdString()) / "new measurement"));
  const std::int64_t id =
      session->newCampaign("a new measurement", "2026-01-31T08:00:00Z", campaign->machine.source.dump(1));
  window.session().adopt(std::move(session), id);
  window.workflow().goTo(StepId::Capture);
  auto* page = qobject_cast<NewCapturePage*>(window.currentPage());
  if (page == nullptr) return QStringLiteral("a new measurement has no page for captures.");
  page->setInstrument(Instrument::Microscope);
  page->arriving()->plan()->makePlan();
  IncomingService& service = IncomingService::of(window.session());
  service.setPace(20, 0.1, 0.5);
  page->arriving()->watch(watched.path());
  QElapsedTimer timer;
  timer.start();
  while (service.items().size() < 4 || !service.idle()) {
    if (timer.elapsed() > 20'000) return QStringLiteral("the images did not arrive.");
    QEventLoop loop;
    QTimer::singleShot(20, &loop, &QEventLoop::quit);
    loop.exec();
  }
  window.workflow().goTo(StepId::Machine);
  window.workflow().goTo(StepId::Capture);
  if (auto* panel = panelOf<ArrivingPanel>(window)) bringToFront(panel);
  return {};
}

}  // namespace spindrift::gui
