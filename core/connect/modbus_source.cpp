// SPDX-License-Identifier: Apache-2.0
#include "core/connect/modbus_source.h"

#include <fmt/format.h>
#include <modbus/modbus.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <map>
#include <thread>

#include "core/base/steady_seconds.h"
#include "core/base/text.h"

namespace spindrift {
namespace {

enum class Table { Coil, Discrete, Holding, Input };

struct Register {
  Table table = Table::Input;
  int number = 0;
  std::string type = "int16";
  std::string order = "abcd";

  [[nodiscard]] int words() const { return type.ends_with("32") ? 2 : 1; }
};

Register registerOf(const std::string& address) {
  static const std::map<std::string, Table> tables{
      {"coil", Table::Coil}, {"discrete", Table::Discrete}, {"holding", Table::Holding}, {"input", Table::Input}};
  const std::vector<std::string> parts = splitList(address, ':');
  Register out;
  double number = -1.0;
  const bool numbered = parts.size() >= 2 && parseNumber(parts[1], number) && number == static_cast<int>(number) &&
                        number >= 0.0 && number <= 65535.0;
  if (!numbered || parts.size() > 4 || !tables.contains(parts[0]))
    throw std::invalid_argument("input:N, holding:N, coil:N or discrete:N with N from 0 to 65535");
  out.table = tables.at(parts[0]);
  out.number = static_cast<int>(number);
  const bool bit = out.table == Table::Coil || out.table == Table::Discrete;
  if (parts.size() > 2) {
    constexpr std::array<std::string_view, 5> types{"int16", "uint16", "int32", "uint32", "float32"};
    if (bit || std::find(types.begin(), types.end(), parts[2]) == types.end())
      throw std::invalid_argument("the types int16, uint16, int32, uint32 and float32, of registers only");
    out.type = parts[2];
  }
  if (parts.size() > 3) {
    constexpr std::array<std::string_view, 4> orders{"abcd", "cdab", "badc", "dcba"};
    if (out.words() != 2 || std::find(orders.begin(), orders.end(), parts[3]) == orders.end())
      throw std::invalid_argument("the orders abcd, cdab, badc and dcba, of types with 32 bits");
    out.order = parts[3];
  }
  if (out.number + out.words() > 65536) throw std::invalid_argument("registers up to 65535");
  return out;
}

double valueOf(const Register& reg, const std::uint16_t* words) {
  if (reg.table == Table::Coil || reg.table == Table::Discrete) return words[0] != 0 ? 1.0 : 0.0;
  if (reg.type == "int16") return static_cast<std::int16_t>(words[0]);
  if (reg.type == "uint16") return words[0];
  std::uint16_t high = words[0], low = words[1];
  const auto swapped = [](std::uint16_t w) { return static_cast<std::uint16_t>((w << 8) | (w >> 8)); };
  if (reg.order == "cdab" || reg.order == "dcba") std::swap(high, low);
  if (reg.order == "badc" || reg.order == "dcba") {
    high = swapped(high);
    low = swapped(low);
  }
  const std::uint32_t bits = (static_cast<std::uint32_t>(high) << 16) | low;
  if (reg.type == "int32") return static_cast<std::int32_t>(bits);
  if (reg.type == "uint32") return bits;
  return std::bit_cast<float>(bits);
}

class ModbusSource final : public Source {
 public:
  explicit ModbusSource(ModbusOptions options) : options_(std::move(options)) {}
  ~ModbusSource() override { close(); }

  void connect(const std::stop_token&) override {
    close();
    const std::size_t begin = options_.url.find("://");
    const std::string scheme = options_.url.substr(0, begin);
    std::string rest = options_.url.substr(begin + 3);
    if (scheme == "rtu") {
      context_ = modbus_new_rtu(rest.c_str(), options_.baud, options_.parity, 8, options_.stop_bits);
    } else {
      while (rest.ends_with('/')) rest.pop_back();
      const std::size_t colon = rest.rfind(':');
      const std::string port = colon == std::string::npos ? "502" : rest.substr(colon + 1);
      context_ = modbus_new_tcp_pi(rest.substr(0, colon).c_str(), port.c_str());
    }
    if (context_ == nullptr) fail("cannot be opened");
    const double answer_s = std::max(0.01, options_.answer_s);
    const auto seconds = static_cast<std::uint32_t>(answer_s);
    modbus_set_response_timeout(context_, seconds, static_cast<std::uint32_t>((answer_s - seconds) * 1e6));
    modbus_set_slave(context_, options_.unit_id);
    if (modbus_connect(context_) != 0) fail("cannot be connected");
    next_s_ = 0.0;
  }

