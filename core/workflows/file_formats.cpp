// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/file_formats.h"

#include <array>

namespace spindrift {
namespace {

constexpr std::string_view introduction = R"(# Files

Everything Spindrift reads and writes is plain text in UTF-8, apart from images, point clouds and the database of a session. This chapter is
written by the program from the table that its tests hold against its readers; `spindrift-cli files` prints it, `spindrift-cli files machine` one
of its sections.

Each reader checks what it reads. An unknown format, a newer version, a missing column or key, a value that is not a finite number, a
time that runs backwards and a duplicate are reported in one sentence with file, line or path, the value found and what is allowed;
nothing is written then. Unknown columns and keys are ignored or kept.

- **JSON** documents carry `format` (in brackets behind each title) and `version` 1. A value that does not exist is `null`.
- **CSV**: comma separated, decimal point, one header row, lines that begin with `#` are comments; text may stand in double quotes.
- **Units** stand in the names. Positions mm, deviations um, small angles urad, rotary positions deg, expansion um/m, temperatures
degC, times s since the start of the campaign.
- **Frame**: the machine coordinate frame (MCF), right-handed, axes as in ISO 841. `c_deg` is the rotation of the table about +Z,
counter-clockwise seen from above, whatever the control counts.
- **Signs**: deviation = actual minus commanded position of the tool relative to the table; compensation = minus the deviation.
- In the tables `[]` is each entry of a list, and *without it* says what holds where a key or column is absent.

A **campaign** is a folder: `campaign.json`, `machine.json`, and where there are such `log.csv`, `captures/fiducials.csv`, `captures/touches.csv`,
`captures/scans.csv`, `observations.csv` with `observations.cov.csv`, `warm_up.csv` (one point measured repeatedly while the instrument warms up,
columns as in observations.csv), and what `campaign.json` names. No evaluation ever alters a campaign. Paths in its files are relative to their
folder and do not leave it.
)";

constexpr std::array<FileFormatText, 32> texts{{
    {"campaign", "campaign.json", "spindrift-campaign", "Name and start of a campaign, and what it is compared with.",
     R"({"format": "spindrift-campaign", "version": 1, "name": "warm-up 12",
 "start_utc": "2026-01-31T08:00:00Z", "simulation": "simulation.csv",
 "simulation_gain_uncertainty": 0.01, "reference": "first_state"})",
     R"(name | required | | name of the campaign
start_utc | required | a UTC time such as 2026-01-31T08:00:00Z | time at which `time_s` is 0
simulation | no simulation | `simulation.csv`, `model.json` or `fe.json` | the simulation to compare with
simulation_gain_uncertainty | 0.01 | 0 or more | relative standard uncertainty of the simulation, for each component
reference | first_state | `first_state`, `absolute` | whether each series has an unknown constant, or observations are absolute values
effects | the catalogue alone | a file of the folder | effects of your own
simulator | no simulator | a file of the folder | a simulation that can be run)"},
    {"machine", "machine.json", "spindrift-machine",
     "The machine with its sensors, measuring points, artefacts and instruments. A command that needs a key that is "
     "absent says so.",
     R"({"format": "spindrift-machine", "version": 1, "name": "VMC 4", "chain": "V [w-X'-Y'-b-Z-(C)-t]",
 "axes": [{"name": "X", "travel_mm": [0, 300], "resolution_um": 1, "scale": "rotary_encoder",
           "drive": {"type": "ball_screw", "pitch_mm": 5, "fixed_bearing_mm": 0}, "datum_mm": 0},
          {"name": "Y", "travel_mm": [0, 200]}, {"name": "Z", "travel_mm": [-250, 0]}],
 "spindle": {"axis": "Z", "max_rpm": 6000, "nose_offset_mm": [0, 0, 0]},
 "temperature_sensors": [{"name": "T_column_degC", "place": "column front", "role": "column_front"}],
 "points": [{"id": "F1", "kind": "fiducial", "x_mm": 20, "y_mm": 30, "z_mm": -200}]})",
     R"(name | required | | name of the machine
