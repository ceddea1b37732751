// SPDX-License-Identifier: Apache-2.0
// "What if": the errors of a machine set by hand, and what they do to probing points, artefacts and a milled part.
//
// The deviation is a sum, linear in every parameter (GeometricErrors, effects of the catalogue):
//   deviation(place) = sum_i value_i * unit_i(place) + sum_j driver_j * sensitivity_j * shape_j(place)      um, urad
// An effect is given by the amplitude of its driver in the steady state, all lags run out (K, um, ...); the sensitivity
// is a typical one of a machine of steel and cast iron and stands beside it. The answer of one unit at every place is
// kept once it was asked for, so that a change of a value costs one sum.
//
// Effects of the instrument act on what is measured and not on the part; the expansion of an artefact acts on its own
// features alone. Sources: ISO 230-1:2012; Mayr et al. 2012, Thermal issues in machine tools, CIRP Annals 61/2.
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/machine/effect.h"
#include "core/machine/geometric_errors.h"
#include "core/machine/machine_description.h"
#include "core/machine/test_part.h"

namespace spindrift {

/// What a value of one parameter means.
struct WhatIfParameter {
  std::string id;            ///< "EYX_um" or "ball_screw.expansion.x"
  std::string title;         ///< what people call it
  std::string group;         ///< "X", "squareness", "C", or the family of the effect: "ball_screw"
  std::string unit;          ///< of the value: "um", "urad", "um_per_m", "K", "%", ...
  double largest = 0.0;      ///< |value| of a slider goes so far
  bool geometric = false;    ///< an error parameter of ISO 230-1; else an effect
  std::string driver;        ///< of an effect: what the value is, "temperature rise of the ball screw"
  double sensitivity = 1.0;  ///< of an effect: gain per unit of the value
  std::string gain_unit;     ///< of that gain: "um_per_m"
  std::string physics;       ///< of an effect: one paragraph
  std::string formula;       ///< of an effect: its shape
};

/// A deviation somewhere, um and urad: EX ... EC.
using SixComponents = Eigen::Matrix<double, 6, 1>;

struct WhatIfPlace {
  std::string id;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  SixComponents deviation = SixComponents::Zero();
};

/// An artefact as placed on the table.
struct WhatIfArtefact {
  std::string id;
  std::string kind;       ///< "hole_bar", "balls" or "fiducial_plate"
  std::string pose;       ///< "c = 90°", "turned by 90°", "as it lies" or empty
  std::string reference;  ///< the feature that the others are compared with
  /// Deviations relative to that of the reference.
  std::vector<WhatIfPlace> features;
  /// Hole bar: slope of the deviation along the bar, least squares.
  std::optional<double> along_um_per_m;
};

struct WhatIfAnswer {
  std::vector<WhatIfPlace> points;
  std::vector<WhatIfArtefact> artefacts;
  std::vector<Eigen::Vector3d> part_um;  ///< at TestPart::points()
  std::vector<PartCharacteristic> part;
};

class WhatIf {
 public:
  /// Machines that lack points or an artefact get standard ones.
  explicit WhatIf(const MachineDescription& machine);

  [[nodiscard]] const MachineDescription& machine() const noexcept { return machine_; }
  [[nodiscard]] const std::vector<WhatIfParameter>& parameters() const noexcept { return parameters_; }
  /// Throws InputError naming the closest parameters.
  [[nodiscard]] std::size_t find(const std::string& id) const;
  [[nodiscard]] double value(std::size_t parameter) const { return values_[parameter]; }
  /// Throws InputError for what is not finite.
  void set(std::size_t parameter, double value);
  void reset();
  /// Null where the machine has no room for one; `whyNoPart` says why.
  [[nodiscard]] const TestPart* part() const noexcept { return part_ ? &*part_ : nullptr; }
  [[nodiscard]] const std::string& whyNoPart() const noexcept { return why_no_part_; }

  [[nodiscard]] WhatIfAnswer answer() const;
  /// The values that are not zero, and the answer.
  [[nodiscard]] nlohmann::json json() const;

 private:
  /// Where something is asked for, and of which artefact (-1: of none).
  struct Asked {
    DeviationQuery query;
    int artefact = -1;
    bool part = false;
  };
  struct Placed {
    WhatIfArtefact artefact;
    std::size_t first = 0;
    std::size_t reference = 0;
    std::optional<Eigen::Vector3d> along;  ///< of a bar
    bool front = false;                    ///< the one that `artefact.expansion` is of
  };
  void addParameters();
  void addStandardPlaces();
  void addArtefact(Placed placed, const std::vector<DeviationQuery>& features);
  void addBars();
  void addBalls();
  void addPlate();
  [[nodiscard]] const Eigen::Matrix<double, 6, Eigen::Dynamic>& unit(std::size_t parameter) const;

  MachineDescription machine_;
  GeometricErrors geometric_;
  std::vector<Effect> effects_;             ///< parameters_[geometric count + i]
  std::vector<std::vector<double>> gains_;  ///< of their shapes, for one unit of the driver
  std::vector<WhatIfParameter> parameters_;
  std::vector<double> values_;
  std::vector<Asked> asked_;  ///< points, artefacts one after another, part
  std::size_t point_count_ = 0;
  std::vector<Placed> placed_;
  std::optional<TestPart> part_;
  std::size_t part_first_ = 0;
  std::string why_no_part_;
  mutable std::map<std::size_t, Eigen::Matrix<double, 6, Eigen::Dynamic>> units_;
};

/// A vertical machining centre that can have nearly every effect: for whoever has no machine at hand.
[[nodiscard]] MachineDescription standardMachine();

struct WhatIfRequest {
  std::filesystem::path campaign;     ///< its machine; empty: `machine`
  std::filesystem::path machine;      ///< machine.json; empty as well: the standard machine
  std::vector<std::string> settings;  ///< "EXX_um_per_m=20"
  std::filesystem::path svg;          ///< picture of the part; empty: none
  std::filesystem::path png;
};
/// Sets, answers, writes the pictures. Throws InputError.
[[nodiscard]] WhatIf runWhatIf(const WhatIfRequest& request);
/// For people: the values set, the points, the artefacts, the part.
[[nodiscard]] std::string whatIfText(const WhatIf& what_if);
/// Every parameter with its unit, range and meaning.
[[nodiscard]] std::string whatIfParametersText(const WhatIf& what_if);
[[nodiscard]] nlohmann::json whatIfParametersJson(const WhatIf& what_if);

}  // namespace spindrift
