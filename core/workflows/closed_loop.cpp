// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/closed_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <thread>
#include <utility>

#include "core/base/atomic_file.h"
#include "core/base/csv.h"
#include "core/base/error.h"
#include "core/base/no_number.h"
#include "core/base/text.h"
#include "core/base/utc_time.h"
#include "core/connect/append_file.h"
#include "core/workflows/loop_models.h"
#include "core/workflows/loop_search.h"
#include "core/workflows/loop_state.h"

namespace spindrift {
namespace {

double secondsOf(std::chrono::nanoseconds time) {
  return std::chrono::duration<double>(time).count();
}

double steadyNow() {
  return secondsOf(std::chrono::steady_clock::now().time_since_epoch());
}

double unixNow() {
  return secondsOf(std::chrono::system_clock::now().time_since_epoch());
}

void nap() {
  std::this_thread::sleep_for(std::chrono::milliseconds(40));
}

class ClosedLoop {
 public:
  ClosedLoop(const LoopPlan& plan, MachineControl& control, const LoopOperator& who,
             const std::filesystem::path& folder, JobContext& job, const LoopLook& look, UtcOfZero utc_of_zero)
      : plan_(plan),
        control_(control),
        who_(who),
        folder_(folder),
        job_(job),
        look_(look),
        utc_of_zero_(std::move(utc_of_zero)),
        channel_(plan.limits),
        log_file_(folder / "log.csv"),
        cycle_text_(measuringProgram(plan)),
        models_(plan, [this](const std::string& text) { say(text); }),
        search_(plan, who) {
    if (who_.wishes) hold_ = who_.wishes->hold;
  }

  LoopResult run() {
    if (std::filesystem::exists(folder_ / loop_state_file)) {
      resume();
    } else {
      writeCampaign();
    }
    try {
      const bool dated = time_s_ > 0.0;  // by the run that began it
      begin();
      if (!dated) writeHead();
      loop();
      end();
    } catch (const InputError& error) {
      say(error.what());
      save();
      writeFileAtomically(folder_ / "loop.json", result().json().dump(1));
      throw;
    }
    job_.throwIfCancelled();
    return result();
  }

 private:
  void loop() {
    while (time_s_ < plan_.duration_s && !stopWanted()) {
      try {
        turn();
      } catch (const ConnectionError& error) {
        recover(error.what());
      }
      job_.report(std::min(1.0, time_s_ / plan_.duration_s), std::string(toString(stage_)));
      nap();
    }
  }

  [[nodiscard]] bool leaveWanted() const { return who_.wishes && who_.wishes->leave; }
  [[nodiscard]] bool stopWanted() const {
    return job_.cancelled() || leaveWanted() || (who_.wishes && who_.wishes->stop);
  }

  // --- the control

  void begin() {
    control_.connect({});
    for (const ControlFinding& finding : control_.check()) {
      if (!finding.good)
        throw InputError(
            fmt::format("The control is not fit for a closed loop: {}: {}.", finding.what, finding.sentence));
    }
    switchOn();
    say("the control is ready");
  }

  void switchOn() {
    const DryRun homing;
    control_.switchOn(who_.confirm && who_.confirm(homing));
    control_.openChannel(hold_);
    readClock();
    channel_.begin(control_.compensation().applied_um, time_s_);
  }

  void readClock() {
    const std::optional<double> machine = control_.signals({"machine-time"})[0];
    if (machine && *machine > 0.0) {
      time_s_ = std::max(time_s_, *machine);
    } else if (!machine) {
      if (began_unix_s_ == 0.0) began_unix_s_ = unixNow();
      time_s_ = std::max(time_s_, unixNow() - began_unix_s_);
    }
  }

  void recover(const std::string& why) {
    ++result_.losses;
    say("the control was lost: " + why);
    control_.close();
    measuring_ = false;
    running_ = no_number;
    save();
    const double until = steadyNow() + plan_.patience_s;
    while (!stopWanted()) {
      try {
        control_.connect({});
        switchOn();
        say("the control is back; the compensation returns from what is applied");
        return;
      } catch (const ConnectionError&) {
      } catch (const InputError&) {
      }
      if (steadyNow() > until)
        throw InputError(fmt::format("The control did not come back within {:g} s: {}", plan_.patience_s, why));
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
    }
  }

