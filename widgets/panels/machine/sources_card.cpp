// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/machine/sources_card.h"

#include <QPushButton>
#include <QTableView>
#include <algorithm>

#include "widgets/common/core_sentence.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"

namespace spindrift::gui {
namespace {

Cell stateCell(const SourceStatus* status) {
  if (status == nullptr) return {SourcesCard::tr("not connected")};
  switch (status->state) {
    case SourceStatus::State::Connecting:
      return {SourcesCard::tr("connecting"), Tone::Neutral, "in-progress"};
    case SourceStatus::State::Live:
      return {SourcesCard::tr("live"), Tone::Good, "check-circle"};
    case SourceStatus::State::Lost: {
      Cell cell{SourcesCard::tr("lost"), Tone::Bad, "error"};
      cell.tip = coreSentence(status->sentence);
      return cell;
    }
    case SourceStatus::State::Stopped:
      break;
  }
  return {SourcesCard::tr("stopped")};
}

}  // namespace

SourcesCard::SourcesCard(QWidget* parent) : Card(tr("Sources"), parent) {
  options_ = makeButton({}, "settings");
  options_->setToolTip(tr("Options of the source: user, unit, pattern of its lines, exposure …"));
  options_->setAccessibleName(tr("Options of the source"));
  remove_ = makeButton({}, "trash");
  remove_->setToolTip(tr("Take the source and its columns away"));
  remove_->setAccessibleName(tr("Remove the source"));
  auto* open = makeButton({}, "folder-open");
  open->setToolTip(tr("Take over sources and columns from a connections.json"));
  open->setAccessibleName(tr("Open connections.json"));
  addToTitle(open);
  addToTitle(options_);
  addToTitle(remove_);
  rows_ = new RowsModel({tr("Source"), tr("State"), tr("Address")}, this);
  table_ = makeTable(rows_, tr("Sources"), tr("Enter an address above. Nothing else is contacted."));
  body()->addWidget(table_, 1);
  connect(options_, &QPushButton::clicked, this, &SourcesCard::optionsWanted);
  connect(remove_, &QPushButton::clicked, this, &SourcesCard::removeWanted);
  connect(open, &QPushButton::clicked, this, &SourcesCard::fileWanted);
  connect(table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this, [this] {
    if (!filling_) Q_EMIT chosenChanged();
  });
  connect(table_, &QTableView::doubleClicked, this, [this] { Q_EMIT listWanted(fromCore(chosen())); });
}

std::string SourcesCard::chosen() const {
  const QModelIndex index = table_->currentIndex();
  if (index.isValid()) return rows_->idAt(index.row()).toStdString();
  return rows_->rows().empty() ? std::string() : rows_->rows().front().id.toStdString();
}

void SourcesCard::choose(const std::string& source) {
  table_->selectRow(rows_->rowOf(fromCore(source)));
}

void SourcesCard::show(const nlohmann::json& description, const LiveSnapshot& snapshot, bool recording) {
  std::vector<Row> rows;
  for (const nlohmann::json& source : description["sources"]) {
    const std::string name = source.value("name", std::string());
    const SourceStatus* status = nullptr;
    for (const LiveSource& live : snapshot.sources) {
      if (live.name == name) status = &live.status;
    }
    Row row;
    row.id = fromCore(name);
    row.cells = {nameCell(row.id), stateCell(status), Cell{fromCore(source.value("url", std::string()))}};
    row.cells.back().tip = row.cells.back().text;
    rows.push_back(std::move(row));
  }
  const auto same = [](const Row& a, const Row& b) {
    return a.id == b.id && a.cells[1].text == b.cells[1].text && a.cells[1].tip == b.cells[1].tip &&
           a.cells[2].text == b.cells[2].text;
  };
  const std::vector<Row>& shown = rows_->rows();
  const bool there = !rows.empty();
  for (QPushButton* button : {options_, remove_}) button->setEnabled(there && !recording);
  if (rows.size() == shown.size() && std::equal(rows.begin(), rows.end(), shown.begin(), same)) return;
  const QString selected = fromCore(chosen());
  filling_ = true;
  rows_->setRows(std::move(rows));
  if (there) table_->selectRow(std::max(0, rows_->rowOf(selected)));
  filling_ = false;
}

}  // namespace spindrift::gui
