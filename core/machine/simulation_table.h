// SPDX-License-Identifier: Apache-2.0
// simulation.csv: what another program predicts, `time_s,point,component,predicted`, or with `x_mm,y_mm,z_mm` in place
// of `point`. Predictions um or urad, places mm in MCF, times s.
//
// In time: linear between two rows of a point (or place) and component, never before the first or after the last (1 ms
// is allowed, for times that were written with few digits).
//
// In place (scattered_interpolation.h): exact at the simulated places, exact for every field that is linear in x, y, z,
// smooth between them; outside their convex hull continued linearly from its nearest point, which is told. A place
// whose rows do not reach the time asked for is not used at that time.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/machine/component.h"
#include "core/machine/observation.h"
#include "core/machine/simulation_row.h"

namespace spindrift {

class SimulationTable {
 public:
  /// Throws InputError: a missing column, an unknown component, what is no number, a time that runs backwards for a
  /// point, two predictions for the same.
  [[nodiscard]] static SimulationTable read(const std::filesystem::path& file);
  /// `file` stands in errors; rows of one point (or place) and component in order of time.
  SimulationTable(const std::vector<SimulationRow>& rows, bool by_place, const std::filesystem::path& file);

  /// Why there is a value or none.
  enum class Answer { Known, OutsidePlaces, BeforeOrAfter, UnknownPoint, UnknownComponent };
  struct Prediction {
    double value = 0.0;  ///< NaN unless Known or OutsidePlaces
    Answer answer = Answer::Known;
    double outside_mm = 0.0;  ///< distance to the convex hull of the simulated places
  };
  [[nodiscard]] Prediction at(double time_s, const std::string& point, const Eigen::Vector3d& position_mm,
                              Component component) const;
  [[nodiscard]] bool byPlace() const noexcept { return by_place_; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// Points of a table by point, sorted.
  [[nodiscard]] std::vector<std::string> points() const;
  [[nodiscard]] double firstTime_s() const noexcept { return first_s_; }
  [[nodiscard]] double lastTime_s() const noexcept { return last_s_; }

 private:
  struct Series {
    std::vector<double> time_s;
    std::vector<double> value;
    [[nodiscard]] bool reaches(double time_s) const;
    [[nodiscard]] double at(double time_s) const;
  };
  /// The places that predict one component, with what was worked out for places asked for.
  struct Places;
  [[nodiscard]] Prediction between(double time_s, const Eigen::Vector3d& position_mm, Component component) const;

  bool by_place_ = false;
  std::size_t size_ = 0;
  double first_s_ = 0.0;
  double last_s_ = 0.0;
  std::map<std::string, std::map<Component, Series>, std::less<>> series_;
  std::map<Component, std::shared_ptr<Places>> places_;
};

/// Predictions for observations, and sentences about those that have none or lie outside.
struct SimulationMatch {
  std::vector<double> predicted;  ///< one for every row, NaN where there is none
  std::vector<std::string> notes;
  std::string why_unmatched;  ///< "12 lie before or after its rows (0 s to 3600 s), 4 at points that it lacks: F3"
};
/// `known_points` are those of machine.json; `name` of the simulation stands in the notes.
[[nodiscard]] SimulationMatch matchSimulation(const SimulationTable& table, const ObservationSet& observations,
                                              const std::vector<std::string>& known_points, std::string_view name);

}  // namespace spindrift