  void turn() {
    readClock();
    if (who_.wishes && who_.wishes->hold != hold_) {
      hold_ = who_.wishes->hold;
      control_.holdWhenSilent(hold_);
      say(hold_ ? "if updates stop, the control holds the compensation"
                : "if updates stop, the control lets the compensation fade");
    }
    const ControlState state = control_.state();
    if (state.condition == ControlState::Condition::Unreachable) throw ConnectionError(state.sentence);
    const bool there =
        state.condition == ControlState::Condition::Ready || state.condition == ControlState::Condition::Busy;
    if (state.condition != condition_) {
      condition_ = state.condition;
      if (!there) {
        say(state.sentence);
        measuring_ = false;
        running_ = no_number;
      }
    }
    if (there) notice(state);
    record();
    if (there) drive(state);
    stages();
    CompensationChannel::Wish wish;
    wish.offset_um = -models_.predicted(stage_);
    wish.sigma_um = models_.sigma(stage_);
    wish.age_s = time_s_ - last_values_s_;
    if (rehomed_ && models_.begun())
      wish.refused = "the machine was homed anew: a measuring cycle has to look at its zero";
    CompensationStatus status = control_.compensate(channel_.next(wish, state, time_s_));
    if (!status.watched) {
      say("the watchdog closed the channel: it is opened again from what is applied");
      control_.openChannel(hold_);
      status = control_.compensation();
      channel_.begin(status.applied_um, time_s_);
    }
    if (changed_) save();  // what is shown is kept
    show(state, status, wish);
  }

  void show(const ControlState& state, const CompensationStatus& applied, const CompensationChannel::Wish& wish) {
    if (!look_) return;
    LoopStatus status;
    status.time_s = time_s_;
    status.duration_s = plan_.duration_s;
    status.stage = stage_;
    status.control = state;
    status.channel = channel_.sentence();
    status.active = channel_.active() && stage_ != LoopStage::None;
    status.reason =
        stage_ == LoopStage::None && channel_.active() ? "there is nothing to compensate with yet" : channel_.reason();
    status.applied_um = applied.applied_um;
    status.sigma_um = wish.sigma_um;
    status.age_s = wish.age_s;
    status.hold_when_silent = hold_;
    status.measuring = measuring_;
    status.asking = search_.asking();
    status.stopping = stopping_;
    status.next_cycle_s = next_cycle_s_;
    look_(status, result_);
  }

  /// What somebody else did to the machine: another tool, homed anew.
  void notice(const ControlState& state) {
    if (tool_ && state.tool != shown_tool_) {
      say(state.tool == *tool_
              ? fmt::format("tool {} is back in the spindle: measuring cycles go on", state.tool)
              : fmt::format("tool {} is in the spindle: the compensation continues, measuring cycles wait for tool {}",
                            state.tool, *tool_));
      shown_tool_ = state.tool;
    }
    if (home_mm_ && (state.home_mm - *home_mm_).cwiseAbs().maxCoeff() > 1e-6) {
      say("the machine was homed anew: the compensation is off until a measuring cycle has looked at the zero");
      rehomed_ = true;
      next_cycle_s_ = time_s_;
    }
    if (!home_mm_ || state.home_mm != *home_mm_) {
      home_mm_ = state.home_mm;
      changed_ = true;
    }
  }

  [[nodiscard]] double wantedSpeed() const {
    double rpm = 0.0;
    for (const LoopSpeed& each : plan_.programme) {
      if (each.from_s <= time_s_) rpm = each.spindle_rpm;
    }
    return rpm;
  }

  /// Programme and measuring cycles.
  void drive(const ControlState& state) {
    if (measuring_) {
      readTouches();
      if (state.ready()) {
        measuring_ = false;
        ours_ = false;
        finishCycle(state);
      }
      return;
    }
    if (state.ready()) {
      if (ours_ && running_ > 0.0) say("the program was ended at the control");
      ours_ = false;
      waiting_ = false;
    }
    const bool due = time_s_ >= next_cycle_s_ && (!tool_ || state.tool == *tool_);
    const double rpm = due ? 0.0 : wantedSpeed();
    if (!due && rpm == running_) return;
    if (!state.ready()) {
      if (ours_) {
        control_.abort();
        running_ = no_number;
      } else if (!std::exchange(waiting_, true)) {
        say("a program that is not the loop's is running: the loop waits for its end");
      }
      return;
    }
    if (due) {
      cycle_began_s_ = time_s_;
      touched_.clear();
      (void)control_.printed();
      start(cycle_text_, state);
      measuring_ = true;
      running_ = no_number;
      return;
    }
    running_ = rpm;
    // It runs until the next speed is due; abort ends it.
    if (rpm > 0.0) start(fmt::format("G21 G90\nM3 S{:g}\nG4 P86400\nM5\nM2\n", rpm), state);
  }