chain | required | as in ISO 10791-1 | kinematic chain from workpiece to tool; an apostrophe marks an axis that carries the workpiece
axes[].name | required | as in the chain | linear axis
axes[].travel_mm | required | two numbers, the smaller first | ends of the travel
axes[].resolution_um | - | above 0 | smallest step; without it nothing is judged against the resolution
axes[].drive.type | - | such as `ball_screw` | kind of drive
axes[].drive.pitch_mm | - | above 0 | pitch of the screw
axes[].drive.fixed_bearing_mm | - | | position of the fixed bearing, from which the screw expands
axes[].scale | - | `rotary_encoder`, `linear_scale` | what the position is measured with
axes[].datum_mm | - | | where the scale is fixed
spindle.axis | Z | as in the chain | axis that carries the spindle
spindle.max_rpm | - | above 0 | highest speed
spindle.nose_offset_mm | 0, 0, 0 | three numbers | spindle nose minus reference point
rotary[].name | required | as in the chain | rotary axis
rotary[].centre_mm | required | three numbers | centre of rotation
table.centre_mm | - | two numbers | centre of the table
column.base_mm | - | | height of the foot of the column
column.overhang_mm | - | two or three numbers | spindle minus column, X and Y
crossbeam.axis | Y | | axis along the crossbeam
crossbeam.from_mm | required | | one end of the crossbeam
crossbeam.to_mm | required | other than from_mm | its other end
temperature_sensors[].name | required | `T_NAME_degC` | column of the log
temperature_sensors[].place | - | | where the sensor sits, for people
temperature_sensors[].role | by the name | such as `spindle_housing`, `column_front`, `ambient` | which body it stands for
reference_temperature_degC | 20 | | reference temperature of absolute campaigns
points[].id | required | unique | measuring point
points[].kind | fiducial | `fiducial`, `hole`, `ball`, `surface` | what is measured there
points[].x_mm | required | | place in MCF
points[].y_mm | required | | place in MCF
points[].z_mm | 0 | | place in MCF
artefacts[].id | required | unique | artefact
artefacts[].kind | required | `hole_bar`, `balls` | which keys follow
artefacts[].nominal_positions_mm | required | at least one | hole bar: holes H1, H2, ... along the bar
artefacts[].reference_hole | H1 | H1, H2, ... | hole bar: the hole that places it
artefacts[].reference_in_table_mm | required | three numbers | hole bar: reference hole from the centre of C at c = 0
artefacts[].direction_at_c0 | 1, 0, 0 | vector of length 1 | hole bar: its direction at c = 0
artefacts[].hole_diameter_mm | - | above 0 | hole bar: diameter of its holes
artefacts[].balls[].id | required | unique | ball
artefacts[].balls[].diameter_mm | required | above 0 | calibrated diameter
artefacts[].balls[].certified_mm | required | three numbers | calibrated centre, from the first ball
artefacts[].expansion_um_per_m_K | - | -5 ... 100 | coefficient of thermal expansion
artefacts[].expansion_uncertainty_um_per_m_K | 0: taken as exact | 0 or more | its standard uncertainty
artefacts[].temperature_degC | - | -20 ... 80 | temperature of the artefact where the log has none
artefacts[].temperature_uncertainty_K | 0: taken as exact | 0 or more | standard uncertainty of its temperature
artefacts[].certificate_uncertainty_um | 0 | 0 or more | standard uncertainty of a calibrated position
styli[].id | required | unique | stylus
styli[].radius_mm | required | above 0 | radius of its tip
styli[].offset_mm | required | three numbers | tip minus spindle reference
profiler.scan_model | rigid | `rigid`, `push_broom` | whether the profiler moves with the error of the whole scan or of each profile
profiler.axis | Y | | axis along which is scanned
profiler.height_axis | - | | axis along which the profiler measures, where that is not Z
profiler.lift_mm | 0 | | height by which the profiler is lifted between calibration and scan
profiler.lever_mm | 0, 0, 0 | three numbers | origin of the slide to the tool frame
profiler.profile_points | - | 2 or more | points of a profile
profiler.profile_interval_mm | - | above 0 | distance of these points
profiler.calibration_cloud | not calibrated | a file of the campaign | scan of the calibration pocket
profiler.calibration_circle {mm} | not calibrated | x, y, z, r; r above 0 | circle of the pocket in the tool frame
profiler.mounting_angles_rad.alpha {rad} | from the calibration | angle, standard uncertainty | angle about X known from elsewhere
profiler.mounting_angles_rad.beta {rad} | from the calibration | angle, standard uncertainty | angle about Y known from elsewhere
profiler.mounting_angles_rad.gamma {rad} | from the calibration | angle, standard uncertainty | angle about Z known from elsewhere)"},
    {"log", "log.csv", "",
     "What the machine did. Speeds and switches hold until the next row, temperatures are linear between rows. Rows "
     "may "
     "be irregular, fields may be empty; a column that is not listed is a signal under its name.",
     "",
     R"(time_s | required | does not run backwards | time
spindle_rpm | - | | spindle speed
feed_x_mm_min | - | | mean absolute feed of X; also feed_y_mm_min, feed_z_mm_min
pos_x_mm | - | | position of X; also pos_y_mm, pos_z_mm
speed_c_rpm | - | | speed of the rotary table
coolant | - | 0, 1 | coolant on
instrument_on | - | 0, 1 | the instrument is switched on
compensation_on | - | 0, 1 | the control was compensating
T_NAME_degC | - | | temperature of a sensor)"},
    {"observations", "observations.csv", "", "Deviations with their uncertainty. warm_up.csv has the same columns.", "",
     R"(time_s | required | does not run backwards within a point | time
state | required | such as M1 | thermal state or cycle
point | required | | measuring point
x_mm | required | | place where the deviation holds
y_mm | required | | place where the deviation holds
z_mm | required | | place where the deviation holds
c_deg | 0 | | rotation of the table
component | required | EX, EY, EZ, EA, EB, EC | component of the deviation
value {um, urad} | required | | deviation
sigma {um, urad} | required | above 0 | standard uncertainty
instrument | - | | name of the instrument
use | fit | `fit`, `holdout`, `exclude` | whether it is fitted, validates, or is left out
dir_x | - | -1, 0, 1 | direction of approach
dir_y | - | -1, 0, 1 | direction of approach
dir_z | - | -1, 0, 1 | direction of approach
tool_x_mm | - | | tool point minus spindle reference
tool_y_mm | - | | tool point minus spindle reference
tool_z_mm | - | | tool point minus spindle reference)"},
    {"covariances", "observations.cov.csv", "", "Covariances between observations; pairs that are absent have none.",
     "",
     R"(row | required | from 1 | row of observations.csv
column | required | from 1 | row of observations.csv
covariance {um2, um urad, urad2} | required | | covariance of the two)"},
    {"fiducials", "captures/fiducials.csv", "",
     "Images of fiducials. They are JPEG, PNG, TIFF, BMP or PGM. Positions are commanded ones of the tool relative to "
     "the table.",
     "",
     R"(time_s | required | does not run backwards within a fiducial | time
state | required | | thermal state
fiducial | required | | point of the machine
role | required | `rotation`, `x_axis`, `y_axis`, `focus` | what the image serves for
index | required | | number within the role
x_mm | required | | commanded position
y_mm | required | | commanded position
z_mm | required | | commanded position
spindle_deg | required | | rotation of the spindle with the camera about +Z
image | required | a file of the campaign | image)"},
    {"touches", "captures/touches.csv", "", "Touches of a probe.", "",
     R"(time_s | required | does not run backwards within an artefact | time
cycle | required | such as M1 | measuring cycle
artefact | required | | artefact of the machine
feature | required | | hole or ball
stylus | required | | stylus of the machine
c_deg | required | | rotation of the table
touch | required | 0, 1, 2, ... | number within the feature
x_mm | required | | position of the stylus centre when the probe triggered
y_mm | required | | position of the stylus centre when the probe triggered
z_mm | required | | position of the stylus centre when the probe triggered
nx | required | | unit vector towards the material
ny | required | | unit vector towards the material
nz | required | | unit vector towards the material)"},
    {"scans", "captures/scans.csv", "", "Point clouds of a laser profiler.", "",
     R"(time_s | required | does not run backwards within an artefact | time
cycle | required | | measuring cycle
artefact | required | | point of the machine that is scanned
y_mm | required | | position of the carriage where the scan starts
cloud | required | .pcd (ascii, binary, binary_compressed), .ply, .csv | point cloud)"},
    {"cloud", "A point cloud as .csv", "",
     "In the frame of the profiler: x along the profile, z height, y position of the carriage minus its start.", "",
     R"(x_mm | required | | along the profile
y_mm | required | | along the scan
z_mm | required | | height)"},
    {"reference-record", "A record of a reference instrument", "",
     "CSV that `compare-reference` holds against the probe.", "",
     R"(time_s | required | | time
value {that of the parameter} | required | | what the reference instrument read
sigma {that of the parameter} | 0 | 0 or more | its standard uncertainty)"},
    {"printed-text", "A template of printed text", "spindrift-printed-text",
     "How a control prints touches. `{name}` takes a word or a number, `{skip}` anything; blanks match any number of "
     "blanks. Names are those behind `touch_line`, `artefact` and `stylus`. Other lines are counted and ignored.",
     R"({"format": "spindrift-printed-text", "version": 1,
 "touch_line": "T A{feature} B{stylus} C{c_deg} D{touch} X{x} Y{y} Z{z} I{nx} J{ny} K{nz} S{time}",
 "cycle_line": "CYCLE {cycle}", "cycle_prefix": "M", "artefact": "bar",
 "values": {"feature": {"1": "H1"}, "stylus": {"1": "p0"}}, "position": "stylus_centre",
 "mm_per_unit": 1, "s_per_unit": 0.001, "touch_interval_s": 3, "cycle_interval_s": 600,
 "c_sign": 1, "decimal_comma": false})",
     R"(touch_line | required | a pattern with {x}, {y}, {z} | line of a touch
