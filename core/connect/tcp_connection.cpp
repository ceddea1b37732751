// SPDX-License-Identifier: Apache-2.0
#include "core/connect/tcp_connection.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <memory>

#include "core/base/text.h"
#include "core/connect/source.h"

namespace spindrift {

HostAndPort hostAndPort(const std::string& url, int otherwise) {
  const std::size_t scheme = url.find("://");
  const std::size_t begin = scheme == std::string::npos ? 0 : scheme + 3;
  std::string place = url.substr(begin, url.find_first_of("/?", begin) - begin);
  HostAndPort out{place, otherwise};
  const std::size_t colon = place.rfind(':');
  double port = 0.0;
  if (colon != std::string::npos && place.find(']', colon) == std::string::npos &&
      parseNumber(std::string_view(place).substr(colon + 1), port) && port > 0.0 && port < 65536.0) {
    out = {place.substr(0, colon), static_cast<int>(port)};
  }
  if (out.host.starts_with('[') && out.host.ends_with(']')) out.host = out.host.substr(1, out.host.size() - 2);
  return out;
}

int openTcp(const HostAndPort& peer, double patience_s, const std::stop_token& stop) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience_s);
  const std::string name = fmt::format("{}:{}", peer.host, peer.port);
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* list = nullptr;
  const int failed = ::getaddrinfo(peer.host.c_str(), std::to_string(peer.port).c_str(), &wanted, &list);
  if (failed != 0) throw ConnectionError(fmt::format("{} is not known: {}.", name, ::gai_strerror(failed)));
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> owner(list, ::freeaddrinfo);
  std::string reason = "no address";
  for (const addrinfo* each = list; each != nullptr; each = each->ai_next) {
    const int handle = ::socket(each->ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, each->ai_protocol);
    if (handle < 0) continue;
    int error = ::connect(handle, each->ai_addr, each->ai_addrlen) == 0 ? 0 : errno;
    while (error == EINPROGRESS && !stop.stop_requested() && std::chrono::steady_clock::now() < until) {
      pollfd wait{handle, POLLOUT, 0};
      if (::poll(&wait, 1, 50) <= 0) continue;
      socklen_t size = sizeof error;
      ::getsockopt(handle, SOL_SOCKET, SO_ERROR, &error, &size);
    }
    if (error == 0) return handle;
    ::close(handle);
    if (stop.stop_requested()) return -1;
    reason = error == EINPROGRESS ? fmt::format("no answer within {:.0f} s", patience_s) : std::strerror(error);
  }
  throw ConnectionError(fmt::format("{} cannot be connected: {}.", name, reason));
}

}  // namespace spindrift
