// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/scanning/scan_capture_page.h"

#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <QSplitter>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/tasks/scan_check_payload.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/common/wrap_layout.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/panels/capture/capture_tabs.h"
#include "widgets/panels/common/exclude_items.h"
#include "widgets/panels/scanning/cloud_painter.h"
#include "widgets/panels/scanning/profile_series.h"
#include "widgets/panels/scanning/scan_mask_bar.h"
#include "widgets/plots/plot.h"
#include "widgets/services/incoming_service.h"
#include "widgets/services/scan_results.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
ScanCapturePage::ScanCapturePage(PageContext page_context, QWidget* parent)
    : Page(std::move(page_context), StepId::Capture, parent), results_(ScanResults::of(session())) {
  setInstruction(tr("Scan every artefact in every cycle, check the clouds, and scan incomplete ones again."));
  check_ = makeButton(tr("Check the scans"), nullptr, "primary");
  addAction(check_);

  auto* list = new Card(tr("Scans"));
  rows_ = new RowsModel({tr("Scan"), tr("At / min"), tr("State"), tr("Points"), tr("Coverage / %")}, this);
  table_ = makeTable(rows_, tr("Scans"), tr("Scans appear with the first row of captures/scans.csv."));
  list->body()->addWidget(table_, 1);
  verdict_ = new Callout;
  list->body()->addWidget(verdict_);
  auto* buttons = new QHBoxLayout;
  exclude_ = makeButton(tr("Exclude …"), "exclude");
  exclude_->setToolTip(
      tr("Leave what is chosen in the list out of the evaluation; it stays on the disk and can be brought back"));
  buttons->addWidget(exclude_);
  buttons->addStretch();
  list->body()->addLayout(buttons);

  auto* right = new Card;
  colouring_ = new Segments({tr("Height"), tr("Both"), tr("Change"), tr("Residual"), tr("Used")}, tr("Colours"));
  colouring_->button(1)->setToolTip(tr("Cold and warm, one over the other"));
  colouring_->button(2)->setToolTip(tr("Height over the cold scan as it was measured"));
  colouring_->button(3)->setToolTip(tr("Height over the cold scan after registration"));
  colouring_->button(4)->setToolTip(tr("0 used, 1 near an edge, 2 outlier, 3 masked"));
  part_ = new Segments({tr("Before"), tr("After"), tr("Side by side")}, tr("Before or after cleaning"));
  part_->setToolTip(tr("Before or after edge trimming, outlier removal and masking"));
  part_->setCurrent(1);
  auto* choices = new WrapLayout;
  choices->addWidget(colouring_);
  choices->addWidget(part_);
  right->body()->addLayout(choices);
  before_view_ = new View3D;
  before_view_->hide();
  view_ = new View3D;
  view_->link(before_view_);
  mask_ = new ScanMaskBar(view_, session(), context().undo);
  right->body()->addWidget(mask_);
  view_->setEmptyText(tr("The cloud will appear here"), tr("Choose a scan in the list. It is read in the background."));
  profile_ = new Plot;
  profile_->setAxes(tr("Along the profile / mm"), tr("Height / mm"));
  profile_->setEmptyText(tr("A profile will appear here"), tr("Choose a scan in the list."));
  auto* views = new QHBoxLayout;
  for (View3D* view : {before_view_, view_}) view->setMinimumHeight(150);  // the profile below needs room as well
  views->addWidget(before_view_, 1);
  views->addWidget(view_, 1);
  right->body()->addLayout(views, 5);
  auto* line = new QHBoxLayout;
  line->addWidget(makeLabel(tr("Profile"), "sectionTitle"));
  slider_ = new QSlider(Qt::Horizontal);
  slider_->setAccessibleName(tr("Profile shown"));
  slider_->setMinimumHeight(sizes::control_height);
  slider_->setEnabled(false);
  line->addWidget(slider_, 1);
  slider_text_ = new QLabel;
  slider_text_->setMinimumWidth(150);
  line->addWidget(slider_text_);
  right->body()->addLayout(line);
  right->body()->addWidget(profile_, 3);
  content()->addWidget(captureTabs(this, makeSplitter(nullptr, list, right, 4, 7), context(), Instrument::Profiler), 1);
  showHints(profile_);
  showHints(view_);

  connect(check_, &QPushButton::clicked, this, [this] { runTask("check"); });
  connect(exclude_, &QPushButton::clicked, this, &ScanCapturePage::toggleExcluded);
  connect(colouring_, &Segments::chosen, this, &ScanCapturePage::loadCloud);
  connect(part_, &Segments::chosen, this, [this](int part) {
    before_view_->setVisible(part == 2);
    loadCloud();
  });
  connect(mask_, &ScanMaskBar::restoring, this, [this] {
    // What is masked has to be seen to be taken back.
    colouring_->setCurrent(static_cast<int>(ScanColouring::LeftOut));
    if (part_->current() == 1) part_->setCurrent(0);
    loadCloud();
  });
  connect(slider_, &QSlider::valueChanged, this, &ScanCapturePage::showProfile);
  connect(table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this, [this](const QModelIndex& now) {
    if (filling_ || !now.isValid()) return;
    showVerdict();
    loadCloud();
  });
  connect(table_->selectionModel(), &QItemSelectionModel::selectionChanged, this, &ScanCapturePage::offerExclusion);
}