touch_line.x {that of mm_per_unit} | the line needs it | a number | in the line: position
touch_line.y {that of mm_per_unit} | the line needs it | a number | in the line: position
touch_line.z {that of mm_per_unit} | the line needs it | a number | in the line: position
touch_line.nx | 0 | with ny and nz not zero | in the line: direction of approach
touch_line.ny | 0 | with nx and nz not zero | in the line: direction of approach
touch_line.nz | 0 | with nx and ny not zero | in the line: direction of approach
touch_line.feature | the line needs it | | in the line: hole or ball
touch_line.touch | counted | 0, 1, 2, ... | in the line: number within the feature
touch_line.c_deg | 0 | | in the line: rotation of the table
touch_line.cycle | that of the last cycle_line | | in the line: cycle
touch_line.time {that of s_per_unit} | from touch_interval_s | | in the line: time
cycle_line | no such lines | a pattern | line that begins a cycle
cycle_prefix | empty | | before the number of the cycle
artefact | from the line | | artefact, where the line does not name it
stylus | from the line | | stylus, where the line does not name it
values | - | words to words, for each name | what printed words mean
position | stylus_centre | `stylus_centre`, `spindle_reference` | which position is printed
mm_per_unit {mm} | 1 | above 0 | unit of the printed positions
s_per_unit {s} | 1 | above 0 | unit of the printed times
touch_interval_s | 3 | above 0 | time between touches that are printed without a time
cycle_interval_s | 0 | above 0 | time between cycles that are printed without a time
c_sign | 1 | | sign that the control gives to the rotary axis
clock | running | `running`, `day_of_month` | whether the printed time begins again on the first of each month
decimal_comma | false | true, false | numbers have a decimal comma)"},
    {"pattern", "pattern.json", "spindrift-fiducial-pattern",
     "Artwork of a fiducial. The origin is the centre of the ellipse of the first row and column, X along increasing "
     "columns, Y along increasing rows. The command `artwork` writes it.",
     "",
     R"(unit | um | `um` | unit of all lengths
rows | required | first and last number, 10 ... 99 | rows of ellipses
columns | required | first and last number, 10 ... 99 | columns of ellipses
pitch {um} | required | above 0 | distance of the ellipses
ellipse.semi_axis_x {um} | required | above 0 | semi-axis along X
ellipse.semi_axis_y {um} | required | above 0 | semi-axis along Y
ellipse.line_width {um} | required | above 0 | width of the outline
circle.radius {um} | required | above 0 | radius of the filled circles
circle.offset_x {um} | required | | circle 0, 0 from the origin
circle.offset_y {um} | required | | circle 0, 0 from the origin
circle.rows | required | first index, last index + 1 | rows of circles
circle.columns | required | first index, last index + 1 | columns of circles
digits.offset_x {um} | required | above 0 | digit from the centre of its ellipse
digits.offset_y {um} | required | above 0 | digit from the centre of its ellipse
digits.line_width {um} | required | above 0 | width of the strokes
digits.strokes {um} | required | lists of points for 0 ... 9 | strokes of each digit)"},
    {"plan", "plan.json", "spindrift-plan", "What is to be measured, and when.",
     R"({"format": "spindrift-plan", "version": 1,
 "states": [{"name": "M0", "due_s": 0, "what": "cold"}],
 "items": [{"id": "M0_F1_focus_2", "kind": "image", "state": "M0", "due_s": 0, "fiducial": "F1",
            "role": "focus", "index": 2, "x_mm": 20, "y_mm": 30, "z_mm": -200, "spindle_deg": 0}]})",
     R"(states[].name | required | unique | thermal state
