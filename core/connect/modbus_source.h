// SPDX-License-Identifier: Apache-2.0
// Modbus TCP and RTU: PT100 and analogue modules, asked for their registers at an interval. Only reading functions (1
// to 4) are ever sent.
//
// Address of an item: "input:0", "holding:40:float32", "holding:2:int32:cdab", "coil:3", "discrete:0". Registers count
// from 0 as in the protocol (documentation that says 30001 or 40001 means 0). Types: int16 (the default), uint16,
// int32, uint32, float32, and the order of the bytes of the last three: abcd (high word first, the default), cdab,
// badc, dcba. The scale of a module is that of the column: "scale":0.1. Source: Modbus application protocol 1.1b3.
#pragma once

#include <memory>
#include <string>

#include "core/connect/source.h"

namespace spindrift {

struct ModbusOptions {
  /// "modbus://192.168.1.30:502", or of a serial line "rtu:///dev/ttyUSB0".
  std::string url;
  int unit_id = 1;
  double interval_s = 1.0;
  double answer_s = 1.0;  ///< longest time for one answer
  int baud = 9600;
  char parity = 'N';  ///< N, E or O
  int stop_bits = 1;
};

/// Throws std::invalid_argument with what is allowed if the text is no address of a register.
void checkModbusAddress(const std::string& address);

[[nodiscard]] std::unique_ptr<Source> makeModbusSource(const ModbusOptions& options);

}  // namespace spindrift
