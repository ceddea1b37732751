// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/thermal/clock_panel.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>
#include <set>
#include <utility>

#include "core/base/error.h"
#include "widgets/commands/campaign_undo.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/models/session_model.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {
namespace {

constexpr double longest_search_s = 600.0;

class ClockCommand : public QUndoCommand {
 public:
  ClockCommand(SessionModel& session, ClockOffsets after)
      : QUndoCommand(ClockPanel::tr("change the offset of a clock")),
        session_(session),
        before_(session.clockOffsets()),
        after_(std::move(after)) {}
  void redo() override { session_.setClockOffsets(after_); }
  void undo() override { session_.setClockOffsets(before_); }

 private:
  SessionModel& session_;
  ClockOffsets before_;
  ClockOffsets after_;
};

}  // namespace

ClockPanel::ClockPanel(SessionModel& session, CampaignUndo& undo, std::function<void(const QString&, Work)> run,
                       QWidget* parent)
    : QWidget(parent), session_(session), undo_(undo), run_(std::move(run)), instruments_([this] { refresh(); }) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 8, 0, 0);
  auto* text = makeLabel(tr("Clocks of logger and instruments differ. The offset is added to the times of a source; a "
                            "motion that log and instrument both saw gives it."),
                         "instruction");
  text->setWordWrap(true);
  column->addWidget(text);
  auto* line = new QHBoxLayout;
  source_ = new QComboBox;
  source_->setAccessibleName(tr("Source of times"));
  source_->setMinimumWidth(140);
  line->addWidget(source_);
  offset_ = new QDoubleSpinBox;
  offset_->setAccessibleName(tr("Offset added to the times of the source"));
  offset_->setDecimals(2);
  offset_->setRange(-1e6, 1e6);
  offset_->setSuffix(tr(" s"));
  offset_->setMinimumHeight(sizes::control_height);
  offset_->setKeyboardTracking(false);
  line->addWidget(offset_);
  estimate_ = makeButton(tr("Estimate from the motion"), nullptr);
  line->addWidget(estimate_);
  line->addStretch();
  column->addLayout(line);
  message_ = new Callout;
  message_->set(Tone::Neutral, {});
  column->addWidget(message_);
  rows_ = new RowsModel({tr("Source"), tr("Offset"), tr("From")}, this);
  column->addWidget(makeTable(rows_, tr("Offsets of the clocks"), tr("No clock offset is applied.")), 1);
  connect(source_, &QComboBox::activated, this, [this](int) { refresh(); });
  connect(offset_, &QDoubleSpinBox::valueChanged, this, [this](double value) {
    if (!filling_) change(chosenSource().toStdString(), value, 0.0, "entered");
  });
  connect(estimate_, &QPushButton::clicked, this, &ClockPanel::estimate);
}

QString ClockPanel::chosenSource() const {
  return source_->currentData().toString();
}

QString ClockPanel::nameOf(const std::string& source) {
  return source == "log" ? tr("log", "source of times") : fromCore(source);
}

void ClockPanel::change(const std::string& source, double offset_s, double sigma_s, const std::string& how) {
  ClockOffsets after = session_.clockOffsets();
  if (source.empty()) return;
  if (offset_s == 0.0) {
    after.erase(source);
  } else {
    after[source] = {offset_s, sigma_s, how};
  }
  undo_.push(new ClockCommand(session_, std::move(after)));
}

void ClockPanel::estimate() {
  const auto set = session_.observations();
  if (!set) {
    message_->set(Tone::Attention, tr("There are no observations yet to compare the log with. Evaluate the captures "
                                      "first (Calibrate)."));
    return;
  }
  const std::string source = chosenSource().toStdString();
  // What is found is relative to what is applied to log and observations already.
  const ClockOffsets now = session_.clockOffsets();
  const auto before = now.find(source);
  const double applied_s = before == now.end() ? 0.0 : before->second.offset_s;
  run_(tr("Estimating the offset of a clock"),
       [this, set, source, applied_s, campaign = session_.campaign()](JobContext&) -> std::function<void()> {
         try {
           const CampaignClockOffset found = estimateFromMotion(*campaign, *set, source, longest_search_s);
           return [this, source, applied_s, found] {
             change(source, applied_s + found.offset_s, found.sigma_s, found.how);
             message_->set(Tone::Good,
                           tr("Offset of %1: %2.")
                               .arg(nameOf(source), quantityText(applied_s + found.offset_s, found.sigma_s, tr("s"))));
           };
         } catch (const InputError& e) {
           return [this, sentence = coreSentence(e.what())] { message_->set(Tone::Attention, sentence); };
         }
       });
}

void ClockPanel::fillSources() {
  if (std::exchange(shown_visit_, session_.visit()) != session_.visit()) source_->clear();
  std::set<std::string> sources;
  if (const auto set = session_.observations()) {
    const auto instruments = instruments_.ask(set, {}, [](const ObservationSet& observations) {
      std::set<std::string> found;
      for (const Observation& o : observations.rows)
        if (!o.instrument.empty()) found.insert(o.instrument);
      return found;
    });
    if (instruments == nullptr) return;
    sources = *instruments;
  }
  if (session_.campaign()->log) sources.insert("log");
  const QString chosen = chosenSource();
  source_->clear();
  for (const std::string& s : sources) source_->addItem(nameOf(s), fromCore(s));
  source_->setCurrentIndex(std::max(source_->findData(chosen), source_->count() > 0 ? 0 : -1));
}

void ClockPanel::refresh() {
  if (session_.campaign() == nullptr) return;
  filling_ = true;
  fillSources();
  const ClockOffsets now = session_.clockOffsets();
  const auto found = now.find(chosenSource().toStdString());
  offset_->setValue(found == now.end() ? 0.0 : found->second.offset_s);
  offset_->setEnabled(source_->count() > 0);
  estimate_->setEnabled(source_->count() > 0 && chosenSource() != QLatin1String("log"));
  std::vector<Row> rows;
  for (const auto& [source, o] : now) {
    Row row;
    row.id = fromCore(source);
    row.cells = {nameCell(nameOf(source)),
                 Cell{o.sigma_s > 0.0 ? quantityText(o.offset_s, o.sigma_s, tr("s"))
                                      : QStringLiteral("%1 s").arg(decimalText(o.offset_s, 'f', 2))},
                 Cell{coreSentence(o.how)}};
    rows.push_back(std::move(row));
  }
  rows_->setRows(std::move(rows));
  filling_ = false;
}

}  // namespace spindrift::gui
