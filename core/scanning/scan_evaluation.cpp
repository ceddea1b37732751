// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/scan_evaluation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <numbers>
#include <optional>

#include "core/base/inside_folder.h"
#include "core/base/json_reader.h"
#include "core/base/sha256.h"
#include "core/base/text.h"
#include "core/base/unit_text.h"
#include "core/base/units.h"
#include "core/scanning/cloud_file.h"
#include "core/scanning/scan_points.h"

namespace spindrift {
namespace {

/// A rotation known worse than this carries no information about the machine (rad).
constexpr double blind_rotation_rad = 100e-6;
constexpr double blind_shift_mm = 0.1;

struct Extent {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();
  Eigen::Vector2d size = Eigen::Vector2d::Zero();
};

Extent extentOf(const CellGrid& grid) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e300), high = -low;
  for (const SurfaceCell& c : grid.cells)
    if (c.count > 0.0) {
      low = low.cwiseMin(c.mean.head<2>());
      high = high.cwiseMax(c.mean.head<2>());
    }
  return {low, high - low};
}

/// Two separate surfaces in one cloud: an empty strip across it with much on either side.
std::optional<std::string> twoSurfaces(const CellGrid& grid) {
  for (const bool along_y : {true, false}) {
    const int lines = along_y ? grid.rows : grid.columns;
    std::vector<double> filled(static_cast<std::size_t>(lines), 0.0);
    double total = 0.0;
    for (int r = 0; r < grid.rows; ++r)
      for (int c = 0; c < grid.columns; ++c)
        if (grid.at(c, r).count > 0.0) {
          filled[static_cast<std::size_t>(along_y ? r : c)] += 1.0;
          total += 1.0;
        }
    const double cell = along_y ? grid.size.y() : grid.size.x();
    double before = 0.0;
    int empty = 0;
    for (int i = 0; i < lines; ++i) {
      const double n = filled[static_cast<std::size_t>(i)];
      if (n > 0.0) {
        const double width = empty * cell;
        if (width > 2.0 && before > 0.2 * total && total - before > 0.2 * total) {
          const double at = (along_y ? grid.low.y() : grid.low.x()) + (i - 0.5 * empty) * cell;
          return fmt::format("a gap of {:.1f} mm at {} = {:.1f} mm", width, along_y ? "y" : "x", at);
        }
        empty = 0;
      } else {
        ++empty;
      }
      before += n;
    }
  }
  return std::nullopt;
}

/// Axes of the scan frame: a permutation of the machine's with signs.
struct ScanFrame {
  std::string axis = "Y";
  int travel = 1;  ///< index of the axis
  Eigen::Matrix3d machine_from_scan = Eigen::Matrix3d::Identity();

  [[nodiscard]] static ScanFrame of(const MachineDescription& machine);
  /// Results of a scan, worked out in the scan frame, into machine axes. No products: what is not determined is
  /// infinite.
  void intoMachine(ScanResult& result) const;
};

ScanFrame ScanFrame::of(const MachineDescription& machine) {
  ScanFrame frame;
  frame.axis = machine.profiler->axis;
  const std::size_t travel = std::string("XYZ").find(frame.axis);
  if (frame.axis.size() != 1 || travel == std::string::npos) {
    throw InputError({machine.file, "$.profiler.axis"},
                     fmt::format("found '{}'; allowed: X, Y or Z, the axis that carries the profiler.", frame.axis));
  }
  frame.travel = static_cast<int>(travel);
  std::string height = frame.axis == "Z" ? "-Y" : "Z";
  const auto profiler = JsonNode::parse(machine.source.dump(), machine.file.string()).find("profiler");
  const auto stated = profiler ? profiler->find("height_axis") : std::nullopt;
  if (stated) height = stated->oneOf({"X", "Y", "Z", "-X", "-Y", "-Z"});
  const auto up = static_cast<Eigen::Index>(std::string("XYZ").find(height.back()));
  if (up == frame.travel) {
    stated->reject(fmt::format("an axis across {}, along which the profiler travels", frame.axis));
  }
  const Eigen::Vector3d y = Eigen::Vector3d::Unit(frame.travel);
  const Eigen::Vector3d z = (height.front() == '-' ? -1.0 : 1.0) * Eigen::Vector3d::Unit(up);
  frame.machine_from_scan << y.cross(z), y, z;
  return frame;
}

