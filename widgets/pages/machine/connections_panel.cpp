// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/machine/connections_panel.h"

#include <QComboBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLineEdit>
#include <QPushButton>
#include <QSplitter>
#include <QTableView>
#include <QTableWidget>
#include <QUrl>
#include <QVBoxLayout>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <thread>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/base/untrusted_text.h"
#include "core/connect/column_suggestion.h"
#include "core/connect/connections.h"
#include "core/connect/unit_conversion.h"
#include "core/machine/operating_log.h"
#include "core/machine/sensor_role.h"
#include "widgets/commands/commands.h"
#include "widgets/common/parts.h"
#include "widgets/common/wrap_layout.h"
#include "widgets/models/rows_model.h"
#include "widgets/pages/common/cells.h"
#include "widgets/pages/common/editor_table.h"
#include "widgets/pages/common/fields_dialog.h"
#include "widgets/pages/machine/connections_service.h"
#include "widgets/pages/machine/stated_role.h"
#include "widgets/plots/plot.h"

namespace spindrift::gui {
namespace {

enum ColumnOfTable { ColumnName, Now, Age, QualityWord, From, Unit, Role };
constexpr std::size_t most_items_shown = 2000;
constexpr double listen_s = 3.0;

QString ageText(double age_s) {
  if (!std::isfinite(age_s)) return QStringLiteral("–");
  if (age_s < 1.0) return ConnectionsPanel::tr("< 1 s");
  if (age_s < 120.0) return ConnectionsPanel::tr("%1 s").arg(age_s, 0, 'f', 0);
  if (age_s < 7200.0) return ConnectionsPanel::tr("%1 min").arg(age_s / 60.0, 0, 'f', 0);
  return ConnectionsPanel::tr("%1 h").arg(age_s / 3600.0, 0, 'f', 0);
}

Cell stateCell(const SourceStatus* status) {
  if (status == nullptr) return {ConnectionsPanel::tr("not connected")};
  switch (status->state) {
    case SourceStatus::State::Connecting:
      return {ConnectionsPanel::tr("connecting"), Tone::Neutral, "in-progress"};
    case SourceStatus::State::Live:
      return {ConnectionsPanel::tr("live"), Tone::Good, "check-circle"};
    case SourceStatus::State::Lost: {
      Cell cell{ConnectionsPanel::tr("lost"), Tone::Bad, "error"};
      cell.tip = fromCore(status->sentence);
      return cell;
    }
    case SourceStatus::State::Stopped:
      break;
  }
  return {ConnectionsPanel::tr("stopped")};
}

/// What is asked of a source beside its address; secrets only by where they are.
std::vector<FormField> fieldsOf(const std::string& kind) {
  using Kind = FormField::Kind;
  const auto tr = [](const char* text) { return ConnectionsPanel::tr(text); };
  std::vector<FormField> fields{{"name", tr("Name"), {}, Kind::Text}, {"url", tr("Address"), {}, Kind::Text}};
  const auto add = [&](const char* key, const QString& label, const QString& hint, Kind what) {
    fields.push_back({key, label, hint, what});
  };
  if (kind == "mqtt") {
    add("user", tr("User"), {}, Kind::Text);
    add("password_env", tr("Variable with the password"), tr("name of a variable of the environment"), Kind::Text);
    add("password_file", tr("File with the password"), tr("readable by its owner only"), Kind::Text);
    add("ca_file", tr("Certificates"), tr("file with those that are trusted"), Kind::Text);
    add("client_id", tr("Name of this client"), tr("with one, nothing is missed while it is away"), Kind::Text);
  } else if (kind == "modbus") {
    add("unit_id", tr("Unit"), tr("1"), Kind::Number);
    add("interval_s", tr("Read every / s"), tr("1"), Kind::Number);
  } else if (kind == "mtconnect") {
    add("interval_s", tr("Stream every / s"), {}, Kind::Number);
  } else {
    add("line", tr("Pattern of a line"), tr("T1={column} T2={bed}"), Kind::Text);
    add("save", tr("Append every line to"), tr("file, for printed touches"), Kind::Text);
  }
  if (kind == "modbus" || kind == "text") {
    add("baud", tr("Baud"), tr("9600"), Kind::Number);
    add("parity", tr("Parity"), tr("none, even or odd"), Kind::Text);
  }
  return fields;
}

const nlohmann::json* entryOf(const nlohmann::json& list, const char* key, const std::string& value) {
  for (const nlohmann::json& each : list) {
    if (each.value(key, std::string()) == value) return &each;
  }
  return nullptr;
}

}  // namespace

ConnectionsPanel::ConnectionsPanel(PageContext page_context, QWidget* parent)
    : QWidget(parent), context_(std::move(page_context)), service_(ConnectionsService::of(context_.session)) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 8, 0, 0);
  column->setSpacing(8);
  auto* line = new QHBoxLayout;
  address_ = new QLineEdit;
  address_->setAccessibleName(tr("Address of a source"));
  address_->setPlaceholderText(tr("http://… (MTConnect), mqtt://…, modbus://…, serial:///dev/… or tcp://…"));
  address_->setMinimumHeight(sizes::control_height);
  look_ = makeButton(tr("See what is there"), "eye");
  live_ = makeButton(tr("Look live"), "play");
  record_ = makeButton(tr("Record"), nullptr, "primary");
  record_->setToolTip(tr("Writes what comes into log.csv of this campaign, on its clock"));
  line->addWidget(address_, 1);
  line->addWidget(look_);
  line->addWidget(live_);
  line->addWidget(record_);
  column->addLayout(line);
  state_ = new Callout;
  column->addWidget(state_);
  auto* left = makeSplitter(makeSourcesCard(), makeItemsCard(), 2, 5, Qt::Vertical);
  auto* right = makeSplitter(makeColumnsCard(), makePlotCard(), 4, 3, Qt::Vertical);
  column->addWidget(makeSplitter(left, right, 4, 8), 1);

  connect(look_, &QPushButton::clicked, this, [this] { lookAt(address_->text().trimmed()); });
  connect(address_, &QLineEdit::returnPressed, look_, &QPushButton::click);
  connect(live_, &QPushButton::clicked, this, &ConnectionsPanel::toggleLive);
  connect(record_, &QPushButton::clicked, this, &ConnectionsPanel::toggleRecording);
  connect(&service_, &ConnectionsService::changed, this, [this] {
    if (isVisible()) showLive();
  });
}

