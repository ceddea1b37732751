// SPDX-License-Identifier: Apache-2.0
// Thermal states, models and campaigns side by side: what one pane of a review shows, the difference of two of them,
// and a section through them.
//
// Values of a state are changes from the first state of the campaign (the reference), um or urad, MCF; so are those of
// models. Three kinds of models are shown: the nine parameters of the state, the simulation that the campaign names,
// and this simulation with the effects that were added to it. The heat map of the nine parameters is the model over the
// table; every other heat map is a field between the points (kriging, core/machine/interpolated_field.h), where these
// spread over the plane. Such a map is of one angle of a rotary table: what stands at another angle is another place on
// the table, and its deviation holds for another pose of the machine. A difference is `b` minus `a`; both are taken as
// independent: sigma^2 = sigma_a^2 + sigma_b^2.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/machine/field.h"
#include "core/machine/machine_description.h"
#include "core/machine/nine_parameter_model.h"
#include "core/machine/observation.h"
#include "core/workflows/discrepancy_story.h"

namespace spindrift {

enum class ReviewQuantity {
  Measured,
  NineParameters,
  NineParametersLeft,  ///< measured minus nine parameters
  Simulation,
  SimulationLeft,
  Completed,  ///< simulation with the effects added
  CompletedLeft,
};
/// "measured", "nine parameters", "measured minus simulation".
[[nodiscard]] std::string_view toString(ReviewQuantity quantity) noexcept;

struct ReviewRequest {
  std::string state;
  ReviewQuantity quantity = ReviewQuantity::Measured;
  Component component = Component::EX;
  int nodes = 81;            ///< of the longer side of a model's heat map; between points half of it
  bool heat_map = false;     ///< also between points; that of the nine parameters is always there
  NineParameterOptions fit;  ///< of the nine parameters; its state counts for nothing beside `state`
  /// Only points that were measured at this angle of the table; without it all, and several angles have no map between.
  std::optional<double> c_deg;
};

/// What a model says for every row of the observations, um or urad; NaN where it says nothing. Empty `value`: there is
/// no such model, and `why` is the reason.
struct ReviewPrediction {
  std::vector<double> value;
  std::vector<double> sigma;
  std::string why;
  std::string uncertainty;  ///< what sigma is, in a few words without a full stop; empty: not known
};
/// The simulation that the campaign names.
[[nodiscard]] ReviewPrediction reviewSimulation(const Campaign& campaign, const ObservationSet& observations);
/// The completed model of a discrepancy, matched by point, component and time.
[[nodiscard]] ReviewPrediction reviewCompleted(const DiscrepancyStory& story, const ObservationSet& observations);

/// A value at a point; sigma is one standard uncertainty.
struct ReviewValue {
  double value = 0.0;
  double sigma = 0.0;
};

struct ReviewPoint {
  std::string id;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  double c_deg = 0.0;                           ///< rotation of the table about +Z
  bool used = true;                             ///< false: holdout or excluded
  std::map<Component, ReviewValue> components;  ///< everything known at the point
};

/// What one pane shows.
struct ReviewPicture {
  std::string title;  ///< "M3 measured"
  Component component = Component::EX;
  std::vector<ReviewPoint> points;
  std::optional<Field> field;  ///< heat map of the component, where there is one
  std::string message;         ///< why there is no heat map; empty if there is or none was asked for
  std::string uncertainty;     ///< what the stated uncertainties are, where they are not those of the measurement
  double largest = 0.0;        ///< |value| of the component over points and determined nodes
};

/// Angles of the table at which anything was measured, ascending, deg; at least one where there are observations.
[[nodiscard]] std::vector<double> tableAngles(const ObservationSet& observations);

/// Points and heat map of one state. `prediction` is of the model asked for; not used for measured values and the nine
/// parameters. Throws InputError for a state that does not exist.
[[nodiscard]] ReviewPicture reviewOf(const ObservationSet& observations, const MachineDescription& machine,
                                     const ReviewRequest& request, const ReviewPrediction* prediction = nullptr);

/// b minus a: at the points both have, and over the grid if both have a heat map of the same component.
[[nodiscard]] ReviewPicture reviewDifference(const ReviewPicture& a, const ReviewPicture& b);

/// A line through a field along x (or y) at a fixed y (or x): places and values with their sigma. Nodes that the model
/// does not determine are left out. Between rows of the grid values are interpolated.
struct ReviewSection {
  std::vector<double> place_mm;
  std::vector<double> value;
  std::vector<double> sigma;
};
[[nodiscard]] ReviewSection reviewSection(const Field& field, bool along_x, double at_mm);

}  // namespace spindrift
