// SPDX-License-Identifier: GPL-3.0-or-later
// The compensator through its C interface with random models, limits, cycles and inputs, good ones and all that a
// controller may hand over by mistake: not finite, far outside, stale, a clock that runs backwards, arrays of another
// length, measured offsets of 1e9, resets at any time. In every step: outputs are numbers within limit and slew, what
// is refused is said, a bad input leads into the fall-back in time and out of it again, the fall-back fades to zero.
// `compensator_soak [STEPS [SEED]]`, default 1e6 steps from seed 1; 0 if all held. Also run with 1e8 steps under the
// address and undefined-behaviour sanitizers (preset sanitizers).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/thermal/compensator_c.h"
#include "core/thermal/thermal_model.h"
#include "tests/support/temp_folder.h"

namespace {

using spindrift::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

spindrift::ThermalModel randomModel(Random& random) {
  using spindrift::SignalKind;
  spindrift::ThermalModel model;
  const auto signals = 1 + random.index(12);
  for (std::uint64_t s = 0; s < signals; ++s) {
    const SignalKind kinds[] = {SignalKind::Temperature, SignalKind::Temperature, SignalKind::Speed, SignalKind::Feed,
                                SignalKind::Switch};
    const SignalKind kind = kinds[random.index(5)];
    const bool driven = kind == SignalKind::Speed || kind == SignalKind::Feed;
    const double low = kind == SignalKind::Temperature ? random.uniform(-20.0, 30.0) : 0.0;
    const double range = kind == SignalKind::Switch ? 1.0 : std::pow(10.0, random.uniform(-3.0, 4.0));
    for (std::uint64_t p = 0; p < (driven ? 1 + random.index(3) : 1); ++p) {
      const double powers[] = {1.0, 1.5, 2.0, 1.3};
      model.inputs.push_back({"input " + std::to_string(s), kind, driven ? powers[random.index(4)] : 1.0,
                              driven ? std::max(1.0, range) : 1.0, low, low, low + range});
    }
  }
  const bool enormous = random.index(10) == 0;  // sums beyond the largest number: the value is none
  const auto outputs = 1 + random.index(8);
  for (std::uint64_t o = 0; o < outputs; ++o) {
    spindrift::ThermalOutput output;
    output.name = "output " + std::to_string(o);
    output.unit = random.index(2) == 0 ? "um" : "urad";
    output.offset = random.normal(0.0, 20.0);
    const auto terms = 1 + random.index(random.index(8) == 0 ? 120 : 12);
    for (std::uint64_t t = 0; t < terms; ++t) {
      const double tau_s = random.index(4) == 0 ? 0.0 : std::pow(10.0, random.uniform(-4.0, 6.0));
      double gain = random.normal(0.0, 5.0);
      if (enormous && random.index(3) == 0) gain *= 1e306;
      output.terms.push_back({static_cast<int>(random.index(model.inputs.size())), tau_s, gain});
    }
    if (random.index(6) == 0) output.verdict = spindrift::ThermalVerdict{false, 0.0, 1.0, 2.0, "made so"};
    model.outputs.push_back(std::move(output));
  }
  return model;
}

spindrift_compensator_options randomOptions(Random& random, double& cycle_s) {
  cycle_s = std::pow(10.0, random.uniform(-3.0, 1.5));
  spindrift_compensator_options options{};
  options.struct_size = sizeof options;
  options.cycle_s = cycle_s;
  options.limit = std::pow(10.0, random.uniform(-1.0, 3.0));
  options.slew_per_s = std::pow(10.0, random.uniform(-2.0, 2.0));
  options.stale_after_s = cycle_s * random.uniform(0.1, 60.0);
  options.recover_after_s = cycle_s * random.uniform(0.1, 60.0);
  options.range_margin = random.uniform(0.05, 1.0);
  options.minimum_margin = random.uniform(0.1, 30.0);
  options.update_limit = random.uniform(1.0, 200.0);
  options.force = 1;
  return options;
}

/// One model until its steps are done. Says what did not hold and returns false.
class Soak {
 public:
  Soak(const spindrift::ThermalModel& model, const spindrift_compensator_options& options,
       spindrift_compensator* compensator, Random& random)
      : options_(options), compensator_(compensator), random_(random) {
    for (const spindrift::ThermalOutput& output : model.outputs) forced_ = forced_ || output.verdict;
    const int count = spindrift_compensator_inputs(compensator);
    for (int i = 0; i < count; ++i) {
      const std::string name = spindrift_compensator_input_name(compensator, i);
      const auto input = std::find_if(model.inputs.begin(), model.inputs.end(),
                                      [&](const spindrift::ThermalInput& in) { return in.name == name; });
      const double range = input->train_max - input->train_min;
      const double least = input->kind == spindrift::SignalKind::Temperature ? options.minimum_margin : 0.0;
      const double margin = std::max(options.range_margin * range, least);
      low_.push_back(input->train_min - margin);
      high_.push_back(input->train_max + margin);
      size_only_.push_back(spindrift::isDriven(input->kind) ? 1 : 0);
    }
    inputs_ = middle();
    ages_.assign(low_.size(), 0.0);
    bad_for_s_.assign(low_.size(), 0.0);
    last_.assign(static_cast<std::size_t>(spindrift_compensator_outputs(compensator)), 0.0);
    outputs_ = last_;
    sums_ = last_;
  }

