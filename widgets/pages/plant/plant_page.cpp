// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/plant/plant_page.h"

#include <QComboBox>
#include <QCoreApplication>
#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QItemSelectionModel>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSettings>
#include <QSignalBlocker>
#include <QSplitter>
#include <QTabWidget>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <set>

#include "core/base/atomic_file.h"
#include "core/base/count_text.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/unit_text.h"
#include "core/base/utc_time.h"
#include "core/plant/publish.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/demo_names.h"
#include "widgets/common/help_text.h"
#include "widgets/common/parts.h"
#include "widgets/common/words.h"
#include "widgets/export/exportable.h"
#include "widgets/models/rows_model.h"
#include "widgets/panels/plant/batches_panel.h"
#include "widgets/panels/plant/plant_parts.h"
#include "widgets/plots/plot.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"

namespace spindrift::gui {
namespace {

constexpr double day_s = 86'400.0;
constexpr auto store_key = "plant/store";

double now() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

QString day(double time_s) {
  return time_s > 0.0 ? text(utcText(time_s).substr(0, 10)) : QStringLiteral("–");
}

/// Kinds of results as the store has them.
constexpr std::array kinds{QT_TRANSLATE_NOOP("PlantKinds", "fit"), QT_TRANSLATE_NOOP("PlantKinds", "evaluate"),
                           QT_TRANSLATE_NOOP("PlantKinds", "thermal"), QT_TRANSLATE_NOOP("PlantKinds", "discrepancy"),
                           QT_TRANSLATE_NOOP("PlantKinds", "verify")};

/// "fit/EX_um" with the kind in the language of the window.
QString shownTrend(const QString& key) {
  const QString kind = key.section(QLatin1Char('/'), 0, 0);
  const bool known =
      std::any_of(kinds.begin(), kinds.end(), [&](const char* one) { return kind == QLatin1String(one); });
  return known ? QCoreApplication::translate("PlantKinds", kind.toUtf8().constData()) + key.mid(kind.size()) : key;
}

Tone toneOf(const std::string& verdict) {
  if (verdict == "unknown" || verdict == "ambiguous" || verdict == "not_met" || verdict == "undecided")
    return Tone::Attention;
  if (verdict == "rejected" || verdict == "degenerate" || verdict == "no convergence") return Tone::Bad;
  return Tone::Neutral;
}

}  // namespace

PlantLook lookAtPlant(const PlantAddress& address, double now_s) {
  PlantStore store = PlantStore::open(address, {.as = PlantRole::Reader});
  PlantLook look;
  look.machines = plantOverview(store, now_s);
  for (const MachineState& m : look.machines) {
    look.names.push_back(store.trendNames(m.machine.name));
  }
  look.campaigns = store.campaigns();
  look.batches = BatchQueue(store).all();
  look.warnings = store.warnings();
  return look;
}

PlantPage::PlantPage(SessionModel& session, JobRunner& jobs, QWidget* parent)
    : QWidget(parent), session_(session), jobs_(jobs) {
  setAccessibleName(tr("Plant"));
  auto* outer = new QVBoxLayout(this);
  outer->setContentsMargins(24, 16, 24, 16);
  outer->setSpacing(12);
  auto* head = new QHBoxLayout;
  auto* titles = new QVBoxLayout;
  titles->setSpacing(2);
  titles->addWidget(makeLabel(tr("Plant"), "pageTitle"));
  titles->addWidget(
      makeLabel(tr("Open the store of your plant to see which machine is due, and what has changed."), "instruction"));
  head->addLayout(titles, 1);
  auto* back = makeButton(tr("Back"), "chevron-left");
  connect(back, &QPushButton::clicked, this, &PlantPage::closed);
  head->addWidget(back);
  outer->addLayout(head);

  auto* line = new QHBoxLayout;
  line->setSpacing(8);
  address_ = new QLineEdit;
  address_->setAccessibleName(tr("Plant store"));
  address_->setPlaceholderText(tr("plant.sqlite, or postgresql:host=NAME dbname=plant user=NAME"));
  address_->setToolTip(tr("A file, or a PostgreSQL server; its password stands in the file that PGPASSFILE names"));
  address_->setText(QSettings().value(QLatin1String(store_key)).toString());
  line->addWidget(address_, 1);
  auto* choose = makeButton(tr("File …"), "folder-open");
  auto* open = makeButton(tr("Open"), nullptr, "primary");
  publish_ = makeButton(tr("Publish this session"), "export");
  publish_->setToolTip(tr("Campaigns of the open session with their newest results; raw captures stay where they are"));
  line->addWidget(choose);
  line->addWidget(open);
  line->addWidget(publish_);
  outer->addLayout(line);
  callout_ = new Callout;
  callout_->hide();
  outer->addWidget(callout_);
  connect(choose, &QPushButton::clicked, this, [this] {
    const QString file = QFileDialog::getOpenFileName(this, tr("Open a plant store"), {}, tr("Plant store (*.sqlite)"));
    if (!file.isEmpty()) openStore(file);
  });
  connect(open, &QPushButton::clicked, this, [this] { openStore(address_->text()); });
  connect(address_, &QLineEdit::returnPressed, this, [this] { openStore(address_->text()); });
  connect(publish_, &QPushButton::clicked, this, &PlantPage::publish);
  connect(&session_, &SessionModel::sessionChanged, this, [this] { publish_->setEnabled(session_.isOpen()); });
  publish_->setEnabled(session_.isOpen());

  machines_ = new RowsModel({tr("Machine"), tr("Next"), tr("Model"), tr("Last"), tr("Verdict")}, this);
  machine_table_ = makeTable(machines_, tr("Machines"), tr("Machines appear here once campaigns are published."));
  machine_table_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  auto* list = new Card(tr("Machines"));
  list->body()->addWidget(machine_table_);
  report_ = makeButton(tr("Report …"), "report");
  report_->setToolTip(tr("State, events, trends and model of the selected machine as one HTML file"));
  report_->setEnabled(false);
  list->addToTitle(report_);
  connect(report_, &QPushButton::clicked, this, [this] {
    const QString file = QFileDialog::getSaveFileName(
        this, tr("Report of the machine"),
        fileNameOf(shownName(chosenMachines().value(0).toStdString())) + QStringLiteral(".html"),
        tr("Report (*.html)"));
    if (!file.isEmpty()) writeReport(file);
  });
  connect(machine_table_->selectionModel(), &QItemSelectionModel::selectionChanged, this, [this] {
    showParameters();
    showCampaigns();
  });

  parameter_ = new QComboBox;
  parameter_->setAccessibleName(tr("Parameter"));
  plot_ = new Plot;
  plot_->setEmptyText(tr("No trend yet"), tr("Select a machine that has been measured at least twice."));
  said_ = makeLabel({}, "secondaryText");
  said_->setWordWrap(true);
  said_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  said_->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
  plot_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  connect(parameter_, &QComboBox::currentIndexChanged, this, &PlantPage::showTrends);

  campaigns_ =
      new RowsModel({QString(), tr("Machine"), tr("Campaign"), tr("Date"), tr("Verdict"), tr("Published by")}, this);
  campaign_table_ = makeTable(campaigns_, tr("Campaigns"), tr("Select a machine."));
  connect(campaigns_, &RowsModel::checkedChanged, this, [this](const QString& id, int, bool checked) {
    const std::int64_t number = id.toLongLong();
    std::erase(compared_, number);
    if (checked) compared_.push_back(number);
    showCampaigns();
    compareChecked();
  });
  comparison_ = new RowsModel({tr("Parameter")}, this);
  QTableView* comparison_table =
      makeTable(comparison_, tr("Comparison"), tr("Check two or more campaigns to see them side by side."));

  event_kind_ = new QComboBox;
  event_kind_->setAccessibleName(tr("What was done to the machine"));
  for (const std::string& kind : eventKinds())
    event_kind_->addItem(sentenceStart(coreSentence(eventWords(kind))), text(kind));
  event_time_ = new QLineEdit(text(utcText(now()).substr(0, 10)));
  event_time_->setAccessibleName(tr("When it was done (UTC)"));
  event_time_->setToolTip(tr("UTC: a day such as 2026-01-31, or a time such as 2026-01-31T08:00:00Z"));
  event_time_->setFixedWidth(150);
  event_note_ = new QLineEdit;
  event_note_->setAccessibleName(tr("Note on the event"));
  event_note_->setPlaceholderText(tr("A few words"));
  event_note_->setMinimumWidth(140);
  enter_event_ = makeButton(tr("Enter event"), "plus");
  enter_event_->setToolTip(tr("What was done to the selected machine; limits of its trends begin anew after it"));
  enter_event_->setEnabled(false);
  connect(event_note_, &QLineEdit::returnPressed, enter_event_, &QPushButton::click);
  connect(event_time_, &QLineEdit::returnPressed, enter_event_, &QPushButton::click);
  connect(enter_event_, &QPushButton::clicked, this, &PlantPage::enterEvent);

  tabs_ = makeTabs(nullptr);
  tabs_->addTab(column({parameter_, plot_, said_, row({event_kind_, event_time_, event_note_, enter_event_}, 2)}),
                tr("Trend"));
  tabs_->addTab(makeSplitter(nullptr, column({campaign_table_}), column({comparison_table}), 3, 2, Qt::Vertical),
                tr("Campaigns"));
  batches_ = new BatchesPanel(jobs_, *callout_, [this] { return addressText(); });
  tabs_->addTab(batches_, tr("Batches"));
  auto* help = new HelpText(tr("Help on the plant"));
  help->showHelp(QStringLiteral("plant"));
  tabs_->addTab(column({help}), tr("Help"));
  outer->addWidget(makeSplitter(this, list, tabs_, 9, 11), 1);
}

QString PlantPage::said() const {
  return said_->text();
}

QString PlantPage::addressText() const {
  return address_->text().trimmed();
}

void PlantPage::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  publish_->setEnabled(session_.isOpen());
}

