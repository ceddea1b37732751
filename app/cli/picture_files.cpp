// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/picture_files.h"

#include <fmt/format.h>

#include "core/base/atomic_file.h"

namespace spindrift::cli {

void PictureFiles::addTo(CLI::App& command, std::string_view what) {
  for (const auto& [option, file, kind] :
       {std::tuple{"--svg", &svg, "SVG"}, {"--png", &png, "PNG"}, {"--pdf", &pdf, "PDF"}})
    command.add_option(option, *file, fmt::format("Write {} as {}", what, kind))->type_name("FILE");
}

std::string PictureFiles::write(const Drawing& drawing) const {
  std::string summary;
  const auto put = [&](const std::string& file, auto bytes) {
    if (file.empty()) return;
    writeFileAtomically(file, bytes());
    summary += fmt::format("written: {}\n", file);
  };
  put(svg, [&] { return svgOf(drawing); });
  put(png, [&] { return pngOf(drawing); });
  put(pdf, [&] { return pdfOf(drawing); });
  return summary;
}

}  // namespace spindrift::cli
