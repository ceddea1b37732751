// SPDX-License-Identifier: Apache-2.0
// Compensation tables over the position of a base axis, as Siemens, Heidenhain and Fanuc controls take them, written
// and read again as the control applies them.
//
//   Siemens CEC     sag and angularity error compensation, $AN_CEC: a base axis moves another axis, mm. "A positive
//                   compensation value causes the corresponding machine axis to move in the negative direction"
//                   (SINUMERIK 840D sl, Extended Functions, K3 5.4.3, 03/2009, 6FC5397-1BP10-4BA0, p. 372): the value
//                   is the deviation itself.
//   Heidenhain      values of a compensation value table (.COM), mm: points of the error curve (TNC 406/306 Technical
//                   Manual 3/97, 4-21; axis "Error in Z", TNC 407/415/425 Technical Manual 01.98, 1.6.4; EXX "in the
//                   COM file", iTNC 530 HSCI Technical Manual 07/2013, pp. 680, 684), "positive if the table travel is
//                   too long" (TNC 407/415/425, 1.6.3): the value is the deviation itself. The columns (AXISPOS and one
//                   for each axis) are public (MANUALplus 620 Technical Manual 01/2012, pp. 716, 718), the layout of
//                   the file is not: the values are written as CSV, to be entered in the control's table editor.
//   Fanuc           pitch error data, steps in detection units between points at one distance from the reference
//                   position; a step is put out between the two ends of its section (Series 0i Parameter Manual
//                   B-63980EN/01, p. 100; data as N_R_ after G10 L50, number + 10000). Which way a positive step moves
//                   the axis is not said there: whoever has tried it on the machine states it.
//
// Units: positions and values mm, in the axis coordinates of machine.json.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/machine/compensation.h"

namespace spindrift {

/// What a control makes of a table: `axis` is moved by `movement_mm` in its positive direction where `base` stands at
/// `position_mm`; linear between two positions, held beyond the first and the last.
struct ControlTable {
  char base = 'X';
  char axis = 'X';
  std::vector<double> position_mm;  ///< rising
  std::vector<double> movement_mm;

  [[nodiscard]] double movementAt(double base_mm) const;
};

/// One file with a table for every base axis of `tables` and every other axis whose straightness deviation the table
/// holds (EYX, EZX, ...), zero at the reference position; empty if there is none. `measured` leaves out displacements
/// that were not measured and base axes along which nothing was. Throws InputError: more than 200 positions, a value
/// beyond 1 mm.
[[nodiscard]] std::string siemensSagCompensation(const std::vector<AxisComponentTable>& tables,
                                                 const std::optional<MeasuredBox>& measured = {});
/// Reads $AN_CEC and $AA_ENC_COMP tables. Throws InputError.
[[nodiscard]] std::vector<ControlTable> readSiemensTables(const std::string& text, const std::string& file);

/// The errors of all measured axes over the position of `table.axis`, zero at its first position, as the older
/// controls ask; empty if nothing is known. Throws InputError: more than 256 positions, an error that changes by more
/// than 1/64 of the distance between two positions.
[[nodiscard]] std::string heidenhainCompensation(const AxisComponentTable& table,
                                                 const std::optional<MeasuredBox>& measured = {});
[[nodiscard]] std::vector<ControlTable> readHeidenhainTable(const std::string& text, const std::string& file);

/// Which way a positive step of pitch error data moves the axis, as tried on the machine.
enum class FanucStep { Positive, Negative };

/// Where the points of an axis lie: at `interval_mm` from the reference position, which is zero of the axis.
struct FanucPoints {
  double interval_mm = 0.0;
  int first = 0;      ///< the point farthest on the negative side, parameter 3621
  int reference = 0;  ///< parameter 3620
  int last = 0;       ///< the point farthest on the positive side, parameter 3622

  /// Points over the whole travel, `count` - 1 intervals or one more, numbered from `first_number`.
  [[nodiscard]] static FanucPoints over(const LinearAxis& axis, int count, int first_number);
  /// Ends of the sections, `last` - `first` + 2 positions.
  [[nodiscard]] std::vector<double> position_mm() const;
};

/// G10 L50 program of the positioning deviation. `table` holds it at `points.position_mm()`. Throws InputError: a step
/// outside -128 to 127 detection units, a number above 1023, a unit that is not above zero.
[[nodiscard]] std::string fanucPitchError(const AxisComponentTable& table, const FanucPoints& points, FanucStep step,
                                          double detection_unit_um, const std::optional<MeasuredBox>& measured = {});
[[nodiscard]] ControlTable readFanucPitchError(const std::string& text, const std::string& file);

}  // namespace spindrift