void ScanFrame::intoMachine(ScanResult& result) const {
  if (machine_from_scan.isIdentity(0.0)) return;
  std::array<Eigen::Index, 6> from{};  // of the scan frame, for each component in machine axes
  std::array<double, 6> sign{};
  for (Eigen::Index i = 0; i < 3; ++i) {
    Eigen::Index j = 0;
    machine_from_scan.row(i).cwiseAbs().maxCoeff(&j);
    const auto at = static_cast<std::size_t>(i);
    from[at] = j;
    from[at + 3] = j + 3;
    sign[at] = sign[at + 3] = machine_from_scan(i, j);
  }
  const auto turned = [&](const Eigen::Matrix<double, 6, 6>& m, bool both) {
    Eigen::Matrix<double, 6, 6> out;
    for (Eigen::Index i = 0; i < 6; ++i) {
      for (Eigen::Index j = 0; j < 6; ++j) {
        const auto a = static_cast<std::size_t>(i);
        const auto b = static_cast<std::size_t>(j);
        out(i, j) = both ? sign[a] * sign[b] * m(from[a], from[b]) : sign[a] * m(from[a], j);
      }
    }
    return out;
  };
  RegistrationResult& r = result.registration;
  r.translation_mm = machine_from_scan * r.translation_mm;
  r.rotation_rad = machine_from_scan * r.rotation_rad;
  r.commanded_mm = machine_from_scan * r.commanded_mm;
  r.drift_mm = machine_from_scan * r.drift_mm;
  r.covariance = turned(r.covariance, true);
  r.white_covariance = turned(r.white_covariance, true);
  if (r.free_form) r.free_form->motion_covariance = turned(r.free_form->motion_covariance, true);
  result.calibration_spread = turned(result.calibration_spread, false);
  result.axis.error.translation_mm = machine_from_scan * result.axis.error.translation_mm;
  result.axis.error.rotation_rad = machine_from_scan * result.axis.error.rotation_rad;
  result.axis.covariance = turned(result.axis.covariance, true);
  for (auto& [component, reason] : result.not_observed) {
    const auto in_scan = static_cast<Eigen::Index>(component);
    const auto to = std::find(from.begin(), from.end(), in_scan) - from.begin();
    component = static_cast<Component>(to);
    // Directions are named by the axes of the scan frame.
    if (reason.find("leaves it free") != std::string::npos) reason = "the surface does not determine it.";
  }
}

/// All scans of one artefact.
class ArtefactEvaluator {
 public:
  ArtefactEvaluator(const Campaign& campaign, const ProfilerMounting& mounting, ScanModel model, int travel,
                    std::vector<ScanCapture> captures)
      : campaign_(campaign), mounting_(mounting), travel_(travel), captures_(std::move(captures)) {
    takeCopiesOut();
    options_.scan_model = model;
    options_.free_form = true;
    // Of many scans one shows by chance what is rare in one alone.
    options_.clear_evidence += std::log(std::max(1.0, static_cast<double>(captures_.size())));
    options_.machine_from_profiler = mounting.calibration.rotation();
    // Errors of the axis make about one wave over its travel, no more.
    if (const LinearAxis* axis = campaign.machine.findAxis(campaign.machine.profiler->axis))
      options_.smooth_length_mm = (axis->travel_mm[1] - axis->travel_mm[0]) / (2.0 * std::numbers::pi);
  }

  /// `parallel`: scans at the same time, else on this thread.
  void run(const JobContext& job, bool parallel) {
    parallel_ = parallel;
    // The first scan is the reference. If most others do not fit it, it may be the first that is wrong: try the next.
    // Of two that fit as many the one that shows more is the artefact: a plane is not.
    std::vector<ScanResult> best;
    std::vector<RejectedCapture> best_rejected;
    const auto open = [](const std::vector<ScanResult>& of) {
      return of.empty() ? std::numeric_limits<std::size_t>::max() : of.front().not_observed.size();
    };
    for (std::size_t first = 0; first < std::min<std::size_t>(captures_.size(), 3); ++first) {
      scans.clear();
      rejected.clear();
      attempt(first, job);
      if (first == 0 || scans.size() > best.size() || (scans.size() == best.size() && open(scans) < open(best))) {
        best = scans;
        best_rejected = rejected;
      }
      if (captures_.size() < 3 || 2 * scans.size() > captures_.size()) break;
    }
    scans = std::move(best);
    rejected = std::move(best_rejected);
    rejected.insert(rejected.end(), copies_.begin(), copies_.end());
  }

