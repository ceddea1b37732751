// SPDX-License-Identifier: Apache-2.0
// MTConnect agents, versions 1.0 to 2.x: /probe lists, /current gives the state, streamed /sample what follows.
//
// A stream is read by its documents, found by their end, whatever boundaries and lengths say. After a fault it goes on
// at the next sequence number; where the agent no longer has that (OUT_OF_RANGE, another instanceId, a buffer that has
// run over), it begins again at /current and says what was missed. Stamps are those of the adapters, so each device has
// a clock of its own. Conditions give 0 normal, 1 warning, 2 fault: the worst that is active. An address is the id of a
// data item or its name; of a value of several numbers "id[0]", "id[1]", ... Source: ANSI/MTC1.4-2018 parts 1 to 3.
#pragma once

#include <memory>
#include <string>

#include "core/connect/source.h"

namespace spindrift {

struct MtconnectOptions {
  std::string url;           ///< "http://192.168.1.20:5000", or with a device: "http://192.168.1.20:5000/mill"
  double interval_s = 0.2;   ///< at which the agent gathers
  double heartbeat_s = 2.0;  ///< it answers at least that often; silence of three of them is a dead agent
  double answer_s = 10.0;    ///< longest time for one document
  int sample_count = 10000;  ///< most observations of one document
};

[[nodiscard]] std::unique_ptr<Source> makeMtconnectSource(const MtconnectOptions& options);

}  // namespace spindrift
