// SPDX-License-Identifier: Apache-2.0
// The program's own diary: what was opened, run, saved and refused. A file a user can send.
#pragma once

#include <filesystem>
#include <string_view>

namespace spindrift {

enum class LogLevel { Debug, Info, Warning, Error };

/// Starts writing to `file` (rotating, 3 files of 2 MB). Without a call only warnings go to standard error.
void startLogFile(const std::filesystem::path& file);
void log(LogLevel level, std::string_view text);

}  // namespace spindrift