  std::vector<ScanResult> scans;
  std::vector<RejectedCapture> rejected;

 private:
  /// Scans are of one size where the profiler gives a grid, so that the beginning decides; all of a file is read only
  /// where that agrees.
  void takeCopiesOut() {
    std::map<std::pair<std::uintmax_t, std::string>, std::vector<ScanCapture>> alike;
    std::vector<ScanCapture> kept;
    for (const ScanCapture& capture : captures_) {
      const std::filesystem::path file = campaign_.path(capture.cloud);
      std::error_code none;
      const std::uintmax_t size = std::filesystem::file_size(file, none);
      std::string beginning(65536, '\0');
      std::ifstream stream(file, std::ios::binary);
      if (none || !stream) {  // whoever reads it says why
        kept.push_back(capture);
        continue;
      }
      stream.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
      beginning.resize(static_cast<std::size_t>(stream.gcount()));
      std::vector<ScanCapture>& before = alike[{size, sha256(beginning)}];
      const auto same = std::find_if(before.begin(), before.end(), [&](const ScanCapture& b) {
        return sha256OfFile(campaign_.path(b.cloud)) == sha256OfFile(file);
      });
      if (same != before.end()) {
        copies_.push_back({capture.cloud, fmt::format("{} holds the same bytes as {}: a copy is no second measurement.",
                                                      capture.cloud, same->cloud)});
        continue;
      }
      before.push_back(capture);
      kept.push_back(capture);
    }
    captures_ = std::move(kept);
  }

  /// What came of one scan: a result, or why there is none.
  struct Outcome {
    std::optional<ScanResult> result;
    std::optional<RejectedCapture> rejected;
  };

  template <typename Work>
  static Outcome outcomeOf(const ScanCapture& capture, const Work& work) {
    Outcome outcome;
    try {
      work(outcome);
    } catch (const InputError& error) {
      outcome.rejected = {capture.cloud, error.what()};
    } catch (const std::bad_alloc&) {
      outcome.rejected = {capture.cloud, capture.cloud + ": there is not enough memory for the cloud."};
    }
    return outcome;
  }

  void attempt(std::size_t first, const JobContext& job) {
    std::unique_ptr<RegistrationTarget> target;
    std::vector<Outcome> outcomes(captures_.size());
    // The reference is the first usable scan from `first` on; earlier ones are compared with it afterwards.
    std::size_t next = 0;
    for (; next < captures_.size() && !target; ++next) {
      job.throwIfCancelled();
      const ScanCapture& capture = captures_[(first + next) % captures_.size()];
      outcomes[next] = outcomeOf(capture, [&](Outcome& outcome) {
        const PointCloud cloud = readScanPoints(campaign_, capture.cloud).used();
        target = makeReference(cloud, capture, outcome);
      });
    }
    std::vector<std::size_t> rest;
    for (std::size_t k = next; k < captures_.size(); ++k) rest.push_back(k);
    RegistrationOptions options = options_;
    const auto one = [&](std::size_t i) {
      job.throwIfCancelled();
      const ScanCapture& capture = captures_[(first + rest[i]) % captures_.size()];
      outcomes[rest[i]] = outcomeOf(capture, [&](Outcome& outcome) {
        outcome = compare(readScanPoints(campaign_, capture.cloud).used(), capture, *target, options);
      });
    };
    const auto all = [&] {
      if (parallel_) {
        parallelFor(rest.size(), job, one);
      } else {
        for (std::size_t i = 0; i < rest.size(); ++i) one(i);
      }
    };
    all();
    // An artefact that has changed its shape in one state may have in all: where it is less clear, it counts as well.
    const auto changed = [&](std::size_t k) {
      return outcomes[k].result && outcomes[k].result->registration.free_form;
    };
    if (std::any_of(rest.begin(), rest.end(), changed)) {
      std::erase_if(rest, [&](std::size_t k) { return changed(k) || !outcomes[k].result; });
      options.clear_evidence = -std::numeric_limits<double>::infinity();
      all();
    }
    for (Outcome& outcome : outcomes) {
      if (outcome.result) scans.push_back(std::move(*outcome.result));
      if (outcome.rejected) rejected.push_back(std::move(*outcome.rejected));
    }
  }

