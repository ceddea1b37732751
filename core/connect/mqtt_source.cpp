// SPDX-License-Identifier: Apache-2.0
#include "core/connect/mqtt_source.h"

#include <fmt/format.h>
#include <mosquitto.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <deque>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <vector>

#include "core/base/steady_seconds.h"
#include "core/base/text.h"
#include "core/base/untrusted_text.h"
#include "core/connect/sparkplug.pb.h"
#include "core/connect/tcp_connection.h"

namespace spindrift {
namespace {

constexpr std::string_view sparkplug_prefix = "spBv1.0/";
constexpr std::size_t most_listed = 5000;

struct Message {
  std::string topic;
  std::string text;
  bool retained = false;
};

/// "a.b[2].c", with or without "$." in front.
const nlohmann::json* valueAt(const nlohmann::json& root, std::string_view path) {
  const nlohmann::json* at = &root;
  if (path.starts_with('$')) path.remove_prefix(1);
  while (!path.empty()) {
    if (path.front() == '.') path.remove_prefix(1);
    if (path.starts_with('[')) {
      const std::size_t close = path.find(']');
      std::size_t index = 0;
      if (close == std::string_view::npos ||
          std::from_chars(path.data() + 1, path.data() + close, index).ptr != path.data() + close || !at->is_array() ||
          index >= at->size())
        return nullptr;
      at = &(*at)[index];
      path.remove_prefix(close + 1);
      continue;
    }
    const std::size_t end = std::min(path.find_first_of(".["), path.size());
    if (!at->is_object()) return nullptr;
    const auto found = at->find(std::string(path.substr(0, end)));
    if (found == at->end()) return nullptr;
    at = &*found;
    path.remove_prefix(end);
  }
  return at;
}

void setText(Record& record, std::string_view text) {
  double number = 0.0;
  if (parseNumber(trimmed(text), number)) {
    record.quality = Quality::Good;
    record.value = number;
  } else {
    record.quality = Quality::Text;
    record.text = trimmed(text).substr(0, 256);
  }
}

/// False: what stands there is no single value.
bool setJson(Record& record, const nlohmann::json& value) {
  if (value.is_null()) {
    record.quality = Quality::Unavailable;
  } else if (value.is_boolean()) {
    record.value = value.get<bool>() ? 1.0 : 0.0;
  } else if (value.is_number()) {
    record.value = value.get<double>();
  } else if (value.is_string()) {
    setText(record, value.get_ref<const std::string&>());
  } else {
    return false;
  }
  return true;
}

/// Signed integers travel as unsigned ones.
void setMetric(Record& record, const sparkplug::Metric& metric, std::uint32_t type) {
  record.quality = Quality::Good;
  if (metric.is_null()) {
    record.quality = Quality::Unavailable;
    return;
  }
  switch (metric.value_case()) {
    case sparkplug::Metric::kIntValue:
      record.value = type == 1   ? static_cast<std::int8_t>(metric.int_value())
                     : type == 2 ? static_cast<std::int16_t>(metric.int_value())
                     : type == 3 ? static_cast<double>(static_cast<std::int32_t>(metric.int_value()))
                                 : static_cast<double>(metric.int_value());
      break;
    case sparkplug::Metric::kLongValue:
      record.value = type == 4 ? static_cast<double>(static_cast<std::int64_t>(metric.long_value()))
                               : static_cast<double>(metric.long_value());
      break;
    case sparkplug::Metric::kFloatValue:
      record.value = static_cast<double>(metric.float_value());
      break;
    case sparkplug::Metric::kDoubleValue:
      record.value = metric.double_value();
      break;
    case sparkplug::Metric::kBooleanValue:
      record.value = metric.boolean_value() ? 1.0 : 0.0;
      break;
    case sparkplug::Metric::kStringValue:
      setText(record, metric.string_value());
      break;
    case sparkplug::Metric::VALUE_NOT_SET:
      record.quality = Quality::Unavailable;
      break;
  }
}

std::string unitOf(const sparkplug::Metric& metric) {
  for (int i = 0; i < metric.properties().keys_size() && i < metric.properties().values_size(); ++i) {
    const std::string& key = metric.properties().keys(i);
    if (key == "engUnit" || key == "Engineering Unit" || key == "unit")
      return metric.properties().values(i).string_value();
  }
  return {};
}

struct Known {
  std::string device;  ///< empty: of the node
  std::string name;
  std::uint32_t type = 0;
  std::string unit;
};

struct Node {
  bool born = false;
  int seq = -1;
  std::optional<std::uint64_t> birth_number;  ///< bdSeq
  double asked_s = -1e9;                      ///< for a rebirth
  std::uint16_t clock = 0;
  std::map<std::uint64_t, Known> aliases;
  std::map<std::pair<std::string, std::string>, Known> names;  ///< device, metric
};

class MqttSource final : public Source {
 public:
  explicit MqttSource(MqttOptions options) : options_(std::move(options)) {
    static const int started = mosquitto_lib_init();
    (void)started;
  }
  ~MqttSource() override { close(); }

