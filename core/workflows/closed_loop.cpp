// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/closed_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <map>
#include <set>
#include <sstream>
#include <thread>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/connect/append_file.h"
#include "core/discrepancy/effect_model.h"
#include "core/simulation/virtual_machine.h"
#include "core/thermal/measurement_update.h"
#include "core/thermal/response_fit.h"

namespace spindrift {
namespace {

constexpr double row_s = 30.0;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double steadyNow() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The simulation of the user, driven by what the log says.
class Twin {
 public:
  explicit Twin(const Scenario& scenario)
      : environment_(scenario.environment, scenario.duration_s, scenario.seed),
        plant_(scenario.machine, environment_, scenario.physics, scenario.seed) {
    for (const auto& [id, effect] : scenario.effects) {
      if (effect.setting.on && effect.setting.size != 0.0)
        effects_.emplace_back(effect.setting.size, plant_.effect(id, effect.setting));
    }
  }
  void advance(double spindle_rpm, double now_s) {
    ProgrammeSegment speeds;
    speeds.spindle_rpm = spindle_rpm;
    plant_.advance(speeds, now_s);
    now_s_ = std::max(0.0, now_s - ThermalStepper::step_s);
  }
  [[nodiscard]] Eigen::Vector3d deviation_um(const Eigen::Vector3d& position_mm) const {
    PlantQuery query;
    query.time_s = now_s_;
    query.position_mm = position_mm;
    Eigen::Vector3d total = Eigen::Vector3d::Zero();
    for (const auto& [size, function] : effects_) total += size * function(query).translation_mm;
    return 1e3 * total;
  }

 private:
  Environment environment_;
  VirtualMachine plant_;
  std::vector<std::pair<double, PlantEffectFunction>> effects_;
  double now_s_ = 0.0;
};

/// The model of one component over time, and its filter.
struct Identified {
  ThermalModel model;
  GainOffsetFilter filter;
  double run = 0.0;
};

class ClosedLoop {
 public:
  ClosedLoop(const LoopPlan& plan, MachineControl& control, const LoopOperator& who,
             const std::filesystem::path& folder, JobContext& job, const std::function<void(const LoopStatus&)>& look)
      : plan_(plan),
        control_(control),
        who_(who),
        folder_(folder),
        job_(job),
        look_(look),
        channel_(plan.limits),
        log_file_(folder / "log.csv"),
        cycle_text_(measuringProgram(plan)) {
    if (plan.simulation) twin_.emplace(*plan.simulation);
    columns_.resize(1 + plan.temperatures.size());
    for (const LoopTouch& touch : plan.touches) {
      const int axis = axisIndex(touch.component);
      if (!first_touch_[static_cast<std::size_t>(axis)])
        first_touch_[static_cast<std::size_t>(axis)] = touch.point + " " + std::string(toString(touch.component));
    }
  }

  LoopResult run() {
    writeCampaign();
    try {
      begin();
      loop();
      end();
    } catch (const InputError& error) {
      say(error.what());
      writeFileAtomically(folder_ / "loop.json", result_.json().dump(1));
      throw;
    }
    return std::move(result_);
  }

 private:
  void loop() {
    while (time_s_ < plan_.duration_s) {
      job_.throwIfCancelled();
      try {
        turn();
      } catch (const ConnectionError& error) {
        recover(error.what());
      }
      job_.report(std::min(1.0, time_s_ / plan_.duration_s), std::string(toString(stage_)));
      std::this_thread::sleep_for(std::chrono::milliseconds(40));
    }
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
    control_.openChannel(plan_.hold_when_silent);
    readClock();
    channel_.begin(control_.compensation().applied_um, time_s_);
  }

  void readClock() {
    const std::optional<double> machine = control_.signals({"machine-time"})[0];
    if (machine && *machine > 0.0) {
      time_s_ = std::max(time_s_, *machine);
    } else if (!machine) {
      if (began_s_ == 0.0) began_s_ = steadyNow();
      time_s_ = steadyNow() - began_s_;
    }
  }