  std::unique_ptr<RegistrationTarget> makeReference(const PointCloud& cloud, const ScanCapture& capture,
                                                    Outcome& outcome) {
    auto target = std::make_unique<RegistrationTarget>(cloud);
    if (const auto gap = twoSurfaces(target->grid()))
      throw InputError(
          fmt::format("{} holds two separate surfaces ({}); allowed: one artefact per cloud.", capture.cloud, *gap));
    reference_extent_ = extentOf(target->grid());
    reference_y_mm_ = capture.y_mm;
    placeAtPoint(capture);
    // A scan against itself says which directions the surface leaves free, and gives the noise of one scan.
    RegistrationOptions of_itself = options_;
    of_itself.free_form = false;
    const RegistrationResult self = registerToSurface(cloud, *target, of_itself);
    ScanResult result;
    result.capture = capture;
    result.reference = true;
    result.registration = self;
    result.registration.translation_mm.setZero();
    result.registration.rotation_rad.setZero();
    result.registration.target_from_source = RigidTransform();
    result.registration.message.clear();
    noteFree(result);
    result.axis = axisError(result.registration, mounting_);
    outcome.result = std::move(result);
    return target;
  }

  /// The deviation is asked where machine.json says that the point stands, not where the points happen to be dense.
  void placeAtPoint(const ScanCapture& capture) {
    options_.at_y_mm.reset();
    if (const MachinePoint* point = campaign_.machine.findPoint(capture.artefact)) {
      const double along = point->position_mm[travel_] - capture.y_mm;
      const double from = reference_extent_.low.y(), length = reference_extent_.size.y();
      if (along >= from && along <= from + length) options_.at_y_mm = along;
    }
  }

  [[nodiscard]] Outcome compare(PointCloud cloud, const ScanCapture& capture, const RegistrationTarget& target,
                                const RegistrationOptions& options) const {
    const auto reject = [&](std::string reason) {
      return Outcome{std::nullopt, RejectedCapture{capture.cloud, std::move(reason)}};
    };
    ScanResult result;
    result.capture = capture;
    // A scan that started elsewhere: its y counts from there.
    const Eigen::Vector3d commanded(0.0, capture.y_mm - reference_y_mm_, 0.0);
    if (commanded.y() != 0.0) {
      const Eigen::Vector3d in_cloud = options.scan_model == ScanModel::Rigid
                                           ? Eigen::Vector3d(options.machine_from_profiler.transpose() * commanded)
                                           : commanded;
      for (Eigen::Vector3d& p : cloud.points_mm) p += in_cloud;
    }
    result.registration = registerToSurface(cloud, target, options);
    RegistrationResult& r = result.registration;
    r.commanded_mm = commanded;
    const bool degenerate = r.status == FitStatus::Degenerate;
    if (!r.usable() && !degenerate) {
      return reject(fmt::format("{}: {}", capture.cloud, r.message));
    }
    if (r.translation_mm.norm() > options_.search_mm) {
      return reject(
          fmt::format("{}: the scan fits the reference only {:.1f} mm away from where it was taken, on {:.0f} % of the "
                      "surface; allowed: {:.1f} mm. Something lies over it, or it is another artefact.",
                      capture.cloud, r.translation_mm.norm(), 100.0 * r.overlap * r.inliers, options_.search_mm));
    }
    const CellGrid grid = compressCloud(cloud);
    const Eigen::Vector2d size = extentOf(grid).size;
    if ((size - 1.3 * reference_extent_.size).maxCoeff() > 2.0) {
      if (const auto gap = twoSurfaces(grid)) {
        return reject(
            fmt::format("{} holds two separate surfaces ({}); allowed: one artefact per cloud.", capture.cloud, *gap));
      }
    }
    const auto warn = [&](std::string sentence) {
      result.warnings.push_back(fmt::format("{}: {}", capture.cloud, sentence));
    };
    if (r.overlap < 0.9)
      warn(
          fmt::format("covers only {:.0f} % of the reference (cut short or hidden); evaluated with what is there, with "
                      "a larger uncertainty.",
                      100.0 * r.overlap));
    if (r.inliers < 0.85)
      warn(fmt::format(
          "{:.0f} % of the surface does not agree with the reference (something lay in the way?) and was left out.",
          100.0 * (1.0 - r.inliers)));
    if (r.misfit_ratio > 4.0)
      warn(
          fmt::format("the surface differs from the reference {:.1f} times more than the noise explains: the artefact "
                      "has changed its shape or the scan model does not fit.",
                      r.misfit_ratio));
    noteFree(result);
    result.axis = axisError(r, mounting_);
    return Outcome{std::move(result), std::nullopt};
  }

