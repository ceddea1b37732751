// SPDX-License-Identifier: Apache-2.0
#include "core/connect/connections.h"

#include <fmt/format.h>

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <stdexcept>

#include "core/base/atomic_file.h"
#include "core/base/csv.h"
#include "core/base/json_reader.h"
#include "core/base/text.h"
#include "core/connect/genicam_source.h"
#include "core/connect/linuxcnc_source.h"
#include "core/connect/modbus_source.h"
#include "core/connect/mqtt_source.h"
#include "core/connect/mtconnect_source.h"
#include "core/connect/text_source.h"
#include "core/connect/unit_conversion.h"
#include "core/machine/operating_log.h"
#include "core/machine/sensor_role.h"

namespace spindrift {
namespace {

constexpr std::array<std::string_view, 5> reduction_names{"last", "mean", "mean_absolute", "max", "min"};

using Maker = std::function<std::unique_ptr<Source>()>;

Maker mtconnect(const JsonNode& node, const std::string& url) {
  MtconnectOptions options;
  options.url = url;
  if (const auto given = node.find("interval_s")) options.interval_s = given->positiveNumber();
  if (const auto given = node.find("heartbeat_s")) options.heartbeat_s = given->positiveNumber();
  return [options] { return makeMtconnectSource(options); };
}

/// A password that was typed where the name of its variable belongs would be kept and shown: refused, unseen. Names
/// are those of POSIX (capitals), and any other that is set in this environment.
void checkVariable(const JsonNode& variable) {
  const std::string name = variable.name();
  const auto all = [&](const auto& fits) { return std::all_of(name.begin(), name.end(), fits); };
  const bool word = all([](unsigned char c) { return c < 128 && (std::isalnum(c) != 0 || c == '_'); }) &&
                    std::isdigit(static_cast<unsigned char>(name[0])) == 0;
  const bool capitals = all([](unsigned char c) { return std::islower(c) == 0; });
  if (word && (capitals || std::getenv(name.c_str()) != nullptr)) return;
  throw InputError(
      variable.place(),
      "is not the name of a variable (it is not shown, as it may be the password itself); allowed: capital "
      "letters, digits and _, such as HALL_PASSWORD, or a variable that is set in the environment.");
}

/// Of "password_env" or "password_file"; empty where neither is given.
std::string secretOf(const JsonNode& node) {
  if (const auto variable = node.find("password_env")) {
    const char* value = std::getenv(variable->name().c_str());
    if (value == nullptr) variable->reject("a variable that is set in the environment");
    return value;
  }
  const auto file = node.find("password_file");
  if (!file) return {};
  const std::filesystem::path path = file->name();
  struct stat state {};
  if (::stat(path.c_str(), &state) != 0 || !S_ISREG(state.st_mode)) file->reject("a file that is there");
  if ((state.st_mode & (S_IRWXG | S_IRWXO)) != 0) file->reject("a file that nobody but its owner can read (chmod 600)");
  const std::string content = readFile(path);
  return std::string(trimmed(content));
}

Maker mqtt(const JsonNode& node, const std::string& url) {
  MqttOptions options;
  options.url = url;
  options.user = node.stringOr("user", "");
  options.client_id = node.stringOr("client_id", "");
  options.ca_file = node.stringOr("ca_file", "");
  if (const auto will = node.find("will")) {
    options.will_topic = will->at("topic").name();
    options.will_text = will->at("text").string();
  }
  options.ask_rebirth = node.booleanOr("ask_rebirth", true);
  // Looked up when it is needed: connections can be put together where the secret is not.
  return [options, node] {
    MqttOptions with_secret = options;
    with_secret.password = secretOf(node);
    return makeMqttSource(with_secret);
  };
}

char parityOf(const JsonNode& node) {
  const auto given = node.find("parity");
  const std::string word = given ? given->oneOf({"none", "even", "odd"}) : "none";
  return word == "none" ? 'N' : word == "even" ? 'E' : 'O';
}

Maker modbus(const JsonNode& node, const std::string& url) {
  ModbusOptions options;
  options.url = url;
  if (const auto given = node.find("unit_id")) {
    options.unit_id = given->integer();
    if (options.unit_id < 0 || options.unit_id > 247) given->reject("a unit from 0 to 247");
  }
  if (const auto given = node.find("interval_s")) options.interval_s = given->positiveNumber();
  if (const auto given = node.find("answer_s")) options.answer_s = given->positiveNumber();
  if (const auto given = node.find("baud")) options.baud = given->integer();
  options.parity = parityOf(node);
  if (const auto given = node.find("stop_bits")) {
    options.stop_bits = given->integer();
    if (options.stop_bits != 1 && options.stop_bits != 2) given->reject("1 or 2");
  }
  return [options] { return makeModbusSource(options); };
}

Maker text(const JsonNode& node, const std::string& url) {
  TextSourceOptions options;
  options.url = url;
  if (const auto line = node.find("line")) {
    if (line->value().is_array()) {
      for (const JsonNode& each : line->items()) options.lines.emplace_back(each);
    } else {
      options.lines.emplace_back(*line);
    }
  }
  options.save = node.stringOr("save", "");
  if (const auto given = node.find("baud")) options.baud = given->integer();
  options.parity = parityOf(node);
  if (const auto given = node.find("data_bits")) {
    options.data_bits = given->integer();
    if (options.data_bits != 7 && options.data_bits != 8) given->reject("7 or 8");
  }
  options.decimal_comma = node.booleanOr("decimal_comma", false);
  return [options] { return makeTextSource(options); };
}

Maker linuxcnc(const JsonNode& node, const std::string& url) {
  LinuxcncOptions options;
  options.url = url;
  if (const auto given = node.find("interval_s")) options.interval_s = given->positiveNumber();
  if (const auto given = node.find("answer_s")) options.answer_s = given->positiveNumber();
  return [options, node] {
    LinuxcncOptions with_secret = options;
    with_secret.password = secretOf(node);
    return makeLinuxcncSource(with_secret);
  };
}

Maker genicam(const JsonNode& node, const std::string& url) {
  const GenicamSettings settings = readGenicamSettings(node);
  return [settings, name = url.substr(genicam_prefix.size())] { return makeGenicamSource(name, settings); };
}

struct Kind {
  std::string_view name;
  std::vector<std::string> schemes;  ///< the first is meant where an address has none
  Maker (*make)(const JsonNode&, const std::string&);
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{{"mtconnect", {"http", "https"}, mtconnect}, {"mqtt", {"mqtt", "mqtts"}, mqtt},
                                     {"modbus", {"modbus", "rtu"}, modbus},       {"text", {"serial", "tcp"}, text},
                                     {"linuxcnc", {"linuxcnc"}, linuxcnc},        {"genicam", {"genicam"}, genicam}};
  return all;
}

/// "http:// or https://".
std::string beginnings(const std::vector<std::string>& schemes) {
  std::vector<std::string> out;
  for (const std::string& scheme : schemes) out.push_back(scheme + (scheme == "genicam" ? ":" : "://"));
  return joinedList(out, "or");
}

std::string allBeginnings() {
  std::vector<std::string> out;
  for (const Kind& kind : kinds()) out.insert(out.end(), kind.schemes.begin(), kind.schemes.end());
  return beginnings(out);
}

std::string schemeOf(const std::string& url) {
  if (url.starts_with(genicam_prefix)) return std::string(genicam_prefix.substr(0, genicam_prefix.size() - 1));
  const std::size_t end = url.find("://");
  return end == std::string::npos ? std::string() : url.substr(0, end);
}

/// "user:word@host" in the part before the path.
bool holdsPassword(const std::string& url) {
  const std::size_t begin = url.find("://");
  if (begin == std::string::npos) return false;
  const std::string host = url.substr(begin + 3, url.find('/', begin + 3) - begin - 3);
  return host.find('@') != std::string::npos;
}

constexpr const char* password_rule =
    "holds a user or a password; allowed: an address without, \"user\", and \"password_env\" or \"password_file\".";

SourceDescription readSource(const JsonNode& node) {
  SourceDescription source;
  source.name = node.at("name").name();
  std::vector<std::string> names;
  for (const Kind& kind : kinds()) names.emplace_back(kind.name);
  source.kind = node.at("kind").oneOf(names);
  const JsonNode url = node.at("url");
  source.url = url.name();
  for (const char* secret : {"password", "passwd", "token", "secret"}) {
    if (node.has(secret)) {
      throw InputError(node.at(secret).place(),
                       "a secret stands in the file; allowed: \"password_env\" (a variable of the environment) or "
                       "\"password_file\" (a file that only its owner can read).");
    }
  }
  // Not url.reject: the sentence would show the password.
  if (holdsPassword(source.url)) throw InputError(url.place(), password_rule);
  if (const auto variable = node.find("password_env")) checkVariable(*variable);
  const Kind& kind =
      *std::find_if(kinds().begin(), kinds().end(), [&](const Kind& k) { return k.name == source.kind; });
  if (std::find(kind.schemes.begin(), kind.schemes.end(), schemeOf(source.url)) == kind.schemes.end())
    url.reject(fmt::format("an address that begins with {}", beginnings(kind.schemes)));
  if (source.kind == "text") (void)node.at("line");
  source.make = kind.make(node, source.url);
  return source;
}

ColumnMapping readColumn(const JsonNode& node, const std::vector<SourceDescription>& sources) {
  ColumnMapping out;
  out.place = node.place();
  const JsonNode column = node.at("column");
  out.column = column.name();
  if (out.column == "time_s" || out.column.find_first_of(",\"\r\n#") != std::string::npos ||
      csvField(out.column) != out.column)
    column.reject("a name of a column without commas and quotes, other than time_s");
  std::vector<std::string> names;
  for (const SourceDescription& source : sources) names.push_back(source.name);
  const std::string source = node.at("source").oneOf(names);
  out.source = static_cast<std::uint32_t>(std::find(names.begin(), names.end(), source) - names.begin());
  const JsonNode item = node.at("item");
  out.address = item.name();
  if (const std::string& kind = sources[out.source].kind; kind == "modbus" || kind == "linuxcnc") {
    try {
      kind == "modbus" ? checkModbusAddress(out.address) : checkLinuxcncAddress(out.address);
    } catch (const std::invalid_argument& allowed) {
      item.reject(allowed.what());
    }
  }
  if (const auto unit = node.find("unit")) {
    out.unit = unit->name();
    if (!isKnownUnit(out.unit)) unit->reject("a unit such as CELSIUS, FAHRENHEIT, MILLIMETER, mm/s or rpm");
    if (!conversionInto(out.column, out.unit))
      unit->reject(fmt::format("a unit that can become {}, the unit of the column", unitOfColumn(out.column)));
  }
  out.scale = node.numberOr("scale", 1.0);
  out.offset = node.numberOr("offset", 0.0);
  if (const auto band = node.find("dead_band")) out.dead_band = band->nonNegativeNumber();
  out.reduction = OperatingLog::isTemperature(out.column) ? Reduction::Mean
                  : out.column.starts_with("feed_")       ? Reduction::MeanAbsolute
                                                          : Reduction::Last;
  if (const auto reduce = node.find("reduce")) {
    const std::vector<std::string> allowed(reduction_names.begin(), reduction_names.end());
    const std::string word = reduce->oneOf(allowed);
    out.reduction = static_cast<Reduction>(std::find(allowed.begin(), allowed.end(), word) - allowed.begin());
  }
  if (const auto role = node.find("role")) {
    out.role = role->oneOf(sensorRoleNames());
    if (!OperatingLog::isTemperature(out.column)) role->reject("a role for a column T_<name>_degC only");
  }
  if (const auto values = node.find("values")) {
    for (const auto& [word, number] : values->members()) out.values[word] = number.number();
  }
  if (const auto otherwise = node.find("otherwise")) out.otherwise = otherwise->number();
  return out;
}

}  // namespace

std::string_view toString(Reduction reduction) noexcept {
  return reduction_names[static_cast<std::size_t>(reduction)];
}

Connections Connections::read(const std::filesystem::path& file) {
  const JsonNode root = JsonNode::read(file);
  root.requireFormat("spindrift-connections", 1);
  if (const JsonNode sources = root.at("sources"); sources.items().empty()) sources.reject("at least one source");
  Connections out = parse(root);
  out.file = file;
  if (out.columns.empty()) root.at("columns").reject("at least one column");
  for (const SourceDescription& source : out.sources) (void)source.make();  // secrets that are not there
  return out;
}

Connections Connections::parse(const JsonNode& root) {
  root.requireFormat("spindrift-connections", 1);
  Connections out;
  const JsonNode sources = root.at("sources");
  for (const JsonNode& node : sources.items()) {
    SourceDescription source = readSource(node);
    for (const SourceDescription& other : out.sources) {
      if (other.name == source.name) node.at("name").reject("a name that no other source has");
    }
    out.sources.push_back(std::move(source));
  }
  const JsonNode columns = root.at("columns");
  for (const JsonNode& node : columns.items()) {
    ColumnMapping column = readColumn(node, out.sources);
    column.item = 0;
    for (const ColumnMapping& other : out.columns) {
      if (other.column == column.column) node.at("column").reject("a column that is not mapped twice");
      if (other.source == column.source) column.item = std::max(column.item, other.item + 1);
    }
    out.columns.push_back(std::move(column));
  }
  if (const auto given = root.find("interval_s")) out.interval_s = given->positiveNumber();
  if (const auto given = root.find("settle_s")) out.settle_s = given->nonNegativeNumber();
  if (const auto given = root.find("longest_s")) out.longest_s = given->positiveNumber();
  if (const auto given = root.find("rotate_mb")) out.rotate_mb = given->positiveNumber();
  return out;
}

std::vector<std::string> Connections::itemsOf(std::uint32_t source) const {
  std::vector<std::string> items;
  for (const ColumnMapping& column : columns) {
    if (column.source == source) items.push_back(column.address);
  }
  return items;
}

SourceDescription sourceForAddress(const std::string& url) {
  return sourceForAddress(url, JsonNode::parse("{}", ""));
}

SourceDescription sourceForAddress(const std::string& url, const JsonNode& options) {
  if (holdsPassword(url)) throw InputError(fmt::format("The address {}", password_rule));
  const std::string scheme = schemeOf(url);
  if (const auto variable = options.find("password_env")) checkVariable(*variable);
  for (const Kind& kind : kinds()) {
    if (std::find(kind.schemes.begin(), kind.schemes.end(), scheme) == kind.schemes.end()) continue;
    return {url, std::string(kind.name), url, kind.make(options, url)};
  }
  throw InputError(fmt::format("\"{}\" is not an address that can be listed; allowed: one that begins with {}.", url,
                               allBeginnings()));
}

}  // namespace spindrift
