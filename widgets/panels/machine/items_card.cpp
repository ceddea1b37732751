// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/machine/items_card.h"

#include <QLineEdit>
#include <QPushButton>
#include <QTableView>

#include "widgets/common/editor_table.h"
#include "widgets/common/words.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"

namespace spindrift::gui {
namespace {

constexpr std::size_t most_items_shown = 2000;

}  // namespace

ItemsCard::ItemsCard(QWidget* parent) : Card(tr("What is there"), parent) {
  filter_ = new QLineEdit;
  filter_->setPlaceholderText(tr("Filter"));
  filter_->setToolTip(
      tr("Shows the data items that have this in their names. What cannot be listed (a register, a topic, a "
         "place in a line) is added by its address."));
  filter_->setAccessibleName(tr("Filter the data items, or address of one"));
  filter_->setClearButtonEnabled(true);
  filter_->setMaximumWidth(190);
  auto* add = makeButton({}, "plus");
  add->setToolTip(tr("Add the data item with this address"));
  add->setAccessibleName(tr("Add a data item by its address"));
  addToTitle(filter_);
  addToTitle(add);
  rows_ = new RowsModel({tr("Data item"), tr("Now"), tr("Unit"), tr("What"), tr("Where")}, this);
  auto* table = makeTable(rows_, tr("Data items of the source"),
                          tr("Data items of the source appear here; tick those that are to be recorded."));
  body()->addWidget(table, 1);
  connect(filter_, &QLineEdit::textChanged, this, &ItemsCard::fill);
  connect(rows_, &RowsModel::checkedChanged, this, [this](const QString& id, int, bool on) {
    // After the view is done with the click.
    QMetaObject::invokeMethod(
        this, [this, id, on] { Q_EMIT ticked(id, on); }, Qt::QueuedConnection);
  });
  connect(add, &QPushButton::clicked, this, [this, add] {
    const QString item = filter_->text().trimmed();
    if (item.isEmpty()) return sayBeside(add, tr("Type the address of the data item beside this button first."));
    filter_->clear();
    Q_EMIT ticked(item, true);
  });
}

void ItemsCard::show(std::vector<DataItem> found, std::set<std::string> ticked) {
  found_ = std::move(found);
  ticked_ = std::move(ticked);
  fill();
}

void ItemsCard::fill() {
  std::vector<Row> rows;
  const QString wanted = filter_->text().trimmed();
  const auto add = [&](const DataItem& item) {
    const QString all = fromCore(item.address + " " + item.name + " " + item.component + " " + item.type);
    if (rows.size() >= most_items_shown || (!wanted.isEmpty() && !all.contains(wanted, Qt::CaseInsensitive))) return;
    Row row;
    row.id = fromCore(item.address);
    Cell name = nameCell(item.name.empty() ? row.id : fromCore(item.name));
    name.checked = ticked_.contains(item.address);
    name.tip = row.id;
    row.cells = {name, Cell{fromCore(item.example)}, Cell{unitText(item.unit)},
                 Cell{fromCore(item.type.empty() ? item.category : item.type)}, Cell{fromCore(item.component)}};
    rows.push_back(std::move(row));
  };
  std::set<std::string> there;
  for (const DataItem& item : found_) {
    there.insert(item.address);
    add(item);
  }
  // What is mapped and was not listed (a register, a source that is away) can be unticked, too.
  for (const std::string& address : ticked_) {
    if (there.contains(address)) continue;
    DataItem item;
    item.address = address;
    add(item);
  }
  rows_->setRows(std::move(rows));
}

}  // namespace spindrift::gui