QWidget* ConnectionsPanel::makeSourcesCard() {
  auto* card = new Card(tr("Sources"));
  options_ = makeButton({}, "settings");
  options_->setToolTip(tr("Options of the source: user, unit, pattern of its lines …"));
  options_->setAccessibleName(tr("Options of the source"));
  remove_source_ = makeButton({}, "trash");
  remove_source_->setToolTip(tr("Take the source and its columns away"));
  remove_source_->setAccessibleName(tr("Remove the source"));
  auto* open = makeButton({}, "folder-open");
  open->setToolTip(tr("Take over sources and columns from a connections.json"));
  open->setAccessibleName(tr("Open connections.json"));
  card->addToTitle(open);
  card->addToTitle(options_);
  card->addToTitle(remove_source_);
  sources_ = new RowsModel({tr("Source"), tr("State"), tr("Address")}, this);
  source_table_ = makeTable(sources_, tr("Sources"), tr("Enter an address above. Nothing else is contacted."));
  source_table_->setMinimumHeight(84);
  card->body()->addWidget(source_table_, 1);
  connect(options_, &QPushButton::clicked, this, [this] { editSource(); });
  connect(remove_source_, &QPushButton::clicked, this, &ConnectionsPanel::removeSource);
  connect(open, &QPushButton::clicked, this, &ConnectionsPanel::openFile);
  connect(source_table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this, [this] {
    if (!filling_) showItems();
  });
  connect(source_table_, &QTableView::doubleClicked, this, [this] { list(shownSource()); });
  return card;
}

QWidget* ConnectionsPanel::makeItemsCard() {
  items_card_ = new Card(tr("What is there"));
  filter_ = new QLineEdit;
  filter_->setPlaceholderText(tr("Filter, or an address"));
  filter_->setToolTip(
      tr("Shows the data items that have this in their names. What cannot be listed (a register, a topic, a "
         "place in a line) is added by its address."));
  filter_->setAccessibleName(tr("Filter the data items, or address of one"));
  filter_->setClearButtonEnabled(true);
  filter_->setMaximumWidth(190);
  auto* add = makeButton({}, "plus");
  add->setToolTip(tr("Add the data item with this address"));
  add->setAccessibleName(tr("Add a data item by its address"));
  items_card_->addToTitle(filter_);
  items_card_->addToTitle(add);
  items_ = new RowsModel({tr("Data item"), tr("Now"), tr("Unit"), tr("What"), tr("Where")}, this);
  item_table_ = makeTable(items_, tr("Data items of the source"),
                          tr("Data items of the source appear here; tick those that are to be recorded."));
  item_table_->setMinimumHeight(100);
  items_card_->body()->addWidget(item_table_, 1);
  connect(filter_, &QLineEdit::textChanged, this, &ConnectionsPanel::showItems);
  connect(items_, &RowsModel::checkedChanged, this, [this](const QString& id, int, bool on) {
    // After the view is done with the click.
    QMetaObject::invokeMethod(
        this, [this, id, on] { tick(id, on); }, Qt::QueuedConnection);
  });
  connect(add, &QPushButton::clicked, this, &ConnectionsPanel::addItemByAddress);
  return items_card_;
}

