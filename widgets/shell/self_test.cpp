// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/shell/self_test.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "core/base/error.h"
#include "widgets/jobs/job_bar.h"
#include "widgets/shell/demo.h"
#include "widgets/shell/diagnostics.h"
#include "widgets/shell/main_window.h"
#include "widgets/shell/tour.h"

namespace spindrift::gui {
namespace {

constexpr int seconds_per_step = 180;
constexpr double most_memory_MB = 1024.0;
constexpr double part_within_three_sigma = 0.95;

QString selfTestText(const char* text) {
  return QCoreApplication::translate("SelfTest", text);
}

/// Deviations of the evaluation beside those of the truth; both count from the first state.
SelfTestPart judgeDeviations(const QString& name, const ObservationSet& measured, const nlohmann::json& truth) {
  using Key = std::tuple<std::string, std::string, std::string>;
  std::map<Key, double> expected;
  for (const auto& row : truth.at("captures")) {
    expected[{row.at("state"), row.at("point"), row.at("component")}] = row.at("value");
  }
  const std::string first = measured.states().empty() ? std::string() : measured.states().front();
  std::map<std::pair<std::string, std::string>, std::pair<double, double>> start;
  for (const Observation& o : measured.rows) {
    if (o.state == first) start[{o.point, std::string(toString(o.component))}] = {o.value, o.sigma};
  }
  int count = 0;
  int within = 0;
  double squares = 0.0;
  for (const Observation& o : measured.rows) {
    const std::string component(toString(o.component));
    const auto found = expected.find({o.state, o.point, component});
    const auto zero = start.find({o.point, component});
    if (o.state == first || found == expected.end() || zero == start.end()) continue;
    const double error = o.value - zero->second.first - found->second;
    ++count;
    squares += isRotation(o.component) ? 0.0 : error * error;
    if (std::abs(error) <= 3.0 * std::hypot(o.sigma, zero->second.second)) ++within;
  }
  SelfTestPart part;
  part.name = name;
  const double share = count > 0 ? static_cast<double>(within) / count : 0.0;
  const double rms = count > 0 ? std::sqrt(squares / count) : 0.0;
  part.passed = count > 0 && share >= part_within_three_sigma;
  part.figures = {{"deviations", count}, {"within_three_sigma", share}, {"rms_error_um", rms}};
  part.sentence = selfTestText("%1 deviations, %2 % within three standard uncertainties of the truth, rms error %3 µm")
                      .arg(count)
                      .arg(100.0 * share, 0, 'f', 1)
                      .arg(rms, 0, 'f', 2);
  return part;
}

SelfTestPart judgeDiscrepancy(const QString& name, const nlohmann::json& found, const nlohmann::json& truth) {
  SelfTestPart part;
  part.name = name;
  std::vector<std::string> hidden = truth.at("hidden");
  std::string named;
  std::size_t right = 0;
  for (const std::string& id : hidden) {
    for (const auto& effect : found.value("effects", nlohmann::json::array())) {
      std::vector<std::string> ids = effect.value("rivals", std::vector<std::string>());
      ids.push_back(effect.at("id"));
      if (std::find(ids.begin(), ids.end(), id) != ids.end()) ++right;
    }
  }
  for (const auto& effect : found.value("effects", nlohmann::json::array())) {
    named += (named.empty() ? "" : ", ") + effect.at("id").get<std::string>();
  }
  std::string hidden_names;
  for (const std::string& id : hidden) hidden_names += (hidden_names.empty() ? "" : ", ") + id;
  part.passed = right == hidden.size() && !hidden.empty();
  part.figures = {{"hidden", hidden}, {"verdict", found.value("verdict", std::string())}, {"named", named}};
  part.sentence = selfTestText("hidden: %1; named: %2")
                      .arg(QString::fromStdString(hidden_names),
                           named.empty() ? selfTestText("nothing") : QString::fromStdString(named));
  return part;
}

SelfTestPart failed(const QString& name, const QString& sentence) {
  SelfTestPart part;
  part.name = name;
  part.sentence = sentence;
  return part;
}

SelfTestPart runDemo(MainWindow& window, const Demo& demo) {
  const QString name = QString::fromStdString(demo.name);
  window.startDemo(name, true);
  if (!waitForJobs(window, seconds_per_step) || window.session().campaign() == nullptr) {
    return failed(name, selfTestText("the demo could not be made: %1").arg(window.jobBar()->message()));
  }
  for (const StepId step : all_steps) {
    window.workflow().goTo(step);
    if (window.currentPage() == nullptr) return failed(name, selfTestText("%1 has no page").arg(stepTitle(step)));
    window.currentPage()->runAll();
    if (!waitForJobs(window, seconds_per_step)) {
      return failed(name, selfTestText("%1 did not finish").arg(stepTitle(step)));
    }
  }
  JobContext job;
  const nlohmann::json truth = demoTruth(demo.name, true, job);
  if (truth.contains("captures")) {
    const auto evaluation = window.session().evaluation();
    if (evaluation == nullptr) return failed(name, selfTestText("the captures were not evaluated"));
    return judgeDeviations(name, evaluation->observations, truth);
  }
  const auto story = window.session().result("discrepancy");
  if (!story) return failed(name, selfTestText("the discrepancy was not searched"));
  return judgeDiscrepancy(name, story->payload, truth);
}

}  // namespace

bool SelfTestResult::passed() const {
  return !parts.empty() && std::all_of(parts.begin(), parts.end(), [](const SelfTestPart& p) { return p.passed; });
}

nlohmann::json SelfTestResult::json() const {
  nlohmann::json list = nlohmann::json::array();
  for (const SelfTestPart& part : parts) {
    list.push_back({{"name", part.name.toStdString()},
                    {"passed", part.passed},
                    {"sentence", part.sentence.toStdString()},
                    {"figures", part.figures}});
  }
  return {{"passed", passed()}, {"version", SPINDRIFT_VERSION}, {"parts", list}};
}

SelfTestResult runSelfTest(MainWindow& window) {
  SelfTestResult result;
  window.resize(1440, 900);
  window.show();
  for (const Demo& demo : demos()) {
    try {
      result.parts.push_back(runDemo(window, demo));
    } catch (const std::exception& e) {
      result.parts.push_back(failed(QString::fromStdString(demo.name), QString::fromUtf8(e.what())));
    }
  }
  result.memory_MB = residentMegabytes();
  result.peak_memory_MB = peakMegabytes();
  SelfTestPart memory;
  memory.name = QStringLiteral("memory");
  memory.passed = result.memory_MB <= most_memory_MB;
  memory.figures = {{"resident_MB", result.memory_MB}, {"peak_MB", result.peak_memory_MB}};
  memory.sentence = selfTestText("%1 MB in use after all demos, at most %2 MB")
                        .arg(result.memory_MB, 0, 'f', 0)
                        .arg(result.peak_memory_MB, 0, 'f', 0);
  result.parts.push_back(std::move(memory));
  return result;
}

}  // namespace spindrift::gui
