// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/report/report_page.h"

#include <QCheckBox>
#include <QDesktopServices>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QSplitter>
#include <QStackedWidget>
#include <QStandardPaths>
#include <QTableView>
#include <QTimer>
#include <QUrl>
#include <QVBoxLayout>
#include <utility>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/tasks/task_options.h"
#include "widgets/commands/commands.h"
#include "widgets/common/parts.h"
#include "widgets/jobs/task_job.h"
#include "widgets/models/rows_model.h"
#include "widgets/pages/discrepancy/discrepancy_page.h"
#include "widgets/pages/discrepancy/effect_titles.h"
#include "widgets/pages/report/page_view.h"
#include "widgets/pages/report/report_pages.h"
#include "widgets/workflow/simulator_choice.h"

namespace spindrift::gui {
namespace {

constexpr auto result_kind = "report";

}  // namespace

ReportPage::ReportPage(PageContext page_context, QWidget* parent)
    : Page(std::move(page_context), StepId::Report, parent) {
  browser_ = makeButton(tr("Open in browser"), "eye");
  save_html_ = makeButton(tr("HTML …"), "export");
  save_html_->setToolTip(tr("Save the report as one HTML file"));
  save_pdf_ = makeButton(tr("PDF …"), "export");
  save_pdf_->setToolTip(tr("Save the report as PDF"));
  write_ = makeButton(tr("Write the report"), nullptr, "primary");
  for (QPushButton* button : {browser_, save_html_, save_pdf_, write_}) addAction(button);

  stack_ = new QStackedWidget;
  empty_ = new EmptyState("report", {}, {});
  stack_->addWidget(empty_);
  pages_ = new PageView;

  auto* left = new Card(tr("Report"));
  left->body()->addWidget(makeLabel(tr("Operator"), "secondaryText"));
  operator_ = new QLineEdit;
  operator_->setPlaceholderText(tr("Name, or empty to sign by hand"));
  operator_->setAccessibleName(tr("Name of the operator"));
  left->body()->addWidget(operator_);
  connect(operator_, &QLineEdit::editingFinished, this, [this] {
    if (session().campaign() == nullptr) return;
    const std::string name = operator_->text().trimmed().toStdString();
    if (session().setting(option_keys::operator_name, "") == name) return;
    session().setSetting(option_keys::operator_name, name);
    context().workflow.refresh();
    refresh();
    if (session().result(result_kind)) refresh();
  });
  discrepancy_ = new QCheckBox(tr("Tell the discrepancy"));
  discrepancy_->setToolTip(tr("Search for what the simulation lacks and tell it with the effects that were added"));
  left->body()->addWidget(discrepancy_);
  connect(discrepancy_, &QCheckBox::clicked, this, [this](bool tell) {
    context().undo.push(
        new OptionsCommand(session(), tell ? tr("tell the discrepancy") : tr("leave the discrepancy out"),
                           session().campaignKey(option_keys::report), {{"tells_discrepancy", tell}}, [this] {
                             context().workflow.refresh();
                             refresh();
                           }));
  });
  facts_ = makeLabel({}, "secondaryText");
  facts_->setWordWrap(true);
  left->body()->addWidget(facts_);
  left->body()->addWidget(makeLabel(tr("Sections"), "sectionTitle"));
  sections_ = new RowsModel({tr("Section"), tr("Page")}, this);
  section_table_ =
      makeTable(sections_, tr("Sections of the report"), tr("Sections appear when the report is written."));
  stretchColumn(section_table_, 0);
  left->body()->addWidget(section_table_, 1);

  auto* work = new QWidget;
  auto* line = new QVBoxLayout(work);
  line->setContentsMargins(0, 0, 0, 0);
  stack_->addWidget(pages_);
  auto* right = new Card;
  right->body()->addWidget(stack_, 1);
  line->addWidget(makeSplitter(left, right, 3, 9), 1);
  content()->addWidget(work, 1);

  // Ids of results start again in every session.
  connect(&session(), &SessionModel::campaignChanged, this, [this] {
    shown_result_ = 0;
    opening_.reset();
    document_.reset();
    pages_->setPages(nullptr);
  });
  connect(write_, &QPushButton::clicked, this, &ReportPage::write);
  connect(browser_, &QPushButton::clicked, this, &ReportPage::openInBrowser);
  connect(save_pdf_, &QPushButton::clicked, this, [this] { askAndSave(QStringLiteral("pdf"), tr("PDF (*.pdf)")); });
  connect(save_html_, &QPushButton::clicked, this,
          [this] { askAndSave(QStringLiteral("html"), tr("Web page (*.html)")); });
  connect(section_table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
          [this](const QModelIndex& now) {
            if (!following_ && document_ != nullptr && now.isValid()) {
              pages_->goToPage(document_->sections()[static_cast<std::size_t>(now.row())].page);
            }
          });
  connect(pages_, &PageView::pageChanged, this, [this](int page) {
    if (document_ != nullptr && context().hint) {
      context().hint(tr("Page %1 of %2").arg(page + 1).arg(document_->pageCount()));
    }
  });
}

ReportOptions ReportPage::options() const {
  auto& model = const_cast<ReportPage*>(this)->session();
  ReportOptions o;
  o.operator_name = operator_->text().trimmed().toStdString();
  o.discrepancy = discrepancy_->isChecked();
  o.stored = stored();
  const DiscrepancyChoice choice = DiscrepancyChoice::of(model);
  // A search that still holds is told, not made again.
  const StoredResult* searched = model.latest("discrepancy");
  if (searched != nullptr && model.state("discrepancy").current)
    o.story = std::make_shared<const nlohmann::json>(searched->payload);
  o.search.accept = choice.added;
  o.search.reject = choice.rejected;
  o.fit = nineParameterOptions(model.campaignSetting(option_keys::nine_parameters, nlohmann::json::object()));
  o.fit.state.clear();
  for (const auto& [item, reason] : model.excluded())
    o.exclusions.emplace_back(item.toStdString(), reason.toStdString());
  if (Session* store = model.session()) {
    for (const Note& note : store->notes(model.campaignId())) {
      o.notes.push_back(note.created_utc + "  " + note.step + (note.item.empty() ? "" : ", " + note.item) + ": " +
                        note.text);
    }
  }
  return o;
}

StoredResults ReportPage::stored() const {
  auto& model = const_cast<ReportPage*>(this)->session();
  const auto payload = [&](const char* kind) {
    const StoredResult* result = model.latest(kind);
    return result == nullptr ? nlohmann::json() : result->payload;
  };
  StoredResults out;
  out.plan = model.setting("plan/" + std::to_string(model.campaignId()), nlohmann::json());
  out.warm_up = model.warmStatement().value_or(nlohmann::json());
  out.jogs = payload("check-jogs");
  out.repeatability = payload("check-repeatability");
  out.thermal = payload("thermal");
  out.compensation = payload("compensation");
  out.log_compensation = payload("log-compensation");
  out.verification = payload("verify");
  out.simulation = simulationUpdateOf(model);
  return out;
}

std::filesystem::path ReportPage::file() const {
  auto& model = const_cast<ReportPage*>(this)->session();
  const auto stored = model.result(result_kind);
  if (!stored) return {};
  return model.folder() / stored->payload.value("file", std::string());
}

void ReportPage::refresh() {
  if (session().campaign() == nullptr) return;
  noticeCampaign();
  callout()->setAction({}, {});
  const bool possible = canReport(*session().campaign(), session().observations().has_value());
  write_->setEnabled(possible);
  discrepancy_->setVisible(!session().campaign()->simulation.empty());
  const ReportTaskOptions asked = ReportTaskOptions::of(*session().session(), session().campaignId());
  if (!operator_->hasFocus()) operator_->setText(QString::fromStdString(asked.operator_name));
  discrepancy_->setChecked(asked.tells_discrepancy);
  const auto stored = session().result(result_kind);
  for (QPushButton* button : {browser_, save_pdf_, save_html_}) button->setEnabled(stored.has_value());
  if (!stored) {
    shown_result_ = 0;
    showDocument(nullptr);
    empty_->setTexts(possible ? tr("The report will appear here") : tr("There is nothing to report yet"),
                     possible ? tr("Press Write the report: machine, conditions, observations, models with their "
                                   "uncertainties, the discrepancy and where everything came from, on pages to sign.")
                              : tr("Evaluate the captures first (Calibrate)."));
    callout()->set(Tone::Neutral, {});
    return;
  }
  if (stored->id != shown_result_) {
    shown_result_ = stored->id;
    openDocument();
  }
  if (const ResultState state = session().state(result_kind); !state.current) {
    callout()->show(Tone::Outdated, tr("Changed since the report was written: %1.").arg(state.changed));
    callout()->setAction(tr("Write again"), [this] { write(); });
  } else {
    callout()->set(Tone::Neutral, {});
  }
}

void ReportPage::openDocument() {
  showDocument(nullptr);
  empty_->setTexts(tr("Opening the report …"), {});
  opening_ = std::make_shared<ReportPages>(file());
  connect(opening_.get(), &ReportPages::laidOut, this, [this] {
    const auto made = std::exchange(opening_, nullptr);
    if (made->failure().isEmpty()) {
      showDocument(made);
      return;
    }
    QTimer::singleShot(0, this, [made] {});  // it is still telling us
    empty_->setTexts(tr("The report cannot be shown"), tr("Write it again. %1").arg(made->failure()));
    for (QPushButton* button : {browser_, save_pdf_, save_html_}) button->setEnabled(false);
  });
}

void ReportPage::showFacts() {
  const auto stored = session().result(result_kind);
  if (document_ == nullptr || !stored) {
    facts_->clear();
    return;
  }
  facts_->setText(
      tr("Written %1 by Spindrift %2: %3 pages, %4 figures, %5 tables.")
          .arg(QString::fromStdString(stored->provenance.created_utc).replace(QLatin1Char('T'), QLatin1Char(' ')),
               QString::fromStdString(stored->provenance.program_version))
          .arg(document_->pageCount())
          .arg(document_->figureCount())
          .arg(document_->tableCount()));
}

void ReportPage::showDocument(std::shared_ptr<ReportPages> document) {
  document_ = std::move(document);
  pages_->setPages(document_);
  stack_->setCurrentIndex(document_ != nullptr ? 1 : 0);
  showFacts();
  std::vector<Row> rows;
  if (document_ != nullptr) {
    int index = 0;
    for (const ReportDocument::Heading& heading : document_->sections()) {
      Row row;
      row.id = QString::number(index++);
      Cell page{QString::number(heading.page + 1)};
      page.right = true;
      row.cells = {{heading.text}, page};
      row.cells[0].tip = heading.text;
      rows.push_back(std::move(row));
    }
  }
  following_ = true;
  sections_->setRows(std::move(rows));
  following_ = false;
}

void ReportPage::write() {
  const auto observations = session().observations();
  if (!canReport(*session().campaign(), observations.has_value())) return;
  const std::int64_t campaign = session().campaignId();
  const std::string name = "reports/report-" + std::to_string(campaign) + ".html";
  auto campaign_copy = std::make_shared<Campaign>(*session().snapshot().campaign);
  // What the user excluded is marked in the observations.
  if (campaign_copy->observations) campaign_copy->observations = observations;
  const PendingResult pending = session().begin(result_kind);
  Job job;
  job.title = tr("Writing the report");
  job.work = [this, name, campaign_copy, asked = options(), pending, choice = DiscrepancyChoice::of(session()),
              effects_file = DiscrepancyChoice::file(session()),
              target = session().folder() / name](JobContext& progress) -> std::function<void()> {
    const std::string html = campaignReportHtml(*choice.applied(campaign_copy, effects_file), asked, progress);
    progress.throwIfCancelled();
    std::filesystem::create_directories(target.parent_path());
    writeFileAtomically(target, html);
    return [this, name, pending, bytes = html.size()] {
      if (session().finish(pending, {{"file", name}, {"bytes", bytes}})) refresh();
    };
  };
  job.failed = [this](const QString& sentence) {
    callout()->setAction({}, {});
    callout()->show(Tone::Bad, sentence);
  };
  context().jobs.run(taskJob(session(), pending, std::move(job)));
}

void ReportPage::openInBrowser() {
  const QString path = QString::fromStdString(file().string());
  if (!QDesktopServices::openUrl(QUrl::fromLocalFile(path))) {
    callout()->setAction({}, {});
    callout()->show(Tone::Attention, tr("No browser could be started. The report is here: %1").arg(path));
  }
}

void ReportPage::askAndSave(const QString& ending, const QString& filter) {
  const QString name = fileNameOf(QString::fromStdString(session().campaign()->name)) + QStringLiteral("-report.");
  const QString folder = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
  QString chosen =
      QFileDialog::getSaveFileName(this, tr("Save the report"), folder + QLatin1Char('/') + name + ending, filter);
  if (chosen.isEmpty()) return;
  if (!chosen.endsWith(QLatin1Char('.') + ending, Qt::CaseInsensitive)) chosen += QLatin1Char('.') + ending;
  saveTo(chosen);
}

void ReportPage::saveTo(const QString& target) {
  callout()->setAction({}, {});
  if (document_ == nullptr) {
    callout()->show(Tone::Bad, tr("The report has not been written yet; write it first."));
    return;
  }
  run(tr("Saving the report"), [this, source = file(), target](JobContext& progress) -> std::function<void()> {
    saveReport(source, target, progress);
    return [this, target] { callout()->show(Tone::Good, tr("The report was saved as %1.").arg(target)); };
  });
}

std::vector<Exportable> ReportPage::exportables() {
  if (document_ == nullptr) return {};
  const auto source = file();
  return {{tr("Report"),
           {QStringLiteral("pdf"), QStringLiteral("html")},
           [source](const QString& target) { saveReport(source, target, {}); },
           [source](const QString& target, JobContext& job) { saveReport(source, target, job); }}};
}

}  // namespace spindrift::gui
