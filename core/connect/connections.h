// SPDX-License-Identifier: Apache-2.0
// connections.json: which sources there are, and which of their data items become which columns of log.csv.
//
// {"format":"spindrift-connections","version":1,
//  "sources":[{"name":"mill","kind":"mtconnect","url":"http://192.168.1.20:5000"}, and
//    {"name":"hall","kind":"mqtt","url":"mqtts://broker:8883","user":"me","password_env":"HALL_PASSWORD","ca_file":...,
//     "client_id":...,"will":{"topic":...,"text":...},"ask_rebirth":true},
//    {"name":"pt100","kind":"modbus","url":"modbus://192.168.1.30:502" or "rtu:///dev/ttyUSB0","unit_id":1,
//     "interval_s":1,"baud":9600,"parity":"none","stop_bits":1},
//    {"name":"logger","kind":"text","url":"serial:///dev/ttyS0" or "tcp://host:port","line":"T1={a} T2={b}",
//     "save":"touches.txt","baud":9600,"decimal_comma":false},
//    {"name":"lathe","kind":"linuxcnc","url":"linuxcnc://127.0.0.1:5007","password_env":"SHELL_PASSWORD"},
//    {"name":"microscope","kind":"genicam","url":"genicam:Fake_1","exposure_us":5000,"gain":2,"trigger":"Software",
//     "region":[0,0,256,256]}],
//  "columns":[{"column":"T_spindle_degC","source":"mill","item":"Tspindle","unit":"FAHRENHEIT","scale":1,"offset":0,
//    "dead_band":0.05,"reduce":"mean","role":"spindle_housing"},
//    {"column":"coolant","source":"mill","item":"cool","values":{"ON":1,"OFF":0},"otherwise":0}],
//  "interval_s":1,"settle_s":2,"longest_s":60,"rotate_mb":256}
// value = scale * (value in the unit of the column) + offset. `unit` is that of the source, where it does not say one.
// No secret stands in the file: "password_env" names a variable of the environment, "password_file" a file that nobody
// but its owner can read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/connect/source.h"

namespace spindrift {

struct SourceDescription {
  std::string name;
  std::string kind;  ///< "mtconnect", "mqtt", "modbus", "text", "linuxcnc", "genicam"
  std::string url;
  std::function<std::unique_ptr<Source>()> make;
};

/// How the values of an interval become one.
enum class Reduction {
  Last,          ///< the state at its end
  Mean,          ///< over time: a value holds until the next
  MeanAbsolute,  ///< of feeds and speeds of axes
  Max,
  Min,
};
[[nodiscard]] std::string_view toString(Reduction reduction) noexcept;

struct ColumnMapping {
  std::string column;
  std::uint32_t source = 0;  ///< index in sources
  std::uint32_t item = 0;    ///< index in the subscription of that source
  std::string address;
  std::string unit;  ///< of the source, as stated; empty: as the source says
  double scale = 1.0;
  double offset = 0.0;
  double dead_band = 0.0;  ///< in the unit of the column: no row for less
  Reduction reduction = Reduction::Last;
  std::string role;                      ///< of a temperature sensor, as in machine.json; may be empty
  std::map<std::string, double> values;  ///< words and their numbers
  std::optional<double> otherwise;       ///< for words that are not among them
  SourcePlace place;                     ///< in connections.json
};

struct Connections {
  std::filesystem::path file;
  std::vector<SourceDescription> sources;
  std::vector<ColumnMapping> columns;
  double interval_s = 1.0;   ///< of the rows
  double settle_s = 2.0;     ///< a row is closed that long after its time
  double longest_s = 60.0;   ///< states that hold are written at least that often
  double rotate_mb = 256.0;  ///< a log file beyond this is put aside and a new one begun

  /// Throws InputError: the file, the JSON path, what was found and what is allowed.
  [[nodiscard]] static Connections read(const std::filesystem::path& file);
  /// The same of what is still being put together: there may be no source and no column yet.
  [[nodiscard]] static Connections parse(const JsonNode& root);
  /// The addresses that a source is asked for, in the order of ColumnMapping::item.
  [[nodiscard]] std::vector<std::string> itemsOf(std::uint32_t source) const;
};

/// For listing what is there: the kind follows from the address (http, https: MTConnect; mqtt, mqtts; modbus, rtu;
/// linuxcnc; genicam; serial, tcp: lines of text). Throws InputError for any other, and for one that holds a password.
[[nodiscard]] SourceDescription sourceForAddress(const std::string& url);
/// The same with the options of an entry of "sources" ("user", "unit_id", ...); a pattern of lines may be missing.
[[nodiscard]] SourceDescription sourceForAddress(const std::string& url, const JsonNode& options);

}  // namespace spindrift
