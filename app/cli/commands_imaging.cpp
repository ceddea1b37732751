// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <memory>

#include "app/cli/command.h"
#include "core/base/atomic_file.h"
#include "core/base/json_reader.h"
#include "core/base/printed_number.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/imaging/artwork.h"
#include "core/imaging/decoder.h"

namespace spindrift::cli {
namespace {

nlohmann::json decodeJson(const DecodeResult& result) {
  nlohmann::json subpatterns = nlohmann::json::array();
  nlohmann::json circles = nlohmann::json::array();
  if (result.usable()) {
    for (const Subpattern& s : result.subpatterns) {
      subpatterns.push_back({{"row", s.row},
                             {"column", s.column},
                             {"x_px", jsonNumber(s.x_px)},
                             {"y_px", jsonNumber(s.y_px)},
                             {"sigma_px", jsonNumber(s.sigma_px)},
                             {"tilt_rad", jsonNumber(s.tilt_rad)},
                             {"score", jsonNumber(s.score)},
                             {"digit_confidence", jsonNumber(s.digit_confidence)},
                             {"from_neighbours", s.from_neighbours}});
    }
    for (const CircleMark& c : result.circles) {
      circles.push_back({{"i", c.i},
                         {"j", c.j},
                         {"x_px", jsonNumber(c.x_px)},
                         {"y_px", jsonNumber(c.y_px)},
                         {"sigma_px", jsonNumber(c.sigma_px)}});
    }
  }
  const bool usable = result.usable();
  const ExposureStatistics& e = result.exposure;
  nlohmann::json json = {{"status", toString(result.status)},
                         {"pixel_length_um", usable ? jsonNumber(result.map.pixel_length_um) : nullptr},
                         {"pixel_length_sigma_um", usable ? jsonNumber(result.pixel_length_sigma_um) : nullptr},
                         {"tilt_rad", usable ? jsonNumber(result.map.tilt_rad) : nullptr},
                         {"k1_per_px2", usable ? jsonNumber(result.map.k1_per_px2) : nullptr},
                         {"k1_sigma_per_px2", usable ? jsonNumber(result.k1_sigma_per_px2) : nullptr},
                         {"mirrored", usable && result.map.mirrored},
                         {"map_rms_px", usable ? jsonNumber(result.map_rms_px) : nullptr},
                         {"subpatterns", subpatterns},
                         {"circles", circles},
                         {"exposure",
                          {{"dark_level", e.dark_level},
                           {"bright_level", e.bright_level},
                           {"mean_level", jsonNumber(e.mean_level)},
                           {"saturated_fraction", jsonNumber(e.saturated_fraction)},
                           {"noise_level", jsonNumber(e.noise_level)},
                           {"blur_sigma_px", jsonNumber(e.blur_sigma_px)},
                           {"contrast", jsonNumber(e.contrast)}}},
                         {"elapsed_ms", jsonNumber(result.elapsed_ms)}};
  if (!usable) json["reason"] = result.message;
  return json;
}

std::string decodeSummary(const DecodeResult& result, const std::string& image) {
  if (!result.usable()) return fmt::format("{}: {}.", image, result.message);
  int doubtful = 0;
  double sigma = 0.0;
  for (const Subpattern& s : result.subpatterns) {
    doubtful += s.from_neighbours ? 1 : 0;
    sigma += s.sigma_px / static_cast<double>(result.subpatterns.size());
  }
  std::string text = fmt::format(
      "{}: {} ellipses ({} numbered by their neighbours) and {} circles in {:.1f} ms\n"
      "pixel length {}, turned by {:.3f}°{}\n"
      "centres known to {:.4f} px on average; blur {:.2f} px, contrast {:.0f} and noise {:.1f} grey levels\n",
      image, result.subpatterns.size(), doubtful, result.circles.size(), result.elapsed_ms,
      withUncertainty(result.map.pixel_length_um, result.pixel_length_sigma_um, "um"),
      printed(result.map.tilt_rad * deg_per_rad), result.map.mirrored ? ", mirrored" : "", sigma,
      result.exposure.blur_sigma_px, result.exposure.contrast, result.exposure.noise_level);
  text += "row column    x / px    y / px    u / px\n";
  for (const Subpattern& s : result.subpatterns) {
    text += fmt::format("{:>3} {:>6} {:>9.3f} {:>9.3f} {:>9.4f}\n", s.row, s.column, printed(s.x_px), printed(s.y_px),
                        printed(s.sigma_px));
  }
  return text;
}

void addDecode(CLI::App& app, CommandLine& line) {
  struct Arguments {
    std::string image;
    std::string pattern;
    std::string overlay;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = addCommand(
      app, line, "decode",
      "Find the numbered ellipses and circles of a fiducial in a microscope image.\nGives row and column, centre (px, "
      "centre of the top-left pixel is 0, 0) with standard uncertainty and direction\n(rad) of every ellipse wholly in "
      "view, and the pixel length (µm). Exit status 1: no pattern found, with the reason.",
      [arguments](JobContext&) {
        const FiducialPattern own = arguments->pattern.empty() ? FiducialPattern{} : readPattern(arguments->pattern);
        const FiducialPattern& pattern = arguments->pattern.empty() ? standardPattern() : own;
        const GrayImage image = readImage(arguments->image);
        const DecodeResult result = decodeImage(image, pattern);
        if (!arguments->overlay.empty()) {
          writeFileAtomically(arguments->overlay, encodePng(decodeOverlay(image, pattern, result)));
        }
        CommandResult answer;
        answer.json = decodeJson(result);
        answer.summary = decodeSummary(result, arguments->image);
        answer.exit_status = result.usable() ? Done : NotGoodEnough;
        return answer;
      });
  command->add_option("IMAGE", arguments->image, "Microscope image: JPEG, PNG, TIFF, BMP or PGM")->required();
  command->add_option("--pattern", arguments->pattern, "Artwork (pattern.json); default: the standard pattern")
      ->type_name("FILE");
  command->add_option("--overlay", arguments->overlay, "Write the image with the detected features as an overlay (PNG)")
      ->type_name("FILE");
}

void addArtwork(CLI::App& app, CommandLine& line) {
  struct Arguments {
    ArtworkOptions options;
    std::string pattern, json_out, svg, dxf;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = addCommand(
      app, line, "artwork",
      "Write the artwork of a custom fiducial: pattern.json for decode and evaluate, SVG and DXF for the mask shop.\n"
      "All sizes of the standard artwork are scaled with the pitch.",
      [arguments](JobContext&) {
        if (arguments->json_out.empty() && arguments->svg.empty() && arguments->dxf.empty()) {
          throw InputError("nothing to write: give at least one of --pattern-out, --svg and --dxf.");
        }
        const FiducialPattern pattern =
            arguments->pattern.empty() ? makePattern(arguments->options) : readPattern(arguments->pattern);
        CommandResult answer;
        std::vector<std::string> written;
        const auto write = [&](const std::string& file, const std::string& text) {
          if (file.empty()) return;
          writeFileAtomically(file, text);
          written.push_back(file);
        };
        write(arguments->json_out, patternJson(pattern));
        write(arguments->svg, arguments->svg.empty() ? "" : artworkSvg(pattern));
        write(arguments->dxf, arguments->dxf.empty() ? "" : artworkDxf(pattern));
        answer.json = {{"rows", {pattern.first_row, pattern.last_row}},
                       {"columns", {pattern.first_column, pattern.last_column}},
                       {"pitch_um", pattern.pitch_um},
                       {"files", written}};
        answer.summary =
            fmt::format("{} x {} ellipses on a pitch of {} µm ({:.4g} x {:.4g} mm): wrote {}", pattern.rowCount(),
                        pattern.columnCount(), pattern.pitch_um, pattern.columnCount() * pattern.pitch_um * mm_per_um,
                        pattern.rowCount() * pattern.pitch_um * mm_per_um, joinedList(written));
        return answer;
      });
  ArtworkOptions& o = arguments->options;
  command->add_option("--rows", o.rows, "Rows of ellipses")->capture_default_str();
  command->add_option("--columns", o.columns, "Columns of ellipses")->capture_default_str();
  command->add_option("--first-row", o.first_row, "Number of the first row, 10 ... 99")->capture_default_str();
  command->add_option("--first-column", o.first_column, "Number of the first column, 10 ... 99")->capture_default_str();
  command->add_option("--pitch", o.pitch_um, "Pitch of the ellipses in µm")->capture_default_str();
  command->add_option("--pattern", arguments->pattern, "Draw this pattern.json instead")->type_name("FILE");
  command->add_option("--pattern-out", arguments->json_out, "Write the pattern (JSON)")->type_name("FILE");
  command->add_option("--svg", arguments->svg, "Write the drawing as SVG (user unit: 1 µm)")->type_name("FILE");
  command->add_option("--dxf", arguments->dxf, "Write the drawing as DXF release 12 (mm)")->type_name("FILE");
}

}  // namespace

void addImagingCommands(CLI::App& app, CommandLine& line) {
  addDecode(app, line);
  addArtwork(app, line);
}

}  // namespace spindrift::cli
