// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/imaging/fiducial_capture_page.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QSplitter>
#include <QTableView>
#include <QVBoxLayout>
#include <set>

#include "core/base/csv.h"
#include "core/base/error.h"
#include "core/imaging/decoder.h"
#include "core/imaging/evaluate_fiducials.h"
#include "core/imaging/image.h"
#include "core/workflows/capture_check.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/common/wrap_layout.h"
#include "widgets/image_view/decode_marks.h"
#include "widgets/image_view/image_view.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/panels/capture/capture_tabs.h"
#include "widgets/panels/common/exclude_items.h"
#include "widgets/services/incoming_service.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {
namespace {

QString roleName(const QString& role) {
  if (role == QLatin1String("rotation")) return FiducialCapturePage::tr("rotation");
  if (role == QLatin1String("x_axis")) return FiducialCapturePage::tr("along X");
  if (role == QLatin1String("y_axis")) return FiducialCapturePage::tr("along Y");
  if (role == QLatin1String("focus")) return FiducialCapturePage::tr("focus");
  return role;
}

QString roleNumber(double value) {
  return decimalText(value, 'g', 6);
}

/// How many captures of a role the evaluation needs at least.
int needed(const QString& role) {
  return role == QLatin1String("focus") ? 5 : 3;
}

}  // namespace

FiducialCapturePage::FiducialCapturePage(PageContext page_context, QWidget* parent)
    : Page(std::move(page_context), StepId::Capture, parent) {
  check_ = makeButton(tr("Check all captures"), nullptr, "primary");
  addAction(check_);

  auto* list = new Card(tr("Captures"));
  auto* filters = new QHBoxLayout;
  state_filter_ = new QComboBox;
  state_filter_->setAccessibleName(tr("Thermal state"));
  verdict_filter_ = new QComboBox;
  verdict_filter_->setAccessibleName(tr("Verdict"));
  verdict_filter_->addItems({tr("All verdicts"), tr("Good"), tr("Bad"), tr("Not checked"), tr("Excluded")});
  filters->addWidget(state_filter_, 1);
  filters->addWidget(verdict_filter_, 1);
  list->body()->addLayout(filters);
  model_ = new RowsModel({tr("Capture"), tr("State"), tr("Role"), tr("Verdict"), tr("Blur / px")}, this);
  table_ = makeTable(model_, tr("Captures"), tr("No capture has this state and verdict."));
  list->body()->addWidget(table_, 3);
  list->body()->addWidget(makeLabel(tr("Plan: taken of needed"), "sectionTitle"));
  plan_ = new RowsModel({tr("Fiducial"), tr("State"), tr("Rotation"), tr("X"), tr("Y"), tr("Focus")}, this);
  auto* plan_table = makeTable(plan_, tr("Plan"), tr("The plan appears with the first capture."));
  plan_table->setSelectionMode(QAbstractItemView::NoSelection);
  list->body()->addWidget(plan_table, 2);
  list->setMinimumWidth(500);  // all columns of the plan

  auto* picture = new Card(tr("Image"));
  badge_ = new Badge;
  picture->addToTitle(badge_);
  image_ = new ImageView;
  image_->setEmptyText(tr("The image will appear here"),
                       tr("Choose a capture in the list. What was decoded is drawn on top."));
  picture->body()->addWidget(image_, 1);
  verdict_ = new Callout;
  picture->body()->addWidget(verdict_);
  auto* buttons = new WrapLayout;
  exclude_ = makeButton(tr("Exclude …"), "exclude");
  exclude_->setToolTip(
      tr("Leave what is chosen in the list out of the evaluation; it stays on the disk and can be brought back"));
  overlay_ = makeButton(tr("Overlay"), "eye");
  overlay_->setCheckable(true);
  overlay_->setChecked(true);
  auto* fit = makeButton(tr("Whole image"), "fit-window");
  buttons->addWidget(exclude_);
  buttons->addWidget(overlay_);
  buttons->addWidget(fit);
  picture->body()->addLayout(buttons);
  content()->addWidget(captureTabs(this, makeSplitter(nullptr, list, picture, 5, 7), context(), Instrument::Microscope),
                       1);
  showHints(image_);

  connect(check_, &QPushButton::clicked, this, [this] { runTask("check"); });
  connect(state_filter_, &QComboBox::activated, this, &FiducialCapturePage::fillTable);
  connect(verdict_filter_, &QComboBox::activated, this, &FiducialCapturePage::fillTable);
  connect(fit, &QPushButton::clicked, image_, &ImageView::fit);
  connect(overlay_, &QPushButton::toggled, image_, &ImageView::setMarksVisible);
  connect(exclude_, &QPushButton::clicked, this, &FiducialCapturePage::toggleExcluded);
  connect(table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
          [this](const QModelIndex& now) { showImage(model_->idAt(now.row())); });
  connect(table_->selectionModel(), &QItemSelectionModel::selectionChanged, this, &FiducialCapturePage::offerExclusion);
}