  void recover(const std::string& why) {
    ++result_.losses;
    say("the control was lost: " + why);
    control_.close();
    measuring_ = false;
    running_ = nan;
    const double until = steadyNow() + plan_.patience_s;
    while (true) {
      job_.throwIfCancelled();
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
    const ControlState state = control_.state();
    if (state.condition == ControlState::Condition::Unreachable) throw ConnectionError(state.sentence);
    if (state.condition != condition_) {
      condition_ = state.condition;
      if (condition_ != ControlState::Condition::Ready && condition_ != ControlState::Condition::Busy) {
        say(state.sentence);
        measuring_ = false;
        running_ = nan;
      }
    }
    record();
    if (condition_ == ControlState::Condition::Ready || condition_ == ControlState::Condition::Busy) drive(state);
    stages();
    CompensationChannel::Wish wish;
    wish.offset_um = -predicted();
    wish.sigma_um = Eigen::Vector3d::Constant(stage_ == LoopStage::None ? 0.0 : plan_.action_limit_um / 2.0);
    wish.age_s = time_s_ - last_values_s_;
    const CompensationStatus status = control_.compensate(channel_.next(wish, state, time_s_));
    if (!status.watched) {
      say("the watchdog closed the channel: it is opened again from what is applied");
      control_.openChannel(plan_.hold_when_silent);
      channel_.begin(control_.compensation().applied_um, time_s_);
    }
    if (look_) look_({time_s_, stage_, channel_.sentence(), state.sentence, static_cast<int>(result_.cycles.size())});
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
      for (const std::string& line : control_.printed()) readTouch(line);
      if (state.ready()) {
        measuring_ = false;
        finishCycle();
      }
      return;
    }
    const bool due = time_s_ >= next_cycle_s_;
    const double rpm = due ? 0.0 : wantedSpeed();
    if (!due && rpm == running_) return;
    if (!state.ready()) {
      control_.abort();
      return;
    }
    if (due) {
      cycle_began_s_ = time_s_;
      touched_.clear();
      control_.start(ApprovedProgram::approve(cycle_text_, plan_.machine, state.position_mm, who_.confirm));
      measuring_ = true;
      running_ = nan;
      return;
    }
    running_ = rpm;
    // It runs until the next speed is due; abort ends it.
    if (rpm > 0.0)
      control_.start(ApprovedProgram::approve(fmt::format("G21 G90\nM3 S{:g}\nG4 P86400\nM5\nM2\n", rpm), plan_.machine,
                                              state.position_mm, who_.confirm));
  }

  // --- what comes

  void record() {
    std::vector<std::string> names{"spindle.0.speed-out"};
    for (const std::string& column : plan_.temperatures) names.push_back(temperatureSignal(column));
    const std::vector<std::optional<double>> values = control_.signals(names);
    for (const std::optional<double>& value : values) {
      if (!value || !std::isfinite(*value)) return;  // its age tells
    }
    last_values_s_ = time_s_;
    const double rpm = std::abs(*values[0]);
    if (twin_) twin_->advance(rpm, time_s_);
    if (time_s_ < next_row_s_) return;
    next_row_s_ = std::floor(time_s_ / row_s + 1.0) * row_s;
    if (!times_.empty() && time_s_ <= times_.back()) return;
    times_.push_back(time_s_);
    std::string line = fmt::format("{:.1f}", time_s_);
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      columns_[c].push_back(c == 0 ? rpm : *values[c]);
      line += fmt::format(",{:.3f}", columns_[c].back());
    }
    if (!log_file_.append(line + "\n")) say(log_file_.failure());
    refreshModels();
  }