QWidget* ConnectionsPanel::makeColumnsCard() {
  auto* card = new Card(tr("Columns of the log"));
  edit_column_ = makeButton({}, "settings");
  edit_column_->setToolTip(tr("More of the column: scale, words, dead band …"));
  edit_column_->setAccessibleName(tr("More of the column"));
  remove_column_ = makeButton({}, "trash");
  remove_column_->setToolTip(tr("Take the column away"));
  remove_column_->setAccessibleName(tr("Remove the column"));
  card->addToTitle(edit_column_);
  card->addToTitle(remove_column_);
  // What changes stands first: the rest may be scrolled out of sight.
  columns_ = makeEditor({tr("Column"), tr("Now"), tr("Age"), tr("Quality"), tr("From"), tr("Unit there"), tr("Role")},
                        tr("Columns of the log"));
  columns_->setMinimumHeight(120);
  columns_->verticalHeader()->setDefaultSectionSize(44);  // boxes stand in the rows
  columns_->setSelectionBehavior(QAbstractItemView::SelectRows);
  card->body()->addWidget(columns_, 1);
  connect(columns_, &QTableWidget::cellChanged, this, &ConnectionsPanel::cellEdited);
  connect(columns_, &QTableWidget::currentCellChanged, this, [this] {
    if (!filling_) showPlot();
  });
  connect(edit_column_, &QPushButton::clicked, this, [this] { editColumn(); });
  connect(remove_column_, &QPushButton::clicked, this, &ConnectionsPanel::removeColumn);
  return card;
}

QWidget* ConnectionsPanel::makePlotCard() {
  plot_card_ = new Card(tr("The last hour"));
  plot_ = new Plot;
  plot_->setEmptyText(tr("Values will appear here as they come"), tr("Press Look live or Record."));
  plot_->setMinimumHeight(150);
  plot_card_->body()->addWidget(plot_, 1);
  connect(plot_, &Plot::hovered, this, [this](const QString& text) {
    if (context_.hint) context_.hint(text);
  });
  return plot_card_;
}

void ConnectionsPanel::say(const QString& sentence) {
  refusal_ = sentence;
  showState();
}

QString ConnectionsPanel::apply(const QString& what, const nlohmann::json& after) {
  if (service_.recording())
    return tr("Recording is on: stop it first. The columns of a log cannot change while it is written.");
  try {
    (void)Connections::parse(JsonNode::parse(after.dump(), "connections.json"));
  } catch (const InputError& e) {
    return fromCore(e.what());
  }
  if (after == service_.description()) return {};
  context_.undo.push(new OptionsCommand(context_.session, what, service_.descriptionKey(), after, [this] {
    if (service_.running() && !service_.recording()) {
      service_.stop();
      if (!service_.description()["columns"].empty()) (void)service_.look();
    }
    refresh();
  }));
  return {};
}

void ConnectionsPanel::change(const QString& what, const nlohmann::json& after) {
  const QString refused = apply(what, after);
  // What is shown is what is kept.
  if (!refused.isEmpty()) refresh();
  say(refused);
}

void ConnectionsPanel::lookAt(const QString& address) {
  const std::string url = address.toStdString();
  SourceDescription described;
  try {
    described = sourceForAddress(url);
  } catch (const InputError& e) {
    say(fromCore(e.what()));
    return;
  }
  nlohmann::json after = service_.description();
  if (const nlohmann::json* known = entryOf(after["sources"], "url", url)) {
    list(known->value("name", std::string()));
    return;
  }
  QString stem = QUrl(address).host();
  if (stem.isEmpty()) stem = QUrl(address).fileName();
  if (stem.isEmpty()) stem = tr("source");
  QString name = stem;
  for (int number = 2; entryOf(after["sources"], "name", name.toStdString()) != nullptr; ++number)
    name = stem + QStringLiteral(" %1").arg(number);
  nlohmann::json source = {{"name", name.toStdString()}, {"kind", described.kind}, {"url", url}};
  // Lines of text say nothing until it is said how they are read; at first any line is taken.
  if (described.kind == "text") source["line"] = "{line}";
  after["sources"].push_back(source);
  const QString refused = apply(tr("add the source %1").arg(name), after);
  say(refused);
  if (!refused.isEmpty()) return;
  address_->clear();
  list(name.toStdString());
}