  std::vector<DataItem> list(double, const std::stop_token&) override {
    return {};
  }  // registers do not say what they are

  void subscribe(const std::vector<std::string>& items, RecordSink& sink, const std::stop_token&) override {
    if (subscribed_) sink.missed("registers cannot be read afterwards.");
    subscribed_ = true;
    wanted_.clear();
    for (std::uint32_t i = 0; i < items.size(); ++i) {
      try {
        wanted_.push_back({i, registerOf(items[i])});
      } catch (const std::invalid_argument& allowed) {
        sink.note(fmt::format("\"{}\" is not a register; allowed: {}.", items[i], allowed.what()));
      }
    }
    // Neighbours are read together.
    std::stable_sort(wanted_.begin(), wanted_.end(), [](const Wanted& a, const Wanted& b) {
      return std::pair(a.reg.table, a.reg.number) < std::pair(b.reg.table, b.reg.number);
    });
  }

  void poll(double wait_s, RecordSink& sink) override {
    const double now = steadySeconds();
    if (now < next_s_) {
      std::this_thread::sleep_for(std::chrono::duration<double>(std::min(wait_s, next_s_ - now)));
      return;
    }
    next_s_ = std::max(next_s_ + options_.interval_s, now);
    for (std::size_t begin = 0; begin < wanted_.size();) {
      std::size_t end = begin + 1;
      const Register& first = wanted_[begin].reg;
      int last = first.number + first.words();
      // A gap may hold registers that a module refuses to read.
      while (end < wanted_.size() && wanted_[end].reg.table == first.table && wanted_[end].reg.number <= last &&
             wanted_[end].reg.number + wanted_[end].reg.words() - first.number <= 100 && !wanted_[begin].refused &&
             !wanted_[end].refused) {
        last = std::max(last, wanted_[end].reg.number + wanted_[end].reg.words());
        ++end;
      }
      read(begin, end, last - first.number, sink);
      begin = end;
    }
  }

  void close() noexcept override {
    if (context_ == nullptr) return;
    modbus_close(context_);
    modbus_free(context_);
    context_ = nullptr;
  }

 private:
  struct Wanted {
    std::uint32_t item;
    Register reg;
    bool refused = false;  ///< once: it is then read alone
    bool told = false;
  };

  [[noreturn]] void fail(const std::string& what) {
    const std::string reason = modbus_strerror(errno);
    close();
    throw ConnectionError(fmt::format("{} {}: {}.", options_.url, what, reason));
  }

  void read(std::size_t begin, std::size_t end, int count, RecordSink& sink) {
    std::array<std::uint16_t, 128> words{};
    std::array<std::uint8_t, 128> bits{};
    const Register& first = wanted_[begin].reg;
    int got = -1;
    switch (first.table) {
      case Table::Coil:
        got = modbus_read_bits(context_, first.number, count, bits.data());
        break;
      case Table::Discrete:
        got = modbus_read_input_bits(context_, first.number, count, bits.data());
        break;
      case Table::Holding:
        got = modbus_read_registers(context_, first.number, count, words.data());
        break;
      case Table::Input:
        got = modbus_read_input_registers(context_, first.number, count, words.data());
        break;
    }
    const int error = errno;
    const bool bit = first.table == Table::Coil || first.table == Table::Discrete;
    if (bit) std::copy(bits.begin(), bits.end(), words.begin());
    // The module answers, but not to this: the rest goes on. Anything else is the connection.
    const bool refused = got != count && error > MODBUS_ENOBASE && error <= EMBXGTAR;
    if (got != count && !refused) {
      errno = error;
      fail("does not answer");
    }
    for (std::size_t i = begin; i < end; ++i) {
      Record record;
      record.item = wanted_[i].item;
      if (refused) {
        record.quality = Quality::Unavailable;
        if (!wanted_[i].told && end - begin == 1) {
          sink.note(fmt::format("{} refuses register {}: {}.", options_.url, first.number, modbus_strerror(error)));
          wanted_[i].told = true;
        }
        wanted_[i].refused = true;
      } else {
        record.value = valueOf(wanted_[i].reg, words.data() + (wanted_[i].reg.number - first.number));
      }
      sink.record(record);
    }
  }

  ModbusOptions options_;
  modbus_t* context_ = nullptr;
  std::vector<Wanted> wanted_;
  bool subscribed_ = false;
  double next_s_ = 0.0;
};

}  // namespace

void checkModbusAddress(const std::string& address) {
  (void)registerOf(address);
}

std::unique_ptr<Source> makeModbusSource(const ModbusOptions& options) {
  return std::make_unique<ModbusSource>(options);
}

}  // namespace spindrift
