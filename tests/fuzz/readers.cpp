// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/readers.h"

#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/base/error.h"

namespace spindrift::testing {
namespace {

struct Scratch {
  Scratch() {
    const std::filesystem::path memory("/dev/shm");
    const std::filesystem::path parent =
        std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
    folder = parent / ("spindrift-readers-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  std::filesystem::path folder;
};

}  // namespace

std::string sentenceOf(const Reader& reader, std::string_view bytes) {
  std::string sentence;
  try {
    reader.read(bytes);
    return {};
  } catch (const InputError& error) {
    sentence = error.what();
  }
  if (sentence.empty() || sentence.find_first_of(std::string_view("\n\r\0", 3)) != std::string::npos)
    throw std::logic_error("not one sentence: \"" + sentence + "\"");
  (void)nlohmann::json(sentence).dump();  // throws unless it is UTF-8
  return sentence;
}

std::filesystem::path scratchFile(const std::string& name, std::string_view bytes) {
  static const Scratch scratch;
  const std::filesystem::path file = scratch.folder / name;
  if (name.find('/') != std::string::npos) std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return file;
}

std::string smallMachine() {
  return R"({"format":"spindrift-machine","version":1,"name":"m","chain":"V [w-C'-X'-b-Y-Z-(C1)-t]",
"axes":[{"name":"X","travel_mm":[0,300]},{"name":"Y","travel_mm":[0,300]},{"name":"Z","travel_mm":[0,300]}],
"rotary":[{"name":"C","centre_mm":[150,45,0]}],"points":[{"id":"F1","kind":"fiducial","x_mm":1,"y_mm":2,"z_mm":3},
{"id":"F2","kind":"fiducial","x_mm":200,"y_mm":2,"z_mm":3}],
"temperature_sensors":[{"name":"T_column_degC","place":"column front","role":"column_front"}],
"styli":[{"id":"p0","radius_mm":2,"offset_mm":[0,0,-100]}],
"artefacts":[{"id":"bar","kind":"hole_bar","nominal_positions_mm":[0,50,100],"reference_hole":"H1",
"reference_in_table_mm":[10,0,0],"direction_at_c0":[1,0,0],"hole_diameter_mm":10}]})";
}

}  // namespace spindrift::testing
