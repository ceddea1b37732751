// SPDX-License-Identifier: Apache-2.0
// A TCP connection that is tried for a limited time.
#pragma once

#include <stop_token>
#include <string>

namespace spindrift {

struct HostAndPort {
  std::string host;
  int port = 0;
};

/// Of "scheme://host:port/..." or "scheme://[::1]:port"; `otherwise` where there is no port.
[[nodiscard]] HostAndPort hostAndPort(const std::string& url, int otherwise);

/// An open socket (the caller closes it), without delay and not blocking. Throws ConnectionError; -1 if stopped.
[[nodiscard]] int openTcp(const HostAndPort& peer, double patience_s, const std::stop_token& stop);

}  // namespace spindrift
