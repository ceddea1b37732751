// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/report/report_page.h"

#include <QCheckBox>
#include <QComboBox>
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
#include <algorithm>
#include <utility>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/tasks/report_task.h"
#include "core/tasks/task_options.h"
#include "widgets/commands/commands.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/demo_names.h"
#include "widgets/common/languages.h"
#include "widgets/common/parts.h"
#include "widgets/common/report_files.h"
#include "widgets/jobs/task_job.h"
#include "widgets/models/rows_model.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/report/page_view.h"
#include "widgets/report/report_pages.h"

namespace spindrift::gui {
namespace {

constexpr auto report_result = "report";

/// By the ending of `target`, .pdf or .html. Throws InputError.
void saveCopy(const std::filesystem::path& html, const std::filesystem::path& pdf, const QString& target) {
  const bool printed = target.endsWith(QLatin1String(".pdf"), Qt::CaseInsensitive);
  writeFileAtomically(target.toStdString(), readFile(printed ? pdf : html));
}

}  // namespace

ReportPage::ReportPage(PageContext page_context, QWidget* parent)
    : Page(std::move(page_context), StepId::Report, parent),
      options_(session(), context().undo, [this] { refresh(); }) {
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
  operator_->setPlaceholderText(tr("Name (empty: by hand)"));
  operator_->setAccessibleName(tr("Name of the operator"));
  left->body()->addWidget(operator_);
  connect(operator_, &QLineEdit::editingFinished, this, &ReportPage::keepOperator);
  discrepancy_ = new QCheckBox(tr("Include the discrepancy analysis"));
  discrepancy_->setToolTip(
      tr("Search for what the simulation lacks, and report it together with the effects that were added"));
  left->body()->addWidget(discrepancy_);
  connect(discrepancy_, &QCheckBox::clicked, this, [this](bool tell) {
    options_.change(tell ? tr("include the discrepancy analysis") : tr("omit the discrepancy analysis"),
                    [tell](ReportChoice& o) { o.tells_discrepancy = tell; });
  });
  language_title_ = makeLabel(tr("Language"), "secondaryText");
  left->body()->addWidget(language_title_);
  language_ = new QComboBox;
  language_->setAccessibleName(tr("Language of the report"));
  language_->setToolTip(tr("The report is written in both languages: the one that is shown is printed and saved"));
  for (const Language& one : availableLanguages()) {
    if (one.code == availableLanguages().front().code || one.code == currentLanguage())
      language_->addItem(one.own_name, one.code);
  }
  language_->setCurrentIndex(std::max(0, language_->findData(reportLanguage())));
  for (QWidget* w : {static_cast<QWidget*>(language_title_), static_cast<QWidget*>(language_)})
    w->setVisible(language_->count() > 1);
  left->body()->addWidget(language_);
  connect(language_, &QComboBox::activated, this, [this] {
    chooseReportLanguage(language_->currentData().toString());
    shown_result_ = 0;
    refresh();
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
  line->addWidget(makeSplitter(work, left, right, 3, 9), 1);
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

std::filesystem::path ReportPage::storedFile(const char* key) {
  const StoredResult* stored = session().latest(report_result);
  return stored == nullptr ? std::filesystem::path() : storedReport(session().folder(), stored->payload, key);
}

void ReportPage::refresh() {
  if (session().campaign() == nullptr) return;
  const bool other = noticeCampaign();
  callout()->setAction({}, {});
  const bool possible = canRun(report_result);
  write_->setEnabled(possible);
  discrepancy_->setVisible(!session().campaign()->simulation.empty());
  const ReportTaskOptions asked = ReportTaskOptions::of(*session().session(), session().campaignId());
  if (other || !operator_->hasFocus()) operator_->setText(QString::fromStdString(asked.operator_name));
  discrepancy_->setChecked(asked.tells_discrepancy);
  const auto stored = session().result(report_result);
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
  if (const ResultState state = session().state(report_result); !state.current) {
    callout()->show(Tone::Outdated, tr("Changed since the report was written: %1.").arg(state.changed));
    callout()->setAction(tr("Write again"), [this] { write(); });
  } else if (!isWrittenIn(stored->payload, reportLanguage())) {
    callout()->show(Tone::Neutral, tr("This report was written in English only."));
    callout()->setAction(tr("Write again"), [this] { write(); });
  } else {
    callout()->set(Tone::Neutral, {});
  }
}

void ReportPage::openDocument() {
  showDocument(nullptr);
  empty_->setTexts(tr("Opening the report …"), {});
  if (pdf().empty()) {
    empty_->setTexts(tr("This report was written by an earlier version"),
                     tr("Write it again to see its pages, or open it in the browser."));
    save_pdf_->setEnabled(false);
    return;
  }
  opening_ = std::make_shared<ReportPages>(pdf());
  connect(opening_.get(), &ReportPages::opened, this, [this] {
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
  const auto stored = session().result(report_result);
  if (document_ == nullptr || !stored) {
    facts_->clear();
    return;
  }
  facts_->setText(
      tr("Written %1 by Spindrift %2: %3, %4, %5.")
          .arg(QString::fromStdString(stored->provenance.created_utc).replace(QLatin1Char('T'), QLatin1Char(' ')),
               QString::fromStdString(stored->provenance.program_version))
          .arg(tr("%n pages", nullptr, document_->pageCount()),
               tr("%n figures", nullptr, stored->payload.value("figures", 0)),
               tr("%n tables", nullptr, stored->payload.value("tables", 0))));
}

void ReportPage::showDocument(std::shared_ptr<ReportPages> document) {
  document_ = std::move(document);
  pages_->setPages(document_);
  stack_->setCurrentIndex(document_ != nullptr ? 1 : 0);
  showFacts();
  std::vector<Row> rows;
  if (document_ != nullptr) {
    int index = 0;
    for (const ReportPages::Section& section : document_->sections()) {
      Row row;
      row.id = QString::number(index++);
      Cell page{QString::number(section.page + 1)};
      page.right = true;
      // Of a report by an earlier version, which is English.
      const auto stored = session().result(report_result);
      const bool written = stored && isWrittenIn(stored->payload, reportLanguage());
      const QString title = written ? section.title : coreSentence(section.title);
      row.cells = {{title}, page};
      row.cells[0].tip = title;
      rows.push_back(std::move(row));
    }
  }
  following_ = true;
  sections_->setRows(std::move(rows));
  following_ = false;
}

void ReportPage::keepOperator() {
  if (session().campaign() == nullptr) return;
  const auto kept = [this] {
    const ReportTaskOptions asked = ReportTaskOptions::of(*session().session(), session().campaignId());
    return QString::fromStdString(asked.operator_name);
  };
  const QString name = operator_->text().trimmed();
  if (kept() == name) return;
  context().undo.push(new OptionsCommand(session(), tr("change the name of the operator"),
                                         session().campaignKey(option_keys::operator_name), name.toStdString(),
                                         [this, kept] {
                                           operator_->setText(kept());
                                           refresh();
                                         }));
}

void ReportPage::write() {
  keepOperator();
  runTask(report_result);
}

void ReportPage::openInBrowser() {
  const QString path = QString::fromStdString(file().string());
  if (!QDesktopServices::openUrl(QUrl::fromLocalFile(path))) {
    callout()->setAction({}, {});
    callout()->show(Tone::Attention, tr("No browser could be started. The report is here: %1").arg(path));
  }
}

QString ReportPage::proposedName() const {
  return fileNameOf(tr("%1-report", "name of a file").arg(shownName(session().campaign()->name)));
}

void ReportPage::askAndSave(const QString& ending, const QString& filter) {
  const QString folder = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
  QString chosen = QFileDialog::getSaveFileName(
      this, tr("Save the report"), folder + QLatin1Char('/') + proposedName() + QLatin1Char('.') + ending, filter);
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
  run(tr("Saving the report"), [this, html = file(), printed = pdf(), target](JobContext&) -> std::function<void()> {
    saveCopy(html, printed, target);
    return [this, target] { callout()->show(Tone::Good, tr("The report was saved as %1.").arg(target)); };
  });
}

std::vector<Exportable> ReportPage::exportables() {
  if (document_ == nullptr) return {};
  return {{tr("Report"),
           {QStringLiteral("pdf"), QStringLiteral("html")},
           [html = file(), printed = pdf()](const QString& target) { saveCopy(html, printed, target); }}};
}

}  // namespace spindrift::gui
