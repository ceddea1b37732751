// SPDX-License-Identifier: Apache-2.0
#include "core/probing/cycle_evaluation.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "core/base/count_text.h"
#include "core/base/printed_number.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/math/statistics.h"
#include "core/probing/artefact_place.h"
#include "core/probing/cycle_drift.h"
#include "core/probing/surface_rejection.h"

namespace spindrift {

double CycleEvaluation::covariance(int cycle, int a, int b) const {
  return fit.cycles[static_cast<std::size_t>(cycle)].covariance(a, b) * unit[static_cast<std::size_t>(a)] *
         unit[static_cast<std::size_t>(b)];
}

void CycleEvaluation::contradict(std::string sentence) {
  warnings.push_back(std::move(sentence));
  good_enough = false;
}

int CycleEvaluation::indexOf(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  SPINDRIFT_ASSERT(found != names.end(), "unknown parameter of a cycle");
  return static_cast<int>(found - names.begin());
}

namespace {

using GroupKey = std::tuple<std::string, std::string, double>;  // feature, stylus, c_deg

/// The touches of one feature with one stylus at one table angle in one cycle.
struct Group {
  int cycle = 0;
  int setting = 0;                   // index of the GroupKey
  std::vector<std::size_t> touches;  // indices into the list
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  bool centred = false;
};

class Assembler {
 public:
  Assembler(const TouchList& list, const MachineDescription& machine, const Artefact& artefact,
            const CycleAssembly& assembly, CycleEvaluation& result)
      : list_(list), machine_(machine), artefact_(artefact), assembly_(assembly), result_(result) {}

  void run() {
    group();
    guessRadii();
    rejectMisplaced();
    if (assembly_.kind == FeatureKind::Hole) {
      for (RejectedTouch& r :
           contradictedSurfaces(list_, artefact_.id, assembly_.centre_mm, assembly_.axis, result_.rejected)) {
        result_.rejected.push_back(std::move(r));
      }
    }
    findRadii();
    std::vector<bool> excluded(list_.touches.size(), false);
    for (const RejectedTouch& r : result_.rejected) excluded[r.touch] = true;
    requireTouches(excluded);
    leaveOutMovedCycles(excluded);
    constexpr int most_passes = 4;
    for (int pass = 0; pass < most_passes; ++pass) {
      centre(excluded);
      build(excluded);
      result_.fit = fitDriftingCycles(result_.problem, rowTimes(), assembly_.fit);
      bool changed = false;
      // A bad touch spoils the centre about which the others of its feature were linearised, and these look bad as
      // well: the worst of each leaves, and the others are judged once more without it.
      const std::vector<bool> worst = worstOfGroups();
      std::vector<bool> next = excluded;
      for (std::size_t r = 0; r < result_.row_touch.size(); ++r) {
        if (result_.fit.used[r] || (pass + 1 < most_passes && !worst[r])) continue;
        const double error_um = result_.fit.residual_mm[r] * um_per_mm;
        result_.rejected.push_back(
            {result_.row_touch[r],
             fmt::format("it deviates by {:.1f} µm from all other touches ({:.0f} times the touch noise); excluded",
                         error_um, std::abs(result_.fit.studentised[r])),
             error_um});
        next[result_.row_touch[r]] = true;
        changed = true;
      }
      if (!changed) break;
      excluded = next;
    }
    finish(excluded);
  }

 private:
  /// The rows of the fit that deviate by most among those left out of their feature in their cycle.
  [[nodiscard]] std::vector<bool> worstOfGroups() const {
    std::vector<std::size_t> group_of(list_.touches.size(), groups_.size());
    for (std::size_t g = 0; g < groups_.size(); ++g)
      for (const std::size_t i : groups_[g].touches) group_of[i] = g;
    constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> worst_of(groups_.size() + 1, none);
    for (std::size_t r = 0; r < result_.row_touch.size(); ++r) {
      if (result_.fit.used[r]) continue;
      std::size_t& worst = worst_of[group_of[result_.row_touch[r]]];
      if (worst == none || std::abs(result_.fit.studentised[r]) > std::abs(result_.fit.studentised[worst])) worst = r;
    }
    std::vector<bool> out(result_.row_touch.size(), false);
    for (const std::size_t r : worst_of)
      if (r != none) out[r] = true;
    return out;
  }

  /// Throws InputError where no touch is left.
  void requireTouches(const std::vector<bool>& excluded) const {
    std::size_t count = 0;
    for (const Group& g : groups_) {
      count += g.touches.size();
      for (const std::size_t i : g.touches) {
        if (!excluded[i]) return;
      }
    }
    if (result_.rejected.empty()) return;
    const RejectedTouch& first = result_.rejected.front();
    throw InputError(
        SourcePlace::atLine(list_.file, list_.touches[first.touch].line),
        fmt::format("none of the {} touches of {} lies where the machine file has its features, this one for instance: "
                    "{}; allowed: x_mm, y_mm and z_mm in the machine's coordinates (two columns swapped, a wrong sign, "
                    "or another place, direction or order of the features?).",
                    count, artefact_.id, first.reason.substr(0, first.reason.find("; left out"))));
  }

  [[nodiscard]] std::vector<double> rowTimes() const {
    std::vector<double> time_s;
    for (const std::size_t i : result_.row_touch) time_s.push_back(list_.touches[i].time_s);
    return time_s;
  }