void PlantPage::openStore(const QString& address) {
  address_->setText(address);
  refresh();
}

void PlantPage::fail(const QString& sentence) {
  callout_->show(Tone::Bad, sentence);
}

void PlantPage::refresh() {
  const QString wanted = addressText();
  if (wanted.isEmpty()) return;
  try {
    const PlantAddress address = PlantAddress::parse(wanted.toStdString());
    Job job = displayJob(
        tr("Reading the plant store"), "plant-look", [address] { return lookAtPlant(address, now()); },
        [this, wanted](const PlantLook& look) {
          QSettings().setValue(QLatin1String(store_key), wanted);
          show(look);
        });
    job.failed = [this](const QString& sentence) { fail(sentence); };
    jobs_.run(std::move(job));
  } catch (const InputError& e) {
    fail(coreSentence(e.what()));
  }
}

void PlantPage::show(const PlantLook& look) {
  const QStringList chosen = chosenMachines();
  look_ = look;
  if (notice_)
    callout_->show(notice_->first, notice_->second);
  else if (look.warnings.empty())
    callout_->set(Tone::Neutral, {});
  else
    callout_->show(Tone::Attention, coreSentence(look.warnings.front()));
  notice_.reset();
  showMachines();
  batches_->show(look.batches);
  std::erase_if(compared_, [&](std::int64_t id) {
    return std::none_of(look.campaigns.begin(), look.campaigns.end(),
                        [&](const PlantListing& c) { return c.id == id; });
  });
  selectMachines(chosen.isEmpty() && !look.machines.empty() ? QStringList{text(look.machines.front().machine.name)}
                                                            : chosen);
  lookAtModels();
}