  void readTouch(const std::string& line) {
    // "TOUCH point component x y z cx cy cz"
    std::istringstream words(line);
    std::string mark, point, component;
    Eigen::Vector3d at = Eigen::Vector3d::Zero(), applied_mm = Eigen::Vector3d::Zero();
    words >> mark >> point >> component >> at.x() >> at.y() >> at.z() >> applied_mm.x() >> applied_mm.y() >>
        applied_mm.z();
    if (!words || mark != "TOUCH") return;
    touched_.push_back({point + " " + component, at, applied_mm});
    Touched& touched = touched_.back();
    touched.time_s = time_s_;
    const auto measured = componentFromString(component);
    if (measured && !isRotation(*measured) && !zero_.empty()) {
      // What the models say now, not when the cycle is over: after the spindle has stopped everything moves fast.
      const int axis = axisIndex(*measured);
      touched.by_simulation_um = simulatedNow()[axis];
      if (const auto found = identified_.find(axis); found != identified_.end())
        touched.by_model_um = found->second.run;
    }
    if (twin_) {
      for (const LoopTouch& touch : plan_.touches) {
        if (touch.point == point && toString(touch.component) == component)
          touched.simulated_um = twin_->deviation_um(touch.target_mm)[axisIndex(touch.component)];
      }
    }
  }

  void finishCycle() {
    for (const std::string& line : control_.printed()) readTouch(line);
    const std::vector<std::string> messages = control_.messages();
    next_cycle_s_ = time_s_ + plan_.measure_every_s;
    if (touched_.size() != plan_.touches.size()) {
      say(fmt::format("a measuring cycle gave {} of {} touches and is not used{}", touched_.size(),
                      plan_.touches.size(), messages.empty() ? "" : ": " + messages.front()));
      next_cycle_s_ = time_s_ + plan_.shortest_s;
      return;
    }
    LoopCycle cycle;
    cycle.time_s = cycle_began_s_;
    cycle.stage = stage_;
    cycle.why = why_;
    const bool first = zero_.empty();
    const std::string state = fmt::format("M{}", result_.cycles.size());
    for (std::size_t i = 0; i < plan_.touches.size(); ++i) {
      const LoopTouch& touch = plan_.touches[i];
      const int axis = axisIndex(touch.component);
      const Touched& now = touched_[i];
      if (first) {
        zero_[now.name] = now;
        if (twin_) zero_reference_um_ = twin_->deviation_um(plan_.reference_mm);
      }
      const Touched& zero = zero_.at(now.name);
      const double with_um = -1e3 * (now.position_mm[axis] - zero.position_mm[axis]);
      const double without_um = with_um - 1e3 * (now.applied_mm[axis] - zero.applied_mm[axis]);
      if (first_touch_[static_cast<std::size_t>(axis)] == now.name) {
        told_[static_cast<std::size_t>(axis)] = now;
        cycle.with_um[axis] = with_um;
        cycle.without_um[axis] = without_um;
      }
      Observation row;
      row.time_s = now.time_s;
      row.state = state;
      row.point = touch.point;
      row.position_mm = touch.target_mm;
      row.component = touch.component;
      row.value = without_um;
      row.sigma = plan_.touch_sigma_um;
      row.instrument = "probe";
      observations_.rows.push_back(row);
      simulated_.push_back(now.simulated_um - zero.simulated_um);
    }
    observations_.write(folder_ / "observations.csv");
    update(cycle);
    result_.cycles.push_back(cycle);
    why_ = "time";
    if (demanded_) {
      next_cycle_s_ = time_s_ + plan_.shortest_s;
      why_ = "action control limit";
      demanded_ = false;
    }
  }

  // --- models

  [[nodiscard]] OperatingLog log() const {
    OperatingLog out(times_);
    out.setSignal("spindle_rpm", columns_[0]);
    for (std::size_t c = 0; c < plan_.temperatures.size(); ++c) out.setSignal(plan_.temperatures[c], columns_[c + 1]);
    return out;
  }

  [[nodiscard]] TimeSeries series() const {
    TimeSeries out;
    out.time_s = times_;
    out.signals.push_back({"spindle_rpm", SignalKind::Speed, columns_[0]});
    for (std::size_t c = 0; c < plan_.temperatures.size(); ++c)
      out.signals.push_back({plan_.temperatures[c], SignalKind::Temperature, columns_[c + 1]});
    return out;
  }

