// SPDX-License-Identifier: GPL-3.0-or-later
// The desktop program: parse the command line, build the window, run.
#include <unistd.h>

#include <QApplication>
#include <QCommandLineParser>
#include <QDir>
#include <QElapsedTimer>
#include <QFile>
#include <QSettings>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTimer>
#include <algorithm>
#include <clocale>
#include <cstdio>
#include <ctime>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/log.h"
#include "core/base/program_reference.h"
#include "core/base/text.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/languages.h"
#include "widgets/common/preferences.h"
#include "widgets/jobs/job_bar.h"
#include "widgets/recording/recording.h"
#include "widgets/shell/demo.h"
#include "widgets/shell/diagnostics.h"
#include "widgets/shell/main_window.h"
#include "widgets/shell/manual_window.h"
#include "widgets/shell/self_test.h"
#include "widgets/shell/tour.h"
#include "widgets/theme/system_look.h"
#include "widgets/theme/theme.h"

namespace {

constexpr int exit_done = 0;
constexpr int exit_not_good_enough = 1;
constexpr int exit_bad_input = 2;
constexpr int exit_internal = 3;

constexpr double smallest_scale = 0.5;
constexpr double largest_scale = 4.0;

/// --scale has to be known before the application object is made. Returns why its value is not allowed, or nothing.
std::string applyScale(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    std::string text;
    if (argument == "--scale" && i + 1 < argc) {
      text = argv[i + 1];
    } else if (argument.starts_with("--scale=")) {
      text = argument.substr(8);
    } else {
      continue;
    }
    double scale = 0.0;
    if (!spindrift::parseNumber(text, scale) || scale < smallest_scale || scale > largest_scale) {
      return "--scale " + text + " is not allowed; allowed: a number from 0.5 to 4.";
    }
    qputenv("QT_SCALE_FACTOR", text.c_str());
  }
  return {};
}

/// Man page, completion of bash or Markdown of the program's own options.
spindrift::ProgramReference referenceOf(const QList<QCommandLineOption>& options, const QString& description) {
  spindrift::ProgramReference reference;
  reference.version = SPINDRIFT_VERSION;
  reference.summary = "workstation for thermal errors of machine tools";
  reference.see_also = {"spindrift-cli", "spindrift-fe"};
  reference.program.name = "spindrift";
  reference.program.description = description.toStdString();
  reference.program.arguments.push_back(
      {{"SESSION_OR_CAMPAIGN"},
       "FOLDER",
       {},
       QCoreApplication::translate("main", "A session or a campaign to open.").toStdString()});
  for (const QCommandLineOption& option : options) {
    spindrift::ProgramOption one;
    for (const QString& name : option.names())
      one.names.push_back((name.size() == 1 ? "-" : "--") + name.toStdString());
    one.value = option.valueName().toStdString();
    if (one.value.find('|') != std::string::npos) one.allowed = spindrift::splitList(one.value, '|');
    one.description = option.description().toStdString();
    reference.program.options.push_back(one);
  }
  return reference;
}

constexpr QSize smallest_window(1024, 700);
constexpr QSize largest_window(7680, 4320);

/// "1280x800"; nothing if it is no size that a window may have.
std::optional<QSize> sizeOf(const QString& text) {
  const QStringList parts = text.split(QLatin1Char('x'));
  const QSize size(parts.value(0).toInt(), parts.value(1).toInt());
  const bool allowed = parts.size() == 2 && size == size.expandedTo(smallest_window).boundedTo(largest_window);
  return allowed ? std::optional(size) : std::nullopt;
}

/// "en", "de": what --language may be.
QStringList languageCodes() {
  QStringList codes;
  for (const spindrift::gui::Language& one : spindrift::gui::availableLanguages()) codes << one.code;
  return codes;
}

