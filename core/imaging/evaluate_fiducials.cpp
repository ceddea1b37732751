// SPDX-License-Identifier: Apache-2.0
#include "core/imaging/evaluate_fiducials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/imaging/fiducial_displacement.h"
#include "core/math/known_values.h"

namespace spindrift {
namespace {

nlohmann::json withSigma(double value, double sigma) {
  return {{"value", jsonNumber(value)}, {"standard_uncertainty", jsonNumber(sigma)}};
}

nlohmann::json pair(const Eigen::Vector2d& v) {
  return {jsonNumber(v.x()), jsonNumber(v.y())};
}

nlohmann::json centreJson(const SetCentre& c) {
  return {{"x_px", withSigma(c.centre_px.x(), c.centre_sigma_px.x())},
          {"y_px", withSigma(c.centre_px.y(), c.centre_sigma_px.y())},
          {"own_px", pair(c.own_centre_px)},
          {"own_sigma_px", jsonNumber(c.own_centre_sigma_px)},
          {"algebraic_px", c.algebraic_centre_px ? pair(*c.algebraic_centre_px) : nlohmann::json()},
          {"algebraic_tracks", c.algebraic_tracks},
          {"x_fcf_um", withSigma(c.place_um.x(), c.place_sigma_um)},
          {"y_fcf_um", withSigma(c.place_um.y(), c.place_sigma_um)},
          {"rms_um", jsonNumber(c.rms_um)}};
}

/// The paper's circles (P0 (6)-(9)) on the measured tracks beside the joint evaluation: what their bias is here.
nlohmann::json algebraicJson(const CentreResult& centres, double pixel_length_um) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Vector2d squares = Eigen::Vector2d::Zero();
  double count = 0.0;
  for (const SetCentre& c : centres.sets) {
    if (!c.algebraic_centre_px) continue;
    const Eigen::Vector2d difference = (*c.algebraic_centre_px - c.centre_px) * pixel_length_um;
    sum += difference;
    squares += difference.cwiseAbs2();
    count += 1.0;
  }
  if (count == 0.0) return nullptr;
  const Eigen::Vector2d mean = sum / count;
  const Eigen::Vector2d spread = (squares / count - mean.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
  return {{"sets", count}, {"mean", pair(mean)}, {"standard_deviation", pair(spread)}};
}

nlohmann::json axisJson(const AxisDirection& a) {
  if (!a.measured) return nullptr;
  return {{"fcf_rad", withSigma(a.angle_rad, a.sigma_rad)},
          {"image_rad", withSigma(a.image_angle_rad, a.sigma_rad)},
          {"scale_error", withSigma(a.scale_error, a.scale_error_sigma)}};
}

nlohmann::json directionsJson(const SetDirections& d) {
  nlohmann::json out{{"x_axis", axisJson(d.x)}, {"y_axis", axisJson(d.y)}, {"orthogonality_urad", nullptr}};
  if (d.both) {
    out["orthogonality_urad"] = withSigma(d.orthogonality_rad * urad_per_rad, d.orthogonality_sigma_rad * urad_per_rad);
  }
  out["fcf_in_machine_rad"] = withSigma(d.psi_rad, d.psi_sigma_rad);
  return out;
}

nlohmann::json focusJson(const FocusSet& set, const FocusPeak& peak) {
  nlohmann::json curve = nlohmann::json::array();
  for (std::size_t i = 0; i < set.height_mm.size(); ++i) {
    curve.push_back({{"z_mm", set.height_mm[i]}, {"contrast", jsonNumber(set.normalised[i])}});
  }
  return {{"peak_z_um", withSigma(peak.peak_um, peak.sigma_um)}, {"curve", curve}};
}

nlohmann::json stateJson(const FiducialState& s, const FiducialDisplacement& d) {
  nlohmann::json out{{"state", s.state}, {"time_s", s.time_s}, {"reference", s.reference}};
  out["centre_of_rotation"] = s.centre ? centreJson(d.centres.sets[*s.centre]) : nlohmann::json();
  out["axis_directions"] = s.directions ? directionsJson(d.axes.sets[*s.directions]) : nlohmann::json();
  out["focus"] = s.focus_set ? focusJson(d.focus_sets[*s.focus_set], d.focus.peaks[*s.focus_set]) : nlohmann::json();
  out["EX_um"] = s.xy_um ? withSigma(s.xy_um->x(), s.xy_sigma_um.x()) : nlohmann::json();
  out["EY_um"] = s.xy_um ? withSigma(s.xy_um->y(), s.xy_sigma_um.y()) : nlohmann::json();
  out["EZ_um"] = s.z_um ? withSigma(*s.z_um, s.z_sigma_um) : nlohmann::json();
  return out;
}

/// Mean over the fiducials and states that tell it; null if none does.
nlohmann::json orthogonalityJson(const FiducialDisplacement& d) {
  std::vector<double> values, sigmas;
  for (const FiducialState& s : d.states) {
    if (!s.directions || !d.axes.sets[*s.directions].both) continue;
    const SetDirections& axes = d.axes.sets[*s.directions];
    values.push_back(axes.orthogonality_rad * urad_per_rad);
    sigmas.push_back(std::max(1e-6, axes.orthogonality_sigma_rad * urad_per_rad));
  }
  if (values.empty()) return nullptr;
  const WeightedMean mean = weightedMean(values, sigmas);
  return withSigma(mean.value, mean.sigma);
}

nlohmann::json detailsOf(const FiducialCaptureList& list, const FiducialImages& images, const FiducialDisplacement& d) {
  nlohmann::json fiducials = nlohmann::json::array();
  for (const std::string& fiducial : list.fiducials()) {
    nlohmann::json entry{{"fiducial", fiducial}, {"states", nlohmann::json::array()}, {"fcf_in_machine_rad", nullptr}};
    for (const FiducialDirection& direction : d.directions) {
      if (direction.fiducial == fiducial) {
        entry["fcf_in_machine_rad"] = withSigma(direction.psi_rad, direction.sigma_rad);
      }
    }
    for (const FiducialState& s : d.states) {
      if (s.fiducial != fiducial) continue;
      entry["x_mm"] = s.position_mm.x();
      entry["y_mm"] = s.position_mm.y();
      entry["z_mm"] = s.position_mm.z();
      entry["states"].push_back(stateJson(s, d));
    }
    fiducials.push_back(entry);
  }
  double pixel_length = 0.0;
  double count = 0.0;
  for (const FiducialImage& image : images.images) {
    if (!image.usable || image.pose.marks == 0) continue;
    pixel_length += image.pose.pixelLength_um();
    count += 1.0;
  }
  nlohmann::json camera{{"width_px", images.width},
                        {"height_px", images.height},
                        {"pixel_length_um", count > 0.0 ? jsonNumber(pixel_length / count) : nlohmann::json()},
                        {"k1_per_px2", withSigma(images.k1_per_px2, images.k1_sigma_per_px2)},
                        {"direction_rad", nullptr}};
  if (d.axes.status == FitStatus::Converged) {
    camera["direction_rad"] = withSigma(d.axes.phi_rad, d.axes.phi_sigma_rad);
    camera["direction_pooled"] = d.axes.pooled;
    camera["direction_p_value"] = jsonNumber(d.axes.p_value);
    camera["position_repeatability_um"] = jsonNumber(d.axes.repeatability_um);
    camera["position_repeatability_standard_uncertainty_um"] = jsonNumber(d.axes.repeatability_sigma_um);
  }
  nlohmann::json centre{{"status", toString(d.centres.status)}};
  if (d.centres.status == FitStatus::Converged) {
    centre["pooling"] = toString(d.centres.pooling);
    centre["p_value_all"] = jsonNumber(d.centres.p_value_all);
    centre["p_value_per_state"] = jsonNumber(d.centres.p_value_per_state);
    centre["spindle_repeatability_um"] = jsonNumber(d.centres.repeatability_um);
    centre["spindle_repeatability_standard_uncertainty_um"] =
        jsonNumber(d.centres.repeatability_um / std::sqrt(2.0 * std::max(d.centres.degrees_of_freedom, 1.0)));
    centre["degrees_of_freedom"] = d.centres.degrees_of_freedom;
    if (count > 0.0) centre["algebraic_minus_joint_um"] = algebraicJson(d.centres, pixel_length / count);
  }
  nlohmann::json focus{{"status", toString(d.focus.status)}};
  if (d.focus.status == FitStatus::Converged) {
    focus["relative_noise"] = jsonNumber(d.focus.relative_noise);
    focus["degrees_of_freedom"] = d.focus.degrees_of_freedom;
    focus["shape_per_mm"] = {d.focus.shape(0), d.focus.shape(1), d.focus.shape(2)};
  }
  return {{"fiducials", fiducials},
          {"camera", camera},
          {"orthogonality_urad", orthogonalityJson(d)},
          {"centre_of_rotation", centre},
          {"contrast_curve", focus}};
}

std::string summaryOf(const FiducialDisplacement& d) {
  std::string text = "fiducial  state     EX / µm            EY / µm            EZ / µm\n";
  for (const FiducialState& s : d.states) {
    const auto isOwn = [&](const std::optional<std::size_t>& of) { return of && &d.states[*of] == &s; };
    const auto cell = [](bool own, bool there, double value, double sigma) {
      if (own) return std::string("reference");
      return there ? withUncertainty(value, sigma, "") : std::string("-");
    };
    // Widths count characters, not bytes of the signs.
    const auto padded = [](std::string cell_text, std::size_t width) {
      std::size_t length = 0;
      for (const char c : cell_text) length += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U ? 1 : 0;
      if (length < width) cell_text.append(width - length, ' ');
      return cell_text;
    };
    if (isOwn(s.xy_reference) && isOwn(s.z_reference)) {
      text += padded(s.fiducial, 10) + padded(s.state, 10) + "reference\n";
      continue;
    }
    text +=
        padded(s.fiducial, 10) + padded(s.state, 10) +
        padded(cell(isOwn(s.xy_reference), s.xy_um.has_value(), s.xy_um ? s.xy_um->x() : 0.0, s.xy_sigma_um.x()), 19) +
        padded(cell(isOwn(s.xy_reference), s.xy_um.has_value(), s.xy_um ? s.xy_um->y() : 0.0, s.xy_sigma_um.y()), 19) +
        cell(isOwn(s.z_reference), s.z_um.has_value(), s.z_um.value_or(0.0), s.z_sigma_um) + "\n";
  }
  if (d.centres.status == FitStatus::Converged) {
    text += fmt::format("centre of rotation: {}; the spindle repeats to {:.2f} µm\n", toString(d.centres.pooling),
                        d.centres.repeatability_um);
  }
  return text;
}

}  // namespace

std::shared_ptr<const FiducialPattern> campaignPattern(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "pattern.json";
  if (!folder.empty() && std::filesystem::exists(file))
    return std::make_shared<const FiducialPattern>(readPattern(file));
  // The standard one lives as long as the program: a pointer that owns nothing keeps its address, which decoding knows.
  return {std::shared_ptr<const FiducialPattern>(), &standardPattern()};
}

InstrumentEvaluation evaluateFiducials(const Campaign& campaign, JobContext& job) {
  const auto file = campaign.captureList("fiducials.csv");
  if (!file) throw InputError({campaign.path("captures/fiducials.csv"), ""}, "is not there.");
  FiducialCaptureList list = readFiducialCaptures(*file);
  std::erase_if(list.captures, [&](const FiducialCapture& c) { return campaign.excluded_captures.contains(c.image); });
  const FiducialImages images =
      measureFiducialImages(campaign.folder, list, *campaignPattern(campaign.folder), job.part(0.0, 0.95));
  const FiducialDisplacement displacement = findFiducialDisplacement(list, images, campaign.machine);
  InstrumentEvaluation evaluation;
  evaluation.instrument = "microscope";
  evaluation.observations = displacement.observations;
  evaluation.rejected = images.rejected;
  evaluation.rejected.insert(evaluation.rejected.end(), displacement.rejected.begin(), displacement.rejected.end());
  evaluation.warnings.assign(displacement.warnings.begin(), displacement.warnings.end());
  for (const ImplausibleReading& reading : displacement.implausible) rejectReading(reading, evaluation);
  evaluation.details = detailsOf(list, images, displacement);
  evaluation.summary = summaryOf(displacement);
  // What was captured for and is not there in any state leaves its part of the answer open.
  std::vector<std::string> open;
  const auto asked = [&](CaptureRole role) {
    return std::any_of(list.captures.begin(), list.captures.end(),
                       [&](const FiducialCapture& c) { return c.role == role; });
  };
  const auto known = [&](const auto& has) {
    return std::any_of(displacement.states.begin(), displacement.states.end(),
                       [&](const FiducialState& s) { return !s.reference && has(s); });
  };
  const bool in_plane = known([](const FiducialState& s) { return s.xy_um.has_value(); });
  const bool along_z = known([](const FiducialState& s) { return s.z_um.has_value(); });
  if (asked(CaptureRole::Rotation) && !in_plane) open.insert(open.end(), {"X", "Y"});
  if (asked(CaptureRole::Focus) && !along_z) open.emplace_back("Z");
  const bool nothing = !in_plane && !along_z;
  if (nothing) open = {"X", "Y", "Z"};
  if (!open.empty() && list.states().size() > 1) {
    evaluation.good_enough = evaluation.good_enough && !nothing;
    evaluation.warnings.push_back(fmt::format(
        "No displacement in {} could be measured: see the rejected captures and the notes.", joinedList(open)));
  }
  if (evaluation.observations.rows.empty()) {
    evaluation.good_enough = false;
    if (list.states().size() <= 1) evaluation.warnings.emplace_back("No fiducial could be evaluated.");
  }
  job.report(1.0, "evaluated");
  return evaluation;
}

}  // namespace spindrift
