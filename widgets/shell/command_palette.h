// SPDX-License-Identifier: GPL-3.0-or-later
// Find a command: one line to type a few letters into, below it what the window can do, the best first. Enter runs,
// Esc closes. What cannot be run now is listed with the reason.
#pragma once

#include <QDialog>
#include <QString>
#include <functional>
#include <optional>
#include <vector>

class QLineEdit;
class QTableView;

namespace spindrift::gui {

class Callout;
class RowsModel;

/// Something the window can do.
struct Command {
  QString title;    ///< "Open session …"
  QString where;    ///< menu, page or list it belongs to: "Session", "Recent session"
  QString keys;     ///< "Ctrl+O"
  QString why_not;  ///< why it cannot be run now, one sentence; empty: it can
  std::function<void()> run;
};

/// How well typed letters fit a command; larger is better, nothing: they do not. Every word has to occur in the title
/// or in where it belongs, its letters in this order, upper and lower case alike. Letters at the beginning of a word,
/// and such as follow one another, count more; the title counts more than the place, what can be run now a little more
/// than what cannot.
[[nodiscard]] std::optional<int> commandScore(const QString& letters, const Command& command);

class CommandPalette : public QDialog {
  Q_OBJECT
 public:
  explicit CommandPalette(std::vector<Command> commands, QWidget* parent = nullptr);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void fill();
  void runChosen();

  std::vector<Command> commands_;
  QLineEdit* field_;
  QTableView* table_;
  RowsModel* rows_;
  Callout* reason_;
};

}  // namespace spindrift::gui