  void connect(const std::stop_token& stop) override {
    close();
    secure_ = options_.url.starts_with("mqtts://");
    const HostAndPort broker = hostAndPort(options_.url, secure_ ? 8883 : 1883);
    // libmosquitto waits as long as the system does for a broker that does not answer: look first.
    const int trial = openTcp(broker, options_.answer_s, stop);
    if (trial < 0) return;
    ::close(trial);
    client_ = mosquitto_new(options_.client_id.empty() ? nullptr : options_.client_id.c_str(),
                            options_.client_id.empty(), this);
    if (client_ == nullptr) throw ConnectionError(fmt::format("{}: no client can be made.", options_.url));
    mosquitto_connect_with_flags_callback_set(client_, [](mosquitto*, void* self, int code, int flags) {
      static_cast<MqttSource*>(self)->answer_ = code;
      static_cast<MqttSource*>(self)->kept_ = (flags & 1) != 0;
    });
    mosquitto_message_callback_set(client_, [](mosquitto*, void* self, const mosquitto_message* message) {
      static_cast<MqttSource*>(self)->came_.push_back(
          {message->topic,
           std::string(static_cast<const char*>(message->payload), static_cast<std::size_t>(message->payloadlen)),
           message->retain});
    });
    if (!options_.user.empty())
      mosquitto_username_pw_set(client_, options_.user.c_str(),
                                options_.password.empty() ? nullptr : options_.password.c_str());
    if (secure_) {
      const char* file = options_.ca_file.empty() ? nullptr : options_.ca_file.c_str();
      check(mosquitto_tls_set(client_, file, file == nullptr ? "/etc/ssl/certs" : nullptr, nullptr, nullptr, nullptr),
            "cannot use its certificates");
    }
    if (!options_.will_topic.empty())
      check(mosquitto_will_set(client_, options_.will_topic.c_str(), static_cast<int>(options_.will_text.size()),
                               options_.will_text.data(), 1, false),
            "cannot have this will");
    answer_ = -1;
    check(mosquitto_connect(client_, broker.host.c_str(), broker.port, options_.keepalive_s), "cannot be connected");
    const double until = steadySeconds() + options_.answer_s;
    while (answer_ < 0 && !stop.stop_requested()) {
      const int code = mosquitto_loop(client_, 20, 1);
      if (answer_ > 0) break;  // it says why, and ends the connection
      check(code, "ended the connection");
      if (steadySeconds() > until) {
        close();
        throw ConnectionError(fmt::format("{} does not answer as a broker.", options_.url));
      }
    }
    if (answer_ > 0) {
      const std::string reason = mosquitto_connack_string(answer_);
      close();
      throw ConnectionError(fmt::format("{} refuses: {}", options_.url, reason));
    }
  }

  std::vector<DataItem> list(double listen_s, const std::stop_token& stop) override {
    check(mosquitto_subscribe(client_, nullptr, "#", 0), "cannot be subscribed to");
    std::map<std::string, DataItem> found;
    const auto add = [&](DataItem item) {
      if (found.size() < most_listed) found[item.address] = std::move(item);
    };
    const double until = steadySeconds() + listen_s;
    while (steadySeconds() < until && !stop.stop_requested()) {
      check(mosquitto_loop(client_, 20, 1), "ended the connection");
      for (; !came_.empty(); came_.pop_front()) {
        const Message& message = came_.front();
        if (message.topic.starts_with(sparkplug_prefix)) {
          listSparkplug(message, add);
          continue;
        }
        nlohmann::json json(nlohmann::json::value_t::discarded);
        if (deepestJson(message.text) <= most_levels_of_json)
          json = nlohmann::json::parse(message.text, nullptr, false);
        if (json.is_object() || json.is_array()) {
          listJson(message.topic, "", json, add);
        } else {
          add({message.topic, "", "", "", "", "", message.text.substr(0, 40)});
        }
      }
    }
    std::vector<DataItem> items;
    for (auto& [address, item] : found) items.push_back(std::move(item));
    return items;
  }

