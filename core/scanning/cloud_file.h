// SPDX-License-Identifier: Apache-2.0
// Clouds in files: PCD (ascii, binary, binary_compressed), PLY (ascii, binary little and big endian), CSV
// (x_mm,y_mm,z_mm). Positions in mm, float or double.
//
// Points that are not finite (a profiler's missing samples) are dropped on reading. Every reader checks the header
// against the size of the file and says in one sentence what is wrong. Sources: PCD 0.7 (pointclouds.org), PLY 1.0
// (Turk 1994), LZF (liblzf's stream format).
#pragma once

#include <cstddef>
#include <filesystem>

#include "core/scanning/cloud.h"

namespace spindrift {

enum class CloudEncoding { Ascii, Binary, BinaryCompressed };

/// Bytes of a file that is read as a cloud.
inline constexpr std::size_t largest_cloud_file = 4'000'000'000;

/// Reads by the file's extension (.pcd, .ply, .csv) and finds the profiles (from WIDTH x HEIGHT or from the jumps in
/// x). Throws InputError: missing, truncated or lying header, no x, y, z, zero points, all points missing, mixed
/// units, a file of more than largest_cloud_file bytes.
[[nodiscard]] PointCloud readCloud(const std::filesystem::path& file);

/// Writes by extension, atomically; `single_precision` false keeps doubles. CSV and PLY have no compressed form
/// (InputError).
void writeCloud(const PointCloud& cloud, const std::filesystem::path& file,
                CloudEncoding encoding = CloudEncoding::Binary, bool single_precision = true);

}  // namespace spindrift