  /// A cycle in the middle of which artefact or probe was knocked measures two places: it is left out. The first cycle
  /// is what all others are compared with; of it this is only said.
  void leaveOutMovedCycles(std::vector<bool>& excluded) {
    constexpr int most = 3;  // more is no knock
    for (int k = 0; k < most; ++k) {
      centre(excluded);
      build(excluded);
      // A probe stays moved in the machine, an artefact on its table turns with it.
      Eigen::MatrixX3d in_machine(std::ssize(result_.row_normal), 3);
      Eigen::MatrixX3d on_table(in_machine.rows(), 3);
      bool turned = false;
      for (Eigen::Index r = 0; r < in_machine.rows(); ++r) {
        const Eigen::Vector3d& normal = result_.row_normal[static_cast<std::size_t>(r)];
        const double c_deg = list_.touches[result_.row_touch[static_cast<std::size_t>(r)]].c_deg;
        in_machine.row(r) = normal;
        on_table.row(r) = Eigen::AngleAxisd(-c_deg * rad_per_deg, assembly_.axis) * normal;
        turned = turned || c_deg != 0.0;
      }
      std::vector<Eigen::MatrixX3d> frames{in_machine};
      if (turned) frames.push_back(on_table);
      const auto step = findStepInside(result_.problem, rowTimes(), frames, assembly_.fit);
      if (!step) return;
      const std::string& cycle = result_.cycles[static_cast<std::size_t>(step->cycle)];
      const bool reference = step->cycle == result_.problem.reference_cycle;
      const Eigen::Vector3d um = step->step_mm * um_per_mm;
      const std::string size = withUncertainty(um.norm(), step->sigma_mm * um_per_mm, "um");
      result_.contradict(
          reference ? fmt::format(
                          "In the middle of {}, between {:.0f} s and {:.0f} s, {} or the probe moved at once by {} (X "
                          "{:.1f}, Y {:.1f}, Z {:.1f} µm), which heat does not do. All cycles are compared with this "
                          "one: measure it again.",
                          cycle, step->after_s, step->before_s, artefact_.id, size, um.x(), um.y(), um.z())
                    : fmt::format(
                          "In the middle of {}, between {:.0f} s and {:.0f} s, {} or the probe moved at once by {} (X "
                          "{:.1f}, Y {:.1f}, Z {:.1f} µm), which heat does not do. The cycle is left out, and all "
                          "later ones hold that step: measure a new first cycle.",
                          cycle, step->after_s, step->before_s, artefact_.id, size, um.x(), um.y(), um.z()));
      if (reference) return;
      for (const Group& g : groups_) {
        if (g.cycle != step->cycle) continue;
        for (const std::size_t i : g.touches) {
          if (excluded[i]) continue;
          excluded[i] = true;
          result_.rejected.push_back({i, fmt::format("artefact or probe moved in the middle of {}", cycle)});
        }
      }
    }
  }

  void group() {
    std::unordered_map<std::string, int> cycle_index;
    std::map<std::pair<int, int>, std::size_t> group_of;
    std::map<GroupKey, int> setting_of;
    for (std::size_t i = 0; i < list_.touches.size(); ++i) {
      const Touch& t = list_.touches[i];
      if (t.artefact != artefact_.id) continue;
      const auto [cycle, fresh_cycle] = cycle_index.try_emplace(t.cycle, static_cast<int>(result_.cycles.size()));
      if (fresh_cycle) result_.cycles.push_back(t.cycle);
      const auto [setting, fresh_setting] =
          setting_of.try_emplace(GroupKey{t.feature, t.stylus, t.c_deg}, static_cast<int>(settings_.size()));
      if (fresh_setting) settings_.push_back({t.feature, t.stylus, t.c_deg});
      const auto [group, fresh_group] = group_of.try_emplace({cycle->second, setting->second}, groups_.size());
      if (fresh_group) {
        groups_.emplace_back();
        groups_.back().cycle = cycle->second;
        groups_.back().setting = setting->second;
      }
      groups_[group->second].touches.push_back(i);
    }
    std::vector<int> count(result_.cycles.size(), 0);
    result_.cycle_time_s.assign(result_.cycles.size(), 0.0);
    for (const Group& g : groups_) {
      for (const std::size_t i : g.touches) {
        result_.cycle_time_s[static_cast<std::size_t>(g.cycle)] += list_.touches[i].time_s;
        ++count[static_cast<std::size_t>(g.cycle)];
      }
    }
    for (std::size_t k = 0; k < count.size(); ++k) result_.cycle_time_s[k] /= count[k];
    tellThoseWithoutPartner(count);
  }

  /// Touches whose feature, stylus and table angle no other cycle has: they say nothing of a change.
  void tellThoseWithoutPartner(const std::vector<int>& touches_of_cycle) {
    if (touches_of_cycle.size() < 2) return;
    std::vector<int> cycles_of(settings_.size(), 0);
    for (const Group& g : groups_) ++cycles_of[static_cast<std::size_t>(g.setting)];
    std::map<std::pair<int, double>, std::size_t> alone;  // of cycle and angle
    for (const Group& g : groups_) {
      if (cycles_of[static_cast<std::size_t>(g.setting)] > 1) continue;
      alone[{g.cycle, std::get<2>(settings_[static_cast<std::size_t>(g.setting)])}] += g.touches.size();
    }
    for (const auto& [of, touches] : alone) {
      const auto& [cycle, c_deg] = of;
      std::string sentence = fmt::format(
          "No other cycle has the places of {} of {} at a table angle of {:g}°: they are compared with "
          "nothing.",
          countOf(touches, "touch", "touches"), result_.cycles[static_cast<std::size_t>(cycle)], c_deg);
      // What a control reads back, or counts from the other side.
      std::optional<double> meant;
      constexpr double read_back_deg = 0.1;
      for (const auto& [feature, stylus, other_deg] : settings_)
        if (other_deg != c_deg && std::abs(std::remainder(other_deg - c_deg, 360.0)) < read_back_deg) meant = other_deg;
      if (meant)
        sentence +=
            fmt::format(" Touches of one place have one c_deg in all cycles, here {:g}° and {:g}°.", c_deg, *meant);
      result_.warnings.push_back(std::move(sentence));
    }
  }

  [[nodiscard]] double radiusOf(int setting) const {
    const auto& [feature, stylus, c_deg] = settings_[static_cast<std::size_t>(setting)];
    const std::optional<double> stated = assembly_.radius(feature, stylus);
    if (stated || guessed_radius_.empty()) return stated.value_or(0.0);
    return guessed_radius_[static_cast<std::size_t>(setting)];
  }