  void subscribe(const std::vector<std::string>& items, RecordSink& sink, const std::stop_token&) override {
    if (subscribed_ && !kept_) sink.missed(fmt::format("{} keeps nothing for a client that is away.", options_.url));
    subscribed_ = true;
    topics_.clear();
    metrics_.clear();
    units_.assign(items.size(), "");
    std::set<std::string> filters;
    for (std::uint32_t i = 0; i < items.size(); ++i) {
      const std::string& address = items[i];
      const std::size_t mark = address.find('#');
      const std::string topic = address.substr(0, mark);
      const std::string inside = mark == std::string::npos ? "" : address.substr(mark + 1);
      if (topic.starts_with(sparkplug_prefix)) {
        const std::vector<std::string> parts = splitList(topic, '/');
        if (parts.size() < 3 || parts.size() > 4 || inside.empty()) {
          sink.note(fmt::format("\"{}\" is not a metric; allowed: spBv1.0/group/node[/device]#metric.", address));
          continue;
        }
        metrics_[parts[1] + "/" + parts[2]][{parts.size() == 4 ? parts[3] : "", inside}].push_back(i);
        filters.insert(fmt::format("spBv1.0/{}/+/{}/#", parts[1], parts[2]));
      } else if (mosquitto_pub_topic_check(topic.c_str()) != MOSQ_ERR_SUCCESS) {
        sink.note(fmt::format("\"{}\" is not a topic; allowed: one topic without wildcards.", address));
      } else {
        topics_[topic].push_back({i, inside});
        filters.insert(topic);
      }
    }
    for (auto& [name, node] : nodes_) node.born = false;  // what was learnt may have changed meanwhile
    for (const std::string& filter : filters)
      check(mosquitto_subscribe(client_, nullptr, filter.c_str(), 1), "cannot be subscribed to");
    for (const auto& [name, wanted] : metrics_) askForBirth(name, nodes_[name]);
  }

  void poll(double wait_s, RecordSink& sink) override {
    const double until = steadySeconds() + wait_s;
    while (true) {
      const double left = until - steadySeconds();
      const int code = mosquitto_loop(client_, std::clamp(static_cast<int>(left * 1e3), 0, 100), 1);
      for (; !came_.empty(); came_.pop_front()) deliver(came_.front(), sink);
      check(code, "ended the connection");
      if (left <= 0.0) return;
    }
  }

  void close() noexcept override {
    if (client_ == nullptr) return;
    mosquitto_disconnect(client_);
    mosquitto_destroy(client_);
    client_ = nullptr;
    // came_ stays: the broker takes it as delivered, and the next poll delivers it.
  }

 private:
  using Metrics = std::map<std::pair<std::string, std::string>, std::vector<std::uint32_t>>;

  void check(int code, const char* what) {
    if (code == MOSQ_ERR_SUCCESS) return;
    const std::string reason = code == MOSQ_ERR_ERRNO ? std::strerror(errno) : mosquitto_strerror(code);
    close();
    throw ConnectionError(fmt::format("{} {}: {}", options_.url, what, reason));
  }

  template <typename Add>
  static void listJson(const std::string& topic, const std::string& path, const nlohmann::json& value, const Add& add) {
    if (value.is_object() || value.is_array()) {
      std::size_t index = 0;
      for (const auto& [key, member] : value.items()) {
        listJson(topic,
                 value.is_array() ? fmt::format("{}[{}]", path, index++)
                 : path.empty()   ? key
                                  : path + "." + key,
                 member, add);
      }
      return;
    }
    add(DataItem{topic + "#" + path, "", "", "", value.type_name(), "",
                 (value.is_string() ? value.get<std::string>() : value.dump()).substr(0, 40)});
  }