void ConnectionsPanel::list(const std::string& source) {
  const nlohmann::json description = service_.description();
  const nlohmann::json* entry = entryOf(description["sources"], "name", source);
  if (entry == nullptr) return;
  source_table_->selectRow(sources_->rowOf(fromCore(source)));
  // As a job it can be cancelled and never holds the window up.
  Job job;
  job.title = tr("Listing %1").arg(fromCore(entry->value("url", std::string())));
  job.queue = JobQueue::Display;
  job.key = "connections";
  job.work = [this, source, entry = *entry,
              visit = context_.session.visit()](JobContext& progress) -> std::function<void()> {
    const SourceDescription peer_description =
        sourceForAddress(entry.at("url").get<std::string>(), JsonNode::parse(entry.dump(), "the source"));
    // Sources wait on a token of their own; cancelling the job ends that, too.
    std::stop_source stop;
    const std::jthread watch([&progress, &stop](const std::stop_token& done) {
      while (!done.stop_requested() && !stop.stop_requested()) {
        if (progress.cancelled()) stop.request_stop();
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
    });
    auto found = std::make_shared<std::vector<DataItem>>();
    try {
      const std::unique_ptr<Source> peer = peer_description.make();
      progress.report(0.1, tr("connecting").toStdString());
      peer->connect(stop.get_token());
      progress.throwIfCancelled();
      progress.report(0.4, tr("listening").toStdString());
      *found = peer->list(listen_s, stop.get_token());
      // Connections are kept as JSON, which has no other texts.
      std::erase_if(*found, [](const DataItem& item) { return firstInvalidUtf8(item.address) != std::string::npos; });
      peer->close();
    } catch (const ConnectionError& error) {
      throw InputError(error.what());
    }
    progress.throwIfCancelled();
    return [this, source, found, visit] {
      if (visit != context_.session.visit()) return;
      found_[source] = std::move(*found);
      found_visit_ = visit;
      say({});
      refresh();
      source_table_->selectRow(sources_->rowOf(fromCore(source)));
      showItems();
    };
  };
  job.failed = [this](const QString& sentence) { say(sentence); };
  context_.jobs.run(std::move(job));
}

std::string ConnectionsPanel::shownSource() const {
  const QModelIndex index = source_table_->currentIndex();
  if (index.isValid()) return sources_->idAt(index.row()).toStdString();
  return sources_->rows().empty() ? std::string() : sources_->rows().front().id.toStdString();
}

void ConnectionsPanel::tick(const QString& item, bool on) {
  const std::string source = shownSource();
  nlohmann::json after = service_.description();
  nlohmann::json& columns = after["columns"];
  const std::string address = item.toStdString();
  if (!on) {
    nlohmann::json kept = nlohmann::json::array();
    for (const nlohmann::json& each : columns) {
      if (each.value("source", std::string()) != source || each.value("item", std::string()) != address)
        kept.push_back(each);
    }
    columns = kept;
    change(tr("leave %1 out").arg(item), after);
    return;
  }
  DataItem found;
  found.address = address;
  for (const DataItem& each : found_[source]) {
    if (each.address == address) found = each;
  }
  std::set<std::string> taken;
  for (const nlohmann::json& each : columns) taken.insert(each.value("column", std::string()));
  columns.push_back(suggestColumn(found, source, taken));
  change(tr("record %1").arg(item), after);
}

void ConnectionsPanel::addItemByAddress() {
  const QString item = filter_->text().trimmed();
  if (item.isEmpty() || shownSource().empty()) return;
  filter_->clear();
  tick(item, true);
}

FieldsDialog* ConnectionsPanel::editSource() {
  const std::string name = shownSource();
  const nlohmann::json description = service_.description();
  const nlohmann::json* entry = entryOf(description["sources"], "name", name);
  if (entry == nullptr) return nullptr;
  auto* dialog = new FieldsDialog(
      tr("Options of %1").arg(fromCore(name)),
      tr("A password never stands in the session: say in which variable of the environment or in which file it is."),
      *entry, fieldsOf(entry->value("kind", std::string())),
      [this, name](const nlohmann::json& edited) {
        nlohmann::json after = service_.description();
        for (nlohmann::json& each : after["sources"]) {
          if (each.value("name", std::string()) == name) each = edited;
        }
        const std::string renamed = edited.value("name", std::string());
        for (nlohmann::json& each : after["columns"]) {
          if (each.value("source", std::string()) == name) each["source"] = renamed;
        }
        const QString refused = apply(tr("change the source %1").arg(fromCore(name)), after);
        if (refused.isEmpty()) {
          say({});
          list(renamed);
        }
        return refused;
      },
      this);
  dialog->open();
  return dialog;
}

FieldsDialog* ConnectionsPanel::editColumn() {
  const int row = columns_->currentRow();
  const nlohmann::json description = service_.description();
  if (row < 0 || row >= static_cast<int>(description["columns"].size())) return nullptr;
  const nlohmann::json& entry = description["columns"][static_cast<std::size_t>(row)];
  using Kind = FormField::Kind;
  auto* dialog = new FieldsDialog(
      tr("Column %1").arg(fromCore(entry.value("column", std::string()))),
      tr("Value = scale · (value in the unit of the column) + offset. A row is written where it changes by more than "
         "the dead band."),
      entry,
      {{"column", tr("Column"), {}, Kind::Text},
       {"item", tr("Data item"), {}, Kind::Text},
       {"unit", tr("Unit there"), tr("as the source says"), Kind::Text},
       {"scale", tr("Scale"), QStringLiteral("1"), Kind::Number},
       {"offset", tr("Offset"), QStringLiteral("0"), Kind::Number},
       {"dead_band", tr("Dead band"), QStringLiteral("0"), Kind::Number},
       {"reduce", tr("Of an interval"), tr("last, mean, mean_absolute, max or min"), Kind::Text},
       {"values", tr("Words and their numbers"), tr("ACTIVE=1, READY=0"), Kind::Words},
       {"otherwise", tr("Any other word"), tr("unknown"), Kind::Number}},
      [this, row](const nlohmann::json& edited) {
        nlohmann::json after = service_.description();
        after["columns"][static_cast<std::size_t>(row)] = edited;
        const QString refused = apply(tr("change a column"), after);
        if (refused.isEmpty()) say({});
        return refused;
      },
      this);
  dialog->open();
  return dialog;
}

void ConnectionsPanel::removeSource() {
  const std::string name = shownSource();
  nlohmann::json after = service_.description();
  for (const auto& [list, key] : {std::pair{"sources", "name"}, std::pair{"columns", "source"}}) {
    nlohmann::json kept = nlohmann::json::array();
    for (const nlohmann::json& each : after[list]) {
      if (each.value(key, std::string()) != name) kept.push_back(each);
    }
    after[list] = kept;
  }
  change(tr("remove the source %1").arg(fromCore(name)), after);
}

void ConnectionsPanel::removeColumn() {
  const int row = columns_->currentRow();
  nlohmann::json after = service_.description();
  if (row < 0 || row >= static_cast<int>(after["columns"].size())) return;
  after["columns"].erase(static_cast<std::size_t>(row));
  change(tr("remove a column"), after);
}

void ConnectionsPanel::cellEdited(int row, int column) {
  if (filling_ || (column != ColumnName && column != Unit)) return;
  nlohmann::json after = service_.description();
  if (row >= static_cast<int>(after["columns"].size())) return;
  nlohmann::json& entry = after["columns"][static_cast<std::size_t>(row)];
  const std::string text = textAt(columns_, row, column).toStdString();
  if (column == ColumnName) {
    entry["column"] = text;
    // A role is of temperatures only.
    if (!OperatingLog::isTemperature(text)) entry.erase("role");
  } else if (text.empty()) {
    entry.erase("unit");
  } else {
    entry["unit"] = text;
  }
  // After the editor of the cell has gone.
  QMetaObject::invokeMethod(
      this, [this, after] { change(tr("change a column"), after); }, Qt::QueuedConnection);
}

void ConnectionsPanel::roleChosen(int row, const std::string& role) {
  nlohmann::json after = service_.description();
  if (row >= static_cast<int>(after["columns"].size())) return;
  nlohmann::json& entry = after["columns"][static_cast<std::size_t>(row)];
  if (role.empty()) {
    entry.erase("role");
  } else {
    entry["role"] = role;
  }
  QMetaObject::invokeMethod(
      this, [this, after] { change(tr("state the role of a sensor"), after); }, Qt::QueuedConnection);
}

void ConnectionsPanel::toggleLive() {
  if (service_.running()) {
    service_.stop();
    say({});
  } else {
    say(service_.look());
  }
  showLive();
}

void ConnectionsPanel::toggleRecording() {
  if (service_.recording()) {
    service_.stop();
    say({});
  } else {
    const QString refused = service_.record();
    say(refused);
    if (refused.isEmpty()) stateRoles();
  }
  showLive();
}

void ConnectionsPanel::stateRoles() {
  const MachineDescription& machine = context_.session.campaign()->machine;
  const nlohmann::json description = service_.description();
  nlohmann::json edited = machine.source;
  bool any = false;
  for (const nlohmann::json& column : description["columns"]) {
    const std::string role = column.value("role", std::string());
    const std::string name = column.value("column", std::string());
    if (role.empty()) continue;
    const bool stated = std::any_of(machine.temperature_sensors.begin(), machine.temperature_sensors.end(),
                                    [&](const TemperatureSensor& s) { return s.name == name && s.role; });
    if (stated) continue;
    stateSensorRole(edited, name, role);
    any = true;
  }
  if (any) context_.undo.push(new MachineCommand(context_.session, edited));
}

void ConnectionsPanel::openFile() {
  const QString file = QFileDialog::getOpenFileName(this, tr("Connections"), {}, tr("Connections (*.json)"));
  if (file.isEmpty()) return;
  try {
    const JsonNode root = JsonNode::read(file.toStdString());
    (void)Connections::parse(root);
    change(tr("take over %1").arg(QFileInfo(file).fileName()), root.value());
  } catch (const InputError& e) {
    say(fromCore(e.what()));
  }
}

void ConnectionsPanel::refresh() {
  if (context_.session.campaign() == nullptr) return;
  if (found_visit_ != context_.session.visit()) {
    found_.clear();
    refusal_.clear();
    found_visit_ = context_.session.visit();
  }
  showSources();
  showItems();
  showColumns();
  showLive();
}

void ConnectionsPanel::showSources() {
  const nlohmann::json description = service_.description();
  const LiveSnapshot& snapshot = service_.snapshot();
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
  const std::vector<Row>& shown = sources_->rows();
  const bool there = !rows.empty();
  for (QPushButton* button : {options_, remove_source_}) button->setEnabled(there && !service_.recording());
  if (rows.size() == shown.size() && std::equal(rows.begin(), rows.end(), shown.begin(), same)) return;
  const QString selected = fromCore(shownSource());
  filling_ = true;
  sources_->setRows(std::move(rows));
  if (there) source_table_->selectRow(std::max(0, sources_->rowOf(selected)));
  filling_ = false;
}

void ConnectionsPanel::showItems() {
  const std::string source = shownSource();
  const nlohmann::json description = service_.description();
  std::set<std::string> ticked;
  for (const nlohmann::json& column : description["columns"]) {
    if (column.value("source", std::string()) == source) ticked.insert(column.value("item", std::string()));
  }
  const auto found = found_.find(source);
  std::vector<Row> rows;
  const QString wanted = filter_->text().trimmed();
  const auto add = [&](const DataItem& item) {
    const QString all = fromCore(item.address + " " + item.name + " " + item.component + " " + item.type);
    if (rows.size() >= most_items_shown || (!wanted.isEmpty() && !all.contains(wanted, Qt::CaseInsensitive))) return;
    Row row;
    row.id = fromCore(item.address);
    Cell name = nameCell(item.name.empty() ? row.id : fromCore(item.name));
    name.checked = ticked.contains(item.address);
    name.tip = row.id;
    row.cells = {name, Cell{fromCore(item.example)}, Cell{fromCore(item.unit)},
                 Cell{fromCore(item.type.empty() ? item.category : item.type)}, Cell{fromCore(item.component)}};
    rows.push_back(std::move(row));
  };
  std::set<std::string> there;
  if (found != found_.end()) {
    for (const DataItem& item : found->second) {
      there.insert(item.address);
      add(item);
    }
  }
  // What is mapped and was not listed (a register, a source that is away) can be unticked, too.
  for (const std::string& address : ticked) {
    if (there.contains(address)) continue;
    DataItem item;
    item.address = address;
    add(item);
  }
  items_->setRows(std::move(rows));
}

/// As the source said it when it was listed.
std::string ConnectionsPanel::unitThere(const nlohmann::json& column) const {
  const auto found = found_.find(column.value("source", std::string()));
  if (found == found_.end()) return {};
  for (const DataItem& item : found->second) {
    if (item.address == column.value("item", std::string())) return item.unit;
  }
  return {};
}

void ConnectionsPanel::showColumns() {
  const nlohmann::json description = service_.description();
  const nlohmann::json& columns = description["columns"];
  filling_ = true;
  const int selected = columns_->currentRow();
  columns_->setRowCount(0);
  columns_->setRowCount(static_cast<int>(columns.size()));
  const bool recording = service_.recording();
  int role_width = 0;
  for (int row = 0; row < columns_->rowCount(); ++row) {
    const nlohmann::json& entry = columns[static_cast<std::size_t>(row)];
    const std::string name = entry.value("column", std::string());
    setText(columns_, row, ColumnName, fromCore(name));
    const std::string item = entry.value("item", std::string());
    const std::string whole = entry.value("source", std::string()) + ", " + item;
    setText(columns_, row, From, fromCore(description["sources"].size() > 1 ? whole : item));
    setText(columns_, row, Unit, fromCore(entry.value("unit", unitThere(entry))));
    for (const int c : {Role, Now, Age, QualityWord}) setText(columns_, row, c, {});
    for (int c = 0; c < columns_->columnCount(); ++c) {
      QTableWidgetItem* cell = columns_->item(row, c);
      const bool typed = (c == ColumnName || c == Unit) && !recording;
      cell->setFlags(Qt::ItemIsSelectable | Qt::ItemIsEnabled | (typed ? Qt::ItemIsEditable : Qt::NoItemFlags));
    }
    if (!entry.contains("unit")) columns_->item(row, Unit)->setForeground(theme().text_secondary);
    columns_->item(row, Unit)->setToolTip(entry.contains("unit") ? tr("Stated here")
                                                                 : tr("As the source says; type another to state it"));
    columns_->item(row, From)->setToolTip(fromCore(whole));
    if (!OperatingLog::isTemperature(name)) continue;
    auto* role = new QComboBox;
    role->setAccessibleName(tr("Role of %1").arg(fromCore(name)));
    role->addItem(tr("not stated"), QString());
    for (const std::string& each : sensorRoleNames()) {
      const std::string_view text = describe(*sensorRoleFromString(each));
      role->addItem(QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size())), fromCore(each));
    }
    role->setCurrentIndex(std::max(0, role->findData(fromCore(entry.value("role", std::string())))));
    role->setEnabled(!recording);
    connect(role, &QComboBox::activated, this,
            [this, row, role] { roleChosen(row, role->currentData().toString().toStdString()); });
    columns_->setCellWidget(row, Role, role);
    role_width = std::max(role_width, role->sizeHint().width());
  }
  // The header's own mode looks at texts alone, not at the boxes in the cells.
  columns_->horizontalHeader()->setSectionResizeMode(
      Role, role_width > 0 ? QHeaderView::Fixed : QHeaderView::ResizeToContents);
  if (role_width > 0) columns_->horizontalHeader()->resizeSection(Role, std::min(role_width, 170));
  if (selected >= 0 && selected < columns_->rowCount()) columns_->setCurrentCell(selected, ColumnName);
  filling_ = false;
}

