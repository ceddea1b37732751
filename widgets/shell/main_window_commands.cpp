// SPDX-License-Identifier: GPL-3.0-or-later
// Everything the window can do, for the list of commands: actions of the menus, panels and buttons of the page, help.
#include <QAction>
#include <QDialog>
#include <QMenu>
#include <QMenuBar>
#include <QPushButton>
#include <QTabWidget>
#include <QVBoxLayout>

#include "widgets/common/parts.h"
#include "widgets/shell/command_palette.h"
#include "widgets/shell/help_panel.h"
#include "widgets/shell/main_window.h"

namespace spindrift::gui {
namespace {

QString plainText(QString text) {
  return text.remove(QLatin1Char('&')).remove(QChar(0x2009)).trimmed();
}

}  // namespace

void MainWindow::need(QAction* action, std::function<QString()> why_not) {
  needs_[action] = std::move(why_not);
}

QString MainWindow::whyNot(const QAction* action) const {
  const auto found = needs_.find(action);
  if (found != needs_.end()) {
    const QString why = found->second();
    if (!why.isEmpty()) return why;
  }
  return action->isEnabled() ? QString() : tr("Not possible now.");
}

void MainWindow::addCommandsOf(const QMenu& menu, const QString& where, std::vector<Command>& commands) {
  for (QAction* action : menu.actions()) {
    if (action->menu() != nullptr) {
      addCommandsOf(*action->menu(), where + QStringLiteral(" > ") + plainText(action->text()), commands);
    } else if (!action->isSeparator() && action != palette_action_) {
      commands.push_back({plainText(action->text()), where, action->shortcut().toString(QKeySequence::NativeText),
                          whyNot(action), [action] { action->trigger(); }});
    }
  }
}

std::vector<Command> MainWindow::commands() {
  fillRecentMenu();
  std::vector<Command> all;
  for (const QAction* top : menuBar()->actions()) {
    if (top->menu() != nullptr) addCommandsOf(*top->menu(), plainText(top->text()), all);
  }
  if (currentPage() != nullptr && stack_->currentWidget() == work_) {
    const QString page = tr("Page %1").arg(stepTitle(workflow_.current()));
    for (QTabWidget* tabs : page_->findChildren<QTabWidget*>()) {
      for (int i = 0; tabs->isVisible() && i < tabs->count(); ++i) {
        all.push_back({plainText(tabs->tabText(i)), page, {}, {}, [tabs, i] { tabs->setCurrentIndex(i); }});
      }
    }
    for (QPushButton* button : page_->findChildren<QPushButton*>()) {
      const QString title = plainText(button->text().isEmpty() ? button->accessibleName() : button->text());
      if (!button->isVisible() || title.isEmpty()) continue;
      QString why;
      if (!button->isEnabled()) why = button->toolTip().isEmpty() ? tr("Not possible now.") : button->toolTip();
      all.push_back({title, page, {}, why, [button] { button->click(); }});
    }
  }
  for (const StepId step : all_steps) {
    all.push_back({tr("Help: %1").arg(stepTitle(step)), tr("Help"), {}, {}, [this, step] { showHelpOn(step); }});
  }
  return all;
}

void MainWindow::findCommand() {
  if (findChild<CommandPalette*>() != nullptr) return;
  (new CommandPalette(commands(), this))->open();
}

void MainWindow::showHelpOn(StepId step) {
  if (stack_->currentWidget() == work_) {
    if (!help_action_->isChecked()) help_action_->trigger();
    help_->showStep(step);
    return;
  }
  // No step is shown that it could stand beside.
  auto* dialog = new QDialog(this);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle(tr("Help: %1").arg(stepTitle(step)));
  auto* column = new QVBoxLayout(dialog);
  auto* help = new HelpPanel;
  connect(help, &HelpPanel::closed, dialog, &QDialog::close);
  column->addWidget(help);
  help->showStep(step);
  dialog->resize(dialog->sizeHint().width(), 640);
  dialog->show();
}

}  // namespace spindrift::gui
