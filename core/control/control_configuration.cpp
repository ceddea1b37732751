// SPDX-License-Identifier: Apache-2.0
#include "core/control/control_configuration.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/atomic_file.h"
#include "core/base/error.h"

namespace spindrift {
namespace {

constexpr std::array<char, 3> axis_letters{'x', 'y', 'z'};

std::string halFile(const ControlConfiguration& c) {
  std::string out =
      "# Kinematics and motion\nloadrt [KINS]KINEMATICS\n"
      "loadrt [EMCMOT]EMCMOT servo_period_nsec=[EMCMOT]SERVO_PERIOD num_joints=[KINS]JOINTS\n"
      "addf motion-command-handler servo-thread\naddf motion-controller servo-thread\n\n"
      "# Compensation: watchdog -> range, speed, acceleration -> offset that the control does not see\n"
      "loadrt watchdog num_inputs=1\nloadrt or2 names=comp-enable,probe-xy,probe-any\n"
      "loadrt limit3 names=limit-x,limit-y,limit-z\nloadrt offset names=offset-x,offset-y,offset-z\n"
      "loadrt sum2 names=tip-x,tip-y,tip-z\nloadrt comp names=touch-x,touch-y,touch-z\n"
      "addf watchdog.set-timeouts servo-thread\naddf watchdog.process servo-thread\n"
      "addf comp-enable servo-thread\n";
  for (const char* function :
       {"limit-{}", "offset-{}.update-output", "offset-{}.update-feedback", "tip-{}", "touch-{}"}) {
    for (const char axis : axis_letters)
      out += fmt::format("addf {} servo-thread\n", fmt::format(fmt::runtime(function), axis));
  }
  out += "addf probe-xy servo-thread\naddf probe-any servo-thread\n";
  for (std::size_t i = 0; i < axis_letters.size(); ++i) {
    const char a = axis_letters[i];
    out += fmt::format(
        "\nnewsig comp-{0} float\nnewsig error-{0} float\nnewsig surface-{0} float\n"
        "net comp-{0} => limit-{0}.in\nnet applied-{0} limit-{0}.out => offset-{0}.offset\n"
        "setp limit-{0}.min -{1}\nsetp limit-{0}.max {1}\nsetp limit-{0}.maxv {2}\nsetp limit-{0}.maxa {3}\n"
        "net command-{0} joint.{4}.motor-pos-cmd => offset-{0}.in\n"
        "net drive-{0} offset-{0}.out => offset-{0}.fb-in tip-{0}.in0\n"
        "net feedback-{0} offset-{0}.fb-out => joint.{4}.motor-pos-fb\n"
        "net error-{0} => tip-{0}.in1\n",
        a, c.limit_mm, c.speed_mm_s, c.acceleration_mm_s2, i);
    // The floor is touched from above, the walls from below: a comparator is true when in1 is above in0.
    out += fmt::format("net at-{0} tip-{0}.out => touch-{0}.{1}\nnet surface-{0} => touch-{0}.{2}\n", a,
                       a == 'z' ? "in0" : "in1", a == 'z' ? "in1" : "in0");
    // After the nets: the first pin that is linked overwrites the value of a signal.
    out += fmt::format("sets surface-{} {:.6f}\n", a, c.corner_mm[static_cast<Eigen::Index>(i)]);
  }
  out += fmt::format(
      "\nnet touched-x touch-x.out => probe-xy.in0\nnet touched-y touch-y.out => probe-xy.in1\n"
      "net touched-xy probe-xy.out => probe-any.in0\nnet touched-z touch-z.out => probe-any.in1\n"
      "net probe probe-any.out => motion.probe-input\n"
      "\nnewsig comp-alive bit\nnewsig comp-hold bit\nsetp watchdog.timeout-0 {}\nsetp watchdog.enable-in 0\n"
      "net comp-alive => watchdog.input-0\nnet comp-watched watchdog.ok-out => comp-enable.in0\n"
      "net comp-hold => comp-enable.in1\nnet comp-enabled comp-enable.out => limit-x.enable limit-y.enable "
      "limit-z.enable\n"
      "\n# Emergency stop and tool change without hardware\n"
      "net estop-loop iocontrol.0.user-enable-out => iocontrol.0.emc-enable-in\n"
      "net tool-prepare iocontrol.0.tool-prepare => iocontrol.0.tool-prepared\n"
      "net tool-change iocontrol.0.tool-change => iocontrol.0.tool-changed\n"
      "setp spindle.0.at-speed 1\n\nnewsig machine-time float\n",
      c.watchdog_s);
  for (const std::string& column : c.temperatures)
    out += fmt::format("newsig {0} float\nsets {0} 20\n", temperatureSignal(column));
  return out;
}

std::string iniFile(const MachineDescription& machine, const ControlConfiguration& c) {
  std::string out = fmt::format(
      "[EMC]\nVERSION = 1.1\nMACHINE = spindrift\nDEBUG = 0\n\n[DISPLAY]\nDISPLAY = dummy\n\n"
      "[APPLICATIONS]\nDELAY = 0\nAPP = linuxcncrsh --port {} -- -ini spindrift.ini\n\n"
      "[TASK]\nTASK = milltask\nCYCLE_TIME = 0.005\n\n"
      "[RS274NGC]\nPARAMETER_FILE = sim.var\nFEATURES = 12\n\n"
      "[EMCMOT]\nEMCMOT = motmod\nSERVO_PERIOD = {:.0f}\n\n[EMCIO]\nEMCIO = io\nCYCLE_TIME = 0.1\nTOOL_TABLE = "
      "tool.tbl\n\n[HAL]\nHALFILE = spindrift.hal\n\n[KINS]\nKINEMATICS = trivkins coordinates=XYZ\nJOINTS = 3\n\n"
      "[TRAJ]\nCOORDINATES = X Y Z\nLINEAR_UNITS = mm\nANGULAR_UNITS = degree\nDEFAULT_LINEAR_VELOCITY = 50\n"
      "MAX_LINEAR_VELOCITY = {}\n\n",
      c.port, c.servo_period_s * 1e9, c.max_velocity_mm_s);
  for (std::size_t i = 0; i < axis_letters.size(); ++i) {
    const std::string name(1, "XYZ"[i]);
    const LinearAxis& axis = *machine.findAxis(name);
    const auto limits = [&](double faster) {
      return fmt::format("MIN_LIMIT = {:.6f}\nMAX_LIMIT = {:.6f}\nMAX_VELOCITY = {}\nMAX_ACCELERATION = {}\n",
                         axis.travel_mm[0], axis.travel_mm[1], faster * c.max_velocity_mm_s,
                         faster * c.max_acceleration_mm_s2);
    };
    out += fmt::format("[AXIS_{}]\n{}\n[JOINT_{}]\nTYPE = LINEAR\n{}FERROR = 1\nMIN_FERROR = 0.5\nHOME_SEQUENCE = 0\n",
                       name, limits(1.0), i, limits(1.1));
    // Without switches homing declares the position: Z up, X and Y at the beginning of their travel.
    out += fmt::format("HOME = {0:.6f}\nHOME_OFFSET = {0:.6f}\n", axis.travel_mm[i == 2 ? 1 : 0]);
    if (!c.compensation_file[i].empty())
      out += fmt::format("COMP_FILE = {}\nCOMP_FILE_TYPE = {}\n", c.compensation_file[i], c.compensation_type);
    out += "\n";
  }
  return out;
}

/// The numbered parameters that the interpreter demands: coordinate systems at zero, G54 chosen.
std::string variables() {
  std::string out;
  const auto rows = [&](int from, int to) {
    for (int i = from; i <= to; ++i) out += fmt::format("{}\t{}\n", i, i == 5220 ? "1.000000" : "0.000000");
  };
  rows(5161, 5169);
  rows(5181, 5189);
  rows(5210, 5230);
  for (int first = 5241; first <= 5381; first += 20) rows(first, first + 9);
  return out;
}

}  // namespace

void ControlConfiguration::validate() const {
  const auto require = [](bool good, const char* what, double value, const char* allowed) {
    if (!good)
      throw InputError(fmt::format("Configuration of the control: {} {:g}; allowed: {}.", what, value, allowed));
  };
  require(port > 0 && port < 65536, "port", port, "1 to 65535");
  require(servo_period_s >= 1e-4 && servo_period_s <= 0.01, "servo_period_s", servo_period_s, "0.0001 to 0.01");
  require(limit_mm > 0.0 && limit_mm <= 1.0, "limit_mm", limit_mm, "above 0, up to 1");
  require(speed_mm_s > 0.0, "speed_mm_s", speed_mm_s, "above 0");
  require(acceleration_mm_s2 > 0.0, "acceleration_mm_s2", acceleration_mm_s2, "above 0");
  require(watchdog_s >= 0.1 && watchdog_s <= 600.0, "watchdog_s", watchdog_s, "0.1 to 600");
  require(compensation_type == 0 || compensation_type == 1, "compensation_type", compensation_type, "0 or 1");
}

std::string temperatureSignal(const std::string& column) {
  std::string out = column;
  std::replace(out.begin(), out.end(), '_', '-');
  return out;
}

void writeControlConfiguration(const MachineDescription& machine, const ControlConfiguration& configuration,
                               const std::filesystem::path& folder) {
  configuration.validate();
  for (std::size_t i = 0; i < axis_letters.size(); ++i) {
    const std::string name(1, "XYZ"[i]);
    const LinearAxis* axis = machine.findAxis(name);
    if (axis == nullptr)
      throw InputError({machine.file, "$.axes"},
                       fmt::format("there is no axis {}; the control drives X, Y and Z.", name));
    const double at = configuration.corner_mm[static_cast<Eigen::Index>(i)];
    if (at < axis->travel_mm[0] || at > axis->travel_mm[1])
      throw InputError(fmt::format("The artefact's corner lies at {} = {:g} mm; allowed: the travel, {:g} to {:g} mm.",
                                   name, at, axis->travel_mm[0], axis->travel_mm[1]));
  }
  writeFileAtomically(folder / "spindrift.hal", halFile(configuration));
  writeFileAtomically(folder / "spindrift.ini", iniFile(machine, configuration));
  writeFileAtomically(folder / "sim.var", variables());
  writeFileAtomically(folder / "tool.tbl", "T1 P1 Z0 D6 ;probe\nT2 P2 Z0 D10 ;tool\n");
}

}  // namespace spindrift