void ConnectionsPanel::showLive() {
  const LiveSnapshot& snapshot = service_.snapshot();
  showSources();
  filling_ = true;
  for (int row = 0; row < columns_->rowCount(); ++row) {
    const std::string name = textAt(columns_, row, ColumnName).toStdString();
    const LiveColumn* column = snapshot.find(name);
    QString now = QStringLiteral("–"), age = QStringLiteral("–"), word;
    Tone tone = Tone::Neutral;
    if (column != nullptr) {
      if (std::isfinite(column->newest.value)) now = columnValue(name, column->newest.value);
      age = ageText(snapshot.now_s - column->came_s);
      if (snapshot.isLost(*column)) {
        word = column->records > 0 ? tr("lost") : tr("waiting");
        tone = column->records > 0 ? Tone::Bad : Tone::Neutral;
      } else if (column->known) {
        word = tr("good");
        tone = Tone::Good;
      } else if (column->records + column->refused == 0 && column->text.empty()) {
        word = tr("waiting");
      } else {
        word = column->text.empty() ? tr("unknown") : fromCore(column->text).left(16).toLower();
        tone = Tone::Attention;
      }
    }
    columns_->item(row, Now)->setText(now);
    columns_->item(row, Age)->setText(age);
    columns_->item(row, QualityWord)->setText(word);
    columns_->item(row, QualityWord)
        ->setForeground(tone == Tone::Neutral ? theme().text_secondary : theme().tone(tone));
    columns_->item(row, Now)->setToolTip(column == nullptr ? QString() : fromCore(column->conversion));
  }
  filling_ = false;
  const bool recording = service_.recording();
  live_->setText(QChar(0x2009) + (service_.running() ? tr("Stop looking") : tr("Look live")));
  live_->setVisible(!recording);
  live_->setEnabled(columns_->rowCount() > 0);
  record_->setText(recording ? tr("Stop recording") : tr("Record"));
  record_->setEnabled(columns_->rowCount() > 0);
  for (QPushButton* button : {edit_column_, remove_column_}) button->setEnabled(columns_->rowCount() > 0 && !recording);
  showState();
  showPlot();
}