  /// Where the machine file states no diameter: how far the touches lie from the nominal place along their approach.
  void guessRadii() {
    if (!assembly_.nominal) return;
    const double side = assembly_.kind == FeatureKind::Sphere ? -1.0 : 1.0;
    std::vector<std::vector<double>> along(settings_.size());
    for (const Group& g : groups_) {
      const auto& [feature, stylus, c_deg] = settings_[static_cast<std::size_t>(g.setting)];
      const auto nominal = assembly_.nominal(feature, c_deg);
      if (!nominal || assembly_.radius(feature, stylus)) continue;
      for (const std::size_t i : g.touches) {
        const Touch& t = list_.touches[i];
        if (assembly_.kind == FeatureKind::Hole && isSurfaceTouch(t, assembly_.axis)) continue;
        along[static_cast<std::size_t>(g.setting)].push_back(side * (t.position_mm - *nominal).dot(t.approach));
      }
    }
    std::vector<double> guessed(settings_.size(), 0.0);
    bool any = false;
    for (std::size_t s = 0; s < along.size(); ++s) {
      if (along[s].empty()) continue;
      guessed[s] = std::max(0.0, median(std::move(along[s])));
      any = true;
    }
    if (any) guessed_radius_ = std::move(guessed);
  }

  /// Where the touch says that the centre of its feature is; components along the surface are meaningless but small.
  [[nodiscard]] Eigen::Vector3d impliedCentre(const Touch& t, int setting) const {
    const double side = assembly_.kind == FeatureKind::Sphere ? 1.0 : -1.0;
    if (assembly_.kind == FeatureKind::Hole && isSurfaceTouch(t, assembly_.axis)) return t.position_mm;
    return t.position_mm + side * radiusOf(setting) * t.approach;
  }

  /// Where a feature is expected: its nominal place, and the artefact as it stands beside its own.
  [[nodiscard]] std::optional<Eigen::Vector3d> expected(const std::string& feature, double c_deg) const {
    auto at = assembly_.nominal ? assembly_.nominal(feature, c_deg) : std::nullopt;
    if (at) *at += place_.offset_mm(*at, c_deg);
    return at;
  }

  /// How the artefact was clamped, of all cycles together: no wrong feature.
  void findPlace() {
    if (!assembly_.nominal) return;
    std::map<int, std::array<std::vector<double>, 3>> implied;  // by setting
    for (const Group& g : groups_) {
      for (const std::size_t i : g.touches) {
        if (assembly_.kind == FeatureKind::Hole && isSurfaceTouch(list_.touches[i], assembly_.axis)) continue;
        const Eigen::Vector3d at = impliedCentre(list_.touches[i], g.setting);
        for (std::size_t k = 0; k < 3; ++k) implied[g.setting][k].push_back(at(static_cast<Eigen::Index>(k)));
      }
    }
    std::vector<FoundFeature> found;
    std::set<double> angles;
    for (const auto& [setting, at] : implied) {
      const auto& [feature, stylus, c_deg] = settings_[static_cast<std::size_t>(setting)];
      const auto nominal = assembly_.nominal(feature, c_deg);
      if (!nominal) continue;
      found.push_back({c_deg, *nominal, {median(at[0]), median(at[1]), median(at[2])}});
      angles.insert(c_deg);
    }
    place_ = registerArtefact(found, assembly_.axis, assembly_.centre_mm);
    constexpr double telling_mm = 1.0;
    if (!(place_.largest_mm > telling_mm)) return;
    result_.warnings.push_back(
        angles.size() > 1
            ? fmt::format(
                  "{} stands up to {:.1f} mm beside where the machine file has it (clamped {:.1f} mm beside its "
                  "place and turned by {:.2f}°, centre of the rotary axis {:.1f} mm off): its features were "
                  "found there, but its place in the machine file enters the evaluation.",
                  artefact_.id, place_.largest_mm, place_.on_table_mm.norm(), printed(place_.turn_rad * deg_per_rad),
                  place_.centre_offset_mm.norm())
            : fmt::format("{} stands up to {:.1f} mm beside where the machine file has it (turned by {:.2f}°): its "
                          "features were found there, but its place in the machine file enters the evaluation.",
                          artefact_.id, place_.largest_mm, printed(place_.turn_rad * deg_per_rad)));
  }

  /// How far beside the holes most surface touches are made, mm; with one or two cycles there is no habit to go by.
  [[nodiscard]] double usualReach() const {
    std::vector<double> distances;
    for (const Group& g : groups_) {
      const auto& [feature, stylus, c_deg] = settings_[static_cast<std::size_t>(g.setting)];
      const auto nominal = expected(feature, c_deg);
      if (!nominal || assembly_.kind != FeatureKind::Hole) continue;
      for (const std::size_t i : g.touches) {
        if (!isSurfaceTouch(list_.touches[i], assembly_.axis)) continue;
        Eigen::Vector3d d = list_.touches[i].position_mm - *nominal;
        d -= assembly_.axis * assembly_.axis.dot(d);
        distances.push_back(d.norm());
      }
    }
    return distances.empty() ? 0.0 : std::min(median(distances), 30.0);
  }