void PlantPage::showMachines() {
  const PlantLook& look = look_;
  std::vector<Row> rows;
  for (std::size_t i = 0; i < look.machines.size(); ++i) {
    const MachineState& m = look.machines[i];
    const ModelState model = i < look.models.size() ? look.models[i] : ModelState();
    Cell holds{look.models.empty() ? tr("…") : tr("none")};
    if (model.model) {
      holds = model.reasons.empty() ? Cell{tr("holds"), Tone::Good, "check-circle"}
                                    : Cell{tr("no longer holds"), Tone::Attention, "alert"};
      if (!model.reasons.empty()) holds.tip = coreSentence(model.reasons.front());
    }
    const bool due = m.every_days > 0.0 && m.overdue_days > 0.0;
    Cell next{due ? tr("due for %1").arg(coreSentence(countOf(static_cast<long>(std::ceil(m.overdue_days)), "day")))
                  : day(m.due_s),
              due ? Tone::Attention : Tone::Neutral, due ? "clock" : nullptr};
    next.tip = coreSentence(m.dueSentence());
    rows.push_back({text(m.machine.name),
                    {{shownName(m.machine.name), Tone::Neutral, nullptr, false, true},
                     next,
                     holds,
                     {day(m.machine.last_s)},
                     {coreSentence(m.machine.last_verdict.empty() ? "–" : m.machine.last_verdict),
                      toneOf(m.machine.last_verdict)}}});
  }
  machines_->setRows(std::move(rows));
}