states[].due_s | required | | when it is due
states[].what | - | | what the machine does before it
items[].id | required | unique | capture
items[].kind | required | `image`, `cycle`, `scan` | which keys follow
items[].state | required | a state of the plan | thermal state
items[].due_s | required | | when it is due
items[].fiducial | required | | image: fiducial
items[].role | required | `rotation`, `x_axis`, `y_axis`, `focus` | image: what it serves for
items[].index | required | | image: number within the role
items[].x_mm | required | | image: commanded position
items[].y_mm | required | | image: commanded position; scan: position of the carriage where it starts
items[].z_mm | required | | image: commanded position
items[].spindle_deg | required | | image: rotation of the spindle
items[].artefact | required | | cycle, scan: artefact
items[].touches | 0 | | cycle: number of touches that makes it complete)"},
    {"simulation", "simulation.csv", "",
     "What a simulation predicts; linear in time and never beyond its rows. Observations without a prediction are left "
     "out and counted.",
     "",
     R"(time_s | required | does not run backwards within a point | time
point | x_mm, y_mm, z_mm instead | | measuring point
x_mm | point instead | | place; between places it is interpolated
y_mm | point instead | | place; between places it is interpolated
z_mm | point instead | | place; between places it is interpolated
component | required | EX, EY, EZ, EA, EB, EC | component of the deviation
predicted {um, urad} | required | | predicted deviation)"},
    {"finite-elements", "fe.json", "spindrift-finite-elements", "How results of finite elements become deviations.",
     R"({"format": "spindrift-finite-elements", "version": 1, "result": "mech.frd", "mesh": "mesh.inp",
 "unit_of_displacement": "mm", "first_state_s": 0, "state_interval_s": 900,
 "points": [{"point": "P1", "tool": {"set": "TOOL"}, "table": {"nodes": [1, 2, 3]}}]})",
     R"(result | - | .frd, .dat, .vtu, .pvd | file of displacements
mesh | - | .inp | mesh with node sets
unit_of_displacement | asked for | `mm`, `m` | unit of the displacements
unit_of_length | that of displacements | `mm`, `m` | unit of the coordinates
first_state_s | 0 | | time of the undeformed state
state_interval_s | times of the result | above 0 | time between states
mcf_from_mesh {mm} | the same frame | 4 x 4 transform | places in MCF from places in the mesh
displacement | the usual name | | name of the array in a VTK file
components | all | EX, EY, EZ, EA, EB, EC | components to write
points[].point | required | unique | measuring point
points[].tool | required | nodes | nodes of the tool
points[].table | required | nodes | nodes of the table
points[].tool.set | nodes or nearest_to_mm instead | a set of the mesh | nodes by the name of their set
points[].tool.nodes | set or nearest_to_mm instead | at least one | nodes by their numbers
points[].tool.nearest_to_mm | set or nodes instead | three numbers | nodes next to a place
points[].tool.count | 1 | 1 or more | how many of these
points[].tool.at_mm | centre of the nodes | three numbers | place to which the displacement is carried
each_table_node | points instead | tool and table | tool minus every node of the table
observe | points instead | a file with the columns below | weights of nodes)"},
    {"observe", "Weights of nodes", "", "CSV: a deviation is the sum of weight times displacement.", "",
     R"(point | required | | measuring point
component | required | EX, EY, EZ, EA, EB, EC | component of the deviation
node | required | | number of the node
dof | required | 1, 2, 3 | direction of its displacement
weight {um/mm, urad/mm} | required | | weight)"},
    {"effects", "effects.json", "spindrift-effects", "Effects of your own.",
     R"({"format": "spindrift-effects", "version": 1, "built_in": true, "effects": [
  {"id": "pointing.collimation", "title": "collimation", "physics": "The optical axis is not square.",
   "drivers": ["spindle_rpm^1.5"], "dynamics": "lag", "tau_s": [60, 20000], "sign": 0,
   "shape": [{"gain_unit": "urad", "EA": "z/100", "EB": "x/100"}], "contains": [], "references": []}]})",
     R"(built_in | true | true, false | whether the catalogue is searched as well
