// SPDX-License-Identifier: GPL-3.0-or-later
// Written by resources/translations/update.py from the sources; do not edit.
// The formats of each folder of core, and the words that several of them put together.
#pragma once

#include <span>

namespace spindrift::gui::core_formats {

[[nodiscard]] std::span<const char* const> base() noexcept;
[[nodiscard]] std::span<const char* const> connect() noexcept;
[[nodiscard]] std::span<const char* const> control() noexcept;
[[nodiscard]] std::span<const char* const> discrepancy() noexcept;
[[nodiscard]] std::span<const char* const> geometry() noexcept;
[[nodiscard]] std::span<const char* const> imaging() noexcept;
[[nodiscard]] std::span<const char* const> machine() noexcept;
[[nodiscard]] std::span<const char* const> math() noexcept;
[[nodiscard]] std::span<const char* const> plant() noexcept;
[[nodiscard]] std::span<const char* const> probing() noexcept;
[[nodiscard]] std::span<const char* const> reporting() noexcept;
[[nodiscard]] std::span<const char* const> scanning() noexcept;
[[nodiscard]] std::span<const char* const> session() noexcept;
[[nodiscard]] std::span<const char* const> simulation() noexcept;
[[nodiscard]] std::span<const char* const> simulator() noexcept;
[[nodiscard]] std::span<const char* const> tasks() noexcept;
[[nodiscard]] std::span<const char* const> thermal() noexcept;
[[nodiscard]] std::span<const char* const> words() noexcept;
[[nodiscard]] std::span<const char* const> workflows() noexcept;

inline constexpr std::span<const char* const> (*groups[])() noexcept = {
    base,
    connect,
    control,
    discrepancy,
    geometry,
    imaging,
    machine,
    math,
    plant,
    probing,
    reporting,
    scanning,
    session,
    simulation,
    simulator,
    tasks,
    thermal,
    words,
    workflows,
};

}  // namespace spindrift::gui::core_formats
