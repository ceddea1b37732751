// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/error.h"
#include "core/machine/machine_description.h"
#include "core/probing/printed_text.h"
#include "core/probing/program_block.h"
#include "core/probing/touch.h"
#include "core/probing/touch_stream.h"
#include "tests/fuzz/readers.h"

namespace spindrift::testing {
namespace {

const MachineDescription& machine() {
  static const MachineDescription read =
      MachineDescription::parse(JsonNode::parse(smallMachine(), "machine.json"), "machine.json");
  return read;
}

void touches(std::string_view bytes) {
  const TouchList read = TouchList::parse(std::string(bytes), "touches.csv");
  const TouchList back = TouchList::parse(read.csv(), "back.csv");
  SPINDRIFT_ASSERT(back.touches.size() == read.touches.size(), "every touch is written");
}

/// The file grows by halves.
void stream(TouchStream all, std::string_view bytes) {
  for (std::size_t part = 0; part < 4; ++part) {
    const std::size_t from = bytes.size() * part / 4;
    (void)all.update(bytes.substr(from, bytes.size() * (part + 1) / 4 - from));
  }
}

void touchStream(std::string_view bytes) {
  stream(TouchStream("touches.csv", machine()), bytes);
}

/// The template up to an empty line, then the text.
void printed(std::string_view bytes) {
  const std::size_t gap = bytes.find("\n\n");
  const JsonNode pattern = JsonNode::parse(bytes.substr(0, gap), "template.json");
  const std::string_view text = gap == std::string_view::npos ? std::string_view() : bytes.substr(gap + 2);
  stream(TouchStream("printed.txt", machine(), pattern), text);
  (void)readPrintedText(text, "printed.txt", pattern, machine());
}

/// Blocks of a measuring programme; the language is told by the text.
void programBlocks(std::string_view bytes) {
  for (const ProgramBlock& block : readProgramBlocks(bytes))
    SPINDRIFT_ASSERT(block.line > 0, "a block says where it stands");
}

constexpr Reader readers[] = {
    {"touches", touches}, {"touch_stream", touchStream}, {"printed", printed}, {"nc_program", programBlocks}};

}  // namespace

std::span<const Reader> probingReaders() {
  return readers;
}

}  // namespace spindrift::testing
