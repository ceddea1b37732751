// SPDX-License-Identifier: GPL-3.0-or-later
// Recent sessions, sample data, what is dropped onto the window, news and printing.
#include <gtest/gtest.h>

#include <QAction>
#include <QDialog>
#include <QDropEvent>
#include <QFile>
#include <QMenu>
#include <QMenuBar>
#include <QMimeData>
#include <QPrinter>
#include <QPushButton>
#include <QSettings>
#include <QTest>
#include <QTextBrowser>
#include <QUrl>

#include "core/base/error.h"
#include "core/machine/campaign.h"
#include "tests/support/source_folder.h"
#include "tests/widgets/support/select_campaign.h"
#include "tests/widgets/support/story_support.h"
#include "widgets/jobs/job_bar.h"
#include "widgets/pages/page.h"
#include "widgets/report/report_pages.h"
#include "widgets/services/incoming_service.h"
#include "widgets/shell/demo.h"
#include "widgets/shell/news_dialog.h"
#include "widgets/shell/tour.h"
#include "widgets/shell/welcome_page.h"
#include "widgets/theme/theme.h"

namespace spindrift::gui {
namespace {

QString plain(const QAction* action) {
  QString text = action->text();
  return text.remove(QLatin1Char('&'));
}

/// The action at the end of a path of titles; null if there is none.
QAction* actionAt(const MainWindow& window, const QStringList& path) {
  QList<QAction*> level = window.menuBar()->actions();
  QAction* found = nullptr;
  for (const QString& title : path) {
    found = nullptr;
    for (QAction* action : level)
      if (plain(action) == title) found = action;
    if (found == nullptr) return nullptr;
    level = found->menu() != nullptr ? found->menu()->actions() : QList<QAction*>();
  }
  return found;
}

class FilesTest : public StoryTest {
 protected:
  [[nodiscard]] QStringList recentTitles() const {
    const QAction* menu = actionAt(*window_, {QStringLiteral("Session"), QStringLiteral("Recent sessions")});
    QStringList titles;
    if (menu == nullptr) return titles;
    for (const QAction* action : menu->menu()->actions())
      if (!action->isSeparator()) titles << plain(action);
    return titles;
  }
  [[nodiscard]] bool welcomeLists(const QString& name) const {
    for (const auto* button : window_->welcome()->findChildren<QPushButton*>())
      if (button->text().contains(name)) return true;
    return false;
  }
  void drop(const std::vector<std::filesystem::path>& files) {
    QList<QUrl> urls;
    for (const auto& file : files) urls << QUrl::fromLocalFile(QString::fromStdString(file.string()));
    QMimeData data;
    data.setUrls(urls);
    const QPoint at(600, 400);
    QDragEnterEvent enter(at, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(window_.get(), &enter);
    ASSERT_TRUE(enter.isAccepted());
    QDropEvent event(at, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(window_.get(), &event);
    QCoreApplication::processEvents();
    wait();
    QCoreApplication::processEvents();
  }
  [[nodiscard]] std::string message() const { return window_->jobBar()->message().toStdString(); }
};

TEST_F(FilesTest, RecentSessionsAreInTheMenuAndGoneOnesAreNot) {
  const auto campaign = writeStoryCampaign(folder_, Hidden::Nothing);
  open(campaign, StepId::Machine);
  const std::filesystem::path session = window_->session().folder();
  const QString name = QString::fromStdString(session.filename().string());
  QSettings().setValue(QStringLiteral("recent"),
                       QStringList{QString::fromStdString(session.string()), QStringLiteral("/nowhere/gone")});
  window_->closeSession();
  EXPECT_TRUE(recentTitles().contains(name));
  EXPECT_FALSE(recentTitles().contains(QStringLiteral("gone")));
  EXPECT_TRUE(welcomeLists(name));
  EXPECT_FALSE(welcomeLists(QStringLiteral("gone")));
  QAction* again = actionAt(*window_, {QStringLiteral("Session"), QStringLiteral("Recent sessions"), name});
  ASSERT_NE(again, nullptr);
  again->trigger();
  wait();
  EXPECT_EQ(window_->session().folder(), session);
  window_->closeSession();
  actionAt(*window_, {QStringLiteral("Session"), QStringLiteral("Recent sessions"), QStringLiteral("Clear the list")})
      ->trigger();
  QCoreApplication::processEvents();
  EXPECT_TRUE(recentTitles().isEmpty());
  EXPECT_FALSE(welcomeLists(name));
  EXPECT_TRUE(std::filesystem::exists(session)) << "the list is cleared, not the sessions";
  std::filesystem::remove_all(session);
}

TEST_F(FilesTest, ASessionThatIsDeletedLeavesTheListOfTheFirstScreen) {
  open(writeStoryCampaign(folder_, Hidden::Nothing), StepId::Machine);
  const std::filesystem::path session = window_->session().folder();
  const QString name = QString::fromStdString(session.filename().string());
  window_->session().close();
  std::filesystem::remove_all(session);
  window_->closeSession();
  EXPECT_FALSE(welcomeLists(name));
}

TEST_F(FilesTest, SampleDataIsOpenedAndWrittenFromTheMenu) {
  const QString sample = QStringLiteral("Sample data");
  for (const Demo& demo : demos())
    EXPECT_NE(actionAt(*window_, {QStringLiteral("Session"), sample, demo.title}), nullptr) << demo.name;
  const QString folder = QString::fromStdString(folder_.path().string());
  window_->writeSample("holes", folder);
  wait();
  ASSERT_TRUE(std::filesystem::exists(folder_ / "spindrift_holes/campaign.json")) << message();
  EXPECT_NO_THROW((void)Campaign::read(folder_ / "spindrift_holes"));
  const auto written = std::filesystem::last_write_time(folder_ / "spindrift_holes/campaign.json");
  window_->writeSample("holes", folder);
  wait();
  QCoreApplication::processEvents();
  EXPECT_NE(message().find("not written over"), std::string::npos) << message();
  EXPECT_EQ(std::filesystem::last_write_time(folder_ / "spindrift_holes/campaign.json"), written);
}

TEST_F(FilesTest, SessionsCampaignsAndLogsThatAreDroppedAreOpened) {
  const auto campaign = writeStoryCampaign(folder_, Hidden::Nothing);
  drop({campaign});
  ASSERT_NE(window_->session().campaign(), nullptr) << message();
  const std::filesystem::path session = window_->session().folder();
  sessions_.push_back(session);
  window_->closeSession();
  drop({session / "spindrift-session.json"});
  EXPECT_EQ(window_->session().folder(), session) << message();
  std::string rows = "time_s,spindle_degC,ez_um\n";
  for (int i = 0; i < 60; ++i)
    rows += std::to_string(60 * i) + ',' + std::to_string(20.0 + 0.1 * i) + ',' + std::to_string(0.5 * i) + '\n';
  const auto log = folder_.write("growth.csv", rows);
  drop({log});
  EXPECT_NE(window_->session().folder(), session) << message();
  EXPECT_TRUE(window_->session().isLogOnly());
}

TEST_F(FilesTest, FilesThatWereNotLookedAtAreNamedWhenAnotherCampaignIsChosen) {
  const auto campaign = writeStoryCampaign(folder_, Hidden::Nothing);
  open(campaign, StepId::Machine);
  std::filesystem::copy(campaign, folder_ / "other", std::filesystem::copy_options::recursive);
  (void)folder_.write("other/note.txt", "so that its content is another");
  const std::int64_t first = window_->session().campaignId();
  window_->addCampaign(QString::fromStdString((folder_ / "other").string()));
  wait();
  ASSERT_NE(window_->session().campaignId(), first);
  QStringList files;
  for (const char* name : {"a.png", "b.png", "c.png"})
    files << QString::fromStdString(folder_.write(name, "no picture").string());
  std::vector<IncomingItem> answered;
  int answers = 0;
  IncomingService::of(window_->session()).takeFiles(files, [&](const std::vector<IncomingItem>& items) {
    answered = items;
    ++answers;
  });
  selectCampaign(window_->session(), first);
  ASSERT_EQ(answers, 1) << "at once, and once";
  ASSERT_EQ(answered.size(), 3U);
  for (const IncomingItem& item : answered) {
    EXPECT_EQ(item.state, IncomingState::Ignored);
    EXPECT_NE(item.sentence.find("not looked at, because another campaign was chosen"), std::string::npos);
  }
  wait();
  QTest::qWait(100);
  EXPECT_EQ(answers, 1);
}

TEST_F(FilesTest, WhatCannotBeTakenIsSaidInOneSentence) {
  const auto text = folder_.write("letter.pdf", "x");
  drop({text});
  EXPECT_NE(message().find("letter.pdf cannot be opened; allowed:"), std::string::npos) << message();
  std::filesystem::create_directories(folder_ / "holiday");
  drop({folder_ / "holiday"});
  EXPECT_NE(message().find("neither a session nor a campaign"), std::string::npos) << message();
  drop({folder_.write("a.png", "x")});
  EXPECT_NE(message().find("open a session or begin a new measurement first"), std::string::npos) << message();
  const auto campaign = writeStoryCampaign(folder_, Hidden::Nothing);
  drop({campaign, campaign / "log.csv"});
  EXPECT_NE(message().find("one at a time"), std::string::npos) << message();
  EXPECT_TRUE(window_->welcomeShown());
}

TEST_F(FilesTest, WhatIsNewIsShownOnceAfterAnUpdate) {
  const auto shown = [&] { return window_->findChild<QDialog*>(QStringLiteral("news")); };
  window_->showNewsIfDue();
  EXPECT_EQ(shown(), nullptr) << "a first start has no news";
  QSettings().setValue(QStringLiteral("news/seen"), QStringLiteral("0.0.1"));
  window_->showNewsIfDue();
  ASSERT_NE(shown(), nullptr);
  EXPECT_TRUE(shown()->findChild<QTextBrowser*>()->toPlainText().contains(QStringLiteral("Find a command")));
  shown()->close();
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  window_->showNewsIfDue();
  EXPECT_EQ(shown(), nullptr);
  QAction* action = actionAt(*window_, {QStringLiteral("Help"), QStringLiteral("What's new …")});
  ASSERT_NE(action, nullptr);
  action->trigger();
  EXPECT_NE(shown(), nullptr);
  const QString log = QStringLiteral(
      "# Log\n\n## 2.0\n\n### In short\n- new\n\n### In Kürze\n- neu\n\n### For packagers\n- no\n\n## 1.0\n\n### In "
      "short\n- old\n");
  EXPECT_EQ(newestNews(log, QStringLiteral("en")), QStringLiteral("- new"));
  EXPECT_EQ(newestNews(log, QStringLiteral("de")), QStringLiteral("- neu"));
  // What is shown can be read at a glance: no names of tests or files, no more than fits into the window.
  QFile file(QString::fromStdString((spindrift::testing::sourceFolder() / "CHANGELOG.md").string()));
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  const QString changelog = QString::fromUtf8(file.readAll());
  for (const char* language : {"en", "de"}) {
    const QString news = newestNews(changelog, QString::fromLatin1(language));
    EXPECT_GE(news.count(QStringLiteral("\n- ")), 5) << language;
    EXPECT_LE(news.count(QStringLiteral("\n- ")), 14) << language;
    EXPECT_LT(news.size(), 2500) << language;
    EXPECT_FALSE(news.contains(QLatin1Char('`'))) << language;
  }
  EXPECT_NE(actionAt(*window_, {QStringLiteral("Edit"), QStringLiteral("Jobs and messages …")}), nullptr);
}

TEST_F(FilesTest, APageAndTheReportArePrinted) {
  open(writeStoryCampaign(folder_, Hidden::Nothing), StepId::Model);
  window_->currentPage()->runAll();
  wait();
  const auto printTo = [&](const char* name, auto&& print) {
    QPrinter printer(QPrinter::ScreenResolution);
    printer.setOutputFormat(QPrinter::PdfFormat);
    printer.setOutputFileName(QString::fromStdString((folder_ / name).string()));
    print(printer);
  };
  const auto pagesOf = [&](const std::filesystem::path& file) {
    ReportPages pages(file);
    EXPECT_TRUE(QTest::qWaitFor([&] { return pages.pageCount() > 0 || !pages.failure().isEmpty(); }));
    return pages.pageCount();
  };
  window_->setTheme(ThemeKind::Dark);
  printTo("page.pdf", [&](QPrinter& printer) { window_->printPage(printer); });
  EXPECT_EQ(theme().kind, ThemeKind::Dark);
  window_->setTheme(ThemeKind::Light);
  EXPECT_EQ(pagesOf(folder_ / "page.pdf"), 1);
  EXPECT_GT(std::filesystem::file_size(folder_ / "page.pdf"), 20'000U) << "with a picture in it";
  EXPECT_THROW(printTo("report.pdf", [&](QPrinter& printer) { window_->printReportOn(printer); }), InputError);
  window_->workflow().goTo(StepId::Report);
  window_->currentPage()->runAll();
  wait();
  printTo("report.pdf", [&](QPrinter& printer) { window_->printReportOn(printer); });
  int reports = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(window_->session().folder())) {
    if (entry.path().extension() != ".pdf") continue;
    ++reports;
    EXPECT_EQ(pagesOf(folder_ / "report.pdf"), pagesOf(entry.path()));
  }
  EXPECT_EQ(reports, 1);
  EXPECT_THROW(printTo("no/such/folder/x.pdf", [&](QPrinter& printer) { window_->printPage(printer); }), InputError);
}

}  // namespace
}  // namespace spindrift::gui