void FiducialCapturePage::load() {
  captures_.clear();
  const auto campaign = session().campaign();
  const auto file = campaign == nullptr ? std::nullopt : campaign->captureList("fiducials.csv");
  if (!file) return;
  try {
    const CsvTable table = CsvTable::read(*file);
    const std::size_t state = table.column("state");
    const std::size_t fiducial = table.column("fiducial");
    const std::size_t role = table.column("role");
    const std::size_t index = table.column("index");
    const std::size_t z = table.column("z_mm");
    const std::size_t spindle = table.column("spindle_deg");
    const std::size_t image = table.column("image");
    for (std::size_t r = 0; r < table.rowCount(); ++r) {
      ListedCapture c;
      c.image = QString::fromStdString(table.requiredText(r, image));
      c.state = QString::fromStdString(std::string(table.text(r, state)));
      c.fiducial = QString::fromStdString(table.requiredText(r, fiducial));
      c.role = QString::fromStdString(table.requiredText(r, role));
      c.index = static_cast<int>(table.number(r, index));
      c.z_mm = table.number(r, z);
      c.spindle_deg = table.number(r, spindle);
      captures_.push_back(std::move(c));
    }
  } catch (const InputError& e) {
    callout()->show(Tone::Bad, coreSentence(e.what()));
  }
  if (const auto stored = session().result("check")) {
    std::map<QString, const nlohmann::json*> by_image;
    for (const auto& entry : stored->payload.at("captures")) {
      by_image[QString::fromStdString(entry.at("image").get<std::string>())] = &entry;
    }
    for (ListedCapture& c : captures_) {
      const auto found = by_image.find(c.image);
      if (found == by_image.end()) continue;
      const nlohmann::json& e = *found->second;
      c.checked = true;
      c.good = e.at("good").get<bool>();
      c.sentence = coreSentence(e.at("sentence").get<std::string>());
      c.ellipses = e.at("ellipses").get<int>();
      c.sharpness_px = e.at("blur_px").get<double>();
    }
  }
}

