// SPDX-License-Identifier: GPL-3.0-or-later
// A text of the help with its drawing, in the language of the window.
//
// Help is written as HTML and SVG (resources/help). Each of its blocks (heading, paragraph, item, cell, text of a
// drawing) is a text of the catalogues, with its marks, in the context "help".
#pragma once

#include <QTextBrowser>

namespace spindrift::gui {

class HelpText : public QTextBrowser {
  Q_OBJECT
 public:
  explicit HelpText(const QString& accessible_name, QWidget* parent = nullptr);
  /// ":/help/NAME.html", and HTML that is put behind it.
  void showHelp(const QString& name, const QString& behind = {});
  [[nodiscard]] QVariant loadResource(int type, const QUrl& name) override;
};

}  // namespace spindrift::gui
