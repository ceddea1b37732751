// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/services/closed_loop_service.h"

#include <QDir>
#include <QFileInfo>
#include <algorithm>
#include <chrono>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/control/linuxcnc_control.h"
#include "core/reporting/report_language.h"
#include "core/workflows/loop_state.h"
#include "widgets/common/core_sentence.h"
#include "widgets/models/session_model.h"

namespace spindrift::gui {
namespace {

constexpr int look_ms = 250;

}  // namespace

ClosedLoopService::ClosedLoopService(SessionModel& session)
    : QObject(&session), make_([](const LoopPlan& plan) { return std::make_unique<LinuxcncControl>(plan.control); }) {
  timer_.setInterval(look_ms);
  connect(&timer_, &QTimer::timeout, this, &ClosedLoopService::poll);
}

ClosedLoopService::~ClosedLoopService() {
  wishes_->leave = true;
  answered_.notify_all();
  if (thread_.joinable()) thread_.join();
}

ClosedLoopService& ClosedLoopService::of(SessionModel& session) {
  auto* found = session.findChild<ClosedLoopService*>(QString(), Qt::FindDirectChildrenOnly);
  return found != nullptr ? *found : *new ClosedLoopService(session);
}

QString ClosedLoopService::load(const QString& file) {
  if (running_) return tr("The loop runs: stop it before another plan is opened.");
  try {
    LoopPlan plan = LoopPlan::read(file.toStdString());
    plan_ = std::move(plan);
  } catch (const InputError& e) {
    return coreSentence(e.what());
  }
  file_ = file;
  const QFileInfo info(file);
  folder_ = info.dir().filePath(info.completeBaseName() + QStringLiteral("-loop"));
  wishes_->hold = plan_->hold_when_silent;
  snapshot_ = {};
  Q_EMIT changed();
  return {};
}

void ClosedLoopService::setFolder(const QString& folder) {
  if (running_ || folder.isEmpty()) return;
  folder_ = folder;
  snapshot_ = {};
  Q_EMIT changed();
}

bool ClosedLoopService::resumable() const {
  return !folder_.isEmpty() && QFileInfo::exists(QDir(folder_).filePath(QString::fromLatin1(loop_state_file)));
}

DryRun ClosedLoopService::dryRun() const {
  const LoopTouch& first = plan_->touches.front();
  DryRun run = spindrift::dryRun(measuringProgram(*plan_), plan_->machine,
                                 {first.before_mm.x(), first.before_mm.y(), plan_->safe_z_mm});
  for (const LoopSpeed& speed : plan_->programme) run.largest_rpm = std::max(run.largest_rpm, speed.spindle_rpm);
  return run;
}

QString ClosedLoopService::start() {
  if (running_ || !plan_) return running_ ? QString() : tr("Open a plan first.");
  if (thread_.joinable()) thread_.join();
  const bool hold = wishes_->hold;
  wishes_ = std::make_shared<LoopWishes>();
  wishes_->hold = hold;
  try {
    control_ = make_(*plan_);
  } catch (const InputError& e) {
    return coreSentence(e.what());
  }
  {
    const std::scoped_lock lock(mutex_);
    latest_ = {};
    answer_.reset();
    ended_ = false;
  }
  snapshot_ = {};
  running_ = true;
  thread_ = std::thread([this] { run(*control_); });
  timer_.start();
  Q_EMIT changed();
  return {};
}

void ClosedLoopService::run(MachineControl& control) {
  LoopOperator who;
  who.wishes = wishes_;
  who.confirm = [](const DryRun&) { return true; };  // asked on the page before start()
  who.choose = [this](const DiscrepancyResult& found, const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    answer_.reset();
    latest_.choice = found;
    while (!answer_ && !stop.stop_requested() && !wishes_->leave && !wishes_->stop)
      answered_.wait_for(lock, std::chrono::milliseconds(200));
    latest_.choice.reset();
    return answer_.value_or(std::vector<std::string>());
  };
  QString failure;
  try {
    JobContext job;
    const std::filesystem::path folder = folder_.toStdString();
    const LoopResult result =
        runClosedLoop(*plan_, control, who, folder, job, [this](const LoopStatus& status, const LoopResult& so_far) {
          const std::scoped_lock lock(mutex_);
          latest_.status = status;
          latest_.any = true;
          // Copied when something was added: the loop turns more often than a cycle comes.
          if (latest_.result.events.size() != so_far.events.size() ||
              latest_.result.cycles.size() != so_far.cycles.size())
            latest_.result = so_far;
        });
    const Report report = result.report("Closed loop");
    writeFileAtomically(folder / "report.html", htmlOf(report));
    if (const auto& language = offeredReportLanguage())
      writeFileAtomically(folder / ("report." + language->code + ".html"), htmlOf(inLanguage(report, *language)));
    const std::scoped_lock lock(mutex_);
    latest_.result = result;
  } catch (const std::exception& e) {
    failure = coreSentence(e.what());
  }
  const std::scoped_lock lock(mutex_);
  latest_.failure = failure;
  ended_ = true;
}

void ClosedLoopService::poll() {
  bool ended = false;
  {
    const std::scoped_lock lock(mutex_);
    snapshot_ = latest_;
    ended = ended_;
  }
  if (ended && running_) {
    thread_.join();
    control_.reset();
    running_ = false;
    timer_.stop();
  }
  Q_EMIT changed();
}

void ClosedLoopService::stop() {
  wishes_->stop = true;
  answered_.notify_all();
}

void ClosedLoopService::setHold(bool hold) {
  wishes_->hold = hold;
  Q_EMIT changed();
}

void ClosedLoopService::accept(const std::vector<std::string>& ids) {
  {
    const std::scoped_lock lock(mutex_);
    answer_ = ids;
  }
  answered_.notify_all();
  snapshot_.choice.reset();
  Q_EMIT changed();
}

}  // namespace spindrift::gui
