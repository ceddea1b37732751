// SPDX-License-Identifier: Apache-2.0
// Campaigns of the finite-element example machine (core/finite_elements/c_frame_machine.h,
// c_frame_deck.h) whose simulation lacks one cause.
//
// What was "measured" comes from CalculiX as well, but from another model of the machine than the simulation's: a finer
// mesh, half the increment, dimensions of the castings about 1 %, films and conductivity some per cent off, and with
// the cause of the story switched on; noise 0.5 um and 2 urad is added. The simulation of the campaign is the coarse
// deck with that cause switched off (0). A shop's day of eight hours: speeds with pauses, coolant in phases, a room
// that drifts. The last 30 % of the states are held out.
//
//   sun       sun on the front of the column, its begin and end inside the fitted part
//   friction  friction in the spindle's bearings
//   coolant   the coolant cools the table while it runs (in the other stories it takes up no heat)
//   room      the change of the room's temperature
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/job_context.h"
#include "core/finite_elements/c_frame_deck.h"
#include "core/machine/operating_log.h"
#include "core/machine/simulation_row.h"

namespace spindrift {

enum class CFrameStory { Sun, Friction, Coolant, Room };

[[nodiscard]] std::string_view toString(CFrameStory story) noexcept;
[[nodiscard]] std::optional<CFrameStory> cFrameStoryFromString(std::string_view name) noexcept;
/// "sun", "friction", "coolant", "room".
[[nodiscard]] const std::vector<std::string>& cFrameStoryNames();

struct CFrameCampaignOptions {
  double coarse_cell_mm = 110.0;  ///< of the simulation
  double fine_cell_mm = 60.0;     ///< of what is "measured"
  int states = 32;                ///< after the first
  double state_interval_s = 900.0;
  double increment_s = 300.0;  ///< of the simulation; half of it for what is measured
  double noise_um = 0.5;
  double noise_urad = 2.0;
};

/// What was written.
struct CFrameCampaign {
  std::size_t observations = 0;
  std::size_t simulation_rows = 0;
  std::size_t coarse_nodes = 0;
  std::size_t fine_nodes = 0;
  double coarse_s = 0.0;  ///< duration of one run of the campaign's simulation
  double fine_s = 0.0;
  double elapsed_s = 0.0;
  nlohmann::json truth;
};

/// The shop's day: rows every minute with `spindle_rpm`, `coolant` and `T_ambient_degC`. Every seed has other minutes
/// and another room, all have the same course of work.
[[nodiscard]] OperatingLog cFrameLog(double duration_s, std::uint64_t seed);

/// Values of the parameters that the story's simulation has, resp. of what was left out of it.
[[nodiscard]] CFrameValues simulatedValues(CFrameStory story);
[[nodiscard]] CFrameValues hiddenValues(CFrameStory story, double duration_s);

/// True if a program `ccx` stands in one of the folders of PATH.
[[nodiscard]] bool calculixIsInstalled();

/// Deviations of all points and components (um, urad) at the start and at the end of every state, as CalculiX finds
/// them; `changes` replace values of the deck. Throws SimulatorFailed, Cancelled: see ProgramSimulator.
[[nodiscard]] std::vector<SimulationRow> runDeck(const CFrameDeck& deck, const OperatingLog& log,
                                                 const CFrameValues& changes, const JobContext& job);

/// Runs CalculiX three times and writes campaign.json, machine.json, log.csv, observations.csv, simulation.csv and the
/// deck in fe/; beside the folder <folder>.truth.json: hidden parameters, the machine that was measured, noise-free gap
/// (rms of EX, EY, EZ in um and of EA, EB in urad; of the fitted and the held-out states) without and with what is
/// hidden. Deterministic: the same story, seed and program give the same campaign. Throws InputError: CalculiX is not
/// installed or fails, the folder is there and not empty; Cancelled. Then nothing is left behind.
CFrameCampaign writeCFrameCampaign(CFrameStory story, const std::filesystem::path& folder, std::uint64_t seed,
                                   const JobContext& job, const CFrameCampaignOptions& options = {});

}  // namespace spindrift