  template <typename Add>
  void listSparkplug(const Message& message, const Add& add) {
    const std::vector<std::string> parts = splitList(message.topic, '/');
    sparkplug::Payload payload;
    if (parts.size() < 4 || !payload.ParseFromString(message.text)) return;
    const std::string& kind = parts[2];
    const std::string name = parts[1] + "/" + parts[3];
    Node& node = nodes_[name];
    if (kind == "NDATA" || kind == "DDATA") {
      if (!node.born) askForBirth(name, node);
      return;
    }
    if (kind != "NBIRTH" && kind != "DBIRTH") return;
    node.born = true;
    const std::string place = fmt::format("spBv1.0/{}{}", name, parts.size() > 4 ? "/" + parts[4] : "");
    for (const sparkplug::Metric& metric : payload.metrics()) {
      Record shown;
      setMetric(shown, metric, metric.datatype());
      add(DataItem{place + "#" + metric.name(), metric.name(), place, "",
                   fmt::format("Sparkplug {}", metric.datatype()), unitOf(metric),
                   shown.quality == Quality::Text ? shown.text : fmt::format("{:g}", shown.value)});
    }
  }

  void askForBirth(const std::string& name, Node& node) {
    if (!options_.ask_rebirth || steadySeconds() - node.asked_s < 5.0) return;
    node.asked_s = steadySeconds();
    sparkplug::Payload payload;
    payload.set_timestamp(static_cast<std::uint64_t>(localUtc() * 1e3));
    sparkplug::Metric& metric = *payload.add_metrics();
    metric.set_name("Node Control/Rebirth");
    metric.set_datatype(11);
    metric.set_boolean_value(true);
    const std::string text = payload.SerializeAsString();
    const std::size_t slash = name.find('/');
    const std::string topic = fmt::format("spBv1.0/{}/NCMD/{}", name.substr(0, slash), name.substr(slash + 1));
    check(mosquitto_publish(client_, nullptr, topic.c_str(), static_cast<int>(text.size()), text.data(), 0, false),
          "cannot be asked for a birth");
  }

  void deliver(const Message& message, RecordSink& sink) {
    if (message.topic.starts_with(sparkplug_prefix)) {
      deliverSparkplug(message, sink);
      return;
    }
    const auto found = topics_.find(message.topic);
    if (found == topics_.end()) return;
    std::optional<nlohmann::json> json;
    for (const auto& [item, path] : found->second) {
      Record record;
      record.item = item;
      record.snapshot = message.retained;
      if (path.empty()) {
        setText(record, message.text);
        sink.record(std::move(record));
        continue;
      }
      if (!json) json = nlohmann::json::parse(message.text, nullptr, false);
      if (json->is_discarded()) {
        if (told_.insert(message.topic).second) sink.note(fmt::format("{} sends no JSON.", message.topic));
        continue;
      }
      const nlohmann::json* value = valueAt(*json, path);
      // A message need not hold everything.
      if (value != nullptr && setJson(record, *value)) sink.record(std::move(record));
    }
  }