/// Whether models hold takes a look at all trends: it comes after the list.
void PlantPage::lookAtModels() {
  const PlantAddress address = PlantAddress::parse(addressText().toStdString());
  std::vector<std::string> names;
  for (const MachineState& m : look_.machines) names.push_back(m.machine.name);
  Job job = displayJob(
      tr("Looking at models"), "plant-models",
      [address, names] {
        PlantStore store = PlantStore::open(address, {.as = PlantRole::Reader});
        std::pair<std::vector<std::string>, std::vector<ModelState>> found{names, {}};
        for (const std::string& name : names) found.second.push_back(modelState(store, name, {}));
        return found;
      },
      [this](const std::pair<std::vector<std::string>, std::vector<ModelState>>& found) {
        if (found.first.size() != look_.machines.size()) return;
        for (std::size_t i = 0; i < found.first.size(); ++i) {
          if (found.first[i] != look_.machines[i].machine.name) return;  // of a store that is shown no more
        }
        look_.models = found.second;
        const QStringList chosen = chosenMachines();
        showMachines();
        select(chosen);
      });
  job.queue = JobQueue::Work;  // trends that are chosen meanwhile do not wait for it
  jobs_.run(std::move(job));
}

void PlantPage::selectMachines(const QStringList& names) {
  select(names);
  showParameters();
  showCampaigns();
}

void PlantPage::select(const QStringList& names) {
  QItemSelection selection;
  for (const QString& name : names) {
    const int row = machines_->rowOf(name);
    if (row >= 0) selection.select(machines_->index(row, 0), machines_->index(row, machines_->columnCount() - 1));
  }
  {
    const QSignalBlocker quiet(machine_table_->selectionModel());
    machine_table_->selectionModel()->select(selection, QItemSelectionModel::ClearAndSelect);
  }
  machine_table_->viewport()->update();
}

QStringList PlantPage::chosenMachines() const {
  QStringList names;
  for (const QModelIndex& index : machine_table_->selectionModel()->selectedRows())
    names << machines_->idAt(index.row());
  return names;
}

void PlantPage::showParameters() {
  const QString before = parameter_->currentData().toString();
  const QStringList chosen = chosenMachines();
  std::set<QString> names;
  QString most;
  std::size_t most_values = 0;
  for (std::size_t i = 0; i < look_.machines.size(); ++i) {
    if (!chosen.contains(text(look_.machines[i].machine.name))) continue;
    for (const TrendName& n : look_.names[i]) {
      const QString name = text(n.kind + "/" + n.name);
      names.insert(name);
      if (n.values > most_values) {
        most_values = n.values;
        most = name;
      }
    }
  }
  {
    const QSignalBlocker quiet(parameter_);
    parameter_->clear();
    for (const QString& name : names) parameter_->addItem(shownTrend(name), name);
    const int again = parameter_->findData(before);
    parameter_->setCurrentIndex(again >= 0 ? again : parameter_->findData(most));
  }
  parameter_->setEnabled(!names.empty());
  showTrends();
}