void ConnectionsPanel::showState() {
  const LiveSnapshot& snapshot = service_.snapshot();
  const auto known = std::count_if(snapshot.columns.begin(), snapshot.columns.end(),
                                   [&](const LiveColumn& c) { return c.known && !snapshot.isLost(c); });
  const QString lost = service_.lost();
  if (!refusal_.isEmpty()) {
    state_->show(Tone::Bad, refusal_);
  } else if (!snapshot.problem.empty()) {
    state_->show(Tone::Bad, fromCore(snapshot.problem));
  } else if (!lost.isEmpty()) {
    state_->show(Tone::Bad, lost + QLatin1Char(' ') + tr("It is tried again and again."));
  } else if (service_.recording()) {
    const QString gaps =
        snapshot.gaps.empty() ? QString() : tr(" The last gap: %1.").arg(fromCore(snapshot.gaps.back()));
    state_->show(Tone::Good,
                 tr("Recording into log.csv of this campaign: %1 rows, %2 of %3 columns have values. You may "
                    "leave this page; recording goes on.%4")
                     .arg(snapshot.rows)
                     .arg(known)
                     .arg(snapshot.columns.size())
                     .arg(gaps));
  } else if (service_.running()) {
    state_->show(Tone::Good,
                 tr("Live: %1 of %2 columns have values; nothing is written.").arg(known).arg(snapshot.columns.size()) +
                     (snapshot.sentences.empty() ? QString() : QLatin1Char(' ') + fromCore(snapshot.sentences.back())));
  } else if (sources_->rows().empty()) {
    state_->show(Tone::Neutral, tr("Enter the address of a machine, a broker, a module or a logger, and see what is "
                                   "there. It is only read; nothing is written to it."));
  } else if (columns_->rowCount() == 0) {
    state_->show(Tone::Accent, tr("Tick the data items that are to be recorded; each becomes a column of the log."));
  } else {
    state_->show(Tone::Accent, service_.ending()
                                   ? tr("The log is being closed.")
                                   : tr("%1 columns are mapped. Look at them live, or record them into the log of this "
                                        "campaign.")
                                         .arg(columns_->rowCount()));
  }
}