effects[].id | required | unique | effect
effects[].title | the id | | how it is called
effects[].physics | - | one sentence | what happens
effects[].drivers | constant in time | columns of the log, with a power | alternatives; a list within the list acts together
effects[].dynamics | none | `none`, `lag`, `step`, `pulse` | how it follows its driver
effects[].tau_s | as in the catalogue | two numbers, the smaller first | bounds of the time constant
effects[].sign | 0 | -1, 0, 1 | sign of the gain; 0: either
effects[].shape[].gain_unit | required | | unit of this gain
effects[].shape[].EX {um} | 0 | expression in x, y, z, c, dirx, diry, dirz | deviation for a gain of one; also EY, EZ and, in urad, EA, EB, EC
effects[].contains | - | ids | effects that are special cases
effects[].references | - | | where it is described)"},
    {"simulator", "simulator.json", "spindrift-simulator",
     "A simulation that can be run. The keys behind `parameters` depend on `kind`.", "",
     R"(kind | required | `scenario`, `command`, `calculix`, `sensitivities` | how it is run
parameters[].name | required | unique | parameter
parameters[].value {its own} | required | from min to max | value now; 0 with `effects`: a mechanism that is switched off
parameters[].unit | - | | its unit
parameters[].standard_uncertainty {its own} | required | 0 or more | how well the value is known
parameters[].min {its own} | required | | lower bound
parameters[].max {its own} | required | | upper bound
parameters[].what | the name | one phrase | what it is
parameters[].effects | - | ids of the catalogue | effects that it can cause
history | - | | what was put in; written by Spindrift
sensor_values | - | | errors of sensors that were found; written by Spindrift
scenario | required | a file of the folder | scenario: a scenario of the virtual machine
templates | required | files of the folder | command, calculix: files in which `{{name}}` or `{{name*1e-6}}` is replaced
include | - | files of the folder | command, calculix: files copied along
run | required | programs with arguments | command, calculix: what is run
result | simulation.csv | | command: the predictions it leaves
time_limit_s | 600 | above 0 | command, calculix: longest time of a run
displacements | required | .dat, .frd | calculix: the result it leaves
observe | required | a file of the folder | calculix: weights of nodes
unit_of_displacement | required | `mm`, `m` | calculix: unit of the displacements
first_state_s | 0 | | calculix: time of the undeformed state
state_interval_s | required | above 0 | calculix: time between states
increment_s | required | above 0 | command, calculix: step of the tables
tables.NAME.column | window instead | a column of the log | table `{{table:NAME}}` of a column
tables.NAME.window {s} | column instead | names of two parameters | table that is 1 between two times
tables.NAME.minus_first | false | true, false | changes since the first value
tables.NAME.between_rows | linear | `linear`, `hold` | how it goes on between rows
tables.NAME.divide_by | 1 | other than 0 | divisor
tables.NAME.power | 1 | | power, after the division
tables.NAME.mean_over_increment | false | true, false | mean over each increment
table | required | a file of the folder | sensitivities: see below
table_values | - | | sensitivities: values that the table holds for; written by Spindrift)"},
    {"sensitivities", "Sensitivities of a simulator", "", "CSV that `table` of simulator.json names.", "",
     R"(time_s | required | rising for each parameter, point and component | time
point | required | | measuring point
component | required | EX, EY, EZ, EA, EB, EC | component of the deviation
parameter | required | a parameter of the simulator | parameter
d_predicted {um, urad for each unit of the parameter} | required | | change of the prediction)"},
    {"error-model", "model.json", "spindrift-error-model",
     "A sum of effects, on top of a table of predictions where one is named. `discrepancy --model-out` writes it.",
     R"({"format": "spindrift-error-model", "version": 1, "effects": []})",
     R"(effects[].id | required | of the catalogue or of effects.json | effect
effects[].parameters {in their names} | required | | gains and time constants
effects[].standard_uncertainty {in their names} | not known | | their standard uncertainties
effects[].inputs[].driver | constant in time | a driver of the log | what drives the effect
effects[].inputs[].dynamics | required | `none`, `lag`, `asymmetric_lag`, `step`, `pulse`, `start` | how it follows
effects[].shared_lag | false | true, false | the inputs share one time constant
effects[].source | - | | where the parameters are from
table | - | a file of the folder | simulation.csv to which the effects are added)"},
    {"thermal-model", "Model over time", "spindrift-thermal-model",
     "Written by `thermal identify`, read by `thermal track`, `thermal compensate` and the compensator. Another JSON "
     "document may carry it as `thermal_model` or `model`.",
     "",
     R"(thermal_model | - | | the model within another document
model | - | | the same
kind | required | | method by which it was identified
train_s | required | two numbers | range that was learned from
period_s | 0 | | sampling period of the identification
source | - | | the log
inputs[].name | required | | column of the log
inputs[].kind | required | `temperature`, `speed`, `feed`, `switch`, `position`, `displacement`, `other` | what the column is
inputs[].power | required | above 0 | power of the input
inputs[].scale {that of the column} | required | above 0 | divisor of the input
inputs[].reference {that of the column} | required | | value that counts as zero
inputs[].train_range {that of the column} | required | two numbers | range in training
outputs[].name | required | | displacement
outputs[].unit | um | | its unit
outputs[].offset {that of the output} | required | | constant
outputs[].terms[].input | required | from 0 | number of the input
outputs[].terms[].tau_s | required | 0 or more | first-order time constant
outputs[].terms[].gain {output for each input} | required | | gain
outputs[].degrees_of_freedom | 0 | | of the fit
outputs[].noise_sigma {that of the output} | 0 | | standard deviation of the noise
outputs[].noise_tau_s | 0 | | its correlation time
outputs[].uncertainty_factor | 1 | | factor by which uncertainties were found too small
outputs[].covariance_lower | not known | row by row | covariance of offset and gains
outputs[].verdict.good_enough | required | true, false | whether it may be used for compensation
outputs[].verdict.reason | - | | why not
outputs[].verdict.test_s | required | two numbers | range of the test
outputs[].verdict.test_rms {that of the output} | 0 | | rms in the test
outputs[].training_pattern.inputs | required | columns of the log | which inputs stood together in training
outputs[].training_pattern.lag_s | required | 0 or more | lag of the second value of each input
outputs[].training_pattern.mean | required | two numbers an input | mean in training
outputs[].training_pattern.directions | required | square matrix | directions in which the inputs moved
outputs[].training_pattern.seen | required | rows of two numbers an input | how they stood
outputs[].training_pattern.reach | required | above 0 | distance from these that counts as known)"},
    {"connections", "connections.json", "spindrift-connections",
     "Connections to machines and sensors, and the columns of the log that come from them.",
     R"({"format": "spindrift-connections", "version": 1,
 "sources": [{"name": "mill", "kind": "mtconnect", "url": "http://192.168.1.20:5000"}],
 "columns": [{"column": "T_spindle_degC", "source": "mill", "item": "Tspindle", "role": "spindle_housing"}],
 "interval_s": 1, "settle_s": 2, "longest_s": 60, "rotate_mb": 256})",
     R"(sources[].name | required | unique | source