  void deliverSparkplug(const Message& message, RecordSink& sink) {
    const std::vector<std::string> parts = splitList(message.topic, '/');
    if (parts.size() < 4 || parts.size() > 5) return;
    const std::string& kind = parts[2];
    const std::string name = parts[1] + "/" + parts[3];
    const std::string device = parts.size() == 5 ? parts[4] : "";
    const auto wanted = metrics_.find(name);
    if (wanted == metrics_.end() || kind == "NCMD" || kind == "DCMD") return;
    sparkplug::Payload payload;
    if (!payload.ParseFromString(message.text)) {
      if (told_.insert(message.topic).second) sink.note(fmt::format("{} sends no Sparkplug payload.", message.topic));
      return;
    }
    Node& node = nodes_[name];
    if (node.clock == 0) node.clock = static_cast<std::uint16_t>(nodes_.size());
    if (kind == "NDEATH") {
      // The will of an earlier connection may come after the birth of the present one.
      const auto number = birthNumber(payload);
      if (node.born && number && node.birth_number && *number != *node.birth_number) return;
      node.born = false;
      unavailable(wanted->second, nullptr, sink);
      return;
    }
    if (kind == "NBIRTH") {
      node.aliases.clear();
      node.names.clear();
      node.born = true;
      node.seq = static_cast<int>(payload.seq());
      node.birth_number = birthNumber(payload);
    } else {
      if (!node.born) {
        askForBirth(name, node);
        return;
      }
      const int expected = (node.seq + 1) % 256;
      if (payload.has_seq() && static_cast<int>(payload.seq()) != expected) {
        node.born = false;
        std::vector<std::uint32_t> items;
        for (const auto& [metric, each] : wanted->second) items.insert(items.end(), each.begin(), each.end());
        sink.missedOf(items, fmt::format("{}: message {} came in place of {}.", name, payload.seq(), expected));
        askForBirth(name, node);
        return;
      }
      node.seq = expected;
      if (kind == "DDEATH") {
        unavailable(wanted->second, &device, sink);
        return;
      }
    }
    const bool birth = kind.ends_with("BIRTH");
    if (birth) tellUnits(payload, device, wanted->second, sink);
    for (const sparkplug::Metric& metric : payload.metrics()) {
      Known known{device, metric.name(), metric.datatype(), unitOf(metric)};
      if (birth) {
        if (metric.has_alias()) node.aliases[metric.alias()] = known;
        node.names[{device, metric.name()}] = known;
      } else if (metric.has_name() && !metric.name().empty()) {
        const auto learnt = node.names.find({device, metric.name()});
        if (learnt != node.names.end()) known = learnt->second;
      } else {
        const auto learnt = node.aliases.find(metric.alias());
        if (learnt == node.aliases.end()) continue;
        known = learnt->second;
      }
      const auto items = wanted->second.find({known.device, known.name});
      if (items == wanted->second.end()) continue;
      Record record;
      record.clock = node.clock;
      record.snapshot = birth;
      if (metric.has_timestamp() || payload.has_timestamp())
        record.source_s = static_cast<double>(metric.has_timestamp() ? metric.timestamp() : payload.timestamp()) / 1e3;
      if (metric.is_historical() && std::isfinite(record.source_s)) {
        // Stored by the node and sent afterwards: its stamp says nothing of the delay.
        record.received_s = record.source_s;
        record.clock |= 0x8000U;
      }
      setMetric(record, metric, known.type);
      for (const std::uint32_t item : items->second) {
        record.item = item;
        sink.record(record);
      }
    }
  }

  /// The units that a birth states, before its values.
  void tellUnits(const sparkplug::Payload& birth, const std::string& device, const Metrics& metrics, RecordSink& sink) {
    bool other = false;
    for (const sparkplug::Metric& metric : birth.metrics()) {
      const auto items = metrics.find({device, metric.name()});
      if (items == metrics.end()) continue;
      const std::string unit = unitOf(metric);
      for (const std::uint32_t item : items->second) {
        other = other || units_[item] != unit;
        units_[item] = unit;
      }
    }
    if (other) sink.units({units_});
  }

  static std::optional<std::uint64_t> birthNumber(const sparkplug::Payload& payload) {
    for (const sparkplug::Metric& metric : payload.metrics()) {
      if (metric.name() == "bdSeq") return metric.has_long_value() ? metric.long_value() : metric.int_value();
    }
    return std::nullopt;
  }

  /// All of a node, or those of one device.
  static void unavailable(const Metrics& metrics, const std::string* device, RecordSink& sink) {
    for (const auto& [metric, items] : metrics) {
      if (device != nullptr && metric.first != *device) continue;
      for (const std::uint32_t item : items) {
        Record record;
        record.item = item;
        record.quality = Quality::Unavailable;
        sink.record(record);
      }
    }
  }

  MqttOptions options_;
  mosquitto* client_ = nullptr;
  bool secure_ = false;
  int answer_ = -1;
  bool kept_ = false;  ///< the broker kept the session
  bool subscribed_ = false;
  std::deque<Message> came_;
  std::map<std::string, std::vector<std::pair<std::uint32_t, std::string>>> topics_;  ///< item and path
  std::vector<std::string> units_;          ///< of the subscription, as births stated them
  std::map<std::string, Metrics> metrics_;  ///< "group/node"
  std::map<std::string, Node> nodes_;
  std::set<std::string> told_;
};

}  // namespace

std::unique_ptr<Source> makeMqttSource(const MqttOptions& options) {
  return std::make_unique<MqttSource>(options);
}

}  // namespace spindrift