QString ScanCapturePage::selected() const {
  const QModelIndex now = table_->selectionModel()->currentIndex();
  return now.isValid() ? rows_->idAt(now.row()) : QString();
}

std::string ScanCapturePage::referenceOf(const std::string& cloud) const {
  const std::vector<ScanCapture>& all = results_.captures();
  const auto own = std::find_if(all.begin(), all.end(), [&](const ScanCapture& c) { return c.cloud == cloud; });
  if (own == all.end()) return {};
  for (const ScanCapture& c : all) {
    if (c.artefact == own->artefact && !session().excluded().contains(fromCore(c.cloud))) return c.cloud;
  }
  return {};
}

void ScanCapturePage::refresh() {
  if (session().campaign() == nullptr) return;
  const bool other = noticeCampaign();
  if (other) chooseCaptureTab(*this, session());
  if (other) {
    picture_ = before_picture_ = {};
    shown_.clear();
    mask_->setCloud({});
    before_view_->clear();
    view_->clear();
    profile_->setContent({});
  }
  checks_.clear();
  if (const auto stored = session().result("check"); stored && stored->payload.contains("scans")) {
    for (const ScanCheck& c : scanChecksFrom(stored->payload)) checks_[fromCore(c.capture.cloud)] = c;
  }
  fillTable();
  const std::vector<ScanCapture>& captures = results_.captures();
  QStringList bad;
  QString first_bad;
  for (const ScanCapture& c : captures) {
    const auto check = checks_.find(fromCore(c.cloud));
    if (check == checks_.end() || (check->second.usable && check->second.reason.empty()) ||
        session().excluded().contains(check->first))
      continue;
    if (bad.isEmpty()) first_bad = check->first;
    bad << QStringLiteral("%1 · %2").arg(fromCore(c.artefact), fromCore(c.cycle));
  }
  callout()->setAction({}, {});
  if (!results_.failure().isEmpty()) {
    callout()->show(Tone::Bad, results_.failure());
  } else if (checks_.empty()) {
    const QString arrived = IncomingService::of(session()).checkedOnArrival(static_cast<int>(captures.size()));
    callout()->show(Tone::Accent, !arrived.isEmpty()
                                      ? arrived
                                      : tr("%n scans are there and none is checked yet. Checking reads every cloud and "
                                           "says which to take again.",
                                           nullptr, static_cast<int>(captures.size())));
  } else if (!session().state("check").current) {
    callout()->show(Tone::Outdated,
                    tr("Changed since: %1. Check the scans again.").arg(session().state("check").changed));
  } else if (!bad.isEmpty()) {
    callout()->setAction(tr("Show it"), [this, first_bad] { select(first_bad); });
    callout()->show(Tone::Attention, tr("%n of %1 scans are incomplete or cannot be used (%2). Scan again, or exclude "
                                        "them: the others are evaluated without them.",
                                        nullptr, static_cast<int>(bad.size()))
                                         .arg(captures.size())
                                         .arg(firstOf(bad)));
  } else {
    callout()->show(Tone::Good,
                    tr("All %n scans are complete and can be used.", nullptr, static_cast<int>(captures.size())));
  }
  if (selected().isEmpty() && rows_->rowCount() > 0) {
    table_->selectRow(0);
  } else if (!selected().isEmpty() &&
             (shown_ != selected() || shown_mask_ != ScanMaskBar::maskOf(session(), shown_).first)) {
    loadCloud();
  }
  showVerdict();
}