sources[].kind | required | `mtconnect`, `mqtt`, `modbus`, `text`, `linuxcnc`, `genicam` | how it is spoken to
sources[].url | required | without user and password | address
sources[].user | - | | mqtt: user
sources[].password_env | - | capital letters, digits and _ | mqtt, linuxcnc: variable of the environment that holds the password
sources[].password_file | - | only its owner can read it | mqtt, linuxcnc: file that holds the password
sources[].ca_file | that of the system | | mqtt: certificate of the authority
sources[].client_id | made up | | mqtt: name of this client
sources[].will.topic | required | | mqtt: topic told when the connection breaks
sources[].will.text | required | | mqtt: text told then
sources[].ask_rebirth | true | true, false | mqtt: Sparkplug nodes are asked for all their values
sources[].interval_s | 0.2 (mtconnect), 1 | above 0 | mtconnect, modbus, linuxcnc: time between questions
sources[].heartbeat_s | 2 | above 0 | mtconnect: longest silence of the agent
sources[].answer_s | 1 (modbus), 5 (linuxcnc) | above 0 | longest wait for an answer
sources[].unit_id | 1 | 0 to 247 | modbus: unit
sources[].baud | 9600 | | modbus, text over a serial line: speed
sources[].parity | none | `none`, `even`, `odd` | modbus, text over a serial line: parity
sources[].stop_bits | 1 | 1, 2 | modbus over a serial line: stop bits
sources[].data_bits | 8 | 7, 8 | text over a serial line: data bits
sources[].line | required | patterns such as `T1={column} T2={bed}` | text: lines that hold values
sources[].save | - | a file | text: where all that comes is kept
sources[].decimal_comma | false | true, false | text: numbers have a decimal comma
sources[].exposure_us | that of the camera | above 0 | genicam: exposure
sources[].gain {dB} | that of the camera | | genicam: gain
sources[].trigger | free running | | genicam: trigger
sources[].region {px} | all | x, y, width, height | genicam: part of the sensor
columns[].column | required | unique | column of the log
columns[].source | required | a source above | where it comes from
columns[].item | required | | data item there
columns[].unit | that of the column | such as CELSIUS, MILLIMETER | unit of the source
columns[].scale | 1 | | value = scale x (value in the unit of the column) + offset
columns[].offset {that of the column} | 0 | | see scale
columns[].dead_band {that of the column} | - | 0 or more | a row is written where it changes by more
columns[].reduce | mean (temperatures), mean_absolute (feeds), last | `last`, `mean`, `mean_absolute`, `max`, `min` | what becomes of several values in a row
columns[].role | by the name | such as `spindle_housing` | temperatures: which body it stands for
columns[].values | - | words to numbers | what words of the source mean
columns[].otherwise | empty | | number for other words
interval_s | 1 | above 0 | time between rows
settle_s | 2 | 0 or more | wait for late values
longest_s | 60 | above 0 | at least one row in that time
rotate_mb | 256 | above 0 | a log beyond it is put aside and a new one begun)"},
    {"loop-plan", "Plan of a closed loop", "spindrift-loop-plan",
     "What `loop` measures, models and compensates on a control. `loop --example DIR` writes one.", "",
     R"(machine | required | a file beside the plan | machine.json
simulation | - | a file beside the plan | scenario that the machine is compared with
control.kind | required | `linuxcnc` | kind of control
control.address | 127.0.0.1:5007 | host and port | where it listens
control.folder | required | a folder beside the plan | folder it shares
temperatures | required | columns of the log | temperatures that are recorded
touches[].point | required | letters, digits, _, - and . | measuring point
touches[].component | required | EX, EY, EZ | component that it measures
touches[].before_mm | required | three numbers | place before the touch
touches[].target_mm | required | three numbers, along the axis | end of the touch
programme[].from_s | required | rising | beginning of a speed
programme[].spindle_rpm | required | 0 or more | spindle speed
reference_mm | required | three numbers | tool point that is compensated
safe_z_mm | required | | height above everything
duration_s | required | above 0 | length of the loop
clear_mm | 10 | above 0 | distance from a wall before moving along it
feed_mm_min | 60 | above 0 | feed of a touch
touch_sigma_um | 0.35 | above 0 | standard uncertainty of a touch
measure_every_s | 1200 | above 0 | time between cycles
shortest_s | 600 | above 0 | shortest time between cycles
action_limit_um | 4 | above 0 | a prediction off by more is measured earlier
patience_s | 60 | above 0 | wait for a control that went away
discrepancy_s | 0: never | 0 or more | time between searches for missing effects
identify_s | 0: never | 0 or more | time between identifications
limits.limit_um | 150 | above 0 | largest correction
limits.rate_um_s | 0.2 | above 0 | largest change a second
limits.step_um | 5 | above 0 | largest change at once
limits.oldest_s | 60 | above 0 | age of inputs beyond which nothing is known
accept | named | `named`, `ask`, ids of effects | which effects go into the model
when_silent | zero | `zero`, `hold` | what becomes of the correction when Spindrift no longer answers)"},
    {"batch", "Batch", "spindrift-batch", "Many campaigns or seeds, one work on each.",
     R"({"format": "spindrift-batch", "version": 1, "name": "monthly", "work": "discrepancy",
 "campaigns": ["campaigns/a", "campaigns/b"], "options": {}, "chunk": 1, "item_time_limit_s": 3600,
 "retries": 2, "lease_s": 30})",
     R"(name | required | | name of the batch