  void start(const std::string& text, const ControlState& state) {
    control_.start(ApprovedProgram::approve(text, plan_.machine, state.position_mm, who_.confirm));
    ours_ = true;
    changed_ = true;
  }

  // --- what comes

  void record() {
    std::vector<std::string> names{"spindle.0.speed-out"};
    for (const std::string& column : plan_.temperatures) names.push_back(temperatureSignal(column));
    const std::vector<std::optional<double>> found = control_.signals(names);
    std::vector<double> values;
    for (const std::optional<double>& value : found) {
      if (!value || !std::isfinite(*value)) return;  // its age tells
      values.push_back(*value);
    }
    values[0] = std::abs(values[0]);
    last_values_s_ = time_s_;
    models_.drive(values[0], time_s_);
    if (time_s_ < next_row_s_) return;
    next_row_s_ = std::floor(time_s_ / LoopModels::row_s + 1.0) * LoopModels::row_s;
    writeRow(std::move(values));
  }

  void writeRow(std::vector<double> values) {
    // As the file has it: what is read again after a restart is the same.
    const double at_s = std::round(10.0 * time_s_) / 10.0;
    if (!models_.times().empty() && at_s <= models_.times().back()) return;
    std::string line = fmt::format("{:.1f}", at_s);
    for (double& value : values) {
      value = std::round(1e3 * value) / 1e3;
      line += std::isnan(value) ? "," : fmt::format(",{:.3f}", value);
    }
    if (!log_file_.append(line + "\n")) say(log_file_.failure());
    models_.addRow(at_s, values);
    changed_ = true;
  }

  void readTouches() {
    for (const std::string& line : control_.printed()) {
      if (std::optional<LoopReading> reading = models_.reading(line, time_s_, stage_))
        touched_.push_back(std::move(*reading));
    }
  }

  void finishCycle(const ControlState& state) {
    readTouches();
    const std::vector<std::string> messages = control_.messages();
    next_cycle_s_ = time_s_ + plan_.measure_every_s;
    changed_ = true;
    bool whole = touched_.size() == plan_.touches.size();
    for (std::size_t i = 0; i < touched_.size() && whole; ++i)
      whole = touched_[i].name == plan_.touches[i].point + " " + std::string(toString(plan_.touches[i].component));
    if (!whole) {
      say(fmt::format("a measuring cycle gave {} of {} touches and is not used{}", touched_.size(),
                      plan_.touches.size(), messages.empty() ? "" : ": " + messages.front()));
      next_cycle_s_ = time_s_ + plan_.shortest_s;
      return;
    }
    if (!tool_) tool_ = shown_tool_ = state.tool;
    const bool rehomed = std::exchange(rehomed_, false) && models_.begun();
    if (rehomed) {
      const Eigen::Vector3d shift_um = models_.takeShift(touched_);
      say(shift_um.isZero() ? std::string("the zero is where it was: the compensation returns")
                            : fmt::format("the zero has moved by X {:+.1f}, Y {:+.1f}, Z {:+.1f} µm: that is taken out "
                                          "of the reference and not compensated; look at the workpiece's zero",
                                          shift_um.x(), shift_um.y(), shift_um.z()));
    }
    LoopCycle cycle;
    cycle.time_s = cycle_began_s_;
    cycle.stage = stage_;
    cycle.why = rehomed ? std::string("homed anew") : std::exchange(why_, "time");
    std::set<int> again;
    models_.take(std::move(touched_), fmt::format("M{}", result_.cycles.size()), rehomed, cycle, again);
    touched_.clear();
    result_.cycles.push_back(cycle);
    if (!again.empty()) {
      next_cycle_s_ = time_s_ + plan_.shortest_s;
      why_ = "action control limit";
      // After they were judged: a model is not judged by what it was made from.
      for (const int axis : again) models_.identify(axis, job_);
    }
    save();
    models_.observations().write(folder_ / "observations.csv");
  }

  // --- stages

  void enter(LoopStage stage) {
    stage_ = stage;
    result_.stages.emplace_back(time_s_, stage);
    say(fmt::format("compensation: {}", toString(stage)));
    changed_ = true;
  }

  void stages() {
    if (stage_ == LoopStage::None && models_.simulates() && models_.begun()) enter(LoopStage::Simulation);
    search();
    if (stage_ != LoopStage::Identified && plan_.identify_s > 0.0 && time_s_ >= plan_.identify_s && !measuring_ &&
        !search_.searching() && result_.cycles.size() >= LoopModels::least_cycles && result_.cycles.size() != tried_) {
      tried_ = result_.cycles.size();
      for (int axis = 0; axis < 3; ++axis) {
        if (models_.touches(axis)) models_.identify(axis, job_);
      }
      if (models_.anyIdentified()) enter(LoopStage::Identified);
    }
  }

