// SPDX-License-Identifier: Apache-2.0
// Time stamps of documents as UTC seconds since 1970, and back.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace spindrift {

/// "2026-01-31T08:00:00", with any fraction, with "Z", "+01:00", or nothing (taken as UTC); an MTConnect duration
/// ("...Z@10.5") is left out. Nothing if it is no such text.
[[nodiscard]] std::optional<double> parseUtc(std::string_view text);
/// "2026-01-31T08:00:00.123Z".
[[nodiscard]] std::string utcText(double utc_s);
/// Its date alone, "2026-03-01".
[[nodiscard]] std::string utcDay(double utc_s);

}  // namespace spindrift