void FiducialCapturePage::refresh() {
  if (session().campaign() == nullptr) return;
  const bool other = noticeCampaign();
  if (other) {
    chooseCaptureTab(*this, session());
    verdict_filter_->setCurrentIndex(0);
    clearImage();
  }
  callout()->setAction({}, {});
  callout()->set(Tone::Neutral, {});
  load();
  QStringList states;
  for (const ListedCapture& c : captures_) {
    if (!states.contains(c.state)) states << c.state;
  }
  const QString chosen = other ? QString() : state_filter_->currentData().toString();
  state_filter_->clear();
  state_filter_->addItem(tr("All states"), QString());
  for (const QString& s : states) state_filter_->addItem(tr("State %1").arg(s), s);
  state_filter_->setCurrentIndex(std::max(0, state_filter_->findData(chosen)));
  fillTable();
  fillPlan();

  std::vector<const ListedCapture*> bad;
  for (const ListedCapture& c : captures_) {
    if (c.checked && !c.good && !session().excluded().contains(c.image)) bad.push_back(&c);
  }
  const auto unchecked =
      std::count_if(captures_.begin(), captures_.end(), [](const ListedCapture& c) { return !c.checked; });
  if (callout()->sentence().isEmpty()) {
    if (captures_.empty()) {
      callout()->show(Tone::Attention, tr("The campaign lists no captures yet."));
    } else if (unchecked == static_cast<std::ptrdiff_t>(captures_.size())) {
      const QString arrived = IncomingService::of(session()).checkedOnArrival(static_cast<int>(captures_.size()));
      callout()->show(Tone::Accent, !arrived.isEmpty() ? arrived
                                                       : tr("%n captures are there and none is checked yet. Checking "
                                                            "decodes every image and says which to take again.",
                                                            nullptr, static_cast<int>(captures_.size())));
    } else if (const ResultState check = session().state("check"); check.there && !check.current) {
      callout()->show(Tone::Outdated, tr("Changed since: %1. Check the captures again.").arg(check.changed));
    } else if (!bad.empty()) {
      showBad(bad);
    } else {
      showComplete();
    }
  }
  if (other || shown_.isEmpty()) {
    // A row that was already the current one does not become it again.
    if (model_->rowCount() > 0) table_->selectRow(0);
    if (model_->rowCount() > 0 && shown_.isEmpty()) showImage(model_->idAt(0));
  } else {
    const int row = model_->rowOf(shown_);
    if (row >= 0) table_->selectRow(row);
    showImage(shown_);
  }
}

void FiducialCapturePage::showComplete() {
  const auto excluded = std::count_if(captures_.begin(), captures_.end(), [this](const ListedCapture& c) {
    return session().excluded().contains(c.image);
  });
  QString text = excluded == 0
                     ? tr("All %n captures are checked and can be used.", nullptr, static_cast<int>(captures_.size()))
                     : tr("Of %n captures %1 can be used, %2 excluded.", nullptr, static_cast<int>(captures_.size()))
                           .arg(static_cast<std::ptrdiff_t>(captures_.size()) - excluded)
                           .arg(tr("%n are", nullptr, static_cast<int>(excluded)));
  QStringList lacking;
  for (const Row& row : plan_->rows()) {
    for (std::size_t c = 2; c < row.cells.size(); ++c) {
      if (row.cells[c].tone != Tone::Attention) continue;
      lacking << tr("%1 in state %2 has %3 for %4")
                     .arg(row.cells[0].text, row.cells[1].text, row.cells[c].text,
                          plan_->headerData(static_cast<int>(c), Qt::Horizontal, Qt::DisplayRole).toString().toLower());
    }
  }
  if (!lacking.isEmpty()) text += tr(" Too few: %1.").arg(firstOf(lacking));
  callout()->show(lacking.isEmpty() ? Tone::Good : Tone::Attention, text);
}

void FiducialCapturePage::showBad(const std::vector<const ListedCapture*>& bad) {
  QStringList names;
  for (const ListedCapture* c : bad) {
    names << tr("%1 in state %2, %3 %4").arg(c->fiducial, c->state, roleName(c->role)).arg(c->index);
  }
  callout()->setAction(tr("Show it"), [this, image = bad.front()->image] {
    state_filter_->setCurrentIndex(0);
    verdict_filter_->setCurrentIndex(0);
    fillTable();
    select(image);
  });
  callout()->show(Tone::Attention, tr("%n of %1 captures failed the check (%2). Take them again, or exclude them: what "
                                      "decodes of them is evaluated as it is.",
                                      nullptr, static_cast<int>(bad.size()))
                                       .arg(captures_.size())
                                       .arg(firstOf(names)));
}

