// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/question.h"

#include <QCheckBox>
#include <QCoreApplication>
#include <QMessageBox>
#include <QPushButton>

namespace spindrift::gui {

bool goAhead(const Question& question, QWidget* parent) {
  if (!(preferences().*question.asked)) return true;
  QMessageBox box(QMessageBox::Question, question.title, question.sentence, QMessageBox::Cancel, parent);
  const QPushButton* yes = box.addButton(question.go_ahead, QMessageBox::DestructiveRole);
  box.setDefaultButton(QMessageBox::Cancel);
  auto* never = new QCheckBox(QCoreApplication::translate("Question", "Do not ask again"));
  box.setCheckBox(never);
  box.exec();
  if (box.clickedButton() != yes) return false;
  if (never->isChecked()) {
    Preferences changed = preferences();
    changed.*question.asked = false;
    setPreferences(changed);
  }
  return true;
}

}  // namespace spindrift::gui
