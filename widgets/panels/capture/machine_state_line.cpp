// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/capture/machine_state_line.h"

#include "core/connect/live_recording.h"
#include "widgets/common/core_sentence.h"
#include "widgets/models/cells.h"
#include "widgets/services/connections_service.h"

namespace spindrift::gui {

MachineStateLine::MachineStateLine(SessionModel& session, QWidget* parent)
    : Callout(parent), service_(ConnectionsService::of(session)) {
  connect(&service_, &ConnectionsService::changed, this, &MachineStateLine::showNow);
  showNow();
}

void MachineStateLine::showNow() {
  const MachineRest rest = machineRest(service_.snapshot());
  if (!rest.tells) {
    set(Tone::Neutral, {});
    return;
  }
  const QString now = service_.machineAt(service_.snapshot().now_s - service_.startUtc());
  if (rest.at_rest) {
    set(Tone::Good, tr("The machine stands still: %1.").arg(now));
  } else {
    set(Tone::Attention, coreSentence(rest.sentence));
  }
}

}  // namespace spindrift::gui
