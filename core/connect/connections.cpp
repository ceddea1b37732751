// SPDX-License-Identifier: Apache-2.0
#include "core/connect/connections.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/base/csv.h"
#include "core/base/json_reader.h"
#include "core/base/text.h"
#include "core/connect/mtconnect_source.h"
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

struct Kind {
  std::string_view name;
  std::vector<std::string> schemes;  ///< the first is meant where an address has none
  Maker (*make)(const JsonNode&, const std::string&);
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{{"mtconnect", {"http", "https"}, mtconnect}};
  return all;
}

/// "http:// or https://".
std::string beginnings(const std::vector<std::string>& schemes) {
  std::vector<std::string> out;
  for (const std::string& scheme : schemes) out.push_back(scheme + "://");
  return joinedList(out, "or");
}

std::string allBeginnings() {
  std::vector<std::string> out;
  for (const Kind& kind : kinds()) out.insert(out.end(), kind.schemes.begin(), kind.schemes.end());
  return beginnings(out);
}

std::string schemeOf(const std::string& url) {
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
  const Kind& kind =
      *std::find_if(kinds().begin(), kinds().end(), [&](const Kind& k) { return k.name == source.kind; });
  if (std::find(kind.schemes.begin(), kind.schemes.end(), schemeOf(source.url)) == kind.schemes.end())
    url.reject(fmt::format("an address that begins with {}", beginnings(kind.schemes)));
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
  out.address = node.at("item").name();
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
  Connections out;
  out.file = file;
  const JsonNode sources = root.at("sources");
  for (const JsonNode& node : sources.items()) {
    SourceDescription source = readSource(node);
    for (const SourceDescription& other : out.sources) {
      if (other.name == source.name) node.at("name").reject("a name that no other source has");
    }
    out.sources.push_back(std::move(source));
  }
  if (out.sources.empty()) sources.reject("at least one source");
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
  if (out.columns.empty()) columns.reject("at least one column");
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
  if (holdsPassword(url)) throw InputError(fmt::format("The address {}", password_rule));
  const std::string scheme = schemeOf(url);
  for (const Kind& kind : kinds()) {
    if (std::find(kind.schemes.begin(), kind.schemes.end(), scheme) == kind.schemes.end()) continue;
    const JsonNode nothing = JsonNode::parse("{}", "");
    return {url, std::string(kind.name), url, kind.make(nothing, url)};
  }
  throw InputError(
      fmt::format("\"{}\" is no address that can be listed; allowed: one that begins with {}.", url, allBeginnings()));
}

}  // namespace spindrift