  /// Deviation at the tool point by the model that is in use, relative to the first cycle.
  [[nodiscard]] Eigen::Vector3d predicted() const {
    Eigen::Vector3d out = Eigen::Vector3d::Zero();
    if (zero_.empty() || stage_ == LoopStage::None) return out;
    out = simulatedNow();
    if (stage_ != LoopStage::Identified) return out;
    for (const auto& [axis, each] : identified_) {
      if (trusted_[static_cast<std::size_t>(axis)].identified) out[axis] = each.filter.value(each.run);
    }
    return out;
  }

  /// The simulation with what was added to it, relative to the first cycle; zero without one.
  [[nodiscard]] Eigen::Vector3d simulatedNow() const {
    if (!twin_) return Eigen::Vector3d::Zero();
    return twin_->deviation_um(plan_.reference_mm) - zero_reference_um_ + effect_um_;
  }

  /// Which of the two predicted the cycles so far better, before they were told: that one compensates the axis.
  void weigh(int axis, double measured_um, double simulated_um, double identified_um) {
    constexpr double memory = 0.7;  // about the last three cycles
    Trust& trust = trusted_[static_cast<std::size_t>(axis)];
    const double by_simulation = measured_um - simulated_um, by_model = measured_um - identified_um;
    trust.simulation_um2 = trust.cycles == 0
                               ? by_simulation * by_simulation
                               : memory * trust.simulation_um2 + (1.0 - memory) * by_simulation * by_simulation;
    trust.model_um2 =
        trust.cycles == 0 ? by_model * by_model : memory * trust.model_um2 + (1.0 - memory) * by_model * by_model;
    ++trust.cycles;
    const bool better = !twin_ || (trust.cycles >= 2 && trust.model_um2 < trust.simulation_um2);
    if (better == trust.identified) return;
    trust.identified = better;
    say(fmt::format("{} is compensated by the {}: {:.1f} µm off against {:.1f} µm", "XYZ"[axis],
                    better ? "identified model" : "simulation",
                    std::sqrt(better ? trust.model_um2 : trust.simulation_um2),
                    std::sqrt(better ? trust.simulation_um2 : trust.model_um2)));
  }

  /// What the log says now, for models that are slow to ask.
  void refreshModels() {
    if (effect_file_ && times_.size() > 2) {
      const OperatingLog now = log();
      const auto model = EffectModel::read(*effect_file_, plan_.machine, &now, observations_.points());
      const auto at = [&](double time_s) {
        Eigen::Vector3d out = Eigen::Vector3d::Zero();
        DeviationQuery query;
        query.time_s = time_s;
        query.position_mm = plan_.reference_mm;
        for (int axis = 0; axis < 3; ++axis) out[axis] = model->predict(query, static_cast<Component>(axis)).value;
        return out;
      };
      effect_um_ = at(times_.back()) - at(observations_.rows.front().time_s);
    }
    if (identified_.empty()) return;
    const TimeSeries now = series();
    for (auto& [axis, each] : identified_) {
      each.run = each.model.predict(now, 0).value.back();
      if (times_.size() > 1) each.filter.advance(times_.back() - times_[times_.size() - 2]);
    }
  }

