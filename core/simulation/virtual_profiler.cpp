// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/virtual_profiler.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/base/csv.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/geometry/rigid_transform.h"
#include "core/scanning/cloud_file.h"

namespace spindrift {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Maps a reading to the true point, for one profile.
class ReadingToPoint {
 public:
  ReadingToPoint(const VirtualProfilerMounting& mounting, double y_mm, const SmallError& error)
      : rotation_(RigidTransform::fromAlphaBetaGamma(mounting.alpha_rad, mounting.beta_rad, mounting.gamma_rad,
                                                     Eigen::Vector3d::Zero())
                      .rotation()) {
    const bool push_broom = mounting.scan_model == "push_broom";
    const Eigen::Vector3d in_plane = push_broom ? mounting.offset_mm : mounting.offset_mm + y_mm * rotation_.col(1);
    const Eigen::Vector3d nominal = push_broom ? in_plane + Eigen::Vector3d(0.0, y_mm, 0.0) : in_plane;
    const Eigen::Vector3d arm = mounting.lever_mm - Eigen::Vector3d(0.0, 0.0, mounting.lift_mm) + in_plane;
    const Eigen::Matrix3d turned = Eigen::Matrix3d::Identity() + crossMatrix(error.rotation_rad);
    along_x_ = turned * rotation_.col(0);
    along_z_ = turned * rotation_.col(2);
    origin_ = nominal + error.translation_mm + error.rotation_rad.cross(arm);
  }
  [[nodiscard]] Eigen::Vector3d operator()(double x_mm, double z_mm) const {
    return origin_ + x_mm * along_x_ + z_mm * along_z_;
  }
  [[nodiscard]] const Eigen::Vector3d& alongZ() const noexcept { return along_z_; }

 private:
  Eigen::Matrix3d rotation_;
  Eigen::Vector3d along_x_;
  Eigen::Vector3d along_z_;
  Eigen::Vector3d origin_;
};

/// White noise plus a moving average along the profile.
class ReadingNoise {
 public:
  ReadingNoise(const VirtualOptics& optics, Random& random) : optics_(optics), random_(random) {
    window_.resize(static_cast<std::size_t>(std::max(1, optics.speckle_points)));
    for (double& w : window_) w = random_.normal();
  }
  [[nodiscard]] double next_mm() {
    window_[next_] = random_.normal();
    next_ = (next_ + 1) % window_.size();
    double sum = 0.0;
    for (const double w : window_) sum += w;
    const double speckle = optics_.speckle_noise_um * sum / std::sqrt(static_cast<double>(window_.size()));
    return mm_per_um * (optics_.white_noise_um * random_.normal() + speckle);
  }

 private:
  const VirtualOptics& optics_;
  Random& random_;
  std::vector<double> window_;
  std::size_t next_ = 0;
};

void addProfile(PointCloud& cloud, std::size_t before) {
  if (cloud.size() > before) cloud.profile_start.push_back(before);
}

/// Height of an artefact, bent or not, in its frame.
double heightOf(const VirtualArtefact& artefact, double x, double y) {
  const double flat = artefact.surface.height_mm(x, y);
  if (!artefact.bending) return flat;
  constexpr double step = 1e-3;
  const double tilt_x = (artefact.bending(x + step, y) - artefact.bending(x - step, y)) / (2.0 * step);
  const double tilt_y = (artefact.bending(x, y + step) - artefact.bending(x, y - step)) / (2.0 * step);
  return artefact.surface.height_mm(x + flat * tilt_x, y + flat * tilt_y) + artefact.bending(x, y);
}

double profileX(const VirtualOptics& optics, int i) {
  return (i - optics.profile_points / 2) * optics.profile_interval_mm;
}

}  // namespace

void VirtualOptics::validate() const {
  const auto require = [](bool good, const char* sentence) {
    if (!good) throw InputError(sentence);
  };
  require(profile_points >= 2, "The virtual profiler needs at least 2 points per profile.");
  require(profile_interval_mm > 0.0 && profile_spacing_mm > 0.0,
          "The spacings of the virtual profiler must be positive (mm).");
  constexpr double most_points_per_mm = 1e6;
  require(
      profile_points / profile_spacing_mm <= most_points_per_mm,
      "The virtual profiler takes more than a million points per mm; allowed: fewer points in a profile or profiles "
      "further apart.");
  require(white_noise_um >= 0.0 && speckle_noise_um >= 0.0 && position_jitter_um >= 0.0 && position_error_um >= 0.0,
          "The noise of the virtual profiler must not be negative (µm).");
  require(speckle_points >= 1, "The correlation length of the speckle noise must be at least 1 point.");
  require(outlier_rate >= 0.0 && outlier_rate <= 1.0 && edge_outlier_rate >= 0.0 && edge_outlier_rate <= 1.0 &&
              lost_rate >= 0.0 && lost_rate <= 1.0,
          "The rates of outliers and lost points must lie between 0 and 1.");
  require(steepest_slope > 0.0, "The steepest slope of the virtual profiler must be positive.");
}

