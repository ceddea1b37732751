// SPDX-License-Identifier: GPL-3.0-or-later
// Help > What's new: what the changelog of this version says to operators and engineers.
#pragma once

#include <QDialog>
#include <QString>

namespace spindrift::gui {

/// What the newest version in a changelog (Markdown, CHANGELOG.md) has in short, in `language` ("en", "de"); empty if
/// nothing.
[[nodiscard]] QString newestNews(const QString& changelog, const QString& language);

class NewsDialog : public QDialog {
  Q_OBJECT
 public:
  explicit NewsDialog(QWidget* parent = nullptr);
};

/// True once after an update: this version has not been seen yet, another one has. A first start has no news.
[[nodiscard]] bool newsAreDue(const QString& version);

}  // namespace spindrift::gui
