// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/machine/connections_panel.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QPushButton>
#include <QTableWidget>
#include <QUrl>
#include <QVBoxLayout>
#include <algorithm>
#include <chrono>
#include <set>
#include <thread>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/base/untrusted_text.h"
#include "core/connect/column_suggestion.h"
#include "core/connect/connections.h"
#include "core/machine/stated_role.h"
#include "widgets/commands/commands.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/jobs/task_job.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/panels/common/fields_dialog.h"
#include "widgets/panels/machine/columns_card.h"
#include "widgets/panels/machine/history_card.h"
#include "widgets/panels/machine/items_card.h"
#include "widgets/panels/machine/source_fields.h"
#include "widgets/panels/machine/sources_card.h"
#include "widgets/plots/plot.h"
#include "widgets/services/connections_service.h"

namespace spindrift::gui {
namespace {

constexpr double listen_s = 3.0;

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
  address_->setPlaceholderText(tr("http://…, mqtt://… or other"));
  address_->setToolTip(
      tr("http://… (MTConnect), mqtt://…, modbus://…, serial:///dev/…, tcp://…, "
         "linuxcnc://… or genicam:…"));
  address_->setMinimumHeight(sizes::control_height);
  look_ = makeButton(tr("See what is there"), "eye");
  live_ = makeButton(tr("Live view"), "play");
  record_ = makeButton(tr("Record"), nullptr, "primary");
  record_->setToolTip(tr("Writes what comes into log.csv of this campaign, on its clock"));
  line->addWidget(address_, 1);
  line->addWidget(look_);
  line->addWidget(live_);
  line->addWidget(record_);
  column->addLayout(line);
  state_ = new Callout;
  column->addWidget(state_);
  sources_ = new SourcesCard;
  items_ = new ItemsCard;
  columns_ = new ColumnsCard(
      [this](int row, const nlohmann::json& entry, const QString& what) { columnEdited(row, entry, what); });
  history_ = new HistoryCard;
  auto* left = makeSplitter(nullptr, sources_, items_, 2, 5, Qt::Vertical);
  auto* right = makeSplitter(nullptr, columns_, history_, 4, 3, Qt::Vertical);
  column->addWidget(makeSplitter(this, left, right, 4, 8), 1);