  /// The readings are held against the simulation, and the operator decides: beside the loop, which goes on.
  void search() {
    if (stage_ == LoopStage::Simulation && plan_.discrepancy_s > 0.0 && time_s_ >= plan_.discrepancy_s && !measuring_ &&
        !searched_ && !search_.running()) {
      writeFileAtomically(folder_ / "simulation.csv", models_.simulationTable());
      say(fmt::format("{} readings are compared with the simulation", models_.observations().rows.size()));
      search_.begin(models_.discrepancyInput());
    }
    if (const std::optional<DiscrepancyResult> found = search_.named()) {
      result_.verdict = std::string(toString(found->verdict));
      say(found->message);
      writeFileAtomically(folder_ / "discrepancy.json", found->json().dump(1));
      if (plan_.accept.rule == LoopAcceptance::Rule::Ask && !found->effects.empty())
        say(who_.choose ? "the operator is asked which of the named effects are added"
                        : "nobody is there to accept what was named");
    }
    const std::optional<LoopSearch::Decision> decision = search_.decided();
    if (!decision) return;
    searched_ = true;
    changed_ = true;
    for (const std::string& id : decision->rejected) say("not accepted: " + id);
    if (decision->accepted.empty()) {
      say("nothing is added to the simulation");
    } else if (!decision->model) {
      say("what was named could not be fitted");
    } else {
      result_.effects = decision->accepted;
      writeFileAtomically(folder_ / "model.json", decision->model->json().dump(1));
      models_.add(folder_ / "model.json");
      say(fmt::format("added to the simulation: {}", joinedList(result_.effects)));
      if (stage_ == LoopStage::Simulation) enter(LoopStage::WithEffect);
    }
  }

  // --- the campaign

  /// Time 0 is the machine's: known once its clock has been read, until then this moment.
  void writeHead() {
    const nlohmann::json campaign = {
        {"format", "spindrift-campaign"},
        {"version", 1},
        {"name", "closed loop"},
        {"start_utc", utcText(utc_of_zero_ ? utc_of_zero_(time_s_) : unixNow() - time_s_)}};
    writeFileAtomically(folder_ / "campaign.json", campaign.dump(1));
  }

  void writeCampaign() {
    writeHead();
    writeFileAtomically(folder_ / "machine.json", plan_.machine.source.dump(1));
    std::string header = "time_s,spindle_rpm";
    for (const std::string& column : plan_.temperatures) header += "," + csvField(column);
    if (log_file_.size() == 0) (void)log_file_.append(header + "\n");
    save();
  }

  /// What the loop would need to go on, whole or not at all.
  void save() {
    changed_ = false;
    LoopState state;
    state.time_s = time_s_;
    state.began_unix_s = began_unix_s_;
    state.stage = stage_;
    state.next_cycle_s = next_cycle_s_;
    state.why = why_;
    state.searched = searched_;
    state.tried = tried_;
    state.ours = ours_;
    state.measuring = measuring_;
    state.tool = tool_;
    state.home_mm = home_mm_;
    state.rehomed = rehomed_;
    state.result = result();
    state.models = models_.state();
    writeFileAtomically(folder_ / loop_state_file, state.json(plan_).dump());
  }

  void resume() {
    const LoopState state = LoopState::read(folder_ / loop_state_file, plan_);
    time_s_ = state.time_s;
    began_unix_s_ = state.began_unix_s;
    stage_ = state.stage;
    next_cycle_s_ = state.next_cycle_s;
    why_ = state.why;
    searched_ = state.searched;
    tried_ = state.tried;
    ours_ = state.ours;
    tool_ = state.tool;
    if (tool_) shown_tool_ = *tool_;
    home_mm_ = state.home_mm;
    rehomed_ = state.rehomed;
    result_ = state.result;
    models_.restore(JsonNode::parse(state.models.dump(), folder_ / loop_state_file), folder_ / "log.csv", folder_,
                    time_s_);
    if (!models_.times().empty()) {
      time_s_ = std::max(time_s_, models_.times().back());
      next_row_s_ = std::floor(models_.times().back() / LoopModels::row_s + 1.0) * LoopModels::row_s;
    }
    if (state.measuring && !models_.times().empty()) {
      // The cycle had stopped the spindle, and it has stood since: the last row may still say that it turned.
      std::vector<double> values = models_.lastRow();
      values[0] = 0.0;
      time_s_ = std::max(time_s_, models_.times().back() + 0.1);
      models_.drive(0.0, time_s_);
      writeRow(std::move(values));
    }
    if (models_.begun()) models_.observations().write(folder_ / "observations.csv");
    ++result_.resumed;
    say(fmt::format("the loop continues with {} measuring cycles and {} rows of the log", result_.cycles.size(),
                    models_.times().size()));
  }

