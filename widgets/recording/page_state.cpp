// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/recording/page_state.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSpinBox>
#include <QAction>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPlainTextEdit>
#include <QTabBar>
#include <QTextDocumentFragment>
#include <QTextEdit>

#include "widgets/recording/control_name.h"

namespace spindrift::gui {
namespace {

constexpr int most_rows = 12;

QString rowText(const QAbstractItemModel& model, int row) {
  QStringList cells;
  for (int column = 0; column < model.columnCount(); ++column) {
    const QModelIndex index = model.index(row, column);
    QString cell = index.data().toString().simplified();
    const QVariant checked = index.data(Qt::CheckStateRole);
    if (checked.isValid())
      cell = (checked.toInt() == Qt::Checked ? QStringLiteral("[x] ") : QStringLiteral("[ ] ")) + cell;
    cells << cell;
  }
  return cells.join(QStringLiteral(" | "));
}

QStringList tableText(const QAbstractItemView& view) {
  QStringList lines;
  const QAbstractItemModel* model = view.model();
  if (model == nullptr) return lines;
  QStringList titles;
  for (int column = 0; column < model->columnCount(); ++column)
    titles << model->headerData(column, Qt::Horizontal).toString().simplified();
  lines << titles.join(QStringLiteral(" | "));
  for (int row = 0; row < std::min(most_rows, model->rowCount()); ++row) lines << rowText(*model, row);
  if (model->rowCount() > most_rows) lines << QStringLiteral("%1 rows").arg(model->rowCount());
  return lines;
}

QStringList menuText(const QMenu& menu) {
  QStringList lines;
  for (const QAction* entry : menu.actions()) {
    if (!entry->isVisible() || entry->isSeparator()) continue;
    QString line = entry->text().remove(QLatin1Char('&'));
    if (!entry->shortcut().isEmpty()) line += QLatin1Char(' ') + entry->shortcut().toString(QKeySequence::PortableText);
    if (entry->isCheckable()) line += entry->isChecked() ? QStringLiteral(" [x]") : QStringLiteral(" [ ]");
    lines << (entry->isEnabled() ? line : line + QStringLiteral(" (cannot be used)"));
  }
  return lines;
}

/// Text of a label, without its marks of rich text.
QString shownText(const QLabel& label) {
  return (Qt::mightBeRichText(label.text()) ? QTextDocumentFragment::fromHtml(label.text()).toPlainText()
                                            : label.text())
      .simplified();
}

/// What the control holds; nothing: only what it is called.
QString valueOf(const QWidget& control) {
  if (const auto* box = qobject_cast<const QComboBox*>(&control)) return box->currentText();
  if (const auto* spin = qobject_cast<const QAbstractSpinBox*>(&control)) return spin->text();
  if (const auto* line = qobject_cast<const QLineEdit*>(&control)) return line->text();
  if (const auto* text = qobject_cast<const QPlainTextEdit*>(&control)) return text->toPlainText().simplified();
  if (const auto* text = qobject_cast<const QTextEdit*>(&control)) return text->toPlainText().simplified();
  if (const auto* tabs = qobject_cast<const QTabBar*>(&control)) {
    QStringList all;
    for (int i = 0; i < tabs->count(); ++i) {
      if (tabs->isTabVisible(i))
        all << (i == tabs->currentIndex() ? QStringLiteral("[%1]").arg(tabs->tabText(i)) : tabs->tabText(i));
    }
    return all.join(QLatin1Char(' '));
  }
  return control.accessibleDescription().simplified();
}

/// Their parts are told with them.
bool isWhole(const QWidget& control) {
  return qobject_cast<const QComboBox*>(&control) != nullptr ||
         qobject_cast<const QAbstractSpinBox*>(&control) != nullptr ||
         qobject_cast<const QAbstractItemView*>(&control) != nullptr ||
         qobject_cast<const QPlainTextEdit*>(&control) != nullptr ||
         qobject_cast<const QTextEdit*>(&control) != nullptr || qobject_cast<const QTabBar*>(&control) != nullptr;
}

void tell(const QWidget& control, int depth, QStringList& lines) {
  QString line;
  const auto* label = qobject_cast<const QLabel*>(&control);
  const auto* button = qobject_cast<const QAbstractButton*>(&control);
  if (label != nullptr) {
    line = shownText(*label);
  } else {
    const QString name = labelOf(control);
    const QString value = valueOf(control);
    if (button != nullptr || isWhole(control) || !control.accessibleName().isEmpty() || !value.isEmpty())
      line = QStringLiteral("<%1>").arg(name) + (value.isEmpty() ? QString() : QStringLiteral(" %1").arg(value));
    if (button != nullptr && button->isCheckable()) line += button->isChecked() ? " [x]" : " [ ]";
    if (!line.isEmpty() && !control.isEnabled()) line += QStringLiteral(" (cannot be used)");
  }
  const QString indent(2 * depth, QLatin1Char(' '));
  if (!line.isEmpty()) lines << indent + line;
  if (const auto* view = qobject_cast<const QAbstractItemView*>(&control)) {
    for (const QString& row : tableText(*view)) lines << indent + QStringLiteral("  ") + row;
  }
  if (const auto* menu = qobject_cast<const QMenu*>(&control)) lines << menuText(*menu);
  if (isWhole(control)) return;
  for (const QObject* child : control.children()) {
    const auto* inner = qobject_cast<const QWidget*>(child);
    if (inner != nullptr && inner->isVisible() && !inner->isWindow())
      tell(*inner, depth + (line.isEmpty() ? 0 : 1), lines);
  }
}

}  // namespace

QString pageState(const QWidget& window) {
  QStringList lines;
  tell(window, 0, lines);
  return lines.join(QLatin1Char('\n')) + QLatin1Char('\n');
}

}  // namespace spindrift::gui