void PlantPage::showTrends() {
  const QStringList chosen = chosenMachines();
  const std::string name = parameter_->currentData().toString().toStdString();
  if (chosen.isEmpty() || name.empty()) {
    plot_->setContent({});
    said_->clear();
    return;
  }
  std::vector<std::string> machines;
  for (std::size_t i = 0; i < look_.machines.size(); ++i) {
    const bool has = std::any_of(look_.names[i].begin(), look_.names[i].end(),
                                 [&](const TrendName& n) { return n.kind + "/" + n.name == name; });
    if (has && chosen.contains(text(look_.machines[i].machine.name)))
      machines.push_back(look_.machines[i].machine.name);
  }
  const PlantAddress address = PlantAddress::parse(addressText().toStdString());
  Job job = displayJob(
      tr("Reading trends"), "plant-trend",
      [address, machines, name] {
        PlantStore store = PlantStore::open(address, {.as = PlantRole::Reader});
        std::vector<MachineTrend> trends;
        for (const std::string& m : machines) trends.push_back(machineTrend(store, m, name, {}, {}));
        return trends;
      },
      [this](const std::vector<MachineTrend>& trends) {
        double first_s = 0.0;
        for (const MachineTrend& t : trends) {
          if (!t.chart.points.empty() && (first_s == 0.0 || t.chart.points.front().point.time_s < first_s))
            first_s = t.chart.points.front().point.time_s;
        }
        std::vector<Series> series;
        QStringList sentences;
        const bool alone = trends.size() == 1;
        for (std::size_t i = 0; i < trends.size(); ++i) {
          const MachineTrend& t = trends[i];
          Series measured{
              alone ? text(t.name) : shownName(t.machine), {}, {}, {}, SeriesStyle::Points, static_cast<int>(i)};
          // A stretch of its own for each level: limits begin anew after an event that changes the machine.
          std::vector<Series> limits;
          double centre = std::nan("");
          for (const ChartPoint& p : t.chart.points) {
            const double x = (p.point.time_s - first_s) / day_s;
            measured.x.push_back(x);
            measured.y.push_back(p.point.value);
            measured.sigma.push_back(p.point.standard_uncertainty);
            if (!alone || p.lower == p.upper) continue;
            if (p.centre != centre) {
              const bool first = limits.empty();
              limits.push_back({tr("moving average (EWMA)"), {}, {}, {}, SeriesStyle::Line, 1, 2, first});
              limits.push_back({tr("control limits"), {}, {}, {}, SeriesStyle::Dashed, 2, 2, first});
              limits.push_back({QString(), {}, {}, {}, SeriesStyle::Dashed, 2, 2, false});
              centre = p.centre;
            }
            const std::array<double, 3> values{p.ewma, p.lower, p.upper};
            for (std::size_t k = 0; k < 3; ++k) {
              Series& s = limits[limits.size() - 3 + k];
              s.x.push_back(x);
              s.y.push_back(values[k]);
            }
          }
          series.push_back(std::move(measured));
          for (Series& s : limits) series.push_back(std::move(s));
          for (const NamedChange& c : t.chart.changes)
            sentences << (alone ? sentenceStart(coreSentence(c.sentence(t.chart.unit)))
                                : shownName(t.machine) + QStringLiteral(": ") + coreSentence(c.sentence(t.chart.unit)));
          if (alone) {
            for (const std::string& note : t.chart.notes) sentences << coreSentence(note);
          }
        }
        if (trends.empty() || trends.front().chart.points.empty()) {
          plot_->setContent({});
          said_->clear();
          return;
        }
        const std::string unit = trends.front().chart.unit;
        // The name carries the unit at its end.
        QString quantity = text(trends.front().name);
        for (const char* end : {"_um_per_m", "_urad", "_um"}) {
          if (!unit.empty() && quantity.endsWith(QLatin1String(end))) quantity.chop(static_cast<int>(std::strlen(end)));
        }
        plot_->setAxes(tr("time since %1 / d").arg(day(first_s)),
                       unit.empty() ? quantity : quantity + QStringLiteral(" / ") + text(printedUnit(unit)));
        plot_->setContent(std::move(series));
        for (const MachineTrend& t : trends) {
          for (const MachineEvent& e : t.events) {
            if (!alone && !changesMachine(e.kind)) continue;
            const QString what = coreSentence(eventWords(e.kind));
            plot_->addMark((e.time_s - first_s) / day_s,
                           alone ? what : shownName(t.machine) + QStringLiteral(": ") + what,
                           changesMachine(e.kind) ? Tone::Attention : Tone::Neutral);
          }
        }
        if (sentences.isEmpty()) sentences << tr("No change that is more than chance.");
        said_->setText(onScreen(sentences.mid(0, 6).join(QLatin1Char('\n'))));
      });
  job.failed = [this](const QString& sentence) { fail(sentence); };
  jobs_.run(std::move(job));
}

