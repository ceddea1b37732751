// SPDX-License-Identifier: Apache-2.0
// A GenICam camera among the sources: how it is set (kept in connections.json, taken by the tab Camera as well), and
// how its frames arrive.
//
// Items: "exposure_us", "gain", "width", "height" (as the camera says them), "frames" and "incomplete" (counted since
// the connection; frames of which packets are missing are never evaluated).
#pragma once

#include <memory>
#include <string>

#include "core/base/json_reader.h"
#include "core/connect/genicam_camera.h"
#include "core/connect/source.h"

namespace spindrift {

/// What stands before the name of a camera: "genicam:Fake_1".
inline constexpr std::string_view genicam_prefix = "genicam:";

/// Of "exposure_us", "gain", "trigger" and "region":[x,y,width,height] of an entry of "sources". Throws InputError.
[[nodiscard]] GenicamSettings readGenicamSettings(const JsonNode& entry);

[[nodiscard]] std::unique_ptr<Source> makeGenicamSource(const std::string& camera, const GenicamSettings& settings);

}  // namespace spindrift
