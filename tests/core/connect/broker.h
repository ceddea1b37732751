// SPDX-License-Identifier: GPL-3.0-or-later
// The broker mosquitto on loopback, and a client that publishes into it.
#pragma once

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <mosquitto.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <vector>

#include "core/connect/source.h"
#include "core/connect/tcp_connection.h"
#include "tests/core/connect/collected.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {

inline int freePort() {
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

class Broker {
 public:
  explicit Broker(const std::string& settings = "allow_anonymous true\n") : port_(freePort()) {
    folder_.write("broker.conf",
                  fmt::format("user root\npersistence false\nlistener {} 127.0.0.1\n{}", port_, settings));
    start();
  }
  ~Broker() { stop(); }
  void start() {
    child_ = ::fork();
    if (child_ == 0) {
      const int nowhere = ::open("/dev/null", O_WRONLY);
      ::dup2(nowhere, 1);
      ::dup2(nowhere, 2);
      const std::string conf = (folder_ / "broker.conf").string();
      ::execl("/usr/sbin/mosquitto", "mosquitto", "-c", conf.c_str(), static_cast<char*>(nullptr));
      ::_exit(127);
    }
    ASSERT_TRUE(waitUntil([&] {
      try {
        ::close(openTcp({"127.0.0.1", port_}, 0.2, {}));
        return true;
      } catch (const ConnectionError&) {
        return false;
      }
    })) << "mosquitto does not start";
  }
  void stop() {
    ::kill(child_, SIGKILL);
    int status = 0;
    ::waitpid(child_, &status, 0);
  }
  [[nodiscard]] int port() const { return port_; }
  [[nodiscard]] std::string url() const { return fmt::format("mqtt://127.0.0.1:{}", port_); }

 private:
  TempFolder folder_;
  int port_;
  pid_t child_ = -1;
};

/// A client that publishes and hears what it has subscribed to.
class Publisher {
 public:
  explicit Publisher(const Broker& broker) {
    mosquitto_lib_init();
    client_ = mosquitto_new(nullptr, true, this);
    mosquitto_message_callback_set(client_, [](mosquitto*, void* self, const mosquitto_message* message) {
      static_cast<Publisher*>(self)->heard.push_back(message->topic);
    });
    EXPECT_EQ(mosquitto_connect(client_, "127.0.0.1", broker.port(), 10), MOSQ_ERR_SUCCESS);
    spin();
  }
  ~Publisher() { mosquitto_destroy(client_); }
  void publish(const std::string& topic, const std::string& text, bool retain = false) {
    EXPECT_EQ(mosquitto_publish(client_, nullptr, topic.c_str(), static_cast<int>(text.size()), text.data(), 1, retain),
              MOSQ_ERR_SUCCESS);
    spin();
  }
  void listen(const std::string& topic) {
    mosquitto_subscribe(client_, nullptr, topic.c_str(), 0);
    spin();
  }
  void spin() {
    for (int i = 0; i < 10; ++i) mosquitto_loop(client_, 5, 1);
  }
  std::vector<std::string> heard;

 private:
  mosquitto* client_;
};

}  // namespace spindrift::testing