  void identify(int axis) {
    TimeSeries known = series();
    std::vector<double> measured(times_.size(), nan);
    for (const Observation& o : observations_.rows) {
      if (axisIndex(o.component) != axis ||
          first_touch_[static_cast<std::size_t>(axis)] != o.point + " " + std::string(toString(o.component)))
        continue;
      const auto after = std::lower_bound(times_.begin(), times_.end(), o.time_s);
      const auto row = std::min<std::ptrdiff_t>(after - times_.begin(), static_cast<std::ptrdiff_t>(times_.size()) - 1);
      measured[static_cast<std::size_t>(row)] = o.value;
    }
    const std::string name = fmt::format("e{}_um", "xyz"[axis]);
    known.signals.push_back({name, SignalKind::Displacement, measured});
    std::vector<std::string> inputs{"spindle_rpm"};
    inputs.insert(inputs.end(), plan_.temperatures.begin(), plan_.temperatures.end());
    ResponseFitOptions options;
    options.period_s = row_s;
    options.strengths = {0.5};
    options.slow_preferences = {0.25};
    options.minimum_samples = 10;
    ResponseFitResult fit;
    try {
      fit = fitResponse(known, name, inputs, -1e300, 1e300, options, job_);
    } catch (const InputError& few) {
      fit.message = few.what();
    }
    if (fit.status != FitStatus::Converged) {
      say(fmt::format("no model of {} yet: {}", name, fit.message));
      return;
    }
    UpdateOptions update;
    update.measurement_sigma = plan_.touch_sigma_um;
    update.offset_sigma = std::max(fit.model.outputs.front().noise_sigma, 1.0);
    update.offset_tau_s = 4.0 * 3600.0;
    update.gain_sigma = 0.1;
    update.gain_drift_per_sqrt_h = 0.02;
    Identified out{fit.model, GainOffsetFilter(update), 0.0};
    out.run = out.model.predict(series(), 0).value.back();
    identified_.insert_or_assign(axis, std::move(out));
    say(fmt::format("model of {} from {} measurements, {:.2f} µm left out of the fit", name, result_.cycles.size(),
                    fit.left_out_rms));
  }

  /// A cycle corrects the identified models; one that is off by too much asks for another, and for new models.
  void update(const LoopCycle& cycle) {
    std::vector<int> off_axes;
    for (int axis = 0; axis < 3; ++axis) {
      const double off = cycle.with_um[axis];
      if (!std::isfinite(off)) continue;
      if (stage_ != LoopStage::None && std::abs(off) > plan_.action_limit_um) {
        say(fmt::format("{} is off by {:+.1f} µm; action control limit {:g} µm", "XYZ"[axis], off,
                        plan_.action_limit_um));
        demanded_ = stage_ == LoopStage::Identified;
        off_axes.push_back(axis);
      }
      const auto found = identified_.find(axis);
      if (found == identified_.end()) continue;
      Identified& model = found->second;
      const Touched& told = told_[static_cast<std::size_t>(axis)];
      weigh(axis, cycle.without_um[axis], told.by_simulation_um, model.filter.value(told.by_model_um));
      model.filter.measure(cycle.without_um[axis], told.by_model_um);
    }
    if (!demanded_) return;
    // After they were judged: a model is not judged by what it was made from.
    for (const int axis : off_axes) identify(axis);
  }

  void enter(LoopStage stage) {
    stage_ = stage;
    result_.stages.emplace_back(time_s_, stage);
    say(fmt::format("compensation: {}", toString(stage)));
  }

  void stages() {
    if (stage_ == LoopStage::None && twin_ && !zero_.empty()) enter(LoopStage::Simulation);
    if (stage_ == LoopStage::Simulation && plan_.discrepancy_s > 0.0 && time_s_ >= plan_.discrepancy_s && !measuring_ &&
        !searched_)
      search();
    if (search_.valid() && search_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) named();
    if (stage_ != LoopStage::Identified && plan_.identify_s > 0.0 && time_s_ >= plan_.identify_s && !measuring_ &&
        !search_.valid() && result_.cycles.size() != tried_) {
      tried_ = result_.cycles.size();
      for (int axis = 0; axis < 3; ++axis) {
        if (first_touch_[static_cast<std::size_t>(axis)]) identify(axis);
      }
      for (const auto& [axis, model] : identified_) trusted_[static_cast<std::size_t>(axis)].identified = !twin_;
      if (!identified_.empty()) enter(LoopStage::Identified);
    }
  }