void ScanCapturePage::fillTable() {
  const QString chosen = selected();
  std::map<QString, QString> rejected;
  if (const auto evaluation = session().evaluation()) {
    for (const RejectedCapture& r : evaluation->rejected) rejected[fromCore(r.capture)] = coreSentence(r.reason);
  }
  std::vector<Row> rows;
  for (const ScanCapture& c : results_.captures()) {
    Row row;
    row.id = fromCore(c.cloud);
    row.cells = {nameCell(QStringLiteral("%1 · %2").arg(fromCore(c.artefact), fromCore(c.cycle))),
                 numberCell(c.time_s / 60.0, 1)};
    const auto found = checks_.find(row.id);
    const ScanCheck* check = found == checks_.end() ? nullptr : &found->second;
    if (session().excluded().contains(row.id)) {
      row.faded = true;
      row.cells.push_back(Cell{tr("excluded"), Tone::Neutral, "exclude"});
      row.cells.back().tip = session().excluded().at(row.id);
    } else if (check == nullptr) {
      row.cells.push_back(toneCell(tr("not checked"), Tone::Neutral));
    } else if (!check->usable || rejected.contains(row.id)) {
      row.cells.push_back(toneCell(tr("rejected"), Tone::Bad));
      row.cells.back().tip = rejected.contains(row.id) ? rejected[row.id] : coreSentence(check->reason);
    } else if (!check->reason.empty()) {
      row.cells.push_back(toneCell(tr("incomplete"), Tone::Attention));
      row.cells.back().tip = coreSentence(check->reason);
    } else {
      row.cells.push_back(toneCell(tr("good"), Tone::Good));
    }
    row.cells.push_back(check == nullptr ? dashCell() : numberCell(static_cast<double>(check->points), 0));
    row.cells.push_back(numberCell(check == nullptr ? std::nan("") : 100.0 * check->completeness, 0));
    rows.push_back(std::move(row));
  }
  filling_ = true;
  rows_->setRows(std::move(rows));
  if (const int at = rows_->rowOf(chosen); at >= 0) table_->selectRow(at);
  filling_ = false;
}

void ScanCapturePage::select(const QString& cloud) {
  const int row = rows_->rowOf(cloud);
  if (row >= 0) table_->selectRow(row);
}

void ScanCapturePage::setColouring(ScanColouring colouring) {
  colouring_->setCurrent(static_cast<int>(colouring));
  loadCloud();
}

void ScanCapturePage::setPart(int part) {
  part_->setCurrent(part);
  before_view_->setVisible(part == 2);
  loadCloud();
}