  /// Components without information, with the reason.
  static void noteFree(ScanResult& result) {
    RegistrationResult& r = result.registration;
    for (const Component k : all_components) {
      const int i = static_cast<int>(k);
      const double sigma = r.standardUncertainty(i);
      const double limit = isRotation(k) ? blind_rotation_rad : blind_shift_mm;
      if (!std::isfinite(sigma)) {
        result.not_observed.emplace_back(
            k, r.free_directions.empty() ? std::string("the surface does not determine it.")
                                         : fmt::format("the surface leaves it free ({}).", r.free_directions.front()));
      } else if (sigma > limit) {
        const bool by_form = r.free_form && std::sqrt(r.free_form->motion_covariance(i, i)) > 0.5 * sigma;
        result.not_observed.emplace_back(
            k, by_form
                   ? fmt::format("the surface has changed its shape, which leaves it uncertain by {:.0f} {}.",
                                 sigma * (isRotation(k) ? urad_per_rad : um_per_mm), printedUnit(unitOf(k)))
                   : fmt::format(
                         "its standard uncertainty under the scan model {} is {:.0f} {}: the surface has too little "
                         "slope or height to show it.",
                         printedName(r.scan_model), sigma * (isRotation(k) ? urad_per_rad : um_per_mm),
                         printedUnit(unitOf(k))));
        r.covariance.row(i).setZero();
        r.covariance.col(i).setZero();
        r.covariance(i, i) = std::numeric_limits<double>::infinity();
      }
    }
  }

  const Campaign& campaign_;
  const ProfilerMounting& mounting_;
  int travel_;
  bool parallel_ = false;
  std::vector<ScanCapture> captures_;
  std::vector<RejectedCapture> copies_;
  RegistrationOptions options_;
  Extent reference_extent_;
  double reference_y_mm_ = 0.0;  ///< carriage position where the reference scan starts
};

/// Angles of the mounting known from elsewhere: profiler.mounting_angles_rad of machine.json.
std::array<std::optional<std::array<double, 2>>, 3> knownAngles(const MachineDescription& machine) {
  std::array<std::optional<std::array<double, 2>>, 3> out;
  const auto profiler = JsonNode::parse(machine.source.dump(), machine.file.string()).find("profiler");
  const auto angles = profiler ? profiler->find("mounting_angles_rad") : std::nullopt;
  if (!angles) return out;
  constexpr std::array<const char*, 3> names{"alpha", "beta", "gamma"};
  for (std::size_t i = 0; i < names.size(); ++i)
    if (const auto known = angles->find(names[i])) {
      const std::vector<double> v = known->numbers();
      if (v.size() != 2 || std::abs(v[0]) > 0.5 || !(v[1] > 0.0))
        known->reject("two numbers: an angle within 0.5 rad and its standard uncertainty above 0");
      out[i] = {v[0], v[1]};
    }
  return out;
}

