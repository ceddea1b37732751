// SPDX-License-Identifier: Apache-2.0
#include "core/plant/plant_address.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "core/base/error.h"
#include "core/base/text.h"

namespace spindrift {
namespace {

/// key=value pairs of libpq; a value may stand in single quotes.
std::map<std::string, std::string> keywords(const std::string& text) {
  std::map<std::string, std::string> found;
  std::size_t i = 0;
  const auto blank = [&](std::size_t k) { return std::isspace(static_cast<unsigned char>(text[k])) != 0; };
  while (i < text.size()) {
    while (i < text.size() && blank(i)) ++i;
    if (i == text.size()) break;
    const std::size_t equals = text.find('=', i);
    if (equals == std::string::npos)
      throw InputError(
          fmt::format("The plant store's address holds \"{}\"; allowed: KEY=VALUE pairs as in "
                      "host=NAME dbname=plant user=NAME.",
                      text.substr(i)));
    const std::string key(trimmed(std::string_view(text).substr(i, equals - i)));
    i = equals + 1;
    while (i < text.size() && blank(i)) ++i;
    std::string value;
    if (i < text.size() && text[i] == '\'') {
      for (++i; i < text.size() && text[i] != '\''; ++i) {
        if (text[i] == '\\' && i + 1 < text.size()) ++i;
        value += text[i];
      }
      ++i;
    } else {
      while (i < text.size() && !blank(i)) value += text[i++];
    }
    found[key] = value;
  }
  return found;
}

bool onThisComputer(const std::string& host) {
  return host.empty() || host.front() == '/' || host == "localhost" || host == "127.0.0.1" || host == "::1";
}

}  // namespace

PlantAddress PlantAddress::parse(const std::string& text) {
  PlantAddress address;
  if (trimmed(text).empty())
    throw InputError(
        "No plant store is named; allowed: a file such as plant.sqlite, or postgresql:host=NAME dbname=plant "
        "user=NAME.");
  if (text.starts_with("postgresql://") || text.starts_with("postgres://"))
    throw InputError(
        "The plant store's address is a URL, in which a password may stand; allowed: postgresql:host=NAME "
        "dbname=plant user=NAME.");
  if (!text.starts_with("postgresql:")) {
    address.file = std::filesystem::absolute(text.starts_with("sqlite:") ? text.substr(7) : text);
    return address;
  }
  address.kind = Kind::Postgres;
  address.connect = std::string(trimmed(std::string_view(text).substr(11)));
  const auto keys = keywords(address.connect);
  const auto value = [&](const char* key) {
    const auto found = keys.find(key);
    return found == keys.end() ? std::string() : found->second;
  };
  if (keys.contains("password") || keys.contains("sslpassword"))
    throw InputError(
        "The plant store's address holds a password, which all who see the address would see; allowed: the "
        "password in the file that PGPASSFILE names (mode 0600).");
  if (!onThisComputer(value("host"))) {
    const std::string mode = value("sslmode");
    if (mode.empty())
      address.connect += " sslmode=verify-full";
    else if (mode != "verify-full")
      throw InputError(
          fmt::format("The plant store's address has sslmode={}, which does not check who the server is; "
                      "allowed over the network: sslmode=verify-full with sslrootcert=FILE.",
                      mode));
  }
  if (!keys.contains("connect_timeout")) address.connect += " connect_timeout=10";
  return address;
}

std::string PlantAddress::text() const {
  return kind == Kind::Sqlite ? file.string() : "postgresql:" + connect;
}

}  // namespace spindrift
