// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/discrepancy/put_in_dialog.h"

#include <QCoreApplication>
#include <QDialog>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QVBoxLayout>

#include "widgets/common/parts.h"

namespace spindrift::gui {
namespace {

QString putInText(const char* text) {
  return QCoreApplication::translate("SimulationPanel", text);
}

}  // namespace

QString askForVersionFolder(QWidget* parent, const QString& proposed, const QString& runs) {
  QDialog dialog(parent);
  dialog.setWindowTitle(putInText("Put it into the simulation"));
  auto* column = new QVBoxLayout(&dialog);
  column->setContentsMargins(24, 16, 24, 16);
  column->setSpacing(12);
  auto* words = new QLabel(putInText("The simulator is run until its parameters fit what was measured. Its new "
                                     "version is written to a new folder; the present one stays as it is.") +
                           QLatin1Char(' ') + runs);
  words->setWordWrap(true);
  column->addWidget(words);
  auto* line = new QHBoxLayout;
  auto* folder = new QLineEdit(proposed);
  folder->setAccessibleName(putInText("New folder"));
  folder->setMinimumWidth(440);
  auto* browse = makeButton(putInText("Browse …"), "folder-open");
  line->addWidget(folder, 1);
  line->addWidget(browse);
  column->addLayout(line);
  auto* buttons = new QHBoxLayout;
  buttons->addStretch(1);
  auto* cancel = makeButton(putInText("Cancel"), nullptr);
  auto* accept = makeButton(putInText("Put it in"), nullptr, "primary");
  accept->setDefault(true);
  buttons->addWidget(cancel);
  buttons->addWidget(accept);
  column->addLayout(buttons);
  QObject::connect(browse, &QPushButton::clicked, &dialog, [&dialog, folder] {
    const QString chosen = QFileDialog::getExistingDirectory(&dialog, putInText("An empty folder"), folder->text());
    if (!chosen.isEmpty()) folder->setText(chosen);
  });
  QObject::connect(folder, &QLineEdit::textChanged, accept,
                   [accept](const QString& path) { accept->setEnabled(!path.trimmed().isEmpty()); });
  QObject::connect(cancel, &QPushButton::clicked, &dialog, &QDialog::reject);
  QObject::connect(accept, &QPushButton::clicked, &dialog, &QDialog::accept);
  return dialog.exec() == QDialog::Accepted ? folder->text().trimmed() : QString();
}

}  // namespace spindrift::gui