void ScanCapturePage::showVerdict() {
  const QString id = selected();
  offerExclusion();
  const bool excluded = session().excluded().contains(id);
  const int row = rows_->rowOf(id);
  if (row < 0) return verdict_->set(Tone::Neutral, {});
  const Cell& state = rows_->rows()[static_cast<std::size_t>(row)].cells[2];
  const auto check = checks_.find(id);
  if (excluded) {
    verdict_->show(Tone::Neutral, tr("Excluded: %1.").arg(session().excluded().at(id)));
  } else if (!state.tip.isEmpty()) {
    verdict_->show(state.tone, state.tip);
  } else if (check != checks_.end()) {
    QString sentence = tr("%1; not used: %2 and %3.")
                           .arg(tr("%n profiles", nullptr, static_cast<int>(check->second.profiles)),
                                tr("%n points near edges", nullptr, static_cast<int>(check->second.edge_points)),
                                tr("%n outliers", nullptr, static_cast<int>(check->second.outlier_points)));
    if (const auto [item, reason] = ScanMaskBar::maskOf(session(), id); !item.isEmpty())
      sentence += QLatin1Char(' ') + tr("A part is masked: %1.").arg(reason);
    verdict_->show(Tone::Good, sentence);
  } else {
    verdict_->set(Tone::Neutral, {});
  }
}

void ScanCapturePage::offerExclusion() {
  const QStringList chosen = selectedIds(*table_, *rows_);
  exclude_->setEnabled(!chosen.isEmpty());
  exclude_->setText(QChar(0x2009) + excludeText(session(), chosen));
}

void ScanCapturePage::toggleExcluded() {
  excludeOrBringBack(context(), this, selectedIds(*table_, *rows_), tr("bad scan"));
}

void ScanCapturePage::loadCloud() {
  const QString id = selected();
  const CampaignSnapshot snapshot = session().snapshot();
  if (id.isEmpty() || snapshot.campaign == nullptr) return;
  shown_ = id;
  mask_->setCloud(id);
  shown_mask_ = mask_->mask().first;
  const bool both = part_->current() == 2;
  const ScanPart part = part_->current() == 0 ? ScanPart::AsScanned : ScanPart::AsUsed;
  const int request = ++request_;
  const auto colouring = static_cast<ScanColouring>(colouring_->current());
  const std::string cloud = id.toStdString();
  const std::string reference = referenceOf(cloud);
  const ScanModel model = scanModelFromString(results_.modelOfMachine());
  Job job;
  job.queue = JobQueue::Display;
  job.key = "scan";
  job.title = tr("Reading %1").arg(QFileInfo(id).fileName());
  job.work = [this, snapshot, cloud, reference, colouring, model, request, part,
              both](JobContext& job_context) -> std::function<void()> {
    auto picture = std::make_shared<ScanPicture>(
        pictureOfScan(*snapshot.campaign, cloud, reference, colouring, model, job_context, part));
    auto before = std::make_shared<ScanPicture>();
    if (both)
      *before = pictureOfScan(*snapshot.campaign, cloud, reference, colouring, model, job_context, ScanPart::AsScanned);
    return std::function<void()>([this, picture, before, request] {
      if (request != request_) return;
      picture_ = *picture;
      before_picture_ = *before;
      showCloud();
    });
  };
  job.failed = [this, request](const QString& sentence) {
    if (request != request_) return;
    picture_ = before_picture_ = {};
    before_view_->clear();
    view_->clear();
    view_->setEmptyText(tr("This cloud cannot be shown"), sentence);
    profile_->setContent({});
    slider_->setEnabled(false);
  };
  context().jobs.run(visitJob(session(), std::move(job)));
}