  bool step() {
    if (--calm_ < 0) disturb();
    for (std::size_t i = 0; i < inputs_.size(); ++i)
      if (good(i))
        inputs_[i] = std::clamp(inputs_[i] + random_.normal(0.0, 1e-3) * (high_[i] - low_[i]), low_[i], high_[i]);
    const bool with_ages = std::any_of(ages_.begin(), ages_.end(), [](double age) { return age != 0.0; });
    const int state = spindrift_compensator_step_sized(compensator_, inputs_.data(), inputs_.size(),
                                                       with_ages ? ages_.data() : nullptr, with_ages ? ages_.size() : 0,
                                                       outputs_.data(), outputs_.size());
    spindrift_compensator_status status{};
    status.struct_size = sizeof status;
    if (spindrift_compensator_get_status(compensator_, &status) != 0) return fail("no status");
    if (status.state != state) return fail("the status tells another state");
    if ((status.forced != 0) != forced_) return fail("the status does not say that the model was forced");

    int first_bad = -1;
    bool long_bad = false;
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      bad_for_s_[i] = good(i) ? 0.0 : bad_for_s_[i] + options_.cycle_s;
      if (bad_for_s_[i] > 0.0 && first_bad < 0) first_bad = static_cast<int>(i);
      long_bad = long_bad || bad_for_s_[i] > options_.stale_after_s + 1.5 * options_.cycle_s;
    }
    good_for_s_ = first_bad < 0 ? good_for_s_ + options_.cycle_s : 0.0;
    if (status.refused_input != first_bad) return fail("the refused input is not the first bad one");
    if (first_bad >= 0 && state == SPINDRIFT_COMPENSATOR_RUNNING) return fail("runs with a bad input");
    if (long_bad && state != SPINDRIFT_COMPENSATOR_FALLBACK) return fail("no fall-back with an input bad for too long");
    if (good_for_s_ > options_.recover_after_s + 2.5 * options_.cycle_s && status.value_not_finite == 0 &&
        state != SPINDRIFT_COMPENSATOR_RUNNING)
      return fail("does not come back with good inputs");

    const double change = options_.slew_per_s * options_.cycle_s;
    for (std::size_t o = 0; o < outputs_.size(); ++o) {
      if (!std::isfinite(outputs_[o])) return fail("an output is no number");
      if (std::abs(outputs_[o]) > options_.limit) return fail("an output is beyond its limit");
      if (std::abs(outputs_[o] - last_[o]) > change * (1.0 + 1e-9) + 1e-12) return fail("an output jumps");
      const bool fading = state == SPINDRIFT_COMPENSATOR_FALLBACK;
      if (fading && std::abs(outputs_[o]) > std::max(0.0, std::abs(last_[o]) - change) + 1e-9 * options_.limit)
        return fail("the fall-back does not fade to zero");
    }
    last_ = outputs_;
    return true;
  }

 private:
  [[nodiscard]] std::vector<double> middle() const {
    std::vector<double> out;
    for (std::size_t i = 0; i < low_.size(); ++i) out.push_back(0.5 * (low_[i] + high_[i]));
    return out;
  }
  [[nodiscard]] bool good(std::size_t i) const {
    const double acting = size_only_[i] != 0 ? std::abs(inputs_[i]) : inputs_[i];
    return acting >= low_[i] && acting <= high_[i] && ages_[i] >= 0.0 && ages_[i] <= options_.stale_after_s;
  }

