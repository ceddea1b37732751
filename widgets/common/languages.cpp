// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/languages.h"

#include <QCoreApplication>
#include <QDoubleSpinBox>
#include <QKeyEvent>
#include <QLibraryInfo>
#include <QTranslator>
#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/reporting/report_language.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/demo_names.h"

// The catalogues lie in a static library: without this the linker leaves them out. It must stand outside of all
// namespaces.
static void initialiseTranslations() {
  Q_INIT_RESOURCE(translations);
}

namespace spindrift::gui {
namespace {

/// Point and comma of the keyboard are both the decimal sign of a box for numbers.
class DecimalKeys : public QObject {
 public:
  using QObject::QObject;
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() != QEvent::KeyPress) return false;
    const auto* key = static_cast<QKeyEvent*>(event);
    if (key->text() != QLatin1String(".") && key->text() != QLatin1String(",")) return false;
    const auto* box = qobject_cast<QDoubleSpinBox*>(watched);
    if (box == nullptr) box = qobject_cast<QDoubleSpinBox*>(watched->parent());
    if (box == nullptr) return false;
    const QString point = box->locale().decimalPoint();
    if (key->text() == point) return false;
    QKeyEvent other(QEvent::KeyPress, key->key(), key->modifiers(), point);
    QCoreApplication::sendEvent(watched, &other);
    return true;
  }
};

struct Installed {
  QString code = QStringLiteral("en");
  std::array<std::unique_ptr<QTranslator>, 2> catalogues;  ///< of the program, of Qt's own dialogs
};

Installed& installed() {
  static Installed one;
  return one;
}

std::unique_ptr<QTranslator> catalogue(const QString& name, const QString& folder) {
  auto one = std::make_unique<QTranslator>();
  if (!one->load(name, folder)) return nullptr;
  QCoreApplication::installTranslator(one.get());
  return one;
}

}  // namespace

const std::vector<Language>& availableLanguages() {
  static const std::vector<Language> all = {{QStringLiteral("en"), QStringLiteral("English")},
                                            {QStringLiteral("de"), QStringLiteral("Deutsch")}};
  return all;
}

bool isAvailableLanguage(const QString& code) {
  const auto& all = availableLanguages();
  return std::any_of(all.begin(), all.end(), [&](const Language& one) { return one.code == code; });
}

QString systemLanguage() {
  for (const QString& name : QLocale::system().uiLanguages()) {
    const QString code = name.section(QLatin1Char('-'), 0, 0).toLower();
    if (isAvailableLanguage(code)) return code;
  }
  return availableLanguages().front().code;
}

QLocale numbersOf(const QString& code) {
  QLocale locale = code == QLatin1String("en") ? QLocale::c() : QLocale(code);
  locale.setNumberOptions(QLocale::OmitGroupSeparator | QLocale::RejectGroupSeparator);
  return locale;
}

void applyLanguage(const QString& code) {
  const QString wanted = code.isEmpty() ? systemLanguage() : code;
  initialiseTranslations();
  Installed& now = installed();
  now.catalogues = {};  // a translator that is destroyed takes itself out
  now.code = isAvailableLanguage(wanted) ? wanted : availableLanguages().front().code;
  // English has a catalogue as well: of its plurals.
  now.catalogues[0] = catalogue(QStringLiteral("spindrift_") + now.code, QStringLiteral(":/translations"));
  now.catalogues[1] =
      catalogue(QStringLiteral("qtbase_") + now.code, QLibraryInfo::path(QLibraryInfo::TranslationsPath));
  QLocale::setDefault(numbersOf(now.code));
  std::optional<ReportLanguage> of_reports;
  if (now.code != availableLanguages().front().code) {
    of_reports = ReportLanguage{
        now.code.toStdString(), [](const std::string& english) { return coreSentence(english).toStdString(); },
        [](std::string_view english) {
          return QCoreApplication::translate("files", std::string(english).c_str()).toStdString();
        },
        [](const std::string& name) { return shownName(name).toStdString(); }};
  }
  offerReportLanguage(std::move(of_reports));
  static QObject* keys = nullptr;
  if (keys == nullptr) {
    keys = new DecimalKeys(QCoreApplication::instance());
    QCoreApplication::instance()->installEventFilter(keys);
  }
}

QString currentLanguage() {
  return installed().code;
}

}  // namespace spindrift::gui
