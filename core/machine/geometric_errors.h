// SPDX-License-Identifier: Apache-2.0
// The geometric errors of a machine by their ISO 230-1 symbols, and the deviation that one unit of each makes.
//
// Of every linear axis p with travel p1 ... p2, middle m, length L (names as in FORMATS.md, here for X):
//   EXX_um_per_m             positioning          e = EXX (p - m)
//   EYX_um, EZX_um           straightness         e = E (1 - (2 (p - m) / L)^2): an arc, zero at both ends, E high
//   EAX_urad, EBX, ECX       roll, pitch, yaw     e = E (p - m) / L: changes by E from one end to the other
// Squareness, errors of location: EC0Y (ex = -EC0Y (y - m)), EA0Z (ey = -EA0Z (z - m)), EB0Z (ex = EB0Z (z - m)).
// Of a rotary axis C that carries the workpiece: EX0C, EY0C, EZ0T (um), EA0C, EB0C, EC0C (urad), displacement and
// rotation of the table about the C centre; the deviation is minus that.
// Errors of a linear axis are stated as what an instrument between tool and workpiece reads, whichever of the two the
// axis moves. They reach the tool through the kinematic chain: an angular error acts by the lever from the origin of
// the carriage (KinematicChain::toolDeviation). Source: ISO 230-1:2012, clause 3.4, annex A.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/machine/error_model.h"
#include "core/machine/machine_description.h"

namespace spindrift {

class GeometricErrors {
 public:
  explicit GeometricErrors(const MachineDescription& machine);

  /// Names with units, axis by axis as machine.json lists them, then squareness, then location of C.
  [[nodiscard]] const std::vector<std::string>& names() const noexcept { return names_; }
  /// Deviation (mm, rad) of the tool relative to the table for one um, urad or um/m of the parameter.
  [[nodiscard]] SmallError unit(std::size_t parameter, const DeviationQuery& query) const;

 private:
  struct Parameter {
    std::string axis;        ///< of the chain
    std::size_t linear = 0;  ///< place in machine_.axes
    Component direction{};   ///< of the error
    enum class Law { Slope, Arc, Turn, Square, Location } law = Law::Slope;
  };
  void add(std::string name, Parameter parameter);

  MachineDescription machine_;
  std::vector<std::string> names_;
  std::vector<Parameter> parameters_;
};

}  // namespace spindrift