double ArtefactBending::height_mm(const ArtefactSurface& surface, double x_mm, double y_mm, double time_s) const {
  const double s = 2.0 * x_mm / surface.size_mm.x() - 1.0;
  const double t = 2.0 * y_mm / surface.size_mm.y() - 1.0 - held_at;
  const double part = 1.0 - std::exp(-time_s / time_constant_s);
  return part * (along_mm * (t * t + skew * t * t * t) + across_mm * s * s + twist_mm * s * t);
}

PointCloud virtualScan(const VirtualArtefact& artefact, const VirtualProfilerMounting& mounting,
                       const VirtualOptics& optics, const CarriageError& carriage, Random& random) {
  optics.validate();
  artefact.surface.validate();
  PointCloud cloud;
  cloud.name = artefact.id;
  const double cos_yaw = std::cos(artefact.yaw_rad);
  const double sin_yaw = std::sin(artefact.yaw_rad);
  const Eigen::Vector2d half = 0.5 * artefact.surface.size_mm;
  const double reach = half.norm() + 1.0;
  const bool push_broom = mounting.scan_model == "push_broom";
  const SmallError at_start = carriage ? carriage(artefact.y_mm) : SmallError{};
  const double phase = random.uniform() * optics.profile_spacing_mm;
  const double y_centre = artefact.centre_mm.y() - mounting.offset_mm.y();
  for (double y = y_centre - reach + phase; y <= y_centre + reach; y += optics.profile_spacing_mm) {
    const double recorded_y = y + mm_per_um * optics.position_jitter_um * random.normal();
    const double actual_y = recorded_y + mm_per_um * optics.position_error_um * random.normal();
    const SmallError error = push_broom && carriage ? carriage(artefact.y_mm + actual_y) : at_start;
    const ReadingToPoint point_of(mounting, actual_y, error);
    ReadingNoise noise(optics, random);
    const std::size_t before = cloud.size();
    double z = 0.0;
    for (int i = 0; i < optics.profile_points; ++i) {
      const double x = profileX(optics, i);
      if (std::abs(point_of(x, z).x() - artefact.centre_mm.x()) > reach) continue;
      double u = 0.0, v = 0.0;
      for (int iteration = 0; iteration < 5; ++iteration) {
        const Eigen::Vector3d p = point_of(x, z) - artefact.centre_mm;
        u = cos_yaw * p.x() + sin_yaw * p.y() + half.x();
        v = -sin_yaw * p.x() + cos_yaw * p.y() + half.y();
        const Eigen::Vector2d g = artefact.surface.gradient(u, v);
        const Eigen::Vector3d& dz = point_of.alongZ();
        const double slope =
            dz.z() - g.x() * (cos_yaw * dz.x() + sin_yaw * dz.y()) - g.y() * (-sin_yaw * dz.x() + cos_yaw * dz.y());
        const double step = (p.z() - heightOf(artefact, u, v)) / slope;
        z -= step;
        if (std::abs(step) < 1e-10) break;
      }
      const double noise_mm = noise.next_mm();
      if (!artefact.surface.contains(u, v)) continue;
      if (artefact.surface.gradient(u, v).cwiseAbs().maxCoeff() > optics.steepest_slope) continue;
      if (random.uniform() < optics.lost_rate) continue;
      const double to_edge = std::min({u, v, artefact.surface.size_mm.x() - u, artefact.surface.size_mm.y() - v});
      const double rate = to_edge < optics.edge_width_mm ? optics.edge_outlier_rate : optics.outlier_rate;
      const double outlier = random.uniform() < rate ? optics.outlier_size_mm * random.normal() : 0.0;
      cloud.points_mm.emplace_back(x, recorded_y, z + noise_mm + outlier);
    }
    addProfile(cloud, before);
  }
  if (!cloud.empty()) cloud.profile_start.push_back(cloud.size());
  return cloud;
}

PointCloud virtualPocketScan(const VirtualPocket& pocket, const VirtualProfilerMounting& mounting,
                             const VirtualOptics& optics, Random& random) {
  optics.validate();
  PointCloud cloud;
  cloud.name = "calibration";
  const auto [cx, cy, top, radius] = pocket.circle_mm;
  for (double y = pocket.scan_from_mm; y < pocket.scan_to_mm - 1e-9; y += pocket.profile_spacing_mm) {
    const ReadingToPoint point_of(mounting, y, SmallError{});
    ReadingNoise noise(optics, random);
    const std::size_t before = cloud.size();
    for (int i = 0; i < optics.profile_points; ++i) {
      const double x = profileX(optics, i);
      // Where the ray meets the plane of the plate decides whether it enters the pocket; inside, it goes on to the
      // floor unless it meets the wall first.
      const auto meet = [&](double height) {
        const double z = (height - point_of(x, 0.0).z()) / point_of.alongZ().z();
        return std::pair{z, point_of(x, z)};
      };
      const auto outside = [&, centre_x = cx, centre_y = cy, r = radius](const Eigen::Vector3d& p) {
        return std::hypot(p.x() - centre_x, p.y() - centre_y) >= r;
      };
      auto [z, p] = meet(top);
      if (!outside(p)) {
        const auto [z_floor, p_floor] = meet(top - pocket.depth_mm);
        z = outside(p_floor) ? nothing : z_floor;  // a wall seen at grazing angle returns nothing
      }
      const double noise_mm = noise.next_mm();
      if (!std::isfinite(z) || random.uniform() < optics.lost_rate) continue;
      const double outlier = random.uniform() < optics.outlier_rate ? optics.outlier_size_mm * random.normal() : 0.0;
      cloud.points_mm.emplace_back(x, y, z + noise_mm + outlier);
    }
    addProfile(cloud, before);
  }
  if (!cloud.empty()) cloud.profile_start.push_back(cloud.size());
  return cloud;
}