  void rejectMisplaced() {
    const double inch = 25.4;
    // Median place of every touch over the cycles: what thermal errors cannot reach is another feature.
    struct Places {
      std::vector<double> x[3];
    };
    std::map<std::pair<int, int>, Places> places;
    for (const Group& g : groups_) {
      for (const std::size_t i : g.touches) {
        Places& p = places[{g.setting, list_.touches[i].touch}];
        for (int k = 0; k < 3; ++k) p.x[k].push_back(list_.touches[i].position_mm(k));
      }
    }
    std::map<std::pair<int, int>, Eigen::Vector3d> usual;
    for (auto& [key, p] : places) {
      // Of two cycles the first is what the other is compared with.
      if (p.x[0].size() < 2) continue;
      if (p.x[0].size() == 2) {
        usual[key] = Eigen::Vector3d(p.x[0].front(), p.x[1].front(), p.x[2].front());
      } else {
        usual[key] = Eigen::Vector3d(median(p.x[0]), median(p.x[1]), median(p.x[2]));
      }
    }
    findPlace();
    // Surface touches are made beside the hole; how far is the programmer's choice.
    double reach = 0.0;
    if (assembly_.nominal) {
      for (const auto& [key, p] : usual) {
        const auto& [feature, stylus, c_deg] = settings_[static_cast<std::size_t>(key.first)];
        const auto nominal = expected(feature, c_deg);
        if (nominal) {
          Eigen::Vector3d d = p - *nominal;
          d -= assembly_.axis * assembly_.axis.dot(d);
          reach = std::max(reach, std::min(d.norm(), 30.0));
        }
      }
    }
    reach = std::max(reach, usualReach());
    const double tolerance = std::max(assembly_.misplaced_mm, 0.05);
    std::map<int, std::vector<double>> away;  // by setting: how far its misplaced touches lie from it
    for (const Group& g : groups_) {
      const auto& [feature, stylus, c_deg] = settings_[static_cast<std::size_t>(g.setting)];
      for (const std::size_t i : g.touches) {
        const Touch& t = list_.touches[i];
        const auto habit = usual.find({g.setting, t.touch});
        std::string reason;
        if (habit != usual.end() && (t.position_mm - habit->second).norm() > tolerance) {
          if ((t.position_mm * inch - habit->second).norm() < 0.02 * habit->second.norm() + tolerance) {
            throw InputError(SourcePlace::atLine(list_.file, t.line),
                             fmt::format("{} lies where the other cycles have it divided by 25.4: inches; allowed: "
                                         "millimetres.",
                                         t.label()));
          }
          reason = fmt::format("it is {:.3f} mm away from where the same touch lies in the other cycles",
                               (t.position_mm - habit->second).norm());
        }
        const bool surface = assembly_.kind == FeatureKind::Hole && isSurfaceTouch(t, assembly_.axis);
        const auto nominal = expected(feature, c_deg);
        if (reason.empty() && nominal) {
          Eigen::Vector3d d = impliedCentre(t, g.setting) - *nominal;
          d -= assembly_.axis * assembly_.axis.dot(d);
          // Across the touched direction the aim may be off by the play in the hole.
          const double limit = surface ? std::max(reach, 2.0) + tolerance : tolerance + 0.5 * radiusOf(g.setting);
          if (d.norm() > limit) {
            reason = fmt::format("it is {:.3f} mm away from {}", d.norm(), feature);
            away[g.setting].push_back(d.norm());
          }
        }
        if (reason.empty()) continue;
        const std::string other = nearest(t, g.setting, c_deg, usual);
        if (!other.empty() && other != feature)
          reason += fmt::format("; it lies on {} (wrong or swapped feature?)", other);
        result_.rejected.push_back({i, reason + "; left out"});
      }
    }
    tellWhatNeverFits(away);
  }

  /// A feature, or a table angle, at which the touches of every cycle are misplaced: the machine file or the list is
  /// wrong of it. Where most do not fit, the list as a whole is (evaluate_touches.cpp).
  void tellWhatNeverFits(const std::map<int, std::vector<double>>& away) {
    std::vector<std::size_t> touches(settings_.size(), 0);
    for (const Group& g : groups_) touches[static_cast<std::size_t>(g.setting)] += g.touches.size();
    struct Whole {
      bool fits = false;
      std::vector<double> away_mm;
    };
    std::map<double, Whole> angles;
    std::map<std::string, Whole> features;
    std::size_t never = 0;
    for (std::size_t s = 0; s < settings_.size(); ++s) {
      const auto& [feature, stylus, c_deg] = settings_[s];
      const auto of = away.find(static_cast<int>(s));
      // Surface touches beside a hole may lie anywhere.
      const bool fits = of == away.end() || 4 * of->second.size() < 3 * touches[s];
      never += fits ? 0 : 1;
      for (Whole* whole : {&angles[c_deg], &features[feature]}) {
        whole->fits = whole->fits || fits;
        if (!fits) whole->away_mm.insert(whole->away_mm.end(), of->second.begin(), of->second.end());
      }
    }
    if (never == 0 || 2 * never > settings_.size()) return;
    for (const auto& [c_deg, whole] : angles) {
      if (whole.fits) continue;
      result_.contradict(fmt::format(
          "All touches of {} at {:g}° lie some {:.0f} mm from where the machine file has their features: has c_deg the "
          "right sign?",
          artefact_.id, c_deg, median(whole.away_mm)));
    }
    for (const auto& [feature, whole] : features) {
      if (whole.fits) continue;
      result_.contradict(fmt::format(
          "All touches of {} lie some {:.1f} mm from where the machine file has it: is its nominal position right?",
          feature, median(whole.away_mm)));
    }
  }

  [[nodiscard]] std::string nearest(const Touch& t, int setting, double c_deg,
                                    const std::map<std::pair<int, int>, Eigen::Vector3d>& usual) const {
    std::string name;
    double best = 2.0 * std::max(assembly_.misplaced_mm, 0.05) + 3.0;
    for (const std::string& feature : assembly_.features) {
      if (const auto nominal = expected(feature, c_deg)) {
        Eigen::Vector3d d = impliedCentre(t, setting) - *nominal;
        d -= assembly_.axis * assembly_.axis.dot(d);
        if (d.norm() < best) {
          best = d.norm();
          name = feature;
        }
      }
    }
    for (const auto& [key, p] : usual) {
      const double d = (t.position_mm - p).norm();
      if (d < best) {
        best = d;
        name = std::get<0>(settings_[static_cast<std::size_t>(key.first)]);
      }
    }
    return name;
  }

  /// Radius of the stylus centre about a feature in one cycle.
  struct FoundRadius {
    int cycle = 0;
    double radius_mm = 0.0;
  };