  /// What happens next, and for how many steps.
  void disturb() {
    const std::size_t at = random_.index(inputs_.size());
    calm_ = static_cast<int>(random_.index(200));
    switch (random_.index(10)) {
      case 0: {
        const double wild[] = {nothing, infinity, -infinity,       1e308,         -1e308,
                               1e9,     -300.0,   high_[at] + 1.0, low_[at] - 1.0};
        inputs_[at] = wild[random_.index(9)];
        break;
      }
      case 1: {
        const double wild[] = {nothing, infinity, -1.0, 1e9, 2.0 * options_.stale_after_s, -infinity};
        ages_[at] = wild[random_.index(6)];
        break;
      }
      case 2:
        inputs_[at] = random_.index(2) == 0 ? low_[at] : high_[at];
        break;
      case 3:
        update();
        break;
      case 4:
        misuse();
        break;
      case 5:
        if (random_.index(8) != 0) break;
        spindrift_compensator_reset(compensator_);
        // The outputs go on from where they are.
        std::fill(bad_for_s_.begin(), bad_for_s_.end(), 0.0);
        break;
      default:
        inputs_ = middle();
        std::fill(ages_.begin(), ages_.end(), 0.0);
        calm_ = static_cast<int>(random_.index(400));
    }
  }

  void update() {
    const double factors[] = {1.0, 1.1, 0.9, 0.0, -1.0, 1e9, nothing, infinity};
    const double offsets[] = {0.0, 1e9, -1e9, nothing, infinity, random_.normal(0.0, options_.update_limit)};
    const auto output = static_cast<int>(random_.index(outputs_.size()));
    const double factor = factors[random_.index(8)];
    const double offset = offsets[random_.index(6)];
    double& sum = sums_[static_cast<std::size_t>(output)];
    const bool possible =
        factor >= 0.2 && factor <= 5.0 && std::abs(sum + offset) <= std::min(options_.update_limit, options_.limit);
    const bool taken = spindrift_compensator_update(compensator_, output, factor, offset) == 1;
    if (taken) sum += offset;
    spindrift_compensator_status status{};
    status.struct_size = sizeof status;
    (void)spindrift_compensator_get_status(compensator_, &status);
    if (taken != possible) (void)fail("a measured update is taken or refused wrongly");
    if (!taken && status.refused_update != output) (void)fail("the status does not name the refused update");
  }

  void misuse() {
    std::vector<double> untouched(outputs_.size() + 1, 42.0);
    const int state = spindrift_compensator_step_sized(compensator_, inputs_.data(), inputs_.size(), nullptr, 0,
                                                       untouched.data(), untouched.size());
    if (state != -1 || untouched.front() != 42.0) (void)fail("a wrong length is not refused");
    if (spindrift_compensator_update(compensator_, 99, 1.0, 0.0) != 0) (void)fail("an output that is none is updated");
    char name[5];
    if (spindrift_compensator_copy_input_name(compensator_, 0, name, sizeof name) < 8 || name[4] != '\0')
      (void)fail("a name is not cut at the end of its buffer");
  }

  bool fail(const char* what) {
    if (!failed_) std::fprintf(stderr, "compensator_soak: %s\n", what);
    failed_ = true;
    return false;
  }

  const spindrift_compensator_options& options_;
  spindrift_compensator* compensator_;
  Random& random_;
  std::vector<double> low_, high_, inputs_, ages_, bad_for_s_, last_, outputs_, sums_;
  std::vector<char> size_only_;  // speeds and feeds
  double good_for_s_ = 0.0;
  int calm_ = 0;
  bool forced_ = false;
  bool failed_ = false;

 public:
  [[nodiscard]] bool failed() const { return failed_; }
};

}  // namespace

int main(int count, char** arguments) {
  const long steps = count > 1 ? static_cast<long>(std::stod(arguments[1])) : 1'000'000L;
  std::uint64_t seed = count > 2 ? std::stoull(arguments[2]) : 1;
  const spindrift::testing::TempFolder folder;
  const std::string file = (folder.path() / "model.json").string();
  long models = 0;
  for (long done = 0; done < steps; ++seed, ++models) {
    Random random(seed);
    const spindrift::ThermalModel model = randomModel(random);
    model.write(file);
    double cycle_s = 0.0;
    const spindrift_compensator_options options = randomOptions(random, cycle_s);
    char message[400];
    spindrift_compensator* compensator =
        spindrift_compensator_load_with(file.c_str(), &options, message, sizeof message);
    if (compensator == nullptr) {
      std::fprintf(stderr, "compensator_soak: seed %llu: %s\n", static_cast<unsigned long long>(seed), message);
      return 1;
    }
    Soak soak(model, options, compensator, random);
    for (long k = 0; k < 20'000 && done < steps; ++k, ++done) {
      if (soak.step() && !soak.failed()) continue;
      std::fprintf(stderr, "compensator_soak: seed %llu, step %ld of its model\n",
                   static_cast<unsigned long long>(seed), k);
      spindrift_compensator_free(compensator);
      return 1;
    }
    spindrift_compensator_free(compensator);
  }
  std::printf(
      "%ld steps of %ld random models: outputs finite, within limit and slew; refusals, fall-back and recovery "
      "as stated\n",
      steps, models);
  return 0;
}
