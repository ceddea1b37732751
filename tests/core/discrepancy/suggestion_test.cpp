// SPDX-License-Identifier: GPL-3.0-or-later
// What to measure next: the plan is within what is allowed, drives one rival and not the other, goes where they differ,
// and the readings that it asks for leave the truth alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/discrepancy/discrepancy.h"
#include "core/discrepancy/measurement_design.h"

namespace spindrift {
namespace {

using ::testing::Contains;

constexpr double step_s = 60.0;
constexpr double day_s = 86400.0;

MachineDescription machine() {
  return MachineDescription::parse(
      JsonNode::parse(R"({"format":"spindrift-machine","version":1,"name":"m","chain":"V [w-X'-Y'-b-Z-t]",
  "axes":[{"name":"X","travel_mm":[0,600],"drive":{"type":"linear_motor"},"scale":"linear_scale","datum_mm":0},
          {"name":"Y","travel_mm":[0,400],"drive":{"type":"linear_motor"}},
          {"name":"Z","travel_mm":[0,400],"drive":{"type":"linear_motor"}}],
  "points":[{"id":"F1","kind":"fiducial","x_mm":400,"y_mm":40,"z_mm":20},
            {"id":"F2","kind":"fiducial","x_mm":400,"y_mm":360,"z_mm":60},
            {"id":"F3","kind":"fiducial","x_mm":400,"y_mm":200,"z_mm":380},
            {"id":"F4","kind":"fiducial","x_mm":400,"y_mm":120,"z_mm":200},
            {"id":"F5","kind":"fiducial","x_mm":30,"y_mm":100,"z_mm":100}],
  "temperature_sensors":[{"name":"T_room_degC","place":"room"}]})",
                      "machine.json"),
      "machine.json");
}

enum class Cause {
  SpindleDrift,  ///< X everywhere, with the heat of the spindle
  Scale,         ///< X in proportion to x, with the room
};

/// A machine whose spindle and coolant may run together or not. What it does is written down minute by minute.
class Shop {
 public:
  Shop(Cause cause, std::uint64_t seed) : machine_(machine()), cause_(cause), random_(seed) {
    phase_ = random_.uniform(-0.3, 0.3);
    room_seed_ = random_.uniform(0.0, 6.0);
  }

  void run(double until_s, double rpm, bool coolant) {
    while (step_s * static_cast<double>(time_.size()) < until_s) {
      const double t = step_s * static_cast<double>(time_.size());
      time_.push_back(t);
      rpm_.push_back(rpm);
      coolant_.push_back(coolant ? 1.0 : 0.0);
      // The course of a day, and a slow weather on it.
      const double air = 2.0 * std::sin(2.0 * M_PI * t / day_s + phase_) + 0.4 * std::sin(t / 5000.0 + room_seed_);
      room_.push_back(air);
      drift_.push_back(body_);
      scale_.push_back(rail_);
      body_ += step_s * (4.0 * rpm / 3000.0 - body_) / 1500.0;
      rail_ += step_s * (air - rail_) / 2400.0;
    }
  }

  void measure(double t, const std::string& point, const Eigen::Vector3d& place, const std::string& state) {
    const std::size_t at = std::min(time_.size() - 1, static_cast<std::size_t>(t / step_s));
    for (int c = 0; c < 3; ++c) {
      Observation o;
      o.time_s = t;
      o.state = state;
      o.point = point;
      o.position_mm = place;
      o.component = static_cast<Component>(c);
      o.sigma = 0.5;
      double truth = 0.0;
      if (c == 0) truth = cause_ == Cause::SpindleDrift ? drift_[at] : 3.0 * scale_[at] * place.x() * 1e-3;
      o.value = truth + random_.normal(0.0, o.sigma);
      rows_.push_back(o);
    }
  }

  /// Eight hours in which everything runs or rests together, measured every 20 minutes at F1 to F4.
  void firstDay() {
    run(1200.0, 0.0, false);
    while (step_s * static_cast<double>(time_.size()) < 28800.0) {
      const bool on = random_.uniform() < 0.5;
      run(step_s * static_cast<double>(time_.size()) + 60.0 * std::floor(random_.uniform(20.0, 60.0)),
          on ? 3000.0 : 0.0, on);
    }
    for (int state = 0; state < 24; ++state) {
      for (std::size_t p = 0; p < 4; ++p) {
        measure(1200.0 * state, machine_.points[p].id, machine_.points[p].position_mm, "M" + std::to_string(state));
      }
    }
  }

  [[nodiscard]] DiscrepancyInput input() {
    DiscrepancyInput in;
    in.machine = machine_;
    OperatingLog log(time_);
    log.setSignal("spindle_rpm", rpm_);
    log.setSignal("coolant", coolant_);
    std::vector<double> room;
    for (const double r : room_) room.push_back(20.0 + r);
    log.setSignal("T_room_degC", room);
    log.setSignal("instrument_on", std::vector<double>(time_.size(), 1.0));
    in.log = log;
    in.observations.rows = rows_;
    in.predicted.assign(rows_.size(), 0.0);
    return in;
  }

