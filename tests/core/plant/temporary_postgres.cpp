// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/core/plant/temporary_postgres.h"

#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace spindrift::testing {
namespace {

std::string binaries() {
  std::vector<std::string> found;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator("/usr/lib/postgresql", none)) {
    if (std::filesystem::exists(entry.path() / "bin/initdb")) found.push_back((entry.path() / "bin").string());
  }
  std::sort(found.begin(), found.end());
  return found.empty() ? "" : found.back();
}

int freePort() {
  const int handle = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ::bind(handle, reinterpret_cast<sockaddr*>(&address), sizeof address);
  socklen_t size = sizeof address;
  ::getsockname(handle, reinterpret_cast<sockaddr*>(&address), &size);
  ::close(handle);
  return ntohs(address.sin_port);
}

}  // namespace

std::string shell(const std::string& command) {
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("no shell");
  std::string said;
  std::array<char, 4096> buffer{};
  for (std::size_t n; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) said.append(buffer.data(), n);
  if (::pclose(pipe) != 0) throw std::runtime_error(command + ": " + said);
  return said;
}

std::string TemporaryPostgres::missing() {
  return binaries().empty() ? "PostgreSQL is not installed (package postgresql): only SQLite was tested" : "";
}

std::string TemporaryPostgres::as() const {
  if (::geteuid() != 0) return "env LANG=C.UTF-8 ";
  return "setpriv --reuid=postgres --regid=$(id -g postgres) --clear-groups env HOME=/ LANG=C.UTF-8 ";
}

TemporaryPostgres::TemporaryPostgres() : port_(freePort()) {
  const std::string place = folder_.path().string();
  const std::string owner = ::geteuid() == 0 ? "postgres" : shell("id -un");
  shell("chmod 711 " + place + " && mkdir -p " + place + "/s " + place + "/tls");
  shell(
      fmt::format("openssl req -x509 -newkey rsa:2048 -nodes -days 2 -subj /CN=localhost -addext "
                  "subjectAltName=DNS:localhost -keyout {0}/tls/server.key -out {0}/tls/server.crt",
                  place));
  shell(fmt::format("chmod 600 {0}/tls/server.key && chmod 755 {0}/tls", place));
  if (::geteuid() == 0)
    shell(fmt::format("mkdir {0}/data && chown -R postgres {0}/s {0}/tls {0}/data && chmod 755 {0}/s", place));
  shell(as() + binaries() + "/initdb -D " + place + "/data -U admin -A peer -E UTF8 --locale=C.UTF-8 --no-sync");
  folder_.write(
      "add.conf",
      fmt::format("listen_addresses = '127.0.0.1'\nport = {1}\nunix_socket_directories = '{0}/s'\n"
                  "ssl = on\nssl_cert_file = '{0}/tls/server.crt'\nssl_key_file = "
                  "'{0}/tls/server.key'\nshared_buffers = 32MB\nmax_connections = 60\nfsync = off\nautovacuum = off\n"
                  "dynamic_shared_memory_type = posix\n",
                  place, port_));
  folder_.write("hba", "local all all trust\nhostssl all reader_one 127.0.0.1/32 scram-sha-256\n");
  shell(
      fmt::format("cat {0}/add.conf | {1} tee -a {0}/data/postgresql.conf >/dev/null && cat {0}/hba | {1} tee "
                  "{0}/data/pg_hba.conf > /dev/null",
                  place, as()));
  start();
  sql("postgres",
      "create role owner login createrole; create role plant_reader nologin; create role plant_writer nologin; create "
      "role writer_one login in role plant_writer; create role reader_one login password 'of the reader' in role "
      "plant_reader; create role nobody_one login;");
}

TemporaryPostgres::~TemporaryPostgres() {
  try {
    stop();
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
  }
}

void TemporaryPostgres::start() const {
  const std::string place = folder_.path().string();
  shell(fmt::format("cd / && {}{}/pg_ctl -D {}/data -l {}/data/log -w -t 30 start", as(), binaries(), place, place));
}

void TemporaryPostgres::stop() const {
  shell(fmt::format("cd / && {}{}/pg_ctl -D {}/data -m fast -w -t 30 stop", as(), binaries(), folder_.path().string()));
}

void TemporaryPostgres::kill() const {
  shell(fmt::format(
      "p=$(head -1 {}/data/postmaster.pid); kids=$(ps -o pid= --ppid $p); kill -9 $p; for i in $(seq 200); do "
      "ps -o pid= -p $p $kids >/dev/null || break; sleep 0.05; done",
      folder_.path().string()));
}

std::string TemporaryPostgres::address(const std::string& database, const std::string& role) const {
  return fmt::format("postgresql:host={}/s port={} dbname={} user={}", folder_.path().string(), port_, database, role);
}

std::string TemporaryPostgres::freshDatabase() {
  const std::string name = fmt::format("plant{}", ++databases_);
  sql("postgres", fmt::format("create database {} owner owner", name));
  return name;
}

std::string TemporaryPostgres::sql(const std::string& database, const std::string& statements) const {
  return shell(fmt::format("psql -X -q -A -t -h {}/s -p {} -U admin -d {} -v ON_ERROR_STOP=1 -c \"{}\"",
                           folder_.path().string(), port_, database, statements));
}

TemporaryPostgres& TemporaryPostgres::shared() {
  static TemporaryPostgres server;
  return server;
}

}  // namespace spindrift::testing