namespace {

nlohmann::json profilerEntry(const VirtualScanCampaign& campaign) {
  const VirtualProfilerMounting& m = campaign.mounting;
  return {{"scan_model", m.scan_model},
          {"profile_points", campaign.optics.profile_points},
          {"profile_interval_mm", campaign.optics.profile_interval_mm},
          {"lift_mm", m.lift_mm},
          {"axis", "Y"},
          {"lever_mm", {m.lever_mm.x(), m.lever_mm.y(), m.lever_mm.z()}},
          {"calibration_cloud", "captures/clouds/calibration.pcd"},
          {"calibration_circle", campaign.pocket.circle_mm}};
}

}  // namespace

std::string writeVirtualScans(const VirtualScanCampaign& campaign, const std::filesystem::path& folder,
                              std::uint64_t seed, JobContext& job) {
  if (campaign.artefacts.empty() || campaign.cycles.empty())
    throw InputError("A campaign of scans needs at least one artefact and one cycle.");
  Random random(seed);
  Random pocket_random = random.split();
  const auto write = [&](const PointCloud& cloud, const std::string& name) {
    if (cloud.empty()) throw InputError(fmt::format("The virtual scan {} sees no surface.", name));
    writeCloud(cloud, folder / name);
  };
  write(virtualPocketScan(campaign.pocket, campaign.mounting, campaign.optics, pocket_random),
        "captures/clouds/calibration.pcd");
  std::string list = "time_s,cycle,artefact,y_mm,cloud\n";
  std::size_t done = 0;
  for (const VirtualScanCycle& cycle : campaign.cycles) {
    double time_s = cycle.time_s;
    for (const VirtualArtefact& artefact : campaign.artefacts) {
      job.throwIfCancelled();
      job.report(static_cast<double>(done++) / static_cast<double>(campaign.artefacts.size() * campaign.cycles.size()),
                 "scanning artefacts");
      CarriageError carriage;
      if (campaign.error) carriage = [&campaign, time_s](double y_mm) { return campaign.error(time_s, y_mm); };
      Random own = random.split();
      VirtualArtefact now = artefact;
      if (const auto bends = campaign.bending.find(artefact.id); bends != campaign.bending.end()) {
        now.bending = [&bending = bends->second, &surface = artefact.surface, time_s](double x_mm, double y_mm) {
          return bending.height_mm(surface, x_mm, y_mm, time_s);
        };
      }
      const PointCloud cloud = virtualScan(now, campaign.mounting, campaign.optics, carriage, own);
      const std::string name = fmt::format("captures/clouds/{}_{}.pcd", artefact.id, cycle.name);
      write(cloud, name);
      list += fmt::format("{},{},{},{},{}\n", exactNumber(time_s), csvField(cycle.name), csvField(artefact.id),
                          exactNumber(artefact.y_mm), csvField(name));
      time_s += cycle.seconds_per_artefact;
    }
  }
  writeFileAtomically(folder / "captures/scans.csv", list);
  return profilerEntry(campaign).dump(1);
}

void writeVirtualScanCampaign(const VirtualScanCampaign& campaign, const std::filesystem::path& folder,
                              std::uint64_t seed, JobContext& job) {
  static_cast<void>(writeVirtualScans(campaign, folder, seed, job));
  nlohmann::json points = nlohmann::json::array();
  for (const VirtualArtefact& a : campaign.artefacts)
    points.push_back(
        {{"id", a.id}, {"kind", "surface"}, {"x_mm", 2000.0}, {"y_mm", a.y_mm + a.centre_mm.y()}, {"z_mm", 0.0}});
  const nlohmann::json machine = {{"format", "spindrift-machine"},
                                  {"version", 1},
                                  {"name", "virtual three-axis gantry"},
                                  {"chain", "V [w-b-X-Y-Z-(C)-t]"},
                                  {"axes",
                                   {{{"name", "X"}, {"travel_mm", {0, 4000}}},
                                    {{"name", "Y"}, {"travel_mm", {0, 1800}}},
                                    {{"name", "Z"}, {"travel_mm", {0, 1000}}}}},
                                  {"profiler", profilerEntry(campaign)},
                                  {"points", points}};
  writeFileAtomically(folder / "machine.json", machine.dump(1) + "\n");
  const nlohmann::json head = {
      {"format", "spindrift-campaign"}, {"version", 1}, {"name", campaign.name}, {"start_utc", campaign.start_utc}};
  writeFileAtomically(folder / "campaign.json", head.dump(1) + "\n");
}

}  // namespace spindrift