  /// The morning after: what is suggested, or the first day again at the times and points of it.
  void secondDay(const MeasurementSuggestion& plan, bool run_first_day_again) {
    const std::vector<double> rpm = rpm_;
    const std::vector<double> coolant = coolant_;
    run(day_s, 0.0, false);
    if (run_first_day_again) {
      for (std::size_t i = 0; i < rpm.size(); ++i) {
        run(day_s + step_s * static_cast<double>(i + 1), rpm[i], coolant[i] > 0.0);
      }
    } else {
      for (const ProgrammeStep& s : plan.programme) run(day_s + s.to_s, s.spindle_rpm, s.coolant);
    }
    run(day_s + 30000.0, 0.0, false);
    int state = 100;
    for (const double t : plan.times_s) {
      for (const std::string& name : plan.points) {
        Eigen::Vector3d place;
        if (const MachinePoint* point = machine_.findPoint(name)) {
          place = point->position_mm;
        } else {
          ASSERT_EQ(std::sscanf(name.c_str(), "(%lf, %lf, %lf)", &place.x(), &place.y(), &place.z()), 3) << name;
        }
        measure(day_s + t, name, place, "M" + std::to_string(state));
      }
      ++state;
    }
  }

  [[nodiscard]] const MachineDescription& description() const { return machine_; }

 private:
  MachineDescription machine_;
  Cause cause_;
  Random random_;
  double phase_ = 0.0;
  double room_seed_ = 0.0;
  std::vector<double> time_, rpm_, coolant_, room_, drift_, scale_;
  double body_ = 0.0;
  double rail_ = 0.0;
  std::vector<Observation> rows_;
};

DiscrepancyResult search(Shop& shop, const DiscrepancyOptions& options = {}) {
  JobContext job;
  return findDiscrepancy(shop.input(), options, job);
}

bool namesAlone(const DiscrepancyResult& result, const std::string& id) {
  return result.effects.size() == 1 && result.effects[0].id == id && result.effects[0].rivals.empty();
}

TEST(Suggestion, RunsAloneWhatRanTogether) {
  int ambiguous = 0;
  int by_plan = 0;
  int by_repeating = 0;
  std::string clear;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Shop shop(Cause::SpindleDrift, seed);
    shop.firstDay();
    const DiscrepancyResult first = search(shop);
    if (first.verdict != DiscrepancyVerdict::Ambiguous) {
      clear += first.summary();
      continue;
    }
    ++ambiguous;
    ASSERT_TRUE(first.suggestion) << "seed " << seed;
    const MeasurementSuggestion& plan = *first.suggestion;
    // Spindle and coolant are told apart only where one runs without the other.
    EXPECT_TRUE(std::any_of(plan.programme.begin(), plan.programme.end(), [](const ProgrammeStep& s) {
      return !s.as_logged && (s.spindle_rpm > 0.0) != s.coolant;
    })) << plan.conditions;
    EXPECT_GT(plan.probability_alone_expected, 0.8) << plan.conditions;
    EXPECT_GT(plan.probability_alone_expected, plan.probability_alone_now);
    EXPECT_GT(plan.expected_delta_bic, 10.0);
    Shop planned = shop;
    planned.secondDay(plan, false);
    by_plan += namesAlone(search(planned), "spindle.drift.x") ? 1 : 0;
    Shop repeated = shop;
    repeated.secondDay(plan, true);
    by_repeating += namesAlone(search(repeated), "spindle.drift.x") ? 1 : 0;
  }
  EXPECT_GE(ambiguous, 4) << clear;
  EXPECT_EQ(by_plan, ambiguous);
  EXPECT_LE(by_repeating, ambiguous - 3);
}

TEST(Suggestion, GoesWhereRivalsOfOneDriverDiffer) {
  int ambiguous = 0;
  int by_plan = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Shop shop(Cause::Scale, seed);
    shop.firstDay();
    const DiscrepancyResult first = search(shop);
    // All points measured stand at one x: a drift of the room and a scale that grows look alike there.
    if (first.verdict != DiscrepancyVerdict::Ambiguous) continue;
    ++ambiguous;
    ASSERT_TRUE(first.suggestion) << "seed " << seed;
    const MeasurementSuggestion& plan = *first.suggestion;
    EXPECT_TRUE(std::any_of(plan.points.begin(), plan.points.end(), [&](const std::string& name) {
      const MachinePoint* point = shop.description().findPoint(name);
      return point == nullptr || point->id == "F5";
    })) << plan.conditions;
    Shop planned = shop;
    planned.secondDay(plan, false);
    by_plan += namesAlone(search(planned), "scale.expansion.x") ? 1 : 0;
  }
  EXPECT_GE(ambiguous, 3);
  EXPECT_GE(by_plan, ambiguous - 1);
}