ProfilerCalibration calibrationOf(const Campaign& campaign, const ProfilerDescription& profiler, ScanModel model,
                                  const ScanFrame& frame, std::vector<EvaluationWarning>& warnings) {
  CalibrationOptions options;
  options.scan_model = model;
  options.known_angles_rad = knownAngles(campaign.machine);
  std::string reason;
  if (profiler.calibration_cloud.empty() || !profiler.calibration_circle_mm) {
    reason = "machine.json names no calibration_cloud with its calibration_circle";
  } else {
    // A path out of the folder is refused, where a cloud that cannot be used is only told.
    const std::filesystem::path cloud =
        InsideFolder(campaign.folder)
            .path(profiler.calibration_cloud, {campaign.machine.file, "$.profiler.calibration_cloud"});
    try {
      std::array<double, 4> circle = *profiler.calibration_circle_mm;
      const Eigen::Vector3d centre =
          frame.machine_from_scan.transpose() * Eigen::Vector3d(circle[0], circle[1], circle[2]);
      for (std::size_t i = 0; i < 3; ++i) circle[i] = centre[static_cast<Eigen::Index>(i)];
      const ProfilerCalibration c = calibrateProfiler(readCloud(cloud), circle, options);
      if (c.usable()) {
        if (!c.message.empty())
          warnings.emplace_back("Calibration of the profiler: " + c.message, WarningKind::CalibrationLimit);
        return c;
      }
      reason = c.message;
    } catch (const InputError& error) {
      reason = error.what();
    }
  }
  ProfilerCalibration c;
  c.scan_model = model;
  c.covariance.diagonal() << Eigen::Vector3d::Constant(std::pow(options.mounting_angle_rad, 2)),
      Eigen::Vector3d::Constant(100.0);
  c.undetermined = {"alpha_rad", "beta_rad", "gamma_rad", "dx_mm", "dy_mm", "dz_mm"};
  warnings.push_back(fmt::format(
      "The profiler is not calibrated ({}): it is taken as parallel to the machine within {} rad and at the tool's "
      "place within 10 mm; the uncertainties carry that.",
      reason, options.mounting_angle_rad));
  return c;
}

/// What angles of the profiler that nothing determines do to the deviations, and what would help.
void warnUndetermined(ScanEvaluation& evaluation) {
  const ProfilerCalibration& calibration = evaluation.mounting.calibration;
  double worst = 0.0;
  const ScanResult* where = nullptr;
  for (const ScanResult& s : evaluation.scans) {
    const double shift = s.calibration_spread.topRows<3>().rowwise().norm().maxCoeff() * um_per_mm;
    if (shift > worst) {
      worst = shift;
      where = &s;
    }
  }
  if (calibration.undetermined.empty() || where == nullptr || worst < 0.05) return;
  std::vector<std::string> open;
  for (const std::string& key : calibration.undetermined) open.push_back(mountingInWords(key));
  evaluation.warnings.push_back(fmt::format(
      "Angles of the profiler that the calibration leaves open ({}) make up to {:.2g} µm of the stated uncertainty of "
      "a "
      "displacement ({} in {}). An angle measured otherwise, such as with a dial indicator along the axis, goes into "
      "profiler.mounting_angles_rad of machine.json.",
      joinedList(open), worst, where->capture.artefact, where->capture.cycle));
}

/// Scans that no motion explains, in one sentence.
void warnChangesOfShape(ScanEvaluation& evaluation) {
  std::size_t compared = 0, changed = 0;
  const ScanResult* most = nullptr;
  const auto size_mm = [](const ScanResult& s) { return s.registration.free_form->rms_mm(); };
  for (const ScanResult& s : evaluation.scans) {
    if (s.reference) continue;
    ++compared;
    if (!s.registration.free_form) continue;
    ++changed;
    if (most == nullptr || size_mm(s) > size_mm(*most)) most = &s;
  }
  if (most == nullptr) return;
  const RegistrationResult& r = most->registration;
  const Eigen::Matrix<double, 6, 1> sigma = um_per_mm * r.free_form->motion_covariance.diagonal().cwiseSqrt();
  evaluation.warnings.push_back(fmt::format(
      "No motion under the scan model {} explains {} of {} scans: the surface has changed its shape, by {:.2g} µm rms "
      "in {} {}. The change is found as a free-form field beside the motion; the part that a motion could explain as "
      "well is in the uncertainty of the deviations (in that scan ± {:.2g} µm).",
      printedName(evaluation.scan_model), changed, compared, um_per_mm * size_mm(*most), most->capture.artefact,
      most->capture.cycle, sigma.head<3>().maxCoeff()));
}