work | required | `evaluate`, `fit`, `identify`, `discrepancy`, `simulate`, `hidden_effect`, `command` | what is done with each
campaigns | seeds instead | folders | evaluate, fit, identify, discrepancy, command: campaigns
seeds | campaigns instead | first and last | simulate, hidden_effect, command: random seeds
options.scenario | required | a file | simulate: scenario
options.out | required | a folder | simulate: where campaigns go
options.run | required | program and arguments | command: {seed} or {campaign} is replaced; prints one JSON document
options | - | as the command of that name | other options, such as `state`, `points`, `output`, `inputs`, `train`, `test`, `max_effects`
chunk | 1 | 1 or more | items given out at once
item_time_limit_s | 3600 | above 0 | longest time of an item
retries | 2 | 0 to 100 | how often a failed item is tried again
lease_s | 30 | above 0 | silence after which an item is given to another worker)"},
    {"scenario", "Scenario of the virtual machine", "spindrift-scenario",
     "What `simulate` makes a campaign from. Without `sensors` the log has those of the machine file. Effects are "
     "named by "
     "their ids and may have parameters of their own; `table`, `rotary` and other places are bodies of the machine.",
     "",
     R"(name | required | | name of the campaign
seed | 1 | from 0 | random seed
start_utc | 2026-03-01T05:00:00Z | a UTC time | start
duration_s | required | at most 60 days | length
log_period_s | 30 | at most the duration | time between rows of the log
machine | required | object, or a file beside the scenario | machine.json
programme.segments[].from_s | required | rising, from 0 | beginning
programme.segments[].spindle_rpm | as before | 0 or more | spindle speed
programme.segments[].feed_x_mm_min | as before | 0 or more | feed; also y, z
programme.segments[].pos_x_mm | as before | | place of the work; also y, z
programme.segments[].stroke_x | as before | 0 or more | part of the travel that is used; also y, z
programme.segments[].c_rpm {1/min} | as before | | speed of the rotary table
programme.segments[].coolant | as before | true, false | coolant on
programme.segments[].instrument_on | as before | true, false | the instrument is on
programme.random.idle_s | 1800 | 0 or more | idle at the beginning
programme.random.mean_hold_s | 2700 | above 0 | mean time of a speed
programme.random.speeds_rpm | 0 to 6000 | at least one | spindle speeds
programme.random.feeds_mm_min | 0 to 15000 | at least one | feeds
programme.random.c_speeds_rpm | 0 to 60 | at least one | speeds of the rotary table
programme.random.coolant | true | true, false | coolant is switched on and off
programme.random.move | true | true, false | the place of the work changes
programme.random.places | 0.1, 0.5, 0.9 | parts of the travel | places of the work
programme.random.stroke_part | 0.8 | above 0 | part of the travel that is used
programme.random.instrument_on_s | 0 | 0 or more | the instrument is off before
environment.temperature_degC | 20 | | mean of the room
environment.day_amplitude_K | 1.5 | | amplitude over a day
environment.day_phase_h | 2 | | phase of the day
environment.ramp_K_per_h | 0 | | ramp
environment.weather_K | 0.3 | 0 or more | standard deviation of slow changes
environment.weather_hours | 4 | above 0 | their correlation time
environment.doors[].time_s | required | | a door opens
environment.doors[].drop_K | 2 | | drop of the temperature
environment.doors[].recovery_s | 1200 | above 0 | time constant of its recovery
environment.random_doors | 0 | 0 to 10000 | further doors at random times
environment.coolant_below_room_K | 3 | | coolant below the room
physics.friction | 1 | above 0 | factor of the heat of spindle bearings and motor
physics.screw_friction | 1 | above 0 | factor of the heat of nuts and screw bearings
physics.convection | 1 | above 0 | factor of convection
physics.convection_speed | 1 | 0 or more | factor of what motion adds to it
physics.conduction | 1 | above 0 | factor of conduction
physics.expansion | 1 | above 0 | factor of the coefficients of expansion
physics.spindle_mass | 1 | above 0 | factor of the heat capacity of spindle and head
physics.screw_mass | 1 | above 0 | factor of the heat capacity of the screws
physics.structure_mass | 1 | above 0 | factor of the heat capacity of the structure
effects.ID.on | true | true, false | whether the effect acts
effects.ID.size | 1 | | factor of its physical size
effects.ID.strength | size instead | 0 or more | its rms in units of sigma
effects.ID.driver | the usual one | `room`, `column`, `spindle` | what drives it
simulation.effects | required | effects of the scenario | effects that the simulation of the campaign knows
simulation.parameter_error | 0.01 | 0 to below 1 | largest relative error of its sizes
simulation.gain_uncertainty | 0.01 | 0 or more | what campaign.json states
simulation.missing_rows | 0 | 0 to below 1 | part of the rows that are missing
simulation.size_errors | - | effects to numbers | relative error of single sizes
measurement.times_s | every_s instead | rising, from 0 | times of the states
measurement.first_s | 0 | 0 or more | first state
measurement.every_s | required | above 0 | time between states
measurement.states | as many as fit | 1 or more | number of states
measurement.per_point_s | 8 | 0 or more | time at a point
measurement.points | all | points of the machine | points that are measured
measurement.components | EX, EY, EZ | EX, EY, EZ, EA, EB, EC | components that are measured
measurement.c_deg | 0 | | angles of the table, one state after another
measurement.tool_offset_mm | 0, 0, 0 | three numbers | tool point minus spindle reference
measurement.holdout | - | names of states | states for validation
measurement.holdout_last | 0 | fewer than states | the last states for validation
measurement.random_approach | true | true, false | directions of approach change
measurement.clock_offset_s | 0 | | clock of the observations minus that of the log
instrument.name | microscope | | name of the instrument
instrument.sigma_um | 0.5 | above 0 | standard deviation of displacements
instrument.sigma_urad | 2 | above 0 | standard deviation of rotations
instrument.resolution_um | 0 | 0 or more | resolution
instrument.drift_um_per_h | 0 | | drift
instrument.ar1 | 0 | 0 to below 1 | correlation of the noise from state to state
instrument.dropped | 0 | 0 to below 1 | part of the readings that are missing
instrument.outliers | 0 | 0 to below 1 | part of the readings that are off
instrument.outlier_size {sigma} | 8 | 0 or more | by how much
touches.artefact | required | an artefact of the machine | artefact
touches.cycles | as many as fit | 1 or more | number of cycles; times as for measurement
touches.touch_s | 2.5 | 0 or more | time of a touch
touches.sigma_um | 0.25 | 0 or more | standard deviation of a touch
touches.pretravel_um | 2 | | distance by which the probe triggers late
touches.origin_mm | 0, 0, 0 | three numbers | centre of the first ball
microscope.fiducials | all | fiducials of the machine | fiducials that are seen; times as for measurement
microscope.width_px | 1920 | 320 to 8192 | width of an image
microscope.height_px | 1080 | 240 to 8192 | height of an image
microscope.pixel_length_um | 1.23 | above 0 | size of a pixel on the fiducial
microscope.centre_px | middle of the image | two numbers | centre of rotation in the image
microscope.camera_turn_deg | -5.7 | | rotation of the camera
microscope.blur_sigma_px | 1 | above 0 | blur in focus
microscope.defocus_px_per_um | 0.014 | above 0 | blur out of focus
microscope.noise_level {grey values} | 2 | 0 or more | noise
microscope.gradient_x | 0.2 | | unevenness of the light
microscope.gradient_y | 0.1 | | unevenness of the light
microscope.flicker | 0.01 | 0 or more | change of the light from image to image
microscope.spindle_repeatability_um | 0.25 | 0 or more | scatter of the tool, X and Y
microscope.axis_repeatability_um | 0.1 | 0 or more | scatter of the tool, Z
microscope.dust | 5 | 0 to 1000 | grains of dust
microscope.jpeg_quality | 92 | 1 to 100 | quality of the images
microscope.rotations_deg | -8, 0, 8 | at least 3 | orientations of the spindle
microscope.steps_mm | -0.1016 to 0.1016 | at least 3 | steps along the axes
microscope.heights_mm | -0.254 to 0.254 | at least 5 | heights for the focus
microscope.image_interval_s | 8 | 0 or more | time between images
microscope.pattern | the standard artwork | file, or an object | artwork of the fiducials
microscope.pattern.rows | 9 | 1 to 90 | rows of ellipses
microscope.pattern.columns | 9 | 1 to 90 | columns of ellipses
microscope.pattern.first_row | 11 | 10 to 99 | number of the first row
microscope.pattern.first_column | 11 | 10 to 99 | number of the first column
microscope.pattern.pitch_um | 350 | above 0 | distance of the ellipses
profiler.seconds_per_artefact {s} | 40 | 0 or more | time of a scan; times as for touches
profiler.alpha_rad | 0 | | mounting angle about X
profiler.beta_rad | 0 | | mounting angle about Y
profiler.gamma_rad | 0 | | mounting angle about Z
profiler.offset_mm | 0, 0, 0 | three numbers | profiler in the tool frame
profiler.profile_spacing_mm | 0.15 | above 0 | distance of the profiles
profiler.white_noise_um | 0.5 | 0 or more | uncorrelated noise
profiler.speckle_noise_um | 0.5 | 0 or more | correlated noise
profiler.artefacts[].point | required | a surface of the machine | surface that is scanned
profiler.artefacts[].y_mm | required | | carriage where the scan starts
profiler.artefacts[].turn_rad | 0 | | rotation of the surface
profiler.artefacts[].bumps[].x_mm | required | | place of a bump
profiler.artefacts[].bumps[].y_mm | required | | place of a bump
profiler.artefacts[].bumps[].radius_mm | required | above 0 | its radius
profiler.artefacts[].bumps[].height_mm | required | | its height
profiler.artefacts[].bending.along_mm | 0 | | change of shape as the machine warms up: curvature along Y, over half the length
profiler.artefacts[].bending.across_mm | 0 | | curvature across, over half the width
profiler.artefacts[].bending.twist_mm | 0 | | twist at the corners
profiler.artefacts[].bending.held_at | 0 | -1 ... 1 | place along Y where it is held
profiler.artefacts[].bending.skew | 0 | | part of the curvature that grows along Y
profiler.artefacts[].bending.time_constant_s | 7200 | above 0 | time constant of the change
sensors[].name | required | `T_NAME_degC` | column of the log
sensors[].place | required | such as `column front`, `front bearing`, `room` | body that it sits on; `@0.5` says where along it
sensors[].noise_K | 0.04 | 0 or more | noise
sensors[].ar1 | 0 | 0 to below 1 | its correlation from row to row
sensors[].resolution_K | 0.001 | 0 or more | resolution
sensors[].bias_K | 0 | | offset
sensors[].drift_K_per_h | 0 | | drift
sensors[].time_constant_s | 0 | 0 or more | first-order time constant
sensors[].dead | false | true, false | repeats its first value
sensors[].dropout | 0 | 0 to below 1 | part of the rows without a value
log.omit | - | columns | columns that the log lacks)"},
    {"recording", "What was done at the window", "spindrift-recording",
     "Written by `spindrift --record FILE`, so that others can do it again. Controls are named by what stands on them, "
     "in "
     "the language that it was made in. Everything that is typed is in it.",
     R"({"format": "spindrift-recording", "version": 1, "demo": "fiducials", "language": "en",
 "window": [1280, 800], "done": [
  {"do": "press", "on": "QPushButton Fit the model", "at": [0.5, 0.5]},
  {"do": "key", "key": "S", "held": "Ctrl"},
  {"do": "look", "name": "fitted"}]})",
     R"(demo | none | a demo of the program | sample data that it begins with
