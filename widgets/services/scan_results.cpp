// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/services/scan_results.h"

#include "core/base/error.h"
#include "widgets/common/core_sentence.h"

namespace spindrift::gui {

ScanResults::ScanResults(SessionModel& session) : QObject(&session), session_(session) {}

ScanResults& ScanResults::of(SessionModel& session) {
  auto* found = session.findChild<ScanResults*>(QString(), Qt::FindDirectChildrenOnly);
  return found != nullptr ? *found : *new ScanResults(session);
}

void ScanResults::follow() {
  const std::string folder = session_.campaign() == nullptr ? std::string() : session_.campaign()->folder.string();
  if (folder_ == folder && generation_ == session_.captureGeneration()) return;
  folder_ = folder;
  generation_ = session_.captureGeneration();
  read_ = false;
  captures_.clear();
  failure_.clear();
}

const std::vector<ScanCapture>& ScanResults::captures() {
  follow();
  if (!read_ && session_.campaign() != nullptr) {
    read_ = true;
    try {
      captures_ = readScanList(*session_.campaign());
    } catch (const InputError& e) {
      failure_ = coreSentence(e.what());
    }
  }
  return captures_;
}

std::string ScanResults::modelOfMachine() const {
  const auto campaign = session_.campaign();
  return campaign != nullptr && campaign->machine.profiler ? campaign->machine.profiler->scan_model : "rigid";
}

}  // namespace spindrift::gui