  void end() {
    const bool whole = !stopWanted();
    stopping_ = true;
    result_.ended_s = time_s_;
    say(whole ? "the end of the plan: the compensation fades" : "stopped: the compensation fades");
    fade();
    control_.close();
    log_file_.sync();
    result_.completed = whole;
    save();
    writeFileAtomically(folder_ / "loop.json", result().json().dump(1));
  }

  /// To zero, within rate and step of the channel.
  void fade() {
    try {
      if (ours_) control_.abort();
      double until = steadyNow() + plan_.patience_s;
      while (channel_.written_um().cwiseAbs().maxCoeff() > 1e-6 && steadyNow() < until && !leaveWanted()) {
        readClock();
        const ControlState state = control_.state();
        if (state.condition == ControlState::Condition::Unreachable) throw ConnectionError(state.sentence);
        CompensationChannel::Wish wish;
        wish.refused = "the loop ends";
        const Eigen::Vector3d before = channel_.written_um();
        const CompensationStatus status = control_.compensate(channel_.next(wish, state, time_s_));
        if (channel_.written_um() != before) until = steadyNow() + plan_.patience_s;
        show(state, status, wish);
        nap();
      }
      if (channel_.written_um().isZero(1e-6)) say("the compensation is at zero");
    } catch (const ConnectionError& error) {
      say(std::string("the control was lost while the compensation faded; its watchdog continues the fade: ") +
          error.what());
    }
  }

  [[nodiscard]] LoopResult result() const {
    LoopResult out = result_;
    out.largest_step_um = std::max(out.largest_step_um, channel_.largestStep_um());
    out.largest_rate_um_s = std::max(out.largest_rate_um_s, channel_.largestRate_um_s());
    return out;
  }

  void say(const std::string& text) {
    result_.events.push_back({time_s_, text});
    changed_ = true;
    job_.report(std::min(1.0, time_s_ / plan_.duration_s), text);
  }

  const LoopPlan& plan_;
  MachineControl& control_;
  const LoopOperator& who_;
  std::filesystem::path folder_;
  JobContext& job_;
  LoopLook look_;
  UtcOfZero utc_of_zero_;
  CompensationChannel channel_;
  AppendFile log_file_;
  std::string cycle_text_;
  LoopResult result_;
  LoopModels models_;

  double time_s_ = 0.0;
  double began_unix_s_ = 0.0;
  ControlState::Condition condition_ = ControlState::Condition::Ready;
  bool hold_ = plan_.hold_when_silent;
  double running_ = no_number;  ///< speed that was commanded last
  bool ours_ = false;           ///< what runs is the loop's
  bool waiting_ = false;        ///< for the end of a programme that is not
  bool measuring_ = false;
  bool stopping_ = false;
  double cycle_began_s_ = 0.0;
  double next_cycle_s_ = 0.0;
  std::string why_ = "time";
  std::vector<LoopReading> touched_;
  std::optional<int> tool_;  ///< of the first cycle
  int shown_tool_ = 0;
  std::optional<Eigen::Vector3d> home_mm_;
  bool rehomed_ = false;

  double last_values_s_ = 0.0;
  double next_row_s_ = 0.0;
  bool changed_ = false;  ///< since it was saved

  LoopStage stage_ = LoopStage::None;
  bool searched_ = false;
  std::size_t tried_ = 0;  ///< cycles at the last attempt to identify
  LoopSearch search_;
};

}  // namespace

LoopResult runClosedLoop(const LoopPlan& plan, MachineControl& control, const LoopOperator& who,
                         const std::filesystem::path& folder, JobContext& job, const LoopLook& look,
                         UtcOfZero utc_of_zero) {
  plan.validate();
  if (std::filesystem::exists(folder) && !std::filesystem::is_empty(folder) &&
      !std::filesystem::exists(folder / loop_state_file))
    throw InputError(
        fmt::format("{} is not empty; allowed: a new or empty folder, or that of the same loop.", folder.string()));
  std::filesystem::create_directories(folder);
  return ClosedLoop(plan, control, who, folder, job, look, std::move(utc_of_zero)).run();
}

}  // namespace spindrift