void FiducialCapturePage::fillTable() {
  std::vector<Row> rows;
  const QString state = state_filter_->currentData().toString();
  for (const ListedCapture& c : captures_) {
    const bool excluded = session().excluded().contains(c.image);
    if (!state.isEmpty() && c.state != state) continue;
    switch (verdict_filter_->currentIndex()) {
      case 1:
        if (!c.checked || !c.good || excluded) continue;
        break;
      case 2:
        if (!c.checked || c.good || excluded) continue;
        break;
      case 3:
        if (c.checked) continue;
        break;
      case 4:
        if (!excluded) continue;
        break;
      default:
        break;
    }
    Row row;
    row.id = c.image;
    row.faded = excluded;
    row.cells = {
        {QStringLiteral("%1 · %2").arg(c.fiducial).arg(c.index), Tone::Neutral, nullptr, false, false, {}, c.image},
        {c.state},
        {roleName(c.role)},
        {}};
    if (excluded) {
      row.cells[3] = {tr("excluded"), Tone::Neutral, "exclude"};
      row.cells[3].tip = session().excluded().at(c.image);
    } else if (!c.checked) {
      row.cells[3] = {tr("not checked"), Tone::Neutral, "not-started"};
    } else if (c.good) {
      row.cells[3] = {tr("good"), Tone::Good, "check-circle"};
    } else {
      row.cells[3] = {tr("bad"), Tone::Bad, "error"};
    }
    if (row.cells[3].tip.isEmpty()) row.cells[3].tip = c.sentence;
    Cell blur;
    blur.text = c.checked && c.sharpness_px > 0 ? decimalText(c.sharpness_px, 'f', 1) : QStringLiteral("–");
    row.cells.push_back(blur);
    rows.push_back(std::move(row));
  }
  model_->setRows(std::move(rows));
  offerExclusion();
}

void FiducialCapturePage::fillPlan() {
  struct Count {
    std::map<QString, int> usable, taken;
  };
  std::vector<std::pair<QString, QString>> order;
  std::map<std::pair<QString, QString>, Count> counts;
  std::set<QString> with_axes;
  for (const ListedCapture& c : captures_) {
    const auto key = std::make_pair(c.fiducial, c.state);
    if (!counts.contains(key)) order.push_back(key);
    Count& count = counts[key];
    ++count.taken[c.role];
    if (!session().excluded().contains(c.image) && (!c.checked || c.good)) ++count.usable[c.role];
    if (c.role.endsWith(QLatin1String("_axis"))) with_axes.insert(c.state);
  }
  std::vector<Row> rows;
  for (const auto& key : order) {
    const Count& count = counts[key];
    Row row;
    row.id = key.first + key.second;
    row.cells = {{key.first}, {key.second}};
    for (const char* role : {"rotation", "x_axis", "y_axis", "focus"}) {
      const QString name = QString::fromLatin1(role);
      const auto found = count.usable.find(name);
      const int have = found == count.usable.end() ? 0 : found->second;
      Cell cell;
      if (name.endsWith(QLatin1String("_axis")) && !count.taken.contains(name) && !with_axes.contains(key.second)) {
        cell.text = tr("as before");
        cell.tip = tr("Directions of the axes are measured once, in the reference state.");
      } else {
        cell.text = QStringLiteral("%1/%2").arg(have).arg(needed(name));
        cell.tone = have >= needed(name) ? Tone::Good : Tone::Attention;
        cell.icon = have >= needed(name) ? "check" : "alert";
      }
      row.cells.push_back(cell);
    }
    rows.push_back(std::move(row));
  }
  plan_->setRows(std::move(rows));
}

const ListedCapture* FiducialCapturePage::find(const QString& image) const {
  for (const ListedCapture& c : captures_) {
    if (c.image == image) return &c;
  }
  return nullptr;
}

void FiducialCapturePage::select(const QString& image) {
  const int row = model_->rowOf(image);
  if (row >= 0) table_->selectRow(row);
}

