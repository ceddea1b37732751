// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/services/touch_results.h"

#include "core/base/error.h"
#include "widgets/common/core_sentence.h"

namespace spindrift::gui {

TouchResults::TouchResults(SessionModel& session) : QObject(&session), session_(session) {}

TouchResults& TouchResults::of(SessionModel& session) {
  auto* found = session.findChild<TouchResults*>(QString(), Qt::FindDirectChildrenOnly);
  return found != nullptr ? *found : *new TouchResults(session);
}

void TouchResults::follow() {
  const std::string folder = session_.campaign() == nullptr ? std::string() : session_.campaign()->folder.string();
  if (campaign_ == session_.campaignId() && folder_ == folder && generation_ == session_.captureGeneration()) return;
  campaign_ = session_.campaignId();
  folder_ = folder;
  generation_ = session_.captureGeneration();
  touches_.reset();
  failure_.clear();
}

std::shared_ptr<const TouchList> TouchResults::touches() {
  follow();
  if (touches_ == nullptr && failure_.isEmpty() && session_.campaign() != nullptr) {
    if (const auto file = session_.campaign()->captureList("touches.csv")) {
      try {
        touches_ = std::make_shared<TouchList>(TouchList::read(*file));
      } catch (const InputError& e) {
        failure_ = coreSentence(e.what());
      }
    }
  }
  return touches_;
}

const Artefact* artefactOf(const Campaign& campaign, const TouchList* touches) {
  if (touches != nullptr && !touches->touches.empty()) {
    if (const Artefact* a = campaign.machine.findArtefact(touches->touches.front().artefact)) return a;
  }
  return campaign.machine.artefacts.empty() ? nullptr : &campaign.machine.artefacts.front();
}

}  // namespace spindrift::gui
