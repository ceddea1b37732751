// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the machine stands still, from what is connected: "The spindle is still turning (600 rpm): wait ...". Hidden
// while nothing that comes tells.
#pragma once

#include "widgets/common/parts.h"

namespace spindrift::gui {

class ConnectionsService;
class SessionModel;

class MachineStateLine : public Callout {
  Q_OBJECT
 public:
  explicit MachineStateLine(SessionModel& session, QWidget* parent = nullptr);

 private:
  void showNow();
  ConnectionsService& service_;
};

}  // namespace spindrift::gui
