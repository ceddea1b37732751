// SPDX-License-Identifier: GPL-3.0-or-later
// Against the server of libmodbus.
#include "core/connect/modbus_source.h"

#include <gmock/gmock.h>
#include <modbus/modbus.h>
#include <netinet/in.h>
#include <poll.h>
#include <pty.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <thread>

#include "tests/core/connect/collected.h"

namespace spindrift::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ModbusServer {
 public:
  ModbusServer() : map_(modbus_mapping_new(16, 16, 64, 64)) { start(); }
  ~ModbusServer() {
    stop();
    modbus_mapping_free(map_);
  }
  void start() {
    context_ = modbus_new_tcp("127.0.0.1", port_);
    listener_ = port_ == 0 ? listenAnywhere() : modbus_tcp_listen(context_, 1);
    ASSERT_GE(listener_, 0);
    sockaddr_in address{};
    socklen_t size = sizeof address;
    ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    stopping_ = false;
    thread_ = std::thread([this] { serve(); });
  }
  void stop() {
    stopping_ = true;
    if (thread_.joinable()) thread_.join();
    ::close(listener_);
    modbus_free(context_);
  }
  [[nodiscard]] std::string url() const { return "modbus://127.0.0.1:" + std::to_string(port_); }
  modbus_mapping_t& map() { return *map_; }