void PlantPage::showCampaigns() {
  const QStringList chosen = chosenMachines();
  report_->setEnabled(!chosen.isEmpty());
  enter_event_->setEnabled(chosen.size() == 1);
  std::vector<Row> rows;
  for (auto c = look_.campaigns.rbegin(); c != look_.campaigns.rend(); ++c) {
    const bool checked = std::find(compared_.begin(), compared_.end(), c->id) != compared_.end();
    if (!checked && !chosen.contains(text(c->machine))) continue;
    Cell box;
    box.checked = checked;
    rows.push_back({QString::number(c->id),
                    {box,
                     {shownName(c->machine)},
                     {shownName(c->name)},
                     {day(c->start_s)},
                     {coreSentence(c->verdict.empty() ? "–" : c->verdict), toneOf(c->verdict)},
                     {text(c->publisher)}}});
  }
  campaigns_->setRows(std::move(rows));
}

void PlantPage::compareChecked() {
  if (compared_.size() < 2) {
    comparison_->setHeaders({tr("Parameter")});
    comparison_->setRows({});
    return;
  }
  const PlantAddress address = PlantAddress::parse(addressText().toStdString());
  Job job = displayJob(
      tr("Comparing campaigns"), "plant-compare",
      [address, ids = compared_] {
        PlantStore store = PlantStore::open(address, {.as = PlantRole::Reader});
        return compareCampaigns(store, ids);
      },
      [this](const CampaignComparison& c) {
        QStringList headers{tr("Parameter"), tr("State")};
        for (const PlantCampaign& one : c.campaigns)
          headers << shownName(one.machine) + QStringLiteral(", ") + shownName(one.name);
        headers << tr("Largest difference");
        std::vector<Row> rows;
        for (const CampaignComparison::ComparedRow& r : c.rows) {
          Row row{text(r.kind + "/" + r.name + "/" + r.state), {{text(r.name)}, {text(r.state)}}};
          for (const auto& e : r.entries)
            row.cells.push_back(
                {e ? shownNumbers(text(withUncertainty(e->value, e->standard_uncertainty, ""))) : QStringLiteral("–"),
                 Tone::Neutral, nullptr, true});
          const bool large = r.largest > 3.0;
          row.cells.push_back({r.largest > 0.0 ? tr("%1 standard uncertainties").arg(decimalText(r.largest, 'f', 1))
                                               : QStringLiteral("–"),
                               large ? Tone::Attention : Tone::Neutral, large ? "alert" : nullptr});
          rows.push_back(std::move(row));
        }
        comparison_->setHeaders(headers);
        comparison_->setRows(std::move(rows));
      });
  job.failed = [this](const QString& sentence) { fail(sentence); };
  jobs_.run(std::move(job));
}

void PlantPage::enterEvent() {
  const QStringList chosen = chosenMachines();
  if (chosen.size() != 1) return;
  QString time = event_time_->text().trimmed();
  if (time.size() == 10) time += QStringLiteral("T00:00:00Z");
  const std::optional<double> time_s = parseUtc(time.toStdString());
  if (!time_s || *time_s > now() + day_s) {
    fail(tr("\"%1\" is not a date up to now; allowed: UTC such as 2026-01-31 or 2026-01-31T08:00:00Z.")
             .arg(event_time_->text()));
    event_time_->setFocus();
    return;
  }
  const MachineEvent event{chosen.front().toStdString(), *time_s, event_kind_->currentData().toString().toStdString(),
                           event_note_->text().trimmed().toStdString(), plantPublisher()};
  const PlantAddress address = PlantAddress::parse(addressText().toStdString());
  Job job = displayJob(
      tr("Entering an event"), "",
      [address, event] {
        PlantStore store = PlantStore::open(address);
        store.addEvent(event);
        return event;
      },
      [this, kind = event_kind_->currentText()](const MachineEvent& entered) {
        event_note_->clear();
        notice_ = {Tone::Good,
                   tr("Entered for %1: %2 on %3.").arg(shownName(entered.machine), kind, day(entered.time_s))};
        refresh();
      });
  job.failed = [this](const QString& sentence) { fail(sentence); };
  jobs_.run(std::move(job));
}

