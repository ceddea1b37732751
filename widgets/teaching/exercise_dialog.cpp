// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/teaching/exercise_dialog.h"

#include <QComboBox>
#include <QDateTime>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QPushButton>
#include <QRandomGenerator>
#include <QScrollArea>
#include <QSettings>
#include <QSpinBox>
#include <QTabWidget>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>

#include "core/base/error.h"
#include "widgets/common/parts.h"
#include "widgets/common/quantity_box.h"
#include "widgets/common/words.h"
#include "widgets/jobs/job_runner.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/models/session_model.h"
#include "widgets/panels/common/effect_titles.h"

namespace spindrift::gui {
namespace {

constexpr int longest_history = 50;
constexpr int largest_seed = 99'999;
constexpr int hint_marks = 10;

QString levelTitle(const QString& level) {
  if (level == QLatin1String("medium")) return ExerciseDialog::tr("Medium");
  if (level == QLatin1String("hard")) return ExerciseDialog::tr("Hard");
  return ExerciseDialog::tr("Easy");
}

/// The names that a hint holds, as people write them.
QString hintSentence(const ExerciseKey& key, int number) {
  QStringList names;
  for (const std::string& name : exerciseHint(key, number)) {
    names << (number == 3      ? familyTitle(name)
              : name == "none" ? ExerciseDialog::tr("nothing in the log")
                               : fromCore(name));
  }
  const QString all = names.join(QStringLiteral(", "));
  if (number == 1) return ExerciseDialog::tr("What is missing is largest in: %1").arg(all);
  if (number == 2) return ExerciseDialog::tr("Driven by: %1").arg(all);
  return ExerciseDialog::tr("Family: %1").arg(all);
}

}  // namespace

std::vector<ExerciseRecord> exerciseHistory() {
  QSettings settings;
  std::vector<ExerciseRecord> out;
  const int count = settings.beginReadArray(QStringLiteral("exercises"));
  for (int i = 0; i < count; ++i) {
    settings.setArrayIndex(i);
    out.push_back({settings.value(QStringLiteral("when")).toString(),
                   settings.value(QStringLiteral("level")).toString(),
                   settings.value(QStringLiteral("seed")).toULongLong(),
                   settings.value(QStringLiteral("score")).toInt(), settings.value(QStringLiteral("hints")).toInt()});
  }
  settings.endArray();
  return out;
}

void addToExerciseHistory(const ExerciseRecord& record) {
  std::vector<ExerciseRecord> all = exerciseHistory();
  all.insert(all.begin(), record);
  if (all.size() > longest_history) all.resize(longest_history);
  QSettings settings;
  settings.beginWriteArray(QStringLiteral("exercises"), static_cast<int>(all.size()));
  for (int i = 0; i < static_cast<int>(all.size()); ++i) {
    settings.setArrayIndex(i);
    const ExerciseRecord& one = all[static_cast<std::size_t>(i)];
    settings.setValue(QStringLiteral("when"), one.when);
    settings.setValue(QStringLiteral("level"), one.level);
    settings.setValue(QStringLiteral("seed"), one.seed);
    settings.setValue(QStringLiteral("score"), one.score);
    settings.setValue(QStringLiteral("hints"), one.hints);
  }
  settings.endArray();
}

ExerciseDialog::ExerciseDialog(SessionModel& session, JobRunner& jobs, QWidget* parent)
    : QDialog(parent), session_(session), jobs_(jobs) {
  setWindowTitle(tr("Exercise: find the missing effect"));
  resize(900, 780);
  auto* column = new QVBoxLayout(this);
  column->setSpacing(sizes::step);
  auto* instruction =
      makeLabel(tr("The simulation of a machine lacks something. Look at residuals, log and maps in the "
                   "window, name what is missing, and only then run the search."),
                "instruction");
  instruction->setWordWrap(true);
  column->addWidget(instruction);

  auto* start_card = new Card(tr("New exercise"));
  auto* line = new QHBoxLayout;
  level_ = new Segments({tr("Easy"), tr("Medium"), tr("Hard")}, tr("Level"));
  level_->button(0)->setToolTip(tr("One effect of ten times the noise"));
  level_->button(1)->setToolTip(tr("Two effects of six times the noise; states shifted as a whole"));
  level_->button(2)->setToolTip(tr("Three effects of four times the noise, as a workshop leaves its data"));
  seed_ = new QSpinBox;
  seed_->setRange(1, largest_seed);
  seed_->setPrefix(tr("Number "));
  seed_->setAccessibleName(tr("Number of the exercise"));
  seed_->setToolTip(tr("The same number and level give the same exercise"));
  seed_->setValue(QRandomGenerator::global()->bounded(1, 1000));
  start_ = makeButton(tr("Start"), "play", "primary");
  line->addWidget(level_);
  line->addWidget(seed_);
  line->addStretch(1);
  line->addWidget(start_);
  start_card->body()->addLayout(line);
  column->addWidget(start_card);

  answer_card_ = new Card(tr("Your answer"));
  state_ = new Callout;
  answer_card_->body()->addWidget(state_);
  answer_rows_ = new QVBoxLayout;
  answer_card_->body()->addLayout(answer_rows_);
  hint_text_ = makeLabel({}, "secondaryText");
  hint_text_->setWordWrap(true);
  answer_card_->body()->addWidget(hint_text_);
  auto* buttons = new QHBoxLayout;
  hint_ = makeButton(tr("Show a hint (−%1)").arg(hint_marks), "info");
  search_ = makeButton(tr("Compare with the search"), "discrepancy");
  answer_ = makeButton(tr("Give the answer"), "check", "primary");
  buttons->addWidget(hint_);
  buttons->addStretch(1);
  buttons->addWidget(search_);
  buttons->addWidget(answer_);
  answer_card_->body()->addLayout(buttons);
  column->addWidget(answer_card_);

  results_ = new RowsModel({tr("Hidden"), tr("Named"), tr("Driver"), tr("Size"), tr("Score"), QString()}, this);
  history_ = new RowsModel({tr("When"), tr("Level"), tr("Number"), tr("Score"), tr("Hints"), QString()}, this);
  auto* tabs = makeTabs(this);
  results_table_ = makeTable(results_, tr("What was hidden"), tr("What was hidden appears here after your answer."));
  tabs->addTab(results_table_, tr("Result"));
  tabs->addTab(makeTable(history_, tr("Earlier exercises"), tr("Exercises that were marked appear here.")),
               tr("History"));
  column->addWidget(tabs, 1);

  connect(start_, &QPushButton::clicked, this, [this] {
    const Exercise wanted{static_cast<std::uint64_t>(seed_->value()), static_cast<ExerciseLevel>(level_->current())};
    Q_EMIT startWanted(wanted);
  });
  connect(hint_, &QPushButton::clicked, this, &ExerciseDialog::showHint);
  connect(answer_, &QPushButton::clicked, this, &ExerciseDialog::giveAnswer);
  connect(search_, &QPushButton::clicked, this, &ExerciseDialog::searchWanted);
  connect(&session_, &SessionModel::campaignChanged, this, &ExerciseDialog::refresh);
  connect(&session_, &SessionModel::sessionChanged, this, &ExerciseDialog::refresh);
  refreshHistory();
  refresh();
}

QString ExerciseDialog::hintText() const {
  return hint_text_->text();
}

void ExerciseDialog::refresh() {
  const auto campaign = session_.campaign();
  std::optional<Exercise> now;
  QString problem;
  try {
    if (campaign != nullptr) now = Exercise::of(campaign->folder);
  } catch (const InputError& error) {
    problem = QString::fromUtf8(error.what());
  }
  const bool same = now && exercise_ && campaign->folder == campaign_;
  if (!same) {
    exercise_ = now;
    campaign_ = now ? campaign->folder : std::filesystem::path();
    choices_.clear();
    key_.reset();
    score_.reset();
    hints_ = 0;
    hint_text_->setText({});
    results_->setRows({});
    makeRows();
    if (exercise_) loadChoices();
  }
  const bool open = exercise_ && !score_;
  if (!problem.isEmpty()) {
    state_->set(Tone::Bad, problem);
  } else if (!exercise_) {
    state_->set(Tone::Neutral, tr("Start an exercise: its campaign is opened as if it had been measured."));
  } else if (!score_) {
    state_->set(Tone::Accent, tr("%1, number %2. Hidden effects: %3. Size is the largest change at one point.")
                                  .arg(levelTitle(fromCore(std::string(toString(exercise_->level)))))
                                  .arg(exercise_->seed)
                                  .arg(exercise_->effects()));
  }
  setRole(start_, open ? "secondary" : "primary");  // one thing to do next
  answer_->setVisible(open);
  hint_->setEnabled(open && ready() && hints_ < exercise_hints);
  answer_->setEnabled(open && ready());
  search_->setEnabled(score_.has_value());
  for (const AnswerRow& row : rows_) row.widget->setEnabled(open && ready());
}

void ExerciseDialog::loadChoices() {
  Job job;
  job.title = tr("Reading the effects of the machine");
  job.quiet = true;
  job.queue = JobQueue::Display;
  job.key = "exercise choices";
  job.work = [this, folder = campaign_](JobContext&) -> std::function<void()> {
    auto choices = std::make_shared<std::vector<ExerciseChoice>>(exerciseChoices(folder));
    return [this, folder, choices] {
      if (folder != campaign_) return;
      choices_ = std::move(*choices);
      makeRows();
      refresh();
    };
  };
  job.failed = [this](const QString& sentence) { state_->set(Tone::Bad, sentence); };
  jobs_.run(std::move(job));
}

void ExerciseDialog::makeRows() {
  for (const AnswerRow& row : rows_) delete row.widget;
  rows_.clear();
  const int count = exercise_ ? exercise_->effects() : 1;
  for (int i = 0; i < count; ++i) {
    AnswerRow row;
    row.widget = new QWidget;
    auto* lines = new QGridLayout(row.widget);
    lines->setContentsMargins(0, 0, 0, 0);
    lines->setSpacing(sizes::half_step);
    row.family = new QComboBox;
    row.family->setAccessibleName(tr("Family of effect %1").arg(i + 1));
    row.effect = new QComboBox;
    row.effect->setAccessibleName(tr("Effect %1").arg(i + 1));
    row.driver = new QComboBox;
    row.driver->setAccessibleName(tr("Driver of effect %1").arg(i + 1));
    row.kind = new QComboBox;
    row.kind->setAccessibleName(tr("Kind of the size of effect %1").arg(i + 1));
    row.size = new QuantityBox(QStringLiteral("um"), 1);
    row.size->setAccessibleName(tr("Size of effect %1").arg(i + 1));
    row.size->setRange(0.0, 10'000.0);
    row.size->setSpecialValueText(tr("size not given"));
    for (QComboBox* box : {row.family, row.effect, row.driver}) {
      box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
      box->setMinimumContentsLength(12);
    }
    // Titles of effects are long: two lines for each.
    lines->addWidget(row.family, 0, 0);
    lines->addWidget(row.effect, 0, 1);
    auto* size = new QHBoxLayout;
    size->addWidget(row.kind);
    size->addWidget(row.size, 1);
    lines->addLayout(size, 1, 0);
    lines->addWidget(row.driver, 1, 1);
    lines->setColumnStretch(0, 2);
    lines->setColumnStretch(1, 5);
    row.family->addItem(tr("Family …"));
    QStringList seen;
    for (const ExerciseChoice& choice : choices_) {
      const QString family = fromCore(choice.family);
      if (seen.contains(family)) continue;
      seen << family;
      row.family->addItem(familyTitle(choice.family), family);
    }
    fillEffects(row);
    connect(row.family, &QComboBox::currentIndexChanged, this, [this, row] { fillEffects(row); });
    connect(row.effect, &QComboBox::currentIndexChanged, this, [this, row] { fillDetails(row); });
    connect(row.kind, &QComboBox::currentIndexChanged, this, [row] {
      if (row.kind->currentIndex() >= 0) row.size->setUnit(row.kind->currentData().toString());
    });
    answer_rows_->addWidget(row.widget);
    rows_.push_back(row);
  }
}

void ExerciseDialog::fillEffects(const AnswerRow& row) {
  row.effect->clear();
  row.effect->addItem(tr("Effect …"));
  const std::string family = row.family->currentData().toString().toStdString();
  for (const ExerciseChoice& choice : choices_)
    if (choice.family == family) row.effect->addItem(sentenceStart(effectTitle(choice.id)), fromCore(choice.id));
  fillDetails(row);
}

void ExerciseDialog::fillDetails(const AnswerRow& row) {
  row.driver->clear();
  const ExerciseChoice* choice = chosen(row);
  // A size is of a kind that the effect changes; the one chosen stays where it can.
  const QVariant kind = row.kind->currentData();
  row.kind->clear();
  for (const auto& [unit, title] :
       {std::pair(QStringLiteral("um"), tr("Displacement")), std::pair(QStringLiteral("urad"), tr("Rotation"))}) {
    if (choice == nullptr ||
        std::find(choice->units.begin(), choice->units.end(), unit.toStdString()) != choice->units.end())
      row.kind->addItem(title, unit);
  }
  if (const int at = row.kind->findData(kind); at >= 0) row.kind->setCurrentIndex(at);
  if (choice == nullptr) {
    row.driver->addItem(tr("Driver …"));
  } else if (choice->drivers.empty()) {
    row.driver->addItem(tr("Nothing in the log"));
  } else {
    row.driver->addItem(tr("Driver …"));
    for (const std::string& driver : choice->drivers) row.driver->addItem(driverWords(driver), fromCore(driver));
  }
}

const ExerciseChoice* ExerciseDialog::chosen(const AnswerRow& row) const {
  const std::string id = row.effect->currentData().toString().toStdString();
  const auto found = std::find_if(choices_.begin(), choices_.end(), [&](const auto& c) { return c.id == id; });
  return found == choices_.end() ? nullptr : &*found;
}

bool ExerciseDialog::pick(int row, const std::string& id, const std::string& driver,
                          const std::optional<NamedSize>& size) {
  const AnswerRow& one = rows_.at(static_cast<std::size_t>(row));
  const auto found = std::find_if(choices_.begin(), choices_.end(), [&](const auto& c) { return c.id == id; });
  if (found == choices_.end()) return false;
  one.family->setCurrentIndex(one.family->findData(fromCore(found->family)));
  one.effect->setCurrentIndex(one.effect->findData(fromCore(id)));
  if (const int at = one.driver->findData(fromCore(driver)); at >= 0) one.driver->setCurrentIndex(at);
  one.size->setValue(0.0);
  if (size) {
    const int kind = one.kind->findData(fromCore(size->unit));
    if (kind < 0) return false;
    one.kind->setCurrentIndex(kind);
    one.size->setValue(size->value);
  }
  return one.effect->currentIndex() > 0;
}

std::vector<std::string> ExerciseDialog::sizeUnits(int row) const {
  const QComboBox* kind = rows_.at(static_cast<std::size_t>(row)).kind;
  std::vector<std::string> out;
  for (int i = 0; i < kind->count(); ++i) out.push_back(kind->itemData(i).toString().toStdString());
  return out;
}

void ExerciseDialog::withKey(const QString& title, std::function<void(const ExerciseKey&)> use) {
  if (key_) {
    use(*key_);
    return;
  }
  hint_->setEnabled(false);
  answer_->setEnabled(false);
  Job job;
  job.title = title;
  job.work = [this, exercise = *exercise_, folder = campaign_,
              use = std::move(use)](JobContext& context) -> std::function<void()> {
    auto key = std::make_shared<ExerciseKey>(exerciseKey(exercise, context));
    return [this, folder, key, use] {
      if (folder != campaign_) return;  // another one was opened meanwhile
      key_ = std::move(*key);
      use(*key_);
      refresh();
    };
  };
  job.failed = [this](const QString& sentence) {
    refresh();
    state_->set(Tone::Bad, sentence);
  };
  job.cancelled = [this] { refresh(); };
  jobs_.run(std::move(job));
}

void ExerciseDialog::showHint() {
  withKey(tr("Looking up the hint"), [this](const ExerciseKey& key) {
    if (hints_ >= exercise_hints) return;
    const QString next = hintSentence(key, ++hints_);
    hint_text_->setText(hint_text_->text().isEmpty() ? next : QStringLiteral("%1\n%2").arg(hint_text_->text(), next));
    refresh();
  });
}

void ExerciseDialog::giveAnswer() {
  withKey(tr("Marking the answer"), [this](const ExerciseKey& key) { showScore(key); });
}

void ExerciseDialog::showScore(const ExerciseKey& key) {
  ExerciseAnswer answer;
  answer.hints = hints_;
  answer.searched_before = session_.result("discrepancy").has_value();
  for (const AnswerRow& row : rows_) {
    const ExerciseChoice* choice = chosen(row);
    if (choice == nullptr) continue;
    AnsweredEffect named{choice->id, row.driver->currentData().toString().toStdString(), std::nullopt};
    if (row.size->value() > 0.0) named.size = {row.size->value(), row.kind->currentData().toString().toStdString()};
    answer.named.push_back(std::move(named));
  }
  try {
    score_ = scoreExercise(key, answer);
  } catch (const InputError& error) {
    state_->set(Tone::Attention, QString::fromUtf8(error.what()));
    return;
  }
  std::vector<Row> rows;
  const auto verdict = [](bool right, const QString& text) {
    Cell cell = toneCell(text, right ? Tone::Good : Tone::Bad);
    cell.icon = toneIcon(cell.tone);
    return cell;
  };
  for (const ExerciseScore::Line& line : score_->lines) {
    const EffectSize& true_size = line.size();
    const QString unit = unitText(unitOf(true_size.component));
    const QString size =
        tr("%1 in %2").arg(withError(true_size.value, true_size.uncertainty, unit), componentName(true_size.component));
    QString driver = tr("nothing in the log");
    if (!line.hidden.drivers.empty()) driver = driverWords(line.hidden.drivers.front());
    Row row;
    row.id = fromCore(line.hidden.id);
    row.cells = {nameCell(sentenceStart(effectTitle(line.hidden.id))),
                 line.named.empty() ? verdict(false, tr("no"))
                 : line.exact       ? verdict(true, tr("yes"))
                                    : toneCell(tr("nearly: %1").arg(effectTitle(line.named)), Tone::Attention),
                 verdict(line.driver_right, driver),
                 verdict(line.size_right, size),
                 numberCell(line.marks, 0),
                 {}};
    rows.push_back(std::move(row));
  }
  for (const std::string& id : score_->wrong) {
    Row row;
    row.id = fromCore(id);
    row.cells = {
        nameCell(QStringLiteral("–")), verdict(false, tr("not there: %1").arg(effectTitle(id))), {}, {}, {}, {}};
    rows.push_back(std::move(row));
  }
  results_->setRows(std::move(rows));
  const int total = score_->total;
  QString sentence = tr("%1 of 100.").arg(total);
  if (score_->answer.hints > 0) sentence += QLatin1Char(' ') + tr("Hints used: %1.").arg(score_->answer.hints);
  if (score_->answer.searched_before)
    sentence += QLatin1Char(' ') + tr("The search had been run before: half the marks.");
  state_->set(total >= 80 ? Tone::Good : total >= 40 ? Tone::Attention : Tone::Bad, sentence);
  addToExerciseHistory({QLocale().toString(QDateTime::currentDateTime(), QLocale::ShortFormat),
                        fromCore(std::string(toString(exercise_->level))), exercise_->seed, total, hints_});
  refreshHistory();
  refresh();
}

void ExerciseDialog::refreshHistory() {
  std::vector<Row> rows;
  for (const ExerciseRecord& record : exerciseHistory()) {
    Row row;
    row.cells = {{record.when},
                 {levelTitle(record.level)},
                 {QString::number(record.seed)},
                 numberCell(record.score, 0),
                 numberCell(record.hints, 0),
                 {}};
    rows.push_back(std::move(row));
  }
  history_->setRows(std::move(rows));
}

}  // namespace spindrift::gui