  /// Radius of the stylus centre about the feature: what the touches of all cycles say, else the machine file.
  void findRadii() {
    std::vector<std::vector<FoundRadius>> found(settings_.size());
    std::vector<bool> excluded(list_.touches.size(), false);
    for (const RejectedTouch& r : result_.rejected) excluded[r.touch] = true;
    for (const Group& g : groups_) {
      const auto& [feature, stylus, c_deg] = settings_[static_cast<std::size_t>(g.setting)];
      const Stylus* s = machine_.findStylus(stylus);
      std::vector<std::size_t> kept;
      for (const std::size_t i : g.touches)
        if (!excluded[i]) kept.push_back(i);
      if (kept.empty()) continue;
      FeatureOptions options;
      options.axis = assembly_.axis;
      options.tolerate_one_bad_touch = false;
      const ProbedFeature fit = fitFeature(list_, kept, assembly_.kind, s->radius_mm, options);
      if (fit.status != FitStatus::Converged) continue;
      const double side = assembly_.kind == FeatureKind::Sphere ? 1.0 : -1.0;
      found[static_cast<std::size_t>(g.setting)].push_back({g.cycle, 0.5 * fit.diameter_mm + side * s->radius_mm});
    }
    radius_.assign(settings_.size(), 0.0);
    for (std::size_t s = 0; s < settings_.size(); ++s) {
      std::vector<double> values;
      for (const FoundRadius& r : found[s]) values.push_back(r.radius_mm);
      radius_[s] = values.empty() ? radiusOf(static_cast<int>(s)) : median(std::move(values));
    }
    rejectOtherStyli(found, excluded);
    judgeRadii(found);
  }

  /// A stylus that is another one in one cycle: all its touches there lie on a radius that is not that of the others.
  /// `excluded`: by touch, what is left out already.
  void rejectOtherStyli(const std::vector<std::vector<FoundRadius>>& found, const std::vector<bool>& excluded) {
    constexpr double telling_mm = 0.01;  // a ball warms by nanometres, a probe repeats to micrometres
    constexpr std::size_t telling_features = 3;
    const bool two_cycles = result_.cycles.size() < 3;
    std::map<std::pair<std::string, int>, std::vector<double>> changes;  // by stylus and cycle
    for (std::size_t s = 0; s < settings_.size(); ++s) {
      if (found[s].size() < 2) continue;
      const double usual = two_cycles ? found[s].front().radius_mm : radius_[s];
      for (const FoundRadius& r : found[s])
        changes[{std::get<1>(settings_[s]), r.cycle}].push_back(r.radius_mm - usual);
    }
    for (const auto& [key, values] : changes) {
      const auto& [stylus, cycle] = key;
      if (values.size() < telling_features) continue;
      const double change = median(values);
      const double sigma = robustSigma(values) / std::sqrt(static_cast<double>(values.size()));
      if (!(std::abs(change) > std::max(telling_mm, 8.0 * sigma))) continue;
      const std::string& name = result_.cycles[static_cast<std::size_t>(cycle)];
      const std::string size = withUncertainty(change * um_per_mm, std::max(sigma * um_per_mm, 0.1), "um");
      result_.contradict(
          two_cycles
              ? fmt::format(
                    "In {} the touches with stylus {} lie on a radius that differs by {} from that in {}: another "
                    "stylus, or a tip that is loose; they are left out.",
                    name, stylus, size, result_.cycles.front())
              : fmt::format(
                    "In {} the touches with stylus {} lie on a radius that differs by {} from that in the other "
                    "cycles: another stylus, or a tip that is loose; they are left out.",
                    name, stylus, size));
      for (const Group& g : groups_) {
        if (g.cycle != cycle || std::get<1>(settings_[static_cast<std::size_t>(g.setting)]) != stylus) continue;
        for (const std::size_t i : g.touches)
          if (!excluded[i])
            result_.rejected.push_back({i, fmt::format("stylus {} is not the same as in the other cycles", stylus)});
      }
    }
  }

  /// What the machine file says of diameters and styli, against the touches: one sentence for all features that differ
  /// alike.
  void judgeRadii(const std::vector<std::vector<FoundRadius>>& found) {
    constexpr double telling_mm = 0.1;  // more than the pre-travel of a probe that nobody calibrated
    struct Alike {
      std::vector<std::string> features;
      std::vector<double> difference_mm;
      double given_mm = 0.0;
    };
    std::map<std::pair<std::string, long>, Alike> alike;  // by stylus and difference, twentieths of a millimetre
    for (std::size_t s = 0; s < settings_.size(); ++s) {
      const double given = radiusOf(static_cast<int>(s));
      if (!(given > 0.0) || found[s].empty() || !(std::abs(radius_[s] - given) > telling_mm)) continue;
      const auto& [feature, stylus, c_deg] = settings_[s];
      Alike& a = alike[{stylus, std::lround(20.0 * (radius_[s] - given))}];
      if (std::find(a.features.begin(), a.features.end(), feature) == a.features.end()) a.features.push_back(feature);
      a.given_mm = given;
      for (const FoundRadius& r : found[s]) a.difference_mm.push_back(r.radius_mm - given);
    }
    for (const auto& [key, a] : alike) {
      const double sigma_mm =
          std::max(robustSigma(a.difference_mm) / std::sqrt(static_cast<double>(a.difference_mm.size())), 1e-4);
      result_.warnings.push_back(fmt::format(
          "{} with stylus {}: the touches lie on a radius of {:.4f} ± {:.4f} mm, the machine file gives {:.4f} mm; "
          "check diameter and stylus radius (displacements do not depend on it).",
          shortenedList(a.features), key.first, a.given_mm + median(a.difference_mm), sigma_mm, a.given_mm));
    }
  }