TEST(Suggestion, StaysWithinWhatTheUserAllows) {
  Shop shop(Cause::SpindleDrift, 1);
  shop.firstDay();
  DiscrepancyOptions options;
  options.suggest_hours = 3.0;
  options.suggest_points = 2;
  options.suggest_times = 7;
  const DiscrepancyResult result = search(shop, options);
  ASSERT_TRUE(result.suggestion);
  const MeasurementSuggestion& plan = *result.suggestion;
  EXPECT_LE(plan.points.size(), 2u);
  EXPECT_LE(plan.times_s.size(), 7u);
  EXPECT_EQ(plan.times_s.front(), 0.0);
  EXPECT_LE(plan.times_s.back(), 3.0 * 3600.0);
  EXPECT_EQ(plan.programme.front().from_s, 0.0);
  EXPECT_LE(plan.programme.back().to_s, 3.0 * 3600.0);
  for (std::size_t i = 1; i < plan.programme.size(); ++i) {
    EXPECT_EQ(plan.programme[i].from_s, plan.programme[i - 1].to_s);
  }
  // The same question has the same answer.
  EXPECT_EQ(*search(shop, options).suggestion, plan);
  const nlohmann::json json = result.json()["suggestion"];
  for (const char* key : {"points", "times_s", "conditions", "separates", "expected_delta_bic", "programme",
                          "expected_information_nats", "probability_alone_expected"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  options.suggest_hours = 0.0;
  EXPECT_THROW((void)search(shop, options), InputError);
  options.suggest_hours = 3.0;
  options.suggest_points = 0;
  EXPECT_THROW((void)search(shop, options), InputError);
  options.suggest_points = 2;
  options.suggest_times = 2;
  EXPECT_THROW((void)search(shop, options), InputError);
}

/// Two candidates without free parameters at two places and five times; `difference` of the second from the first.
MeasurementDesign twoCandidates(const Eigen::MatrixXd& difference, DesignNoise noise) {
  std::vector<Eigen::MatrixXd> places;
  for (Eigen::Index p = 0; p < 2; ++p) {
    Eigen::MatrixXd at = Eigen::MatrixXd::Zero(5, 2);
    at.col(1) = difference.col(p);
    places.push_back(at);
  }
  return MeasurementDesign({{0, 0.5, 0, 0}, {1, 0.5, 1, 0}}, {0.0, 600.0, 1200.0, 1800.0, 2400.0}, {std::move(noise)},
                           {places});
}

TEST(MeasurementDesign, KnowsWhatNormalReadingsTell) {
  Eigen::MatrixXd ramp(5, 2);
  ramp.col(0) << -2.0, -1.0, 0.0, 1.0, 2.0;
  ramp.col(1).setZero();
  DesignNoise noise;
  noise.own = 2.0;
  const MeasurementDesign design = twoCandidates(ramp, noise);
  EXPECT_NEAR(design.entropy(), std::log(2.0), 1e-12);
  const Eigen::MatrixXd gram = design.gram({0}, {0, 1, 2, 3, 4});
  const double power = 10.0 / 4.0;
  EXPECT_NEAR(gram(1, 1), power, 1e-9);
  EXPECT_NEAR(design.expectedEvidence(gram, 0, 1), power, 1e-9);
  EXPECT_NEAR(design.remainingEntropy(gram), std::log1p(std::exp(-power / 8.0)), 1e-9);
  // The log odds are normal with mean power / 2 and variance power: alone beyond ln 10.
  const double z = (std::log(10.0) - 0.5 * power) / std::sqrt(power);
  EXPECT_NEAR(design.probabilityAlone(gram, 0.1, 20000, 3), 0.5 * std::erfc(z / std::sqrt(2.0)), 0.015);
  // A constant tells nothing, nor does a place where nothing moves, nor a single time.
  EXPECT_NEAR(twoCandidates(Eigen::MatrixXd::Ones(5, 2), noise).gram({0, 1}, {0, 2, 4})(1, 1), 0.0, 1e-9);
  EXPECT_NEAR(design.gram({1}, {0, 1, 2, 3, 4})(1, 1), 0.0, 1e-12);
  EXPECT_NEAR(design.gram({0}, {4})(1, 1), 0.0, 1e-12);
}

TEST(MeasurementDesign, SeesThroughShiftsOnlyBetweenPoints) {
  Eigen::MatrixXd alike(5, 2);
  alike.col(0) << -2.0, -1.0, 0.0, 1.0, 2.0;
  alike.col(1) = alike.col(0);
  Eigen::MatrixXd opposed = alike;
  opposed.col(1) = -opposed.col(1);
  DesignNoise noise;
  noise.common = 100.0;
  const std::vector<std::size_t> all{0, 1, 2, 3, 4};
  EXPECT_NEAR(twoCandidates(alike, noise).gram({0, 1}, all)(1, 1), 0.0, 1e-2);
  EXPECT_NEAR(twoCandidates(opposed, noise).gram({0, 1}, all)(1, 1), 20.0, 1e-6);
}

}  // namespace
}  // namespace spindrift