  connect(look_, &QPushButton::clicked, this, [this] { lookAt(address_->text().trimmed()); });
  connect(address_, &QLineEdit::returnPressed, look_, &QPushButton::click);
  connect(live_, &QPushButton::clicked, this, &ConnectionsPanel::toggleLive);
  connect(record_, &QPushButton::clicked, this, &ConnectionsPanel::toggleRecording);
  connect(sources_, &SourcesCard::chosenChanged, this, &ConnectionsPanel::showItems);
  connect(sources_, &SourcesCard::listWanted, this, [this](const QString& source) { list(source.toStdString()); });
  connect(sources_, &SourcesCard::optionsWanted, this, [this] { editSource(); });
  connect(sources_, &SourcesCard::removeWanted, this, &ConnectionsPanel::removeSource);
  connect(sources_, &SourcesCard::fileWanted, this, &ConnectionsPanel::openFile);
  connect(items_, &ItemsCard::ticked, this, &ConnectionsPanel::tick);
  connect(columns_, &ColumnsCard::chosenChanged, this, &ConnectionsPanel::showPlot);
  connect(columns_, &ColumnsCard::optionsWanted, this, [this] { editColumn(); });
  connect(columns_, &ColumnsCard::removeWanted, this, &ConnectionsPanel::removeColumn);
  connect(plot(), &Plot::hovered, this, [this](const QString& text) {
    if (context_.hint) context_.hint(text);
  });
  connect(&service_, &ConnectionsService::changed, this, [this] {
    if (isVisible()) showLive();
  });
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
    return coreSentence(e.what());
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
    say(coreSentence(e.what()));
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
  sources_->choose(source);
  // As a job it can be cancelled and never holds the window up.
  Job job;
  job.title = tr("Listing %1").arg(fromCore(entry->value("url", std::string())));
  job.queue = JobQueue::Reading;
  job.key = "connections";
  job.work = [this, source, entry = *entry](JobContext& progress) -> std::function<void()> {
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
    return [this, source, found] {
      found_[source] = std::move(*found);
      found_visit_ = context_.session.visit();
      say({});
      refresh();
      sources_->choose(source);
      showItems();
    };
  };
  job.failed = [this](const QString& sentence) { say(sentence); };
  context_.jobs.run(visitJob(context_.session, std::move(job)));
}

void ConnectionsPanel::tick(const QString& item, bool on) {
  const std::string source = sources_->chosen();
  if (source.empty()) return;
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

FieldsDialog* ConnectionsPanel::editSource() {
  const std::string name = sources_->chosen();
  const nlohmann::json description = service_.description();
  const nlohmann::json* entry = entryOf(description["sources"], "name", name);
  if (entry == nullptr) return nullptr;
  auto* dialog = new FieldsDialog(
      tr("Options of %1").arg(fromCore(name)),
      tr("A password never stands in the session: say in which variable of the environment or in which file it is."),
      *entry, fieldsOfSource(entry->value("kind", std::string())),
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
  const int row = columns_->chosen();
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
  const std::string name = sources_->chosen();
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
  const int row = columns_->chosen();
  nlohmann::json after = service_.description();
  if (row < 0 || row >= static_cast<int>(after["columns"].size())) return;
  after["columns"].erase(static_cast<std::size_t>(row));
  change(tr("remove a column"), after);
}

void ConnectionsPanel::columnEdited(int row, const nlohmann::json& entry, const QString& what) {
  nlohmann::json after = service_.description();
  if (row >= static_cast<int>(after["columns"].size())) return;
  after["columns"][static_cast<std::size_t>(row)] = entry;
  change(what, after);
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
    say(coreSentence(e.what()));
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

/// As the source said it when it was listed.
std::string ConnectionsPanel::unitThere(const nlohmann::json& column) const {
  const auto found = found_.find(column.value("source", std::string()));
  if (found == found_.end()) return {};
  for (const DataItem& item : found->second) {
    if (item.address == column.value("item", std::string())) return item.unit;
  }
  return {};
}

void ConnectionsPanel::showSources() {
  sources_->show(service_.description(), service_.snapshot(), service_.recording());
}

void ConnectionsPanel::showItems() {
  const std::string source = sources_->chosen();
  const nlohmann::json description = service_.description();
  std::set<std::string> ticked;
  for (const nlohmann::json& column : description["columns"]) {
    if (column.value("source", std::string()) == source) ticked.insert(column.value("item", std::string()));
  }
  const auto found = found_.find(source);
  items_->show(found == found_.end() ? std::vector<DataItem>() : found->second, std::move(ticked));
}

void ConnectionsPanel::showColumns() {
  columns_->show(
      service_.description(), [this](const nlohmann::json& column) { return unitThere(column); }, service_.recording());
}

void ConnectionsPanel::showLive() {
  showSources();
  columns_->showLive(service_.snapshot(), service_.recording());
  const bool recording = service_.recording();
  live_->setText(QChar(0x2009) + (service_.running() ? tr("Stop live view") : tr("Live view")));
  live_->setVisible(!recording);
  live_->setEnabled(columns()->rowCount() > 0);
  record_->setText(recording ? tr("Stop recording") : tr("Record"));
  record_->setEnabled(columns()->rowCount() > 0);
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
    state_->show(Tone::Bad, coreSentence(snapshot.problem));
  } else if (!lost.isEmpty()) {
    state_->show(Tone::Bad, lost + QLatin1Char(' ') + tr("It is tried again and again."));
  } else if (service_.recording()) {
    const QString gaps =
        snapshot.gaps.empty() ? QString() : tr(" The last gap: %1.").arg(coreSentence(snapshot.gaps.back()));
    state_->show(Tone::Good, tr("Recording into log.csv of this campaign: %n rows, %1 of %2 columns have values. You "
                                "may leave this page; recording continues.%3",
                                nullptr, static_cast<int>(snapshot.rows))
                                 .arg(known)
                                 .arg(snapshot.columns.size())
                                 .arg(gaps));
  } else if (service_.running()) {
    state_->show(
        Tone::Good,
        tr("Live: %1 of %2 columns have values; nothing is written.").arg(known).arg(snapshot.columns.size()) +
            (snapshot.sentences.empty() ? QString() : QLatin1Char(' ') + coreSentence(snapshot.sentences.back())));
  } else if (sources()->rows().empty()) {
    state_->show(Tone::Neutral, tr("Enter the address of a machine, a broker, a module or a logger, and see what is "
                                   "there. It is only read; nothing is written to it."));
  } else if (columns()->rowCount() == 0) {
    state_->show(Tone::Accent, tr("Tick the data items that are to be recorded; each becomes a column of the log."));
  } else {
    state_->show(Tone::Accent,
                 service_.ending()
                     ? tr("The log is being closed.")
                     : tr("%n columns are mapped. Look at them live, or record them into the log of this campaign.",
                          nullptr, columns()->rowCount()));
  }
}

void ConnectionsPanel::showPlot() {
  history_->show(service_, columns_->chosenName());
}

std::vector<Exportable> ConnectionsPanel::exportables() {
  std::vector<Exportable> items;
  const nlohmann::json description = service_.description();
  if (!description["sources"].empty()) {
    items.push_back({tr("Connections"), {QStringLiteral("json")}, [description](const QString& file) {
                       writeFileAtomically(file.toStdString(), description.dump(1) + "\n");
                     }});
  }
  if (!plot()->empty()) items.push_back(exportableOf(tr("Live values"), plot()));
  return items;
}

RowsModel* ConnectionsPanel::sources() const {
  return sources_->rows();
}

RowsModel* ConnectionsPanel::items() const {
  return items_->rows();
}

QTableWidget* ConnectionsPanel::columns() const {
  return columns_->table();
}

Plot* ConnectionsPanel::plot() const {
  return history_->plot();
}

void ConnectionsPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  refresh();
}

}  // namespace spindrift::gui