  void centre(const std::vector<bool>& excluded) {
    std::vector<std::vector<double>> centres[3];
    for (auto& c : centres) c.assign(settings_.size(), {});
    for (Group& g : groups_) {
      g.centred = false;
      std::vector<std::size_t> kept;
      for (const std::size_t i : g.touches) {
        if (!excluded[i]) kept.push_back(i);
      }
      const double radius = radius_[static_cast<std::size_t>(g.setting)];
      if (kept.empty() || !(radius > 0.0)) continue;
      const Stylus* s = machine_.findStylus(std::get<1>(settings_[static_cast<std::size_t>(g.setting)]));
      const double side = assembly_.kind == FeatureKind::Sphere ? 1.0 : -1.0;
      FeatureOptions options;
      options.axis = assembly_.axis;
      options.tolerate_one_bad_touch = false;
      options.known_diameter_mm = 2.0 * (radius - side * s->radius_mm);
      if (!(*options.known_diameter_mm > 0.0)) continue;
      const ProbedFeature fit = fitFeature(list_, kept, assembly_.kind, s->radius_mm, options);
      if (fit.status != FitStatus::Converged) continue;
      g.centre = fit.centre_mm;
      g.centred = true;
      for (int k = 0; k < 3; ++k) centres[k][static_cast<std::size_t>(g.setting)].push_back(fit.centre_mm(k));
    }
    base_.assign(settings_.size(), Eigen::Vector3d::Zero());
    // Thermal errors are zero in the first cycle by definition: its centres are the place to linearise about. Another
    // choice would turn with the direction of touch and leave an error of second order.
    std::vector<bool> based(settings_.size(), false);
    for (const Group& g : groups_) {
      if (g.cycle != 0 || !g.centred) continue;
      base_[static_cast<std::size_t>(g.setting)] = g.centre;
      based[static_cast<std::size_t>(g.setting)] = true;
    }
    for (std::size_t s = 0; s < settings_.size(); ++s) {
      if (based[s]) continue;
      if (!centres[0][s].empty()) {
        for (int k = 0; k < 3; ++k) base_[s](k) = median(centres[k][s]);
        continue;
      }
      // Never centred: what single touches imply.
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      int count = 0;
      for (const Group& g : groups_) {
        if (g.setting != static_cast<int>(s)) continue;
        for (const std::size_t i : g.touches) {
          if (excluded[i]) continue;
          sum += impliedCentre(list_.touches[i], g.setting);
          ++count;
        }
      }
      if (count > 0) base_[s] = sum / count;
    }
    for (Group& g : groups_) {
      if (!g.centred) g.centre = base_[static_cast<std::size_t>(g.setting)];
    }
  }

  void build(const std::vector<bool>& excluded) {
    CycleProblem& problem = result_.problem;
    problem = {};
    problem.cycles = static_cast<int>(result_.cycles.size());
    problem.parameters = assembly_.names;
    problem.priors = assembly_.priors;
    problem.groups = 2;
    result_.row_touch.clear();
    result_.row_normal.clear();
    std::map<std::tuple<int, int, int, int, int>, int> key_of;
    std::size_t count = 0;
    for (const Group& g : groups_) count += g.touches.size();
    problem.jacobian.resize(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(assembly_.names.size()));
    for (const Group& g : groups_) {
      for (const std::size_t i : g.touches) {
        if (excluded[i]) continue;
        const Touch& t = list_.touches[i];
        const bool along = std::abs(t.approach.dot(assembly_.axis)) > 0.7;
        const bool surface = assembly_.kind == FeatureKind::Hole && along;
        CycleRow row;
        row.cycle = g.cycle;
        row.group = along ? 1 : 0;
        Eigen::Vector3d u = t.approach;
        if (surface) {
          row.value_mm = u.dot(t.position_mm - base_[static_cast<std::size_t>(g.setting)]);
        } else {
          Eigen::Vector3d d = t.position_mm - g.centre;
          Eigen::Vector3d shift = g.centre - base_[static_cast<std::size_t>(g.setting)];
          if (assembly_.kind == FeatureKind::Hole) {
            d -= assembly_.axis * assembly_.axis.dot(d);
            shift -= assembly_.axis * assembly_.axis.dot(shift);
          }
          const double distance = d.norm();
          if (!(distance > 0.0)) continue;
          u = d / distance;
          row.value_mm = distance + u.dot(shift);
        }
        const auto direction = [](double v) { return static_cast<int>(std::lround(50.0 * v)); };
        row.key = key_of
                      .try_emplace({g.setting, t.touch, direction(t.approach.x()), direction(t.approach.y()),
                                    direction(t.approach.z())},
                                   static_cast<int>(key_of.size()))
                      .first->second;
        problem.jacobian.row(static_cast<Eigen::Index>(problem.rows.size())) =
            -u.transpose() * assembly_.jacobian(t, g.centre);
        problem.rows.push_back(row);
        result_.row_touch.push_back(i);
        result_.row_normal.push_back(u);
      }
    }
    problem.jacobian.conservativeResize(static_cast<Eigen::Index>(problem.rows.size()), Eigen::NoChange);
    problem.keys = static_cast<int>(key_of.size());
  }

  /// One sentence for cycles that follow one another and leave the same parameters open.
  void tellWhatIsOpen() {
    const std::vector<CycleSolution>& cycles = result_.fit.cycles;
    for (std::size_t k = 0; k < cycles.size();) {
      std::size_t last = k;
      if (cycles[k].status == FitStatus::Degenerate) {
        while (last + 1 < cycles.size() && cycles[last + 1].status == FitStatus::Degenerate &&
               cycles[last + 1].determined == cycles[k].determined)
          ++last;
        const std::string which = last > k ? fmt::format("{} to {}", result_.cycles[k], result_.cycles[last])
                                           : std::string(result_.cycles[k]);
        result_.contradict(fmt::format("{}: {}.", which, cycles[k].message));
      }
      k = last + 1;
    }
  }