void ScanCapturePage::showIn(View3D* view, const ScanPicture& picture, const QString& part) {
  ColourScale scale;
  QString caption =
      rows_->rowOf(shown_) < 0 ? shown_ : rows_->rows()[static_cast<std::size_t>(rows_->rowOf(shown_))].cells[0].text;
  caption += QStringLiteral(" (%1)").arg(part);
  switch (picture.colouring) {
    case ScanColouring::Height:
      scale.map = ColourMap::Sequential;
      scale.low = picture_.low;  // the same in both views
      scale.high = std::max(picture_.high, picture_.low + 1e-6);
      scale.title = tr("z");
      scale.unit = QStringLiteral("mm");
      if (!picture.message.empty()) {
        caption += QStringLiteral(": ") + coreSentence(picture.message);
      } else if (picture.reference == nullptr && colouring_->current() != 0) {
        caption += tr(": the reference itself");
      }
      break;
    case ScanColouring::Overlay:
      scale = ColourScale::symmetric(1.0, QString(), tr("cold, warm"));
      caption += tr(": blue the cold scan, red this one");
      break;
    case ScanColouring::LeftOut: {
      scale.map = ColourMap::Sequential;
      scale.low = 0.0;
      scale.high = 3.0;
      const auto& n = picture.counts;
      scale.title = tr("kind");
      caption += tr(": edge %1, outlier %2, masked %3").arg(n[1]).arg(n[2]).arg(n[3]);
      break;
    }
    default:
      scale = ColourScale::symmetric(std::max({std::abs(picture_.low), std::abs(picture_.high), 0.1}), tr("dz"),
                                     QStringLiteral("um"));
      caption += picture.colouring == ScanColouring::Measured
                     ? tr(" over the cold scan, median |dz| %1 µm").arg(decimalText(picture.median_magnitude, 'f', 2))
                     : tr(" after registration, median |dz| %1 µm").arg(decimalText(picture.median_magnitude, 'f', 2));
  }
  const Camera camera = view->camera();
  const bool first = view->empty();
  ViewCloud cloud;
  cloud.xyz_mm = picture.xyz_mm;
  cloud.scalar = picture.scalar;
  view->setColourScale(scale);
  view->setCloud(cloud);
  view->setCaption(caption);
  if (first && view == before_view_) {
    view_->setOrthographic(view_->camera().orthographic);  // tells the linked view where to look from
  } else if (first) {
    view->resetCamera(StandardView::Isometric);
  } else {
    view->setCamera(camera);  // the same place before and after a stroke
  }
}

void ScanCapturePage::showCloud() {
  const bool other = QString::fromStdString(picture_.scan == nullptr ? std::string() : picture_.scan->name) != drawn_;
  drawn_ = QString::fromStdString(picture_.scan == nullptr ? std::string() : picture_.scan->name);
  showIn(view_, picture_, part_->current() == 0 ? tr("before") : tr("after"));
  if (before_picture_.scan != nullptr) showIn(before_view_, before_picture_, tr("before"));
  if (other)
    view_->resetCamera(mask_->painter()->tool() == PaintTool::Look ? StandardView::Isometric : StandardView::Top);
  const auto profiles = static_cast<int>(picture_.scan == nullptr ? 0 : picture_.scan->profileCount());
  {
    const QSignalBlocker quiet(slider_);
    const int before = slider_->value();
    slider_->setRange(0, std::max(0, profiles - 1));
    slider_->setValue(before > 0 ? std::min(before, profiles - 1) : profiles / 2);
    slider_->setEnabled(profiles > 1);
  }
  showProfile(slider_->value());
}

void ScanCapturePage::showProfile(int index) {
  slider_text_->clear();
  if (picture_.scan != nullptr && index >= 0 && static_cast<std::size_t>(index) < picture_.scan->profileCount()) {
    if (slider_->value() != index) {
      const QSignalBlocker quiet(slider_);
      slider_->setValue(index);
    }
    slider_text_->setText(
        onScreen(tr("%1 of %2: y %3 mm")
                     .arg(index + 1)
                     .arg(picture_.scan->profileCount())
                     .arg(decimalText(carriageOf(*picture_.scan, static_cast<std::size_t>(index)), 'f', 2))));
  }
  profile_->setContent(profileSeries(picture_, index));
}

std::vector<Exportable> ScanCapturePage::exportables() {
  std::vector<Exportable> items{exportableOf(tr("Scans"), rows_)};
  if (!view_->empty()) items.push_back(exportableOf(tr("Cloud"), view_));
  if (!profile_->empty()) items.push_back(exportableOf(tr("Profile"), profile_));
  return items;
}

}  // namespace spindrift::gui