void FiducialCapturePage::showImage(const QString& image) {
  const ListedCapture* capture = find(image);
  if (capture == nullptr) return;
  const bool same = shown_ == image && !image_->empty();
  shown_ = image;
  offerExclusion();
  if (session().excluded().contains(image)) {
    badge_->set(QStringLiteral("exclude"), Tone::Neutral, tr("excluded"));
    verdict_->show(Tone::Neutral, tr("Excluded: %1").arg(session().excluded().at(image)));
  } else if (!capture->checked) {
    badge_->set(QStringLiteral("not-started"), Tone::Neutral, tr("not checked"));
    verdict_->set(Tone::Neutral, {});
  } else {
    badge_->set(QString::fromLatin1(capture->good ? "check-circle" : "error"), capture->good ? Tone::Good : Tone::Bad,
                capture->good ? tr("good") : tr("bad"));
    verdict_->show(capture->good ? Tone::Good : Tone::Bad, capture->sentence);
  }
  image_->setCaption(tr("%1, state %2, %3 %4, spindle %5°, z %6 mm")
                         .arg(capture->fiducial, capture->state, roleName(capture->role))
                         .arg(capture->index)
                         .arg(roleNumber(capture->spindle_deg), roleNumber(capture->z_mm)));
  if (same) return;
  // Decoded in the background; only the last choice is shown.
  const int request = ++request_;
  const std::filesystem::path file = session().campaign()->path(image.toStdString());
  Job job;
  job.queue = JobQueue::Display;
  job.key = "image";
  job.quiet = true;
  job.title = tr("Decoding %1").arg(QString::fromStdString(file.filename().string()));
  job.work = [this, file, request, folder = session().campaign()->folder](JobContext&) -> std::function<void()> {
    const GrayImage gray = readImage(file);
    const QImage shown = toImage(gray);
    const std::shared_ptr<const FiducialPattern> pattern = campaignPattern(folder);
    const DecodeResult decoded = decodeImage(gray, *pattern);
    return [this, shown, marks = marksOf(decoded, *pattern), request] {
      if (request != request_) return;
      image_->setImage(shown);
      image_->setMarks(marks);
    };
  };
  job.failed = [this, request](const QString& sentence) {
    if (request != request_) return;
    image_->setImage({});
    image_->setEmptyText(tr("This image cannot be shown"), sentence);
  };
  context().jobs.run(visitJob(session(), std::move(job)));
}

void FiducialCapturePage::clearImage() {
  ++request_;
  shown_.clear();
  image_->setImage({});
  image_->setMarks({});
  image_->setCaption({});
  badge_->set({}, Tone::Neutral, {});
  verdict_->set(Tone::Neutral, {});
  offerExclusion();
}

QStringList FiducialCapturePage::chosen() const {
  // What is shown need not stand in the list, which is filtered.
  const QStringList selected = selectedIds(*table_, *model_);
  return selected.size() > 1 || shown_.isEmpty() ? selected : QStringList{shown_};
}

void FiducialCapturePage::offerExclusion() {
  exclude_->setEnabled(!chosen().isEmpty());
  exclude_->setText(QChar(0x2009) + excludeText(session(), chosen()));
}

void FiducialCapturePage::toggleExcluded() {
  const ListedCapture* capture = chosen().size() == 1 ? find(chosen().front()) : nullptr;
  excludeOrBringBack(context(), this, chosen(),
                     capture != nullptr && capture->checked && !capture->good ? capture->sentence : tr("disturbed"));
}

std::vector<Exportable> FiducialCapturePage::exportables() {
  std::vector<Exportable> items{exportableOf(tr("Captures"), model_), exportableOf(tr("Capture plan"), plan_)};
  if (!image_->empty()) items.push_back(exportableOf(tr("Image with overlay"), image_));
  return items;
}

}  // namespace spindrift::gui
