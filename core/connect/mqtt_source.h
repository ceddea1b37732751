// SPDX-License-Identifier: Apache-2.0
// MQTT 3.1.1: plain values, values inside JSON, and Sparkplug B.
//
// Address of an item: a topic whose message is a number or a word, "hall/temperature"; "topic#path" of a value inside
// JSON, "umati/v2/mill#Monitoring.Spindle[0].Speed" ('#' cannot stand in a topic); a Sparkplug metric as
// "spBv1.0/group/node#Metric/Name" or "spBv1.0/group/node/device#Metric/Name".
// Sparkplug: aliases and units are learnt from births; after a gap in seq, data before a birth, or a death, a rebirth
// is asked for (NCMD "Node Control/Rebirth"), the one thing that is ever published, and it can be switched off. A death
// makes the metrics of its node unavailable if its bdSeq is that of the birth. Values between a gap and the next birth
// are told as missed. The connection is no clean session where a client id is given: the broker then keeps what comes
// meanwhile. Source: Sparkplug specification 3.0, Eclipse Foundation 2022.
#pragma once

#include <memory>
#include <string>

#include "core/connect/source.h"

namespace spindrift {

struct MqttOptions {
  std::string url;  ///< "mqtt://192.168.1.40:1883", "mqtts://broker:8883"
  std::string user;
  std::string password;    ///< never shown in any sentence
  std::string client_id;   ///< empty: the broker gives one
  std::string ca_file;     ///< of mqtts; empty: those of the system
  std::string will_topic;  ///< the broker publishes will_text there when this client dies; empty: none
  std::string will_text;
  bool ask_rebirth = true;
  double answer_s = 5.0;
  int keepalive_s = 10;
};

[[nodiscard]] std::unique_ptr<Source> makeMqttSource(const MqttOptions& options);

}  // namespace spindrift