/// Keys of the machine file that the errors of the axis depend on, and what holds without them.
void tellUnstated(const MachineDescription& machine, std::vector<EvaluationWarning>& warnings) {
  if (!machine.source.is_object() || !machine.source.contains("profiler")) return;
  const nlohmann::json& profiler = machine.source.at("profiler");
  std::vector<std::string> zero;
  for (const char* key : {"lever_mm", "lift_mm"})
    if (!profiler.contains(key)) zero.emplace_back(key);
  if (!zero.empty())
    warnings.push_back(fmt::format(
        "machine.json states no {} of the profiler: 0 mm is taken, and errors of the axis that tilt with the slide are "
        "those at the tool frame, not at the origin of the slide.",
        joinedList(zero, "or")));
  if (!profiler.contains("scan_model"))
    warnings.push_back(std::string("machine.json states no scan_model of the profiler: rigid is taken."));
}

}  // namespace

double ScanResult::standardUncertaintyAtArtefact(int i) const {
  return std::sqrt(registration.covariance(i, i) + calibration_spread.row(i).squaredNorm());
}

ScanEvaluation evaluateScanCampaign(const Campaign& campaign, const std::string& scan_model, JobContext& job) {
  std::vector<ScanCapture> captures = readScanList(campaign);
  std::erase_if(captures, [&](const ScanCapture& c) { return campaign.excluded_captures.contains(c.cloud); });
  if (captures.empty())
    throw InputError({campaign.path("captures/scans.csv"), ""}, "has no scans left: all are excluded.");
  if (!campaign.machine.profiler)
    throw InputError({campaign.machine.file, "$.profiler"}, "is missing; scans cannot be evaluated without it.");
  const ProfilerDescription& profiler = *campaign.machine.profiler;
  const ScanFrame frame = ScanFrame::of(campaign.machine);
  ScanEvaluation evaluation;
  evaluation.axis = frame.axis;
  evaluation.machine_from_scan = frame.machine_from_scan;
  evaluation.scan_model = scanModelFromString(scan_model.empty() ? profiler.scan_model : scan_model);
  job.report(0.0, "calibrating the profiler");
  evaluation.mounting.lift_mm = profiler.lift_mm;
  evaluation.mounting.lever_mm = frame.machine_from_scan.transpose() * profiler.lever_mm;
  tellUnstated(campaign.machine, evaluation.warnings);
  evaluation.mounting.calibration =
      calibrationOf(campaign, profiler, evaluation.scan_model, frame, evaluation.warnings);

  std::vector<std::string> order;
  std::map<std::string, std::vector<ScanCapture>> by_artefact;
  for (const ScanCapture& c : captures) {
    if (!by_artefact.contains(c.artefact)) order.push_back(c.artefact);
    by_artefact[c.artefact].push_back(c);
  }
  std::vector<std::unique_ptr<ArtefactEvaluator>> evaluators;
  for (const std::string& id : order)
    evaluators.push_back(std::make_unique<ArtefactEvaluator>(campaign, evaluation.mounting, evaluation.scan_model,
                                                             frame.travel, by_artefact[id]));
  std::mutex mutex;
  std::size_t done = 0;
  const bool many = evaluators.size() >= threadCount();
  const auto run = [&](std::size_t i) {
    evaluators[i]->run(job, !many);
    const std::scoped_lock lock(mutex);
    job.report(static_cast<double>(++done) / static_cast<double>(evaluators.size()), "registering scans");
  };
  if (many) {
    parallelFor(evaluators.size(), job, run);
  } else {
    for (std::size_t i = 0; i < evaluators.size(); ++i) run(i);
  }
  for (auto& e : evaluators) {
    for (ScanResult& s : e->scans) evaluation.scans.push_back(std::move(s));
    for (RejectedCapture& r : e->rejected) evaluation.rejected.push_back(std::move(r));
  }
  std::stable_sort(evaluation.scans.begin(), evaluation.scans.end(),
                   [](const ScanResult& a, const ScanResult& b) { return a.capture.time_s < b.capture.time_s; });
  for (ScanResult& s : evaluation.scans) {
    s.calibration_spread = calibrationSpread(s.registration, evaluation.mounting.calibration);
    frame.intoMachine(s);
  }
  warnChangesOfShape(evaluation);
  warnUndetermined(evaluation);
  for (const ScanResult& s : evaluation.scans)
    for (const std::string& w : s.warnings) evaluation.warnings.push_back(w);
  return evaluation;
}

}  // namespace spindrift
