// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/help_text.h"

#include <QCoreApplication>
#include <QFile>
#include <QImage>
#include <QRegularExpression>

#include "widgets/theme/fonts.h"
#include "widgets/theme/theme.h"

static void loadHelp() {
  Q_INIT_RESOURCE(help);
}

namespace spindrift::gui {
namespace {

/// The file with each of its blocks in the language of the window; nothing if it is not there.
QString translatedFile(const QString& path) {
  static const QRegularExpression block(QStringLiteral("(<(h3|h4|p|li|td|text)\\b[^>]*>)(.*?)(</\\2>)"),
                                        QRegularExpression::DotMatchesEverythingOption);
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return {};
  const QString text = QString::fromUtf8(file.readAll());
  QString out;
  qsizetype done = 0;
  for (auto i = block.globalMatch(text); i.hasNext();) {
    const QRegularExpressionMatch match = i.next();
    const QByteArray source = match.captured(3).simplified().toUtf8();
    out += text.mid(done, match.capturedStart() - done) + match.captured(1) +
           QCoreApplication::translate("help", source.constData()) + match.captured(4);
    done = match.capturedEnd();
  }
  return out + text.mid(done);
}

}  // namespace

HelpText::HelpText(const QString& accessible_name, QWidget* parent) : QTextBrowser(parent) {
  loadHelp();
  setFrameShape(QFrame::NoFrame);
  setAccessibleName(accessible_name);
  document()->setDefaultFont(textFont(sizes::font_body));
  setWordWrapMode(QTextOption::WrapAtWordBoundaryOrAnywhere);
  document()->setDocumentMargin(2);
  document()->setIndentWidth(20);  // of lists: the panel is narrow
}

void HelpText::showHelp(const QString& name, const QString& behind) {
  setHtml(translatedFile(QStringLiteral(":/help/%1.html").arg(name)) + behind);
}

QVariant HelpText::loadResource(int type, const QUrl& name) {
  if (type == QTextDocument::ImageResource && name.path().endsWith(QLatin1String(".svg")))
    return QImage::fromData(
        translatedFile(QLatin1Char(':') + name.path().mid(name.path().indexOf(QLatin1Char('/')))).toUtf8(), "svg");
  return QTextBrowser::loadResource(type, name);
}

}  // namespace spindrift::gui