void ConnectionsPanel::showPlot() {
  const LiveSnapshot& snapshot = service_.snapshot();
  if (snapshot.columns.empty()) {
    if (!plot_->empty()) plot_->setContent({});
    return;
  }
  // The column that is chosen; without a choice all of the unit of the first, temperatures before anything else.
  std::vector<std::size_t> shown;
  const std::string chosen =
      columns_->currentRow() < 0 ? std::string() : textAt(columns_, columns_->currentRow(), ColumnName).toStdString();
  const bool temperatures = std::any_of(snapshot.columns.begin(), snapshot.columns.end(),
                                        [](const LiveColumn& c) { return OperatingLog::isTemperature(c.column); });
  const std::string unit = temperatures ? "degC" : unitOfColumn(snapshot.columns.front().column);
  for (std::size_t c = 0; c < snapshot.columns.size() && shown.size() < theme().series.size(); ++c) {
    const std::string& name = snapshot.columns[c].column;
    if (chosen.empty() ? unitOfColumn(name) == unit : name == chosen) shown.push_back(c);
  }
  std::vector<std::vector<LivePoint>> histories;
  double span_s = 0.0;
  for (const std::size_t c : shown) {
    histories.push_back(service_.history(c));
    if (!histories.back().empty()) span_s = std::max(span_s, snapshot.now_s - histories.back().front().time_s);
  }
  const TimeUnit time = timeUnit(std::min(span_s, LiveValues::history_s));
  std::vector<Series> series;
  QString y_title;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const LiveColumn& column = snapshot.columns[shown[i]];
    Series s;
    s.name = columnTitle(column.column);
    s.colour = static_cast<int>(series.size());
    s.style = OperatingLog::isTemperature(column.column) ? SeriesStyle::Line : SeriesStyle::Steps;
    for (const LivePoint& point : histories[i]) {
      // What held at the beginning of the hour began before it.
      s.x.push_back(std::max(point.time_s - snapshot.now_s, -LiveValues::history_s) / time.seconds);
      s.y.push_back(point.value);
    }
    // What is known holds until now.
    if (!s.x.empty() && column.known && !snapshot.isLost(column)) {
      s.x.push_back(0.0);
      s.y.push_back(s.y.back());
    }
    const bool any = std::any_of(s.y.begin(), s.y.end(), [](double v) { return std::isfinite(v); });
    if (!any) continue;
    const QString of = fromCore(unitOfColumn(column.column));
    y_title = OperatingLog::isTemperature(column.column)
                  ? tr("Temperature / °C")
                  : columnTitle(column.column) + (of.isEmpty() ? QString() : QStringLiteral(" / ") + of);
    series.push_back(std::move(s));
  }
  // A single curve has no legend.
  plot_card_->setTitle(series.size() == 1 ? tr("The last hour: %1").arg(series.front().name) : tr("The last hour"));
  plot_->setAxes(tr("Time from now / %1").arg(time.name), y_title);
  plot_->setContent(std::move(series));
}

std::vector<Exportable> ConnectionsPanel::exportables() {
  std::vector<Exportable> items;
  const nlohmann::json description = service_.description();
  if (!description["sources"].empty()) {
    items.push_back({tr("Connections"), {QStringLiteral("json")}, [description](const QString& file) {
                       writeFileAtomically(file.toStdString(), description.dump(1) + "\n");
                     }});
  }
  if (!plot_->empty()) items.push_back(exportableOf(tr("Live values"), plot_));
  return items;
}

void ConnectionsPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  refresh();
}

}  // namespace spindrift::gui