void PlantPage::writeReport(const QString& file) {
  if (chosenMachines().isEmpty()) return;
  const PlantAddress address = PlantAddress::parse(addressText().toStdString());
  Job job;
  job.title = tr("Writing the report of %1").arg(shownName(chosenMachines().front().toStdString()));
  job.work = [this, address, machine = chosenMachines().front().toStdString(),
              file](JobContext&) -> std::function<void()> {
    PlantStore store = PlantStore::open(address, {.as = PlantRole::Reader});
    const MachineReport made = machineReport(store, machine, now());
    writeFileAtomically(file.toStdString(), htmlOf(inOfferedLanguage(made.report, made.names)));
    return [this, file] { callout_->show(Tone::Good, tr("The report is in %1.").arg(file)); };
  };
  job.failed = [this](const QString& sentence) { fail(sentence); };
  jobs_.run(std::move(job));
}

void PlantPage::publish() {
  if (!session_.isOpen()) return;
  try {
    const PlantAddress address = PlantAddress::parse(addressText().toStdString());
    std::vector<CampaignSource> sources;
    for (const CampaignRecord& record : session_.session()->campaigns())
      sources.push_back(CampaignSource::of(*session_.session(), record.id));
    Job job;
    job.title = tr("Publishing to the plant store");
    job.work = [this, sources = std::move(sources), address,
                folder = session_.folder()](JobContext& context) -> std::function<void()> {
      std::vector<CampaignState> read;
      for (const CampaignSource& source : sources) read.push_back(CampaignState::read(source, context));
      return [this, read = std::move(read), address, folder] {
        if (!session_.isOpen() || session_.folder() != folder) return;
        try {
          send(std::make_shared<Publication>(beginPublication(*session_.session(), read, address)), address);
        } catch (const InputError& e) {
          fail(coreSentence(e.what()));
        }
      };
    };
    job.failed = [this](const QString& sentence) { fail(sentence); };
    jobs_.run(std::move(job));
  } catch (const InputError& e) {
    fail(coreSentence(e.what()));
  }
}

void PlantPage::send(const std::shared_ptr<Publication>& publication, const PlantAddress& address) {
  Job job;
  job.title = tr("Publishing to the plant store");
  job.work = [this, publication, address, folder = session_.folder()](JobContext& context) -> std::function<void()> {
    const PublishOutcome outcome = sendPublication(*publication, address, {}, context);
    return [this, publication, outcome, folder] {
      if (session_.isOpen() && session_.folder() == folder) endPublication(*session_.session(), *publication, outcome);
      if (outcome.waiting > 0) {
        callout_->show(Tone::Attention, tr("%1 waiting in the session until the next publishing. %2")
                                            .arg(coreSentence(countOf(outcome.waiting, "campaign")))
                                            .arg(coreSentence(outcome.reason)));
        return;
      }
      notice_ = {outcome.warnings.empty() ? Tone::Good : Tone::Attention,
                 tr("Published: new %1 and %2; there already %3 and %4.")
                     .arg(coreSentence(countOf(outcome.count.campaigns_new, "campaign")),
                          coreSentence(countOf(outcome.count.results_new, "result")),
                          coreSentence(countOf(outcome.count.campaigns_there, "campaign")),
                          coreSentence(countOf(outcome.count.results_there, "result")))};
      if (outcome.count.results_again > 0)
        notice_->second += QLatin1Char(' ') + tr("In force again, in the place of later ones: %1.")
                                                  .arg(coreSentence(countOf(outcome.count.results_again, "result")));
      for (const std::string& warning : outcome.warnings) notice_->second += QLatin1Char(' ') + coreSentence(warning);
      refresh();
    };
  };
  job.failed = [this](const QString& sentence) { fail(sentence); };
  jobs_.run(std::move(job));
}

}  // namespace spindrift::gui