 private:
  static int listenAnywhere() {
    const int handle = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ::bind(handle, reinterpret_cast<sockaddr*>(&address), sizeof address);
    ::listen(handle, 4);
    return handle;
  }
  void serve() {
    while (!stopping_) {
      pollfd wait{listener_, POLLIN, 0};
      if (::poll(&wait, 1, 20) <= 0) continue;
      const int peer = ::accept(listener_, nullptr, nullptr);
      modbus_set_socket(context_, peer);
      while (!stopping_) {
        pollfd data{peer, POLLIN, 0};
        if (::poll(&data, 1, 20) <= 0) continue;
        std::uint8_t query[MODBUS_TCP_MAX_ADU_LENGTH];
        const int length = modbus_receive(context_, query);
        if (length < 0) break;
        modbus_reply(context_, query, length, map_);
      }
      ::close(peer);
    }
  }
  modbus_mapping_t* map_;
  modbus_t* context_ = nullptr;
  int port_ = 0;
  int listener_ = -1;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

std::unique_ptr<Source> sourceFor(const std::string& url) {
  ModbusOptions options;
  options.url = url;
  options.interval_s = 0.02;
  options.answer_s = 0.5;
  return makeModbusSource(options);
}

TEST(Modbus, TypesAndWordOrders) {
  ModbusServer server;
  std::uint16_t* in = server.map().tab_input_registers;
  in[0] = 0xFFFF;  // -1 as int16
  in[1] = 0xFFFF;
  // As the documentation of modules writes it: A is the highest byte of 0x41AC0000, 21.5. (The functions of libmodbus
  // 3.1.6 with these names mean other orders on this processor.)
  const std::uint16_t floats[] = {0x41AC, 0x0000, 0x0000, 0x41B4, 0xBC41, 0x0000, 0x0000, 0xC441};
  std::copy(std::begin(floats), std::end(floats), in + 10);
  server.map().tab_registers[40] = 0xFFFF;
  server.map().tab_registers[41] = 0xFFFE;
  server.map().tab_bits[3] = 1;
  const auto source = sourceFor(server.url());
  source->connect({});
  Collected sink;
  source->subscribe({"input:0", "input:1:uint16", "input:10:float32", "input:12:float32:cdab", "input:14:float32:badc",
                     "input:16:float32:dcba", "holding:40:int32", "holding:40:uint32", "coil:3", "discrete:3"},
                    sink, {});
  ASSERT_TRUE(pollUntil(*source, sink, [&] { return sink.records.size() >= 10; }));
  std::vector<double> values;
  for (std::uint32_t i = 0; i < 10; ++i) values.push_back(sink.values(i).at(0));
  EXPECT_THAT(values, ElementsAre(-1.0, 65535.0, 21.5, 22.5, 23.5, 24.5, -2.0, 4294967294.0, 1.0, 0.0));
}

TEST(Modbus, ARegisterThatIsRefusedLeavesTheOthers) {
  ModbusServer server;
  server.map().tab_input_registers[63] = 7;
  const auto source = sourceFor(server.url());
  source->connect({});
  Collected sink;
  source->subscribe({"input:63", "input:64", "input:900", "nonsense"}, sink, {});
  ASSERT_TRUE(pollUntil(*source, sink, [&] { return sink.values(0).size() >= 6; }));
  EXPECT_EQ(sink.values(0).back(), 7.0);
  EXPECT_TRUE(std::isnan(sink.values(1).back()));
  ASSERT_EQ(sink.notes.size(), 3U);
  EXPECT_THAT(sink.notes[0], HasSubstr("\"nonsense\" is not a register"));
}

TEST(Modbus, AServerThatGoesAndComesBackIsReadAgain) {
  ModbusServer server;
  const auto source = sourceFor(server.url());
  source->connect({});
  Collected sink;
  source->subscribe({"holding:0"}, sink, {});
  ASSERT_TRUE(pollUntil(*source, sink, [&] { return sink.records.size() >= 3; }));
  server.stop();
  EXPECT_THROW((void)pollUntil(
                   *source, sink, [] { return false; }, 3.0),
               ConnectionError);
  EXPECT_THROW(source->connect({}), ConnectionError);
  server.start();
  server.map().tab_registers[0] = 42;
  source->connect({});
  source->subscribe({"holding:0"}, sink, {});
  EXPECT_TRUE(pollUntil(*source, sink, [&] { return sink.values().back() == 42.0; }));
  EXPECT_EQ(sink.missings.size(), 1U);
}

TEST(Modbus, RtuOverAPseudoTerminal) {
  int controller = -1, terminal = -1;
  char name[256];
  ASSERT_EQ(::openpty(&controller, &terminal, name, nullptr, nullptr), 0);
  std::atomic<bool> stopping{false};
  std::thread module([&] {
    // Function 4 of unit 1, register 0, one word: the frames of the specification.
    while (!stopping) {
      pollfd wait{controller, POLLIN, 0};
      if (::poll(&wait, 1, 20) <= 0) continue;
      std::uint8_t query[256];
      const ssize_t got = ::read(controller, query, sizeof query);
      if (got < 8 || query[0] != 1 || query[1] != 4) continue;
      const std::uint8_t head[] = {1, 4, 2, 0x00, 0xEB};
      std::uint16_t crc = 0xFFFF;
      for (const std::uint8_t byte : head) {
        crc = static_cast<std::uint16_t>(crc ^ byte);
        for (int bit = 0; bit < 8; ++bit)
          crc = static_cast<std::uint16_t>((crc & 1) != 0 ? (crc >> 1) ^ 0xA001 : crc >> 1);
      }
      const std::uint8_t answer[] = {
          1, 4, 2, 0x00, 0xEB, static_cast<std::uint8_t>(crc), static_cast<std::uint8_t>(crc >> 8)};
      EXPECT_EQ(::write(controller, answer, sizeof answer), static_cast<ssize_t>(sizeof answer));
    }
  });
  const auto source = sourceFor(std::string("rtu://") + name);
  Collected sink;
  source->connect({});
  source->subscribe({"input:0"}, sink, {});
  EXPECT_TRUE(pollUntil(*source, sink, [&] { return sink.records.size() >= 3; }));
  EXPECT_EQ(sink.values().at(0), 235.0);
  source->close();
  stopping = true;
  module.join();
  ::close(terminal);
  ::close(controller);
}

}  // namespace
}  // namespace spindrift::testing