/// What the command line asks for and the program does not have; empty if it is all right.
std::string wrongUsage(const QCommandLineParser& parser) {
  const QStringList words = parser.positionalArguments();
  if (words.size() > 1) {
    return "\"" + words[1].toStdString() +
           "\" is one word too many; allowed: one session, campaign or name of a demo. Commands are given "
           "to spindrift-cli.";
  }
  const QString theme = parser.value(QStringLiteral("theme"));
  if (parser.isSet(QStringLiteral("theme")) && theme != QLatin1String("light") && theme != QLatin1String("dark")) {
    return "--theme " + theme.toStdString() + " is not allowed; allowed: light or dark.";
  }
  const QString language = parser.value(QStringLiteral("language"));
  if (parser.isSet(QStringLiteral("language")) && !spindrift::gui::isAvailableLanguage(language)) {
    return "--language " + language.toStdString() +
           " is not allowed; allowed: " + languageCodes().join(QStringLiteral(" or ")).toStdString() + ".";
  }
  if (parser.isSet(QStringLiteral("json")) && !parser.isSet(QStringLiteral("self-test"))) {
    return "--json is allowed only together with --self-test.";
  }
  const QString size = parser.value(QStringLiteral("size"));
  if (parser.isSet(QStringLiteral("size")) && (!parser.isSet(QStringLiteral("tour")) || !sizeOf(size))) {
    return "--size " + size.toStdString() + " is not allowed; allowed: 1024x700 to 7680x4320, together with --tour.";
  }
  const bool unattended = parser.isSet(QStringLiteral("tour")) || parser.isSet(QStringLiteral("self-test")) ||
                          parser.isSet(QStringLiteral("startup-time")) || parser.isSet(QStringLiteral("manual"));
  if (parser.isSet(QStringLiteral("record")) && unattended) {
    return "--record is allowed only where somebody uses the window.";
  }
  if (!parser.isSet(QStringLiteral("demo")) || words.isEmpty()) return {};
  std::vector<std::string> known;
  for (const spindrift::gui::Demo& demo : spindrift::gui::demos()) known.push_back(demo.name);
  const std::string asked = words.front().toStdString();
  if (std::find(known.begin(), known.end(), asked) != known.end()) return {};
  return "--demo " + asked + " is not known; allowed: " + spindrift::joinedList(known, "or") + ".";
}

/// What a slot throws must not end the program and take unsaved thoughts along: it is told and written to the log.
class Application : public QApplication {
 public:
  using QApplication::QApplication;
  std::function<void(const QString&)> tell;

  bool notify(QObject* receiver, QEvent* event) override {
    try {
      return QApplication::notify(receiver, event);
    } catch (const spindrift::InputError& e) {
      report(spindrift::gui::coreSentence(e.what()));
    } catch (const std::exception& e) {
      spindrift::log(spindrift::LogLevel::Error, std::string("internal error: ") + e.what());
      report(
          QCoreApplication::translate("main", "Internal error, please report it: %1").arg(QString::fromUtf8(e.what())));
    }
    return false;
  }

 private:
  void report(const QString& sentence) const {
    if (tell) tell(sentence);
  }
};

/// Milliseconds since the system started this process.
double processAge_ms() {
  QFile file(QStringLiteral("/proc/self/stat"));
  timespec now{};
  if (!file.open(QIODevice::ReadOnly) || ::clock_gettime(CLOCK_BOOTTIME, &now) != 0) return 0.0;
  const QByteArray text = file.readAll();
  const double ticks = text.mid(text.lastIndexOf(')') + 2).split(' ').value(19).toDouble();
  return 1e3 * (static_cast<double>(now.tv_sec) - ticks / static_cast<double>(::sysconf(_SC_CLK_TCK))) +
         1e-6 * static_cast<double>(now.tv_nsec);
}

