// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/thermal/warm_up_page.h"

#include <QCoreApplication>
#include <QInputDialog>
#include <QSplitter>
#include <QTabWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <limits>
#include <optional>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/workflows/instrument_checks.h"
#include "widgets/commands/commands.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/folded_callout.h"
#include "widgets/common/parts.h"
#include "widgets/models/rows_model.h"
#include "widgets/panels/capture/machine_state_line.h"
#include "widgets/panels/thermal/clock_panel.h"
#include "widgets/panels/thermal/resolution_check_panel.h"
#include "widgets/plots/plot.h"
#include "widgets/services/connections_service.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {
namespace {

constexpr std::size_t most_plotted_rows = 1500;
constexpr auto warm_up_task = "check-warm-up";

QString minutes(double seconds) {
  return QCoreApplication::translate("spindrift::gui::WarmUpPage", "%1 min").arg(decimalText(seconds / 60, 'f', 0));
}

QString longerThanRecord(const WarmUpAxis& axis) {
  return QStringLiteral("> ") + minutes(axis.time_s.back() - axis.time_s.front());
}

Cell timeConstantCell(const WarmUpAxis& axis) {
  Cell cell{QStringLiteral("–")};
  if (axis.tau_s) cell.text = minutes(*axis.tau_s);
  if (axis.time_s.empty()) return cell;
  if (axis.time_constant == TimeConstant::BeyondRecord) {
    cell.text = longerThanRecord(axis);
    cell.tip = WarmUpPage::tr("Longer than the record: its end was not seen, so it cannot be determined.");
  }
  if (axis.time_constant == TimeConstant::TooShort)
    cell.tip = WarmUpPage::tr("Too short to be determined from readings this far apart.");
  return cell;
}

Cell settledAfterCell(const WarmUpAxis& axis) {
  if (axis.settled_after_s) return {minutes(*axis.settled_after_s)};
  if (axis.verdict == WarmUpVerdict::Drifts && !axis.time_s.empty()) return {longerThanRecord(axis)};
  return {QStringLiteral("–")};
}

Cell verdictCell(WarmUpVerdict verdict) {
  switch (verdict) {
    case WarmUpVerdict::Settled:
      return {WarmUpPage::tr("settled"), Tone::Good, "check-circle"};
    case WarmUpVerdict::Drifts:
      return {WarmUpPage::tr("drifts"), Tone::Attention, "alert"};
    case WarmUpVerdict::NotDecidable:
      return {WarmUpPage::tr("not decidable"), Tone::Attention, "help"};
  }
  return {};
}

}  // namespace