  void finish(const std::vector<bool>& excluded) {
    const CycleFitResult& fit = result_.fit;
    result_.status = fit.status;
    result_.message = fit.message;
    result_.parameters.resize(result_.cycles.size());
    for (std::size_t k = 0; k < result_.cycles.size(); ++k) {
      const CycleSolution& solution = fit.cycles[k];
      for (std::size_t p = 0; p < result_.names.size(); ++p) {
        const auto e = static_cast<Eigen::Index>(p);
        CycleParameter parameter;
        parameter.determined = solution.determined[p];
        parameter.value = solution.theta(e) * result_.unit[p];
        parameter.standard_uncertainty = std::sqrt(solution.covariance(e, e)) * result_.unit[p];
        result_.parameters[k].push_back(parameter);
      }
    }
    tellWhatIsOpen();
    // What is missing compared with the fullest cycle.
    std::size_t full = 0;
    std::vector<std::size_t> touches(result_.cycles.size(), 0);
    for (const Group& g : groups_) touches[static_cast<std::size_t>(g.cycle)] += g.touches.size();
    for (const std::size_t n : touches) full = std::max(full, n);
    for (std::size_t k = 0; k < touches.size(); ++k) {
      if (touches[k] == full) continue;
      result_.warnings.push_back(
          fmt::format("{}: {} of {} touches are missing; {}.", result_.cycles[k], full - touches[k], full,
                      fit.cycles[k].status == FitStatus::Degenerate ? "the rest does not determine all parameters"
                                                                    : "evaluated from the rest"));
    }
    if (result_.cycles.size() < 2) {
      result_.status = FitStatus::Degenerate;
      result_.message = "One cycle alone is the reference; thermal errors need a second one";
      result_.warnings.push_back(result_.message + ".");
    }
    double freedom = 0.0;
    for (const double f : fit.group_degrees_of_freedom) freedom += f;
    if (!assembly_.fit.sigma_mm && !(freedom > 0.5)) {
      result_.warnings.push_back(fmt::format(
          "No touch of {} checks another, so that nothing is known of the noise of a touch: {:g} µm is assumed.",
          artefact_.id, CycleFitOptions::assumed_sigma_mm * um_per_mm));
    } else if (result_.cycles.size() >= 2 && freedom < 8.0) {
      result_.warnings.push_back(fmt::format(
          "The touch noise rests on {:.0f} degrees of freedom only; the uncertainties are rough.", freedom));
    }
    FeatureOptions options;
    options.axis = assembly_.axis;
    double sigma = 0.0;
    for (const double s : fit.group_sigma_mm) sigma = std::max(sigma, s);
    if (sigma > 1e-7) options.sigma_mm = sigma;
    // Form errors and pre-travel lie outside the touch noise: bad touches were already found against all other cycles.
    options.tolerate_one_bad_touch = false;
    result_.features.reserve(groups_.size());
    for (const Group& g : groups_) {
      std::vector<std::size_t> kept;
      for (const std::size_t i : g.touches) {
        if (!excluded[i]) kept.push_back(i);
      }
      if (kept.empty()) continue;
      const Stylus* s = machine_.findStylus(std::get<1>(settings_[static_cast<std::size_t>(g.setting)]));
      result_.features.push_back(fitFeature(list_, kept, assembly_.kind, s->radius_mm, options));
    }
  }

  const TouchList& list_;
  const MachineDescription& machine_;
  const Artefact& artefact_;
  const CycleAssembly& assembly_;
  CycleEvaluation& result_;
  std::vector<GroupKey> settings_;
  std::vector<Group> groups_;
  ArtefactPlace place_;
  std::vector<double> guessed_radius_;  ///< by setting, where none is stated; empty: all are
  std::vector<double> radius_;
  std::vector<Eigen::Vector3d> base_;
};

}  // namespace

void evaluateCycles(const TouchList& list, const MachineDescription& machine, const Artefact& artefact,
                    const CycleAssembly& assembly, CycleEvaluation& result) {
  result.artefact = artefact.id;
  result.names = assembly.names;
  result.unit = assembly.unit;
  Assembler(list, machine, artefact, assembly, result).run();
}

void addGrowthUncertainty(const TouchList& list, Eigen::MatrixXd factors, std::map<std::string, Eigen::Vector3d> arm_mm,
                          CycleEvaluation& result) {
  if (factors.isZero(0.0)) return;
  const auto& rows = result.problem.rows;
  Eigen::MatrixXd shift = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows.size()), factors.cols());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const auto arm = arm_mm.find(list.touches[result.row_touch[r]].feature);
    if (arm == arm_mm.end()) continue;
    shift.row(static_cast<Eigen::Index>(r)) = result.row_normal[r].dot(arm->second) * factors.row(rows[r].cycle);
  }
  addCauses(result.problem, shift, result.fit);
  for (std::size_t k = 0; k < result.parameters.size(); ++k) {
    for (std::size_t p = 0; p < result.names.size(); ++p) {
      const auto e = static_cast<Eigen::Index>(p);
      result.parameters[k][p].standard_uncertainty = std::sqrt(result.fit.cycles[k].covariance(e, e)) * result.unit[p];
    }
  }
  result.growth_factors = std::move(factors);
  result.growth_arm_mm = std::move(arm_mm);
}

namespace {

/// The first cycle's noise in the rows of one point: causes are its touches, of unit variance. They are turned into as
/// few as the rows tell apart, in order of the rows.
class FirstCycleNoise {
 public:
  /// `row` of the set is moved by `loads(key)` (um) of each touch.
  void add(std::size_t row, const std::vector<int>& keys, const Eigen::VectorXd& loads) {
    Eigen::VectorXd rest = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(place_.size() + keys.size()));
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const auto at = place_.try_emplace(keys[i], static_cast<Eigen::Index>(place_.size())).first->second;
      rest(at) += loads(static_cast<Eigen::Index>(i));
    }
    const double size = rest.norm();
    for (std::size_t f = 0; f < directions_.size(); ++f) {
      const Eigen::VectorXd& direction = directions_[f];
      const double load = direction.dot(rest.head(direction.size()));
      rest.head(direction.size()) -= load * direction;
      if (std::abs(load) > rounding * size) factors_[f].push_back({row, load});
    }
    const double left = rest.norm();
    if (!(left > rounding * size)) return;
    directions_.emplace_back(rest.head(static_cast<Eigen::Index>(place_.size())) / left);
    factors_.push_back({{row, left}});
  }
  [[nodiscard]] std::vector<SharedNoise::Factor>& factors() { return factors_; }

 private:
  static constexpr double rounding = 1e-9;
  std::map<int, Eigen::Index> place_;        ///< of a touch among the causes
  std::vector<Eigen::VectorXd> directions_;  ///< orthonormal; shorter ones end in zeros
  std::vector<SharedNoise::Factor> factors_;
};

}  // namespace