language | en | `en`, `de` | language of the window
window {px} | 1440, 900 | width and height | size of the window
done[].do | required | `press`, `double`, `drag`, `wheel`, `key`, `look` | what was done
done[].name | required | | look: name of the picture that is worth taking
done[].on | required | class and label | control
done[].number | 0 | from 0 | among the controls of that name
done[].in | the main window | class of a window | window of the control
done[].part | at or cell instead | label | tab or entry of a menu
done[].cell | at or part instead | row and column from 0 | cell of a table
done[].at | required | two numbers from 0 to 1 | place, as parts of width and height
done[].to | required | two numbers from 0 to 1 | drag: where it ends
done[].steps | required | | wheel: steps
done[].button | left | `left`, `middle`, `right` | button of the mouse
done[].held | none | Ctrl, Alt, Shift, joined by + | keys that were held
done[].key | text instead | a key such as Return | key: which one
done[].text | key instead | one character | key: what it typed)"},
    {"exercise", "exercise.json", "spindrift-exercise", "In the folder of an exercise; it holds nothing of the truth.",
     "",
     R"(format | required | `spindrift-exercise` | format
version | required | 1 | version
seed | required | 0 or more | number of the exercise
level | required | `easy`, `medium`, `hard` | how much is hidden)"},
    {"session", "A session", "spindrift-session",
     "A folder: `spindrift-session.json`, `session.sqlite` with results, exclusions, notes and settings, and "
     "`campaigns/`. It can be copied to another computer; one process at a time works on it. `loop-state.json` "
     "(spindrift-loop-state) of a closed loop and what `plant export` writes (spindrift-plant-export) are kept by "
     "Spindrift and not meant to be edited.",
     "", ""},
}};

}  // namespace

std::span<const FileFormatText> fileFormatTexts() {
  std::size_t count = 0;
  while (count < texts.size() && !texts[count].id.empty()) ++count;
  return std::span(texts).first(count);
}

std::string_view filesIntroduction() {
  return introduction;
}

}  // namespace spindrift