  [[nodiscard]] DiscrepancyInput discrepancyInput() const {
    DiscrepancyInput input;
    input.machine = plan_.machine;
    input.log = log();
    input.observations = observations_;
    input.predicted = simulated_;
    return input;
  }

  /// Beside the loop: the channel has to be kept alive meanwhile.
  void search() {
    searched_ = true;
    std::string table = "time_s,point,component,predicted\n";
    for (std::size_t i = 0; i < simulated_.size(); ++i) {
      const Observation& o = observations_.rows[i];
      table += fmt::format("{:.1f},{},{},{:.4f}\n", o.time_s, o.point, toString(o.component), simulated_[i]);
    }
    writeFileAtomically(folder_ / "simulation.csv", table);
    say(fmt::format("{} readings are held against the simulation", simulated_.size()));
    search_ = std::async(std::launch::async, [input = discrepancyInput()] {
      JobContext job;
      DiscrepancyOptions options;
      options.suggest = false;
      return findDiscrepancy(input, options, job);
    });
  }

  void named() {
    const DiscrepancyResult found = search_.get();
    result_.verdict = std::string(toString(found.verdict));
    say(found.message);
    writeFileAtomically(folder_ / "discrepancy.json", found.json().dump(1));
    result_.effects = who_.add ? who_.add(found) : std::vector<std::string>();
    if (result_.effects.empty()) {
      say("nothing is added to the simulation");
      return;
    }
    // What the operator added, fitted alone: further names that were not added play no part.
    DiscrepancyOptions options;
    options.accept = result_.effects;
    options.max_effects = 0;
    options.suggest = false;
    const bool all = found.effects.size() == result_.effects.size();
    const DiscrepancyResult added = all ? found : findDiscrepancy(discrepancyInput(), options, job_);
    if (!added.model) {
      say("what was named could not be fitted");
      return;
    }
    writeFileAtomically(folder_ / "model.json", added.model->json().dump(1));
    effect_file_ = folder_ / "model.json";
    refreshModels();
    enter(LoopStage::WithEffect);
    say(fmt::format("added to the simulation: {}", joinedList(result_.effects)));
  }

  // --- the campaign

  void writeCampaign() {
    const nlohmann::json campaign = {{"format", "spindrift-campaign"},
                                     {"version", 1},
                                     {"name", "closed loop"},
                                     {"start_utc", "2026-01-31T08:00:00Z"}};
    writeFileAtomically(folder_ / "campaign.json", campaign.dump(1));
    writeFileAtomically(folder_ / "machine.json", plan_.machine.source.dump(1));
    std::string header = "time_s,spindle_rpm";
    for (const std::string& column : plan_.temperatures) header += "," + column;
    if (log_file_.size() == 0) (void)log_file_.append(header + "\n");
  }

  void end() {
    channel_.begin(channel_.written_um(), time_s_);
    control_.abort();
    control_.close();
    log_file_.sync();
    result_.largest_step_um = channel_.largestStep_um();
    result_.largest_rate_um_s = channel_.largestRate_um_s();
    result_.completed = true;
    say("the end of the plan");
    writeFileAtomically(folder_ / "loop.json", result_.json().dump(1));
  }

  void say(const std::string& text) {
    result_.events.push_back({time_s_, text});
    job_.report(std::min(1.0, time_s_ / plan_.duration_s), text);
  }

  struct Touched {
    std::string name;
    Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
    Eigen::Vector3d applied_mm = Eigen::Vector3d::Zero();
    double time_s = 0.0;
    double simulated_um = 0.0;
    double by_simulation_um = 0.0;  ///< at the tool point
    double by_model_um = 0.0;       ///< the same, before its filter
  };

  const LoopPlan& plan_;
  MachineControl& control_;
  const LoopOperator& who_;
  std::filesystem::path folder_;
  JobContext& job_;
  std::function<void(const LoopStatus&)> look_;
  CompensationChannel channel_;
  AppendFile log_file_;
  std::string cycle_text_;
  std::optional<Twin> twin_;
  std::array<std::optional<std::string>, 3> first_touch_;