WarmUpPage::WarmUpPage(PageContext page_context, QWidget* parent)
    : Page(std::move(page_context), StepId::WarmUp, parent) {
  confirm_ = makeButton(tr("The instrument was warm"), "check");
  confirm_->setToolTip(tr("Records your statement, so that the report can say on what it rests"));
  addAction(confirm_);
  check_ = makeButton(tr("Check the drift"), nullptr, "primary");
  addAction(check_);
  auto* instrument = new Card;
  tabs_ = makeTabs(instrument);
  instrument->body()->addWidget(tabs_, 1);
  auto* drift_tab = new QWidget;
  auto* drift = new QVBoxLayout(drift_tab);
  drift->setContentsMargins(0, 8, 0, 0);
  drift_ = new Plot;
  drift_->setEmptyText(
      tr("Drift curves will appear here"),
      tr("Measure one point every 5 minutes while the instrument warms up: its drift shows when it has settled."));
  verdicts_ = new RowsModel(
      {tr("Axis"), tr("Drift now / (µm/h)"), tr("Time constant"), tr("Settles after"), tr("Verdict")}, this);
  auto* table = makeTable(verdicts_, tr("Drift of each axis"), tr("Drift and time constant of each axis appear here."));
  drift->addWidget(makeSplitter(drift_tab, drift_, table, 11, 10), 1);
  tabs_->addTab(drift_tab, tr("Drift"));
  jogs_ = new ResolutionCheckPanel(
      session(),
      tr("Jog the table by known steps, five or more, and capture the same fiducial after each: what the microscope "
         "reads beside the commanded step must stay within one resolution of the axis."),
      tr("Check the jogs"), "check-jogs", [this] { check("check-jogs"); });
  tabs_->addTab(jogs_, tr("Jogs"));
  repeatability_ = new ResolutionCheckPanel(
      session(),
      tr("Measure the same fiducials again and again on the cold machine, one state each time: the readings must come "
         "back within half a resolution of the axis."),
      tr("Check the repeatability"), "check-repeatability", [this] { check("check-repeatability"); });
  tabs_->addTab(repeatability_, tr("Cold repeatability"));
  clocks_ = new ClockPanel(session(), context().undo,
                           [this](const QString& title, ClockPanel::Work work) { run(title, std::move(work)); });
  tabs_->addTab(clocks_, tr("Clocks"));
  auto* temperature = new Card(tr("Temperatures"));
  temperature_ = new Plot;
  temperature_->setEmptyText(tr("Temperatures will appear here"),
                             tr("They come from log.csv of the campaign; this one has none."));
  temperature->body()->addWidget(temperature_, 1);
  content()->addWidget(new MachineStateLine(session()));
  content()->addWidget(makeSplitter(this, instrument, temperature, 3, 2, Qt::Vertical), 1);
  ConnectionsService& live = ConnectionsService::of(session());
  connect(&live, &ConnectionsService::changed, this, [this, &live] {
    if (!isVisible() || !live.running()) return;
    if (live.recording() && (!since_read_.isValid() || since_read_.elapsed() > 60'000)) readRecorded();
    if (!since_shown_.isValid() || since_shown_.elapsed() >= 1000) showTemperatures();
  });
  showHints(drift_);
  showHints(temperature_);
  connect(confirm_, &QPushButton::clicked, this, &WarmUpPage::confirm);
  connect(check_, &QPushButton::clicked, this, &WarmUpPage::runAll);
}

void WarmUpPage::runAll() {
  check(warm_up_task);
}

void WarmUpPage::check(const std::string& task) {
  runTask(task, {.failed = [this](const QString&) { refresh(); }});  // its panel says why
}

void WarmUpPage::confirm() {
  const bool given = session().warmStatement().has_value();
  context().undo.push(new OptionsCommand(
      session(), given ? tr("take back that the instrument was warm") : tr("state that the instrument was warm"),
      session().warmStatementKey(),
      given ? nlohmann::json::object() : nlohmann::json{{"settled", true}, {"by", "operator"}}, [this] { refresh(); }));
}

void WarmUpPage::readRecorded() {
  const auto campaign = session().campaign();
  if (campaign == nullptr) return;
  since_read_.start();
  // Every minute: nothing to be told about.
  Job job;
  job.title = tr("Reading the log that is being recorded");
  job.quiet = true;
  job.queue = JobQueue::Display;
  job.key = "recorded-log";
  job.work = [this, file = campaign->path("log.csv")](JobContext&) -> std::function<void()> {
    std::shared_ptr<const OperatingLog> log;
    try {
      log = std::make_shared<const OperatingLog>(OperatingLog::read(file));
    } catch (const InputError&) {
      return [] {};  // no row yet
    }
    return [this, log] {
      recorded_ = log;
      recorded_visit_ = session().visit();
      showTemperatures();
    };
  };
  context().jobs.run(visitJob(session(), std::move(job)));
}

void WarmUpPage::showTemperatures() {
  const auto campaign = session().campaign();
  if (campaign == nullptr) return;
  since_shown_.start();
  const ConnectionsService& live = ConnectionsService::of(session());
  const OperatingLog* log = campaign->log ? &*campaign->log : nullptr;
  if (live.recording() && recorded_ != nullptr && recorded_visit_ == session().visit()) log = recorded_.get();
  const double log_ends_s =
      log == nullptr || log->empty() ? -std::numeric_limits<double>::infinity() : log->time_s().back();
  struct Curve {
    std::vector<double> time_s, value;
  };
  std::vector<std::string> names;
  if (log != nullptr) names = log->temperatureNames();
  for (const LiveColumn& column : live.snapshot().columns) {
    if (OperatingLog::isTemperature(column.column) &&
        std::find(names.begin(), names.end(), column.column) == names.end())
      names.push_back(column.column);
  }
  std::vector<Curve> curves;
  double first_s = std::numeric_limits<double>::infinity(), last_s = -first_s;
  for (const std::string& name : names) {
    Curve curve;
    if (log != nullptr && log->has(name)) {
      const std::vector<double>& time = log->time_s();
      const std::vector<double>& values = *log->signal(name);
      // Temperatures are slow and the plot is a thousand pixels wide: means of rows, one point a pixel or more.
      const std::size_t stride = 1 + time.size() / most_plotted_rows;
      for (std::size_t i = 0; i < time.size(); i += stride) {
        const std::size_t end = std::min(time.size(), i + stride);
        double at = 0.0;
        double value = 0.0;
        for (std::size_t k = i; k < end; ++k) {
          at += time[k] / static_cast<double>(end - i);
          value += values[k] / static_cast<double>(end - i);
        }
        curve.time_s.push_back(at);
        curve.value.push_back(value);
      }
    }
    const auto& columns = live.snapshot().columns;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (columns[c].column != name) continue;
      for (const LivePoint& point : live.history(c)) {
        const double at = point.time_s - live.startUtc();
        if (at <= log_ends_s) continue;
        curve.time_s.push_back(at);
        curve.value.push_back(point.value);
      }
    }
    if (!curve.time_s.empty()) {
      first_s = std::min(first_s, curve.time_s.front());
      last_s = std::max(last_s, curve.time_s.back());
    }
    curves.push_back(std::move(curve));
    if (curves.size() >= 6) break;
  }
  std::vector<Series> temperatures;
  if (first_s <= last_s) {
    const TimeUnit unit = timeUnit(last_s - first_s);
    for (std::size_t i = 0; i < curves.size(); ++i) {
      Series s;
      s.name = columnTitle(names[i]);
      for (const double t : curves[i].time_s) s.x.push_back(t / unit.seconds);
      s.y = curves[i].value;
      s.style = SeriesStyle::Line;
      s.colour = static_cast<int>(i);
      temperatures.push_back(std::move(s));
    }
    temperature_->setAxes(tr("Time / %1").arg(unit.name), tr("Temperature / °C"));
  }
  temperature_->setContent(std::move(temperatures));
}

void WarmUpPage::refresh() {
  const auto campaign = session().campaign();
  if (campaign == nullptr) return;
  noticeCampaign();
  showTemperatures();

  std::vector<Series> drift;
  std::vector<Row> rows;
  std::optional<WarmUpResult> judged;
  // What the step says, in the list of steps and on the command line.
  const StepStatus& status = context().workflow.status(StepId::WarmUp);
  showFolded(*callout(), status.state == StepState::NotStarted ? Tone::Attention : stateTone(status.state),
             status.sentence);
  if (const StoredResult* stored = session().latest(warm_up_task)) {
    try {
      judged = warmUpFrom(stored->payload);
    } catch (const InputError& e) {
      showFailure(coreSentence(e.what()));
    }
  }
  if (judged && judged->status == FitStatus::Converged) {
    double last = 0;
    for (const WarmUpAxis& axis : judged->axes) {
      if (!axis.time_s.empty()) last = std::max(last, axis.time_s.back() - axis.time_s.front());
    }
    const TimeUnit unit = timeUnit(last);
    int colour = 0;
    for (const WarmUpAxis& axis : judged->axes) {
      const QString name = QString::fromStdString(std::string(toString(axis.component)));
      if (axis.measured && axis.time_s.size() == axis.value_um.size()) {
        Series s;
        s.name = name;
        s.colour = colour;
        for (const double t : axis.time_s) s.x.push_back(t / unit.seconds);
        s.y = axis.value_um;
        drift.push_back(std::move(s));
      }
      ++colour;
      if (!axis.measured) continue;
      Row row;
      row.id = name;
      Cell first{name};
      first.bold = true;
      row.cells = {
          first,
          {shownNumbers(QString::fromStdString(withUncertainty(axis.drift_um_per_h, axis.drift_sigma_um_per_h, "")))},
          timeConstantCell(axis),
          settledAfterCell(axis),
          verdictCell(axis.verdict)};
      rows.push_back(std::move(row));
    }
    drift_->setAxes(tr("Time / %1").arg(unit.name),
                    tr("Deviation of %1 / µm").arg(QString::fromStdString(judged->point)));
  }
  drift_->setContent(std::move(drift));
  verdicts_->setRows(std::move(rows));
  const bool stated = session().warmStatement().has_value();
  check_->setToolTip(coreSentence(session().tasks().whyNot(warm_up_task)));
  check_->setEnabled(check_->toolTip().isEmpty());
  confirm_->setText(QChar(0x2009) + (stated ? tr("Withdraw the statement") : tr("The instrument was warm")));
  jogs_->refresh();
  repeatability_->refresh();
  clocks_->refresh();
}

std::vector<Exportable> WarmUpPage::exportables() {
  std::vector<Exportable> items;
  if (!drift_->empty()) items.push_back(exportableOf(tr("Drift"), drift_));
  if (!temperature_->empty()) items.push_back(exportableOf(tr("Temperatures"), temperature_));
  return items;
}

}  // namespace spindrift::gui
