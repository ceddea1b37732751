// SPDX-License-Identifier: Apache-2.0
// The program's own diary: what was opened, run, saved and refused. A file a user can send.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace spindrift {

enum class LogLevel { Debug, Info, Warning, Error };

/// Starts writing to `file` (rotating, 3 files of 2 MB). Without a call only warnings go to standard error.
void startLogFile(const std::filesystem::path& file);
/// The last 200 messages, oldest first, each a line with its time.
[[nodiscard]] std::vector<std::string> recentMessages();
void log(LogLevel level, std::string_view text);

}  // namespace spindrift
