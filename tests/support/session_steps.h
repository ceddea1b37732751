// SPDX-License-Identifier: GPL-3.0-or-later
// What happens to a session when a capture arrives or a result is ready the moment it is asked for, in one call.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/atomic_file.h"
#include "core/session/session.h"

namespace spindrift::testing {

/// Started and kept at once. Its id.
inline std::int64_t addResult(Session& session, std::int64_t campaign, const std::string& kind,
                              const nlohmann::json& options, const nlohmann::json& payload) {
  return session.keepResult(session.originOf(campaign, kind, options), payload)->id;
}

/// As an image arrives: its file in the campaign folder as `stored` ("captures/a.jpg"), then its row, which names it.
inline void addCapture(Session& session, std::int64_t campaign, const std::string& list, const std::string& header,
                       const std::string& row, const std::filesystem::path& source, const std::string& stored) {
  writeFileAtomically(session.campaign(campaign).folder / stored, readFile(source));
  session.addCaptureRows(campaign, list, header, {row});
}

}  // namespace spindrift::testing
