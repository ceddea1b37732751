// SPDX-License-Identifier: Apache-2.0
// Lines of text from a serial line or a TCP port: what controls print (DPRNT), loggers, hand-made sensors.
//
// "line" is a pattern as of printed text (core/base/line_pattern.h), or a list of them of which the first that fits is
// taken: "T1={column} T2={bed}". An item is the name of a placeholder. "save":"touches.txt" appends every line to a
// file as it comes: a folder that is watched then takes printed touches in with the template that is used for files.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/line_pattern.h"
#include "core/connect/source.h"

namespace spindrift {

struct TextSourceOptions {
  std::string url;  ///< "serial:///dev/ttyUSB0" or "tcp://192.168.1.50:4001"
  std::vector<LinePattern> lines;
  std::filesystem::path save;  ///< empty: nowhere
  int baud = 9600;
  char parity = 'N';  ///< N, E or O
  int data_bits = 8;
  bool decimal_comma = false;
};

[[nodiscard]] std::unique_ptr<Source> makeTextSource(const TextSourceOptions& options);

}  // namespace spindrift
