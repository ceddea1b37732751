// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/services/touch_results.h"

#include <utility>

#include "widgets/jobs/job_runner.h"

namespace spindrift::gui {

TouchResults::TouchResults(SessionModel& session, JobRunner& jobs)
    : QObject(&session), session_(session), jobs_(jobs) {}

TouchResults& TouchResults::of(SessionModel& session, JobRunner& jobs) {
  auto* found = session.findChild<TouchResults*>(QString(), Qt::FindDirectChildrenOnly);
  return found != nullptr ? *found : *new TouchResults(session, jobs);
}

void TouchResults::follow() {
  const std::string folder = session_.campaign() == nullptr ? std::string() : session_.campaign()->folder.string();
  if (campaign_ == session_.campaignId() && folder_ == folder && generation_ == session_.captureGeneration()) return;
  if (campaign_ != session_.campaignId() || folder_ != folder) touches_.reset();
  campaign_ = session_.campaignId();
  folder_ = folder;
  generation_ = session_.captureGeneration();
  listed_ = false;
  reading_ = false;
  failure_.clear();
}

std::shared_ptr<const TouchList> TouchResults::touches() {
  follow();
  if (listed_ || reading_ || !failure_.isEmpty() || session_.campaign() == nullptr) return touches_;
  if (const auto file = session_.campaign()->captureList("touches.csv")) {
    begin(*file);
  } else {
    touches_.reset();
  }
  return touches_;
}

std::shared_ptr<const TouchList> TouchResults::asListed() {
  follow();
  return listed_ ? touches_ : nullptr;
}

QString TouchResults::whyNone() const {
  if (reading_) return tr("The list of touches is being read.");
  return failure_.isEmpty() ? tr("The campaign lists no touches yet.") : failure_;
}

void TouchResults::begin(const std::filesystem::path& file) {
  reading_ = true;
  // A job that was replaced ends after the one in its place was asked for.
  const auto still = [this, asked = ++asked_] {
    follow();
    return reading_ && asked_ == asked;
  };
  const auto end = [this, still](const auto& take) {
    if (!still()) return;
    reading_ = false;
    take();
    Q_EMIT read();
  };
  Job job;
  job.title = tr("Reading the list of touches");
  job.queue = JobQueue::Reading;
  job.key = "touches";
  job.work = [this, file, end](JobContext&) -> std::function<void()> {
    auto list = std::make_shared<const TouchList>(TouchList::read(file));
    return [this, list, end] {
      end([&] {
        touches_ = list;
        listed_ = true;
      });
    };
  };
  job.failed = [this, end](const QString& sentence) {
    end([&] {
      touches_.reset();
      failure_ = sentence;
    });
  };
  job.cancelled = [this, still] {
    if (still()) reading_ = false;
  };
  jobs_.run(std::move(job));
}

const Artefact* artefactOf(const Campaign& campaign, const TouchList* touches) {
  if (touches != nullptr && !touches->touches.empty()) {
    if (const Artefact* a = campaign.machine.findArtefact(touches->touches.front().artefact)) return a;
  }
  return campaign.machine.artefacts.empty() ? nullptr : &campaign.machine.artefacts.front();
}

}  // namespace spindrift::gui
