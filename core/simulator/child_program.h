// SPDX-License-Identifier: Apache-2.0
// Another program, run without a shell in a folder, with a limit in time. It and what it starts are one process group
// and end together: when the program ends, when its time is over, when the user cancels.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/base/job_context.h"

namespace spindrift {

struct ChildProgram {
  std::vector<std::string> command;  ///< program (looked up in PATH, or a path from `folder`) and arguments
  std::filesystem::path folder;      ///< working directory
  std::filesystem::path log;         ///< absolute; standard output and error are appended
  double time_limit_s = 600.0;
  std::map<std::string, std::string> environment;  ///< replaces variables of this process
};

struct ChildEnd {
  enum class How { Exited, Signalled, TimeOut, TooMuchOutput, NotStarted };
  How how = How::Exited;
  int code = 0;  ///< exit status, number of the signal, or errno of the start
  double elapsed_s = 0.0;
};

/// Waits for the end. Throws Cancelled within 0.1 s of the user's wish; then the program is gone.
[[nodiscard]] ChildEnd runProgram(const ChildProgram& program, const JobContext& job);

}  // namespace spindrift