ObservationSet cycleObservations(const CycleEvaluation& evaluation, const TouchList& list,
                                 const MachineDescription& machine, const Artefact& artefact) {
  ObservationSet set;
  struct Member {
    std::size_t row;
    std::size_t reference_row;
  };
  const auto& rows = evaluation.problem.rows;
  // Rows of the reference cycle by key.
  std::vector<int> reference(static_cast<std::size_t>(evaluation.problem.keys), -1);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (rows[r].cycle == evaluation.problem.reference_cycle && evaluation.fit.used[r]) {
      reference[static_cast<std::size_t>(rows[r].key)] = static_cast<int>(r);
    }
  }
  std::map<std::tuple<int, std::string, std::string, double>, std::size_t> group_of;
  std::vector<std::vector<Member>> groups;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const int ref = reference[static_cast<std::size_t>(rows[r].key)];
    if (!evaluation.fit.used[r] || ref < 0) continue;
    const Touch& t = list.touches[evaluation.row_touch[r]];
    const auto [group, fresh] = group_of.try_emplace({rows[r].cycle, t.feature, t.stylus, t.c_deg}, groups.size());
    if (fresh) groups.emplace_back();
    groups[group->second].push_back({r, static_cast<std::size_t>(ref)});
  }
  std::map<std::string, FirstCycleNoise> first_cycle;  // by point
  std::vector<SharedNoise::Factor> growth(static_cast<std::size_t>(evaluation.growth_factors.cols()));
  for (const std::vector<Member>& members : groups) {
    const Touch& first = list.touches[evaluation.row_touch[members.front().row]];
    const auto n = static_cast<Eigen::Index>(members.size());
    Eigen::MatrixXd U(n, 3);
    Eigen::VectorXd change(n);
    Eigen::VectorXd variance(n);
    std::vector<int> keys;
    double time = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const Member& m = members[static_cast<std::size_t>(i)];
      keys.push_back(rows[m.row].key);
      const double sigma = evaluation.fit.group_sigma_mm[static_cast<std::size_t>(rows[m.row].group)];
      U.row(i) = evaluation.row_normal[m.row].transpose();
      change(i) = rows[m.row].value_mm - rows[m.reference_row].value_mm;
      variance(i) = std::max(sigma * sigma, 1e-18);
      time += list.touches[evaluation.row_touch[m.row]].time_s / static_cast<double>(n);
    }
    const Eigen::Matrix3d normal = U.transpose() * variance.cwiseInverse().asDiagonal() * U;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> modes(normal);
    Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d open = Eigen::Matrix3d::Zero();
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d v = modes.eigenvectors().col(k);
      if (modes.eigenvalues()(k) > 1e-3 * modes.eigenvalues()(2)) {
        inverse += v * v.transpose() / modes.eigenvalues()(k);
      } else {
        open += v * v.transpose();
      }
    }
    const Eigen::MatrixXd W = inverse * U.transpose() * variance.cwiseInverse().asDiagonal();  // 3 x n
    const Eigen::Vector3d displacement = W * change;
    std::string point = artefact.kind == "balls" ? first.feature + "/" + first.stylus : first.feature;
    if (first.c_deg != 0.0) point += fmt::format("@{:g}", first.c_deg);
    const Stylus* stylus = machine.findStylus(first.stylus);
    std::vector<std::size_t> own_rows;
    std::vector<int> own_axis;
    for (int axis = 0; axis < 3; ++axis) {
      if (open.col(axis).norm() > 1e-2) continue;
      Observation o;
      o.time_s = time;
      o.state = first.cycle;
      o.point = point;
      for (Eigen::Index i = 0; i < n; ++i) {
        const std::size_t r = members[static_cast<std::size_t>(i)].row;
        o.position_mm += W(axis, i) * U(i, axis) * list.touches[evaluation.row_touch[r]].position_mm;
      }
      o.c_deg = first.c_deg;
      o.component = static_cast<Component>(axis);
      o.value = -displacement(axis) * um_per_mm;
      if (o.value == 0.0) o.value = 0.0;  // no minus zero in files
      const double own = inverse(axis, axis) * um_per_mm * um_per_mm;
      o.sigma = std::sqrt(2.0 * own);
      o.instrument = "touch_probe";
      if (stylus != nullptr) o.tool_offset_mm = stylus->offset_mm;
      const std::size_t row = set.rows.size();
      first_cycle[point].add(row, keys, um_per_mm * W.row(axis).transpose().cwiseProduct(variance.cwiseSqrt()));
      own_rows.push_back(row);
      own_axis.push_back(axis);
      set.rows.push_back(std::move(o));
      const auto arm = evaluation.growth_arm_mm.find(first.feature);
      if (arm == evaluation.growth_arm_mm.end()) continue;
      const int cycle = rows[members.front().row].cycle;
      for (std::size_t q = 0; q < growth.size(); ++q)
        growth[q].push_back(
            {row, -um_per_mm * arm->second(axis) * evaluation.growth_factors(cycle, static_cast<Eigen::Index>(q))});
    }
    // The touches of this cycle: what its axes share.
    Eigen::MatrixXd own(static_cast<Eigen::Index>(own_axis.size()), static_cast<Eigen::Index>(own_axis.size()));
    for (Eigen::Index i = 0; i < own.rows(); ++i)
      for (Eigen::Index j = 0; j < own.cols(); ++j)
        own(i, j) = um_per_mm * um_per_mm *
                    inverse(own_axis[static_cast<std::size_t>(i)], own_axis[static_cast<std::size_t>(j)]);
    const Eigen::MatrixXd loads = sharedLoads(own);
    for (Eigen::Index f = 0; f < loads.cols(); ++f) {
      SharedNoise::Factor factor;
      for (Eigen::Index i = 0; i < loads.rows(); ++i)
        factor.push_back({own_rows[static_cast<std::size_t>(i)], loads(i, f)});
      set.shared.addFactor(std::move(factor));
    }
  }
  for (auto& [point, noise] : first_cycle)
    for (SharedNoise::Factor& factor : noise.factors()) set.shared.addFactor(std::move(factor));
  for (SharedNoise::Factor& factor : growth) {
    for (const SharedNoise::Load& l : factor) set.rows[l.row].sigma = std::hypot(set.rows[l.row].sigma, l.load);
    set.shared.addFactor(std::move(factor));
  }
  return set;
}

}  // namespace spindrift