  double time_s_ = 0.0;
  double began_s_ = 0.0;
  ControlState::Condition condition_ = ControlState::Condition::Ready;
  double running_ = nan;  ///< speed that was commanded last
  bool measuring_ = false;
  double cycle_began_s_ = 0.0;
  double next_cycle_s_ = 0.0;
  bool demanded_ = false;
  std::string why_ = "time";
  std::vector<Touched> touched_;
  std::map<std::string, Touched> zero_;
  Eigen::Vector3d zero_reference_um_ = Eigen::Vector3d::Zero();

  double last_values_s_ = 0.0;
  double next_row_s_ = 0.0;
  std::vector<double> times_;
  std::vector<std::vector<double>> columns_;
  ObservationSet observations_;
  std::vector<double> simulated_;

  struct Trust {
    bool identified = false;
    int cycles = 0;
    double simulation_um2 = 0.0;
    double model_um2 = 0.0;
  };
  std::array<Trust, 3> trusted_;
  std::array<Touched, 3> told_;  ///< the first touch of each component in the last cycle
  LoopStage stage_ = LoopStage::None;
  bool searched_ = false;
  std::size_t tried_ = 0;  ///< cycles at the last attempt to identify
  std::future<DiscrepancyResult> search_;
  std::optional<std::filesystem::path> effect_file_;
  Eigen::Vector3d effect_um_ = Eigen::Vector3d::Zero();
  std::map<int, Identified> identified_;
  LoopResult result_;
};

}  // namespace

std::string_view toString(LoopStage stage) noexcept {
  switch (stage) {
    case LoopStage::None:
      return "none";
    case LoopStage::Simulation:
      return "simulation";
    case LoopStage::WithEffect:
      return "simulation with the added effect";
    case LoopStage::Identified:
      break;
  }
  return "identified models";
}

std::string measuringProgram(const LoopPlan& plan) {
  std::string out = fmt::format("G21 G90 G94 G40 G49 G54\nM5\n(LOGOPEN,{})\nG0 Z{:.4f}\n", print_file, plan.safe_z_mm);
  for (const LoopTouch& touch : plan.touches) {
    const Eigen::Vector3d along = (touch.target_mm - touch.before_mm).normalized();
    const Eigen::Vector3d clear = touch.before_mm - plan.clear_mm * along;
    out += fmt::format(
        "G0 X{:.4f} Y{:.4f}\nG0 Z{:.4f}\nG0 X{:.4f} Y{:.4f} Z{:.4f}\nG38.2 X{:.4f} Y{:.4f} Z{:.4f} F{:g}\n"
        "(LOG,TOUCH {} {} #5061 #5062 #5063 #<_hal[offset-x.offset]> #<_hal[offset-y.offset]> "
        "#<_hal[offset-z.offset]>)\n"
        "G0 X{:.4f} Y{:.4f} Z{:.4f}\nG0 Z{:.4f}\n",
        clear.x(), clear.y(), clear.z(), touch.before_mm.x(), touch.before_mm.y(), touch.before_mm.z(),
        touch.target_mm.x(), touch.target_mm.y(), touch.target_mm.z(), plan.feed_mm_min, touch.point,
        toString(touch.component), clear.x(), clear.y(), clear.z(), plan.safe_z_mm);
  }
  return out + "(LOGCLOSE)\nM2\n";
}

LoopResult runClosedLoop(const LoopPlan& plan, MachineControl& control, const LoopOperator& who,
                         const std::filesystem::path& folder, JobContext& job,
                         const std::function<void(const LoopStatus&)>& look) {
  plan.validate();
  if (std::filesystem::exists(folder) && !std::filesystem::is_empty(folder))
    throw InputError(fmt::format("{} is not empty; allowed: a new or empty folder.", folder.string()));
  std::filesystem::create_directories(folder);
  return ClosedLoop(plan, control, who, folder, job, look).run();
}

}  // namespace spindrift
