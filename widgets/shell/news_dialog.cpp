// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/shell/news_dialog.h"

#include <QFile>
#include <QHBoxLayout>
#include <QPushButton>
#include <QSettings>
#include <QTextBrowser>
#include <QVBoxLayout>

#include "widgets/common/languages.h"
#include "widgets/common/parts.h"
#include "widgets/theme/fonts.h"

static void loadNews() {
  Q_INIT_RESOURCE(help);
}

namespace spindrift::gui {

QString newestNews(const QString& changelog, const QString& language) {
  const QString title =
      language == QLatin1String("de") ? QStringLiteral("### In Kürze") : QStringLiteral("### In short");
  QString news;
  bool in_version = false;
  bool in_part = false;
  for (const QString& line : changelog.split(QLatin1Char('\n'))) {
    if (line.startsWith(QStringLiteral("## "))) {
      if (in_version) break;
      in_version = true;
    } else if (line.startsWith(QStringLiteral("### "))) {
      in_part = in_version && line == title;
    } else if (in_part) {
      news += line + QLatin1Char('\n');
    }
  }
  return news.trimmed();
}

NewsDialog::NewsDialog(QWidget* parent) : QDialog(parent) {
  loadNews();
  setObjectName(QStringLiteral("news"));
  setWindowTitle(tr("What's new"));
  setAttribute(Qt::WA_DeleteOnClose);
  resize(860, 640);
  auto* column = new QVBoxLayout(this);
  auto* text = new QTextBrowser;
  text->setFrameShape(QFrame::NoFrame);
  text->setAccessibleName(tr("What's new"));
  text->document()->setDefaultFont(textFont(sizes::font_body));
  QFile file(QStringLiteral(":/help/changelog.md"));
  if (file.open(QIODevice::ReadOnly))
    text->setMarkdown(newestNews(QString::fromUtf8(file.readAll()), currentLanguage()));
  column->addWidget(text, 1);
  auto* line = new QHBoxLayout;
  line->addStretch();
  auto* close = makeButton(tr("Close"), nullptr);
  close->setDefault(true);
  line->addWidget(close);
  column->addLayout(line);
  connect(close, &QPushButton::clicked, this, &QDialog::accept);
}

bool newsAreDue(const QString& version) {
  QSettings settings;
  const QString key = QStringLiteral("news/seen");
  const QString seen = settings.value(key).toString();
  if (seen == version) return false;
  settings.setValue(key, version);
  return !seen.isEmpty();
}

}  // namespace spindrift::gui