/// Until the first screen is drawn and answers: from the start of the process, loading of libraries included.
int startUpTime(spindrift::gui::MainWindow& window) {
  window.show();
  (void)window.grab();
  QCoreApplication::processEvents();
  timespec used{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
  std::printf("first usable window after %.0f ms, %.0f ms of them on the processor; memory %.0f MB\n", processAge_ms(),
              1e3 * static_cast<double>(used.tv_sec) + 1e-6 * static_cast<double>(used.tv_nsec),
              spindrift::gui::residentMegabytes());
  return exit_done;
}

int selfTest(spindrift::gui::MainWindow& window, const QString& json_file) {
  const spindrift::gui::SelfTestResult result = spindrift::gui::runSelfTest(window);
  const std::string json = result.json().dump(1) + "\n";
  if (json_file == QLatin1String("-")) {
    std::fputs(json.c_str(), stdout);
  } else {
    for (const auto& part : result.parts) {
      std::printf("%-4s  %-12s %s\n", part.passed ? "pass" : "FAIL", qPrintable(part.name), qPrintable(part.sentence));
    }
    std::printf("%s\n", result.passed() ? "passed" : "NOT passed");
    if (!json_file.isEmpty()) spindrift::writeFileAtomically(json_file.toStdString(), json);
  }
  return result.passed() ? exit_done : exit_not_good_enough;
}

/// One sentence on standard error, as of the command line.
int refused(const std::string& sentence) {
  std::fprintf(stderr, "spindrift: %s\n", sentence.c_str());
  return exit_bad_input;
}

int run(int argc, char** argv) {
  using namespace spindrift::gui;
  const std::string wrong_scale = applyScale(argc, argv);
  if (!wrong_scale.empty()) return refused(wrong_scale);
  const bool unattended = std::any_of(argv + 1, argv + argc, [](const char* argument) {
    return qstrcmp(argument, "--tour") == 0 || qstrcmp(argument, "--self-test") == 0 ||
           qstrcmp(argument, "--startup-time") == 0;
  });
  if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM") &&
      (unattended || (qEnvironmentVariableIsEmpty("DISPLAY") && qEnvironmentVariableIsEmpty("WAYLAND_DISPLAY")))) {
    qputenv("QT_QPA_PLATFORM", "offscreen");
  }
  Application application(argc, argv);
  std::setlocale(LC_NUMERIC, "C");
  QLocale::setDefault(QLocale::c());
  QCoreApplication::setApplicationName(QStringLiteral("spindrift"));
  QCoreApplication::setOrganizationName(QStringLiteral("spindrift"));
  QCoreApplication::setApplicationVersion(QStringLiteral(SPINDRIFT_VERSION));

  QCommandLineParser parser;
  parser.setApplicationDescription(QCoreApplication::translate(
      "main", "Spindrift: measure, understand and compensate the thermal errors of machine tools."));
  const QCommandLineOption help = parser.addHelpOption();
  const QCommandLineOption version = parser.addVersionOption();
  parser.addPositionalArgument(QStringLiteral("folder"),
                               QCoreApplication::translate("main", "A session or a campaign to open."),
                               QStringLiteral("[SESSION_OR_CAMPAIGN]"));
  const QCommandLineOption demo(QStringLiteral("demo"),
                                QCoreApplication::translate("main",
                                                            "Open a demo session of the virtual machine; its name may "
                                                            "follow: fiducials, holes, balls, scans, discrepancy, "
                                                            "own_pattern."));
  const QCommandLineOption tour(
      QStringLiteral("tour"),
      QCoreApplication::translate("main", "Walk through every step on demo data and save pictures in DIR."),
      QStringLiteral("DIR"));
  const QCommandLineOption size(
      QStringLiteral("size"),
      QCoreApplication::translate("main",
                                  "With --tour: size of the window; every page with each of its tabs is shown."),
      QStringLiteral("WIDTHxHEIGHT"));
  const QCommandLineOption theme_option(QStringLiteral("theme"), QCoreApplication::translate("main", "light or dark."),
                                        QStringLiteral("light|dark"));
  const QCommandLineOption language(
      QStringLiteral("language"),
      QCoreApplication::translate("main", "Language of the window; otherwise that of the preferences or the system."),
      languageCodes().join(QLatin1Char('|')));
  const QCommandLineOption scale(QStringLiteral("scale"),
                                 QCoreApplication::translate("main", "Scale of everything, 0.5 to 4."),
                                 QStringLiteral("N"));
  const QCommandLineOption self_test(
      QStringLiteral("self-test"),
      QCoreApplication::translate(
          "main", "Run all demos and compare their results with the known truth: pass or fail for each."));
  const QCommandLineOption json(
      QStringLiteral("json"),
      QCoreApplication::translate("main", "With --self-test: write the result to FILE, or to standard output with -."),
      QStringLiteral("FILE"));
  const QCommandLineOption start_time(
      QStringLiteral("startup-time"),
      QCoreApplication::translate("main", "Print how long it takes to the first usable window, and end."));
  const QCommandLineOption record(
      QStringLiteral("record"),
      QCoreApplication::translate("main",
                                  "Write what is done at the window, with what is typed, to FILE, so that others can "
                                  "do it again (JSON)."),
      QStringLiteral("FILE"));
  const QCommandLineOption manual(
      QStringLiteral("manual"),
      QCoreApplication::translate("main",
                                  "Write the manual in the language of --language to FILE, by its ending .html "
                                  "or .pdf, and end."),
      QStringLiteral("FILE"));
  const QCommandLineOption reference(
      QStringLiteral("reference"),
      QCoreApplication::translate(
          "main", "Print the reference of the options: a man page, the completion of bash, or Markdown."),
      QStringLiteral("man|bash|markdown"));
  const QList<QCommandLineOption> options = {demo,      tour, size,       theme_option, language, scale,
                                             self_test, json, start_time, record,       manual,   reference};
  parser.addOptions(options);
  if (!parser.parse(application.arguments())) {
    return refused(parser.errorText().toStdString());
  }
  if (parser.isSet(QStringLiteral("help"))) {
    std::printf("%s", qPrintable(parser.helpText()));
    return exit_done;
  }
  if (parser.isSet(QStringLiteral("version"))) {
    std::printf("spindrift %s\n", SPINDRIFT_VERSION);
    return exit_done;
  }
  if (parser.isSet(reference)) {
    const std::string format = parser.value(reference).toStdString();
    const std::string text = spindrift::referenceText(
        referenceOf(QList<QCommandLineOption>{help, version} + options, parser.applicationDescription()), format);
    std::fputs(text.c_str(), stdout);
    return exit_done;
  }
  if (const std::string wrong = wrongUsage(parser); !wrong.empty()) return refused(wrong);
  // The user's sessions, recent folders and settings are none of the business of tour and self-test.
  QTemporaryDir scratch;
  if (parser.isSet(tour) || parser.isSet(self_test) || parser.isSet(start_time) || parser.isSet(manual)) {
    QStandardPaths::setTestModeEnabled(true);
    QCoreApplication::setOrganizationName(QStringLiteral("spindrift-unattended"));
    qputenv("SPINDRIFT_SESSIONS", scratch.filePath(QStringLiteral("sessions")).toUtf8());
    QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, scratch.filePath(QStringLiteral("settings")));
  }
  const QString data = QStandardPaths::writableLocation(QStandardPaths::AppDataLocation);
  if (!data.isEmpty()) spindrift::startLogFile((data + QStringLiteral("/spindrift.log")).toStdString());

  // Pictures of a tour and what a self-test says are the same everywhere, unless a language is asked for.
  const bool unattended_run = parser.isSet(tour) || parser.isSet(self_test) || parser.isSet(manual);
  applyLanguage(parser.isSet(language) ? parser.value(language)
                : unattended_run       ? QStringLiteral("en")
                                       : preferences().language);
  if (parser.isSet(manual)) {
    writeManual(parser.value(manual).toStdString());
    return exit_done;
  }
  const QString kind = parser.value(theme_option);
  (void)SystemLook::instance();  // sees the colours of the platform before they are ours
  ThemeKind look = kind == QLatin1String("dark") ? ThemeKind::Dark : ThemeKind::Light;
  if (kind.isEmpty() && !parser.isSet(tour)) look = wantedTheme();
  applyTheme(application, look);

  MainWindow window;
  application.tell = [&window](const QString& sentence) { window.jobBar()->setMessage(sentence); };
  if (parser.isSet(start_time)) return startUpTime(window);
  if (parser.isSet(tour)) {
    QElapsedTimer timer;
    timer.start();
    TourOptions asked;
    if (parser.isSet(size)) asked = {*sizeOf(parser.value(size)), true};
    const TourResult result = runTour(window, parser.value(tour), asked);
    std::printf("%d pictures in %s, %.1f s\n", static_cast<int>(result.pictures.size()), qPrintable(parser.value(tour)),
                static_cast<double>(timer.elapsed()) / 1000.0);
    if (!result.failure.isEmpty()) {
      std::fprintf(stderr, "%s\n", qPrintable(result.failure));
      return exit_not_good_enough;
    }
    return exit_done;
  }
  if (parser.isSet(self_test)) return selfTest(window, parser.value(json));
  window.show();
  const QStringList folders = parser.positionalArguments();
  if (folders.isEmpty()) window.showNewsIfDue();
  const QString asked_demo =
      parser.isSet(demo) ? (folders.isEmpty() ? QStringLiteral("fiducials") : folders.front()) : QString();
  std::optional<Recorder> recorder;
  if (parser.isSet(record)) {
    recorder.emplace(asked_demo, currentLanguage(), window.size());
    recorder->keepIn(parser.value(record).toStdString());
  }
  if (parser.isSet(demo)) {
    window.startDemo(asked_demo);
  } else if (!folders.isEmpty()) {
    window.open(QDir(folders.front()).absolutePath());
  }
  return QApplication::exec();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const spindrift::InputError& e) {
    return refused(e.what());
  } catch (const std::exception& e) {
    std::fprintf(stderr, "internal error: %s\n", e.what());
    return exit_internal;
  }
}
