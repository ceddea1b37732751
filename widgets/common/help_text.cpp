// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/help_text.h"

#include <QCoreApplication>
#include <QFile>
#include <QImage>
#include <QSet>
#include <QXmlStreamReader>

#include "widgets/theme/fonts.h"
#include "widgets/theme/theme.h"

static void loadHelp() {
  Q_INIT_RESOURCE(help);
}

namespace spindrift::gui {
namespace {

QString escaped(QStringView text) {
  QString out = text.toString();
  return out.replace(QLatin1Char('&'), QStringLiteral("&amp;"))
      .replace(QLatin1Char('<'), QStringLiteral("&lt;"))
      .replace(QLatin1Char('>'), QStringLiteral("&gt;"));
}

/// Blanks, tabs and line breaks together are one blank; a no-break space is none.
QString oneLine(const QString& text) {
  QString out;
  for (const QChar c : text) {
    const bool blank = c == QLatin1Char(' ') || c == QLatin1Char('\n') || c == QLatin1Char('\t');
    if (!blank) out += c;
    if (blank && !out.isEmpty() && !out.endsWith(QLatin1Char(' '))) out += QLatin1Char(' ');
  }
  if (out.endsWith(QLatin1Char(' '))) out.chop(1);
  return out;
}

QString startTag(const QXmlStreamReader& in) {
  QString tag = QLatin1Char('<') + in.qualifiedName().toString();
  for (const QXmlStreamNamespaceDeclaration& d : in.namespaceDeclarations())
    tag += QStringLiteral(" xmlns%1=\"%2\"")
               .arg(d.prefix().isEmpty() ? QString() : QLatin1Char(':') + d.prefix().toString(), d.namespaceUri());
  for (const QXmlStreamAttribute& a : in.attributes())
    tag += QStringLiteral(" %1=\"%2\"").arg(a.qualifiedName(), a.value().toString().toHtmlEscaped());
  return tag + QLatin1Char('>');
}

/// The file with each of its blocks in the language of the window; nothing if it is not there or is no XML. Blocks do
/// not stand in each other.
QString translatedFile(const QString& path) {
  static const QSet<QString> blocks{QStringLiteral("h3"), QStringLiteral("h4"), QStringLiteral("p"),
                                    QStringLiteral("li"), QStringLiteral("td"), QStringLiteral("text")};
  static const QString around = QStringLiteral("help");  // pieces of a page have no element around them
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return {};
  QXmlStreamReader in;
  const bool piece = path.endsWith(QLatin1String(".html"));
  if (piece) in.addData(QStringLiteral("<%1>").arg(around));
  in.addData(QString::fromUtf8(file.readAll()));
  if (piece) in.addData(QStringLiteral("</%1>").arg(around));
  QString out;
  qsizetype begin = 0;  // of what stands in the block
  while (!in.atEnd()) {
    const QXmlStreamReader::TokenType token = in.readNext();
    if (token == QXmlStreamReader::Characters) out += escaped(in.text());
    if ((!in.isStartElement() && !in.isEndElement()) || in.name() == around) continue;
    if (in.isStartElement()) {
      out += startTag(in);
      if (blocks.contains(in.name().toString())) begin = out.size();
    } else {
      if (blocks.contains(in.name().toString())) {
        const QString source = oneLine(out.mid(begin));
        out.truncate(begin);
        out += QCoreApplication::translate("help", source.toUtf8().constData());
      }
      if (in.name() != QLatin1String("img")) out += QStringLiteral("</%1>").arg(in.qualifiedName());
    }
  }
  return in.hasError() ? QString() : out;
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
