// SPDX-License-Identifier: Apache-2.0
#include "core/connect/mtconnect_source.h"

#include <curl/curl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <thread>
#include <unordered_map>
#include <vector>

#include "core/base/steady_seconds.h"
#include "core/base/text.h"
#include "core/base/utc_time.h"

namespace spindrift {
namespace {

/// No document of an agent is that long; what is, is none.
constexpr std::size_t longest_document = std::size_t{64} << 20;

/// Name without its prefix: agents write <Header> or <m:Header>.
std::string_view localName(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

pugi::xml_node childNamed(const pugi::xml_node& parent, std::string_view name) {
  for (const pugi::xml_node child : parent.children()) {
    if (localName(child) == name) return child;
  }
  return {};
}

/// One GET that is driven step by step, so that it can be ended at any moment.
class Download {
 public:
  explicit Download(const std::string& url) : url_(url) {
    static const CURLcode started = curl_global_init(CURL_GLOBAL_DEFAULT);
    easy_ = curl_easy_init();
    multi_ = curl_multi_init();
    if (started != CURLE_OK || easy_ == nullptr || multi_ == nullptr) throw ConnectionError("libcurl does not start.");
    curl_easy_setopt(easy_, CURLOPT_URL, url_.c_str());
    curl_easy_setopt(easy_, CURLOPT_NOSIGNAL, 1L);
    // The address that the user entered and no other: no redirects, no proxy of the environment.
    curl_easy_setopt(easy_, CURLOPT_FOLLOWLOCATION, 0L);
    curl_easy_setopt(easy_, CURLOPT_PROXY, "");
    curl_easy_setopt(easy_, CURLOPT_PROTOCOLS_STR, "http,https");
    curl_easy_setopt(easy_, CURLOPT_CONNECTTIMEOUT_MS, 5000L);
    curl_easy_setopt(easy_, CURLOPT_TCP_KEEPALIVE, 1L);
    curl_easy_setopt(easy_, CURLOPT_WRITEDATA, this);
    curl_easy_setopt(
        easy_, CURLOPT_WRITEFUNCTION, +[](char* data, std::size_t size, std::size_t count, void* self) {
          auto& download = *static_cast<Download*>(self);
          download.received_s_ = steadySeconds();
          if (download.buffer.size() + size * count > 2 * longest_document) return std::size_t{0};
          download.buffer.append(data, size * count);
          return size * count;
        });
    curl_multi_add_handle(multi_, easy_);
    received_s_ = steadySeconds();
  }
  Download(const Download&) = delete;
  Download& operator=(const Download&) = delete;
  ~Download() {
    if (multi_ != nullptr && easy_ != nullptr) curl_multi_remove_handle(multi_, easy_);
    if (easy_ != nullptr) curl_easy_cleanup(easy_);
    if (multi_ != nullptr) curl_multi_cleanup(multi_);
  }

  /// Waits for at most `wait_s` and takes what has come. Throws ConnectionError if the transfer broke.
  void step(double wait_s) {
    int running = 0;
    perform(running);
    if (ended_) return;
    curl_multi_poll(multi_, nullptr, 0, static_cast<int>(wait_s * 1e3), nullptr);
    perform(running);
  }
  [[nodiscard]] bool ended() const { return ended_; }
  /// Why the transfer ended early; empty if it is complete.
  [[nodiscard]] const std::string& failure() const { return failure_; }
  [[nodiscard]] double silence_s() const { return steadySeconds() - received_s_; }
  [[nodiscard]] long status() const {
    long code = 0;
    curl_easy_getinfo(easy_, CURLINFO_RESPONSE_CODE, &code);
    return code;
  }

  std::string buffer;

 private:
  void perform(int& running) {
    curl_multi_perform(multi_, &running);
    int left = 0;
    while (const CURLMsg* message = curl_multi_info_read(multi_, &left)) {
      if (message->msg != CURLMSG_DONE) continue;
      ended_ = true;
      failure_ = message->data.result == CURLE_OK ? "" : curl_easy_strerror(message->data.result);
    }
  }

  std::string url_;
  CURL* easy_ = nullptr;
  CURLM* multi_ = nullptr;
  bool ended_ = false;
  std::string failure_;
  double received_s_ = 0.0;
};

/// Takes the next whole document out of a stream: from the first '<' of an XML text to the end tag of its root.
class DocumentCutter {
 public:
  /// Nothing if it is not complete yet; `buffer` loses what was taken.
  std::optional<std::string> next(std::string& buffer) {
    while (true) {
      const std::size_t found = buffer.find("MTConnect", searched_);
      if (found == std::string::npos) {
        searched_ = buffer.size() < 16 ? 0 : buffer.size() - 16;
        return std::nullopt;
      }
      const std::size_t close = buffer.find_first_of("<>", found);
      if (close == std::string::npos) {
        searched_ = found;
        return std::nullopt;
      }
      const std::size_t open = buffer.rfind('<', found);
      searched_ = close + 1;
      if (open == std::string::npos || buffer[close] != '>' || buffer[open + 1] != '/') continue;
      std::size_t begin = buffer.find("<?xml");
      if (begin == std::string::npos || begin > open) begin = buffer.find('<');
      std::string document = buffer.substr(begin, close + 1 - begin);
      buffer.erase(0, close + 1);
      searched_ = 0;
      return document;
    }
  }

 private:
  std::size_t searched_ = 0;
};

struct Wanted {
  std::uint32_t item = 0;
  int part = -1;  ///< of a value of several numbers
};

class MtconnectSource final : public Source {
 public:
  explicit MtconnectSource(MtconnectOptions options) : options_(std::move(options)) {
    std::string& url = options_.url;
    if (const std::size_t query = url.find('?'); query != std::string::npos) url.erase(query);
    while (url.ends_with('/')) url.pop_back();
    for (const std::string_view request : {"/probe", "/current", "/sample"}) {
      if (url.ends_with(request)) url.erase(url.size() - request.size());
    }
  }

  void connect(const std::stop_token& stop) override {
    close();
    const pugi::xml_document probe = get("/probe", stop);
    if (stop.stop_requested()) return;
    if (localName(probe.document_element()) != "MTConnectDevices")
      throw ConnectionError(fmt::format("{}/probe answers, but not with MTConnectDevices.", options_.url));
    items_.clear();
    const pugi::xml_node devices = childNamed(probe.document_element(), "Devices");
    for (const pugi::xml_node device : devices.children()) gatherItems(device, "");
  }

  std::vector<DataItem> list(double, const std::stop_token& stop) override {
    std::vector<DataItem> items = items_;
    const pugi::xml_document current = get("/current", stop);
    std::unordered_map<std::string, std::string> values;
    forEachObservation(current, [&](const pugi::xml_node& node, std::uint16_t, std::string_view group) {
      values[node.attribute("dataItemId").value()] =
          group == "Condition" ? std::string(localName(node)) : std::string(trimmed(node.text().get()));
    });
    for (DataItem& item : items) item.example = values[item.address];
    return items;
  }

  void subscribe(const std::vector<std::string>& items, RecordSink& sink, const std::stop_token& stop) override {
    stop_ = stop;
    wanted_.clear();
    for (std::uint32_t i = 0; i < items.size(); ++i) {
      const auto [item, part] = find(items[i]);
      if (item == nullptr) {
        sink.note(fmt::format("{} has no data item \"{}\".", options_.url, items[i]));
      } else {
        wanted_[item->address].push_back({i, part});
      }
    }
    if (next_ == 0) begin(sink);
    if (!stop.stop_requested()) openStream();
  }

  std::string unit(const std::string& address) const override {
    const DataItem* item = find(address).first;
    return item == nullptr ? std::string() : item->unit;
  }

  void poll(double wait_s, RecordSink& sink) override {
    if (!stream_) {
      openStream();
      return;
    }
    stream_->step(wait_s);
    // A download that only waits has no documents; agents that do not stream send one and end.
    while (std::optional<std::string> text = cutter_.next(stream_->buffer)) {
      if (!take(*text, sink)) return;
    }
    if (stream_->buffer.size() > longest_document)
      throw ConnectionError(fmt::format("{} sends a document without an end.", options_.url));
    if (stream_->ended()) {
      const std::string failure = stream_->failure();
      const long status = stream_->status();
      const bool good = failure.empty() && documents_ > 0;
      stream_.reset();
      if (!good) {
        throw ConnectionError(fmt::format(
            "{} ended the stream{}.", options_.url,
            failure.empty() ? (status == 200 ? std::string(" without data") : fmt::format(" with status {}", status))
                            : ": " + failure));
      }
      // Whole documents and an orderly end: an agent without streams, or one that was stopped. Ask again, not at once.
      const double pause = std::min(options_.interval_s, 1.0);
      reopen_s_ = steadySeconds() + pause;
      return;
    }
    const double patience = 3.0 * options_.heartbeat_s;
    if (stream_->silence_s() > patience)
      throw ConnectionError(fmt::format("{} has said nothing for {:.0f} s.", options_.url, patience));
  }

  void close() noexcept override {
    stream_.reset();
    cutter_ = {};
  }

 private:
  /// The data item of an address and the part of it, -1 for the whole.
  [[nodiscard]] std::pair<const DataItem*, int> find(std::string address) const {
    int part = -1;
    if (const std::size_t open = address.rfind('['); open != std::string::npos && address.ends_with(']')) {
      double number = 0.0;
      if (parseNumber(std::string_view(address).substr(open + 1, address.size() - open - 2), number) && number >= 0.0) {
        part = static_cast<int>(number);
        address.erase(open);
      }
    }
    for (const DataItem& item : items_) {
      if (item.address == address) return {&item, part};
    }
    for (const DataItem& item : items_) {
      if (item.name == address) return {&item, part};
    }
    return {nullptr, part};
  }

  void gatherItems(const pugi::xml_node& component, const std::string& above, int level = 0) {
    constexpr int most_levels = 64;
    if (level > most_levels)
      throw ConnectionError(
          fmt::format("{} describes components nested more than {} levels deep.", options_.url, most_levels));
    std::string name = component.attribute("name").value();
    if (name.empty()) name = localName(component);
    const std::string path = above.empty() ? name : above + " / " + name;
    for (const pugi::xml_node part : component.children()) {
      if (localName(part) == "DataItems") {
        for (const pugi::xml_node item : part.children()) {
          if (localName(item) != "DataItem") continue;
          DataItem out;
          out.address = item.attribute("id").value();
          out.name = item.attribute("name").value();
          out.component = path;
          out.category = item.attribute("category").value();
          std::transform(out.category.begin(), out.category.end(), out.category.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
          out.type = item.attribute("type").value();
          if (const pugi::xml_attribute sub = item.attribute("subType")) out.type += fmt::format(" {}", sub.value());
          out.unit = item.attribute("units").value();
          if (!out.address.empty()) items_.push_back(std::move(out));
        }
      } else if (localName(part) == "Components") {
        for (const pugi::xml_node child : part.children()) gatherItems(child, path, level + 1);
      }
    }
  }

  [[nodiscard]] pugi::xml_document get(const std::string& request, const std::stop_token& stop) const {
    Download download(options_.url + request);
    const double until = steadySeconds() + options_.answer_s;
    while (!download.ended() && !stop.stop_requested()) {
      download.step(0.05);
      if (steadySeconds() > until)
        throw ConnectionError(
            fmt::format("{}{} has not answered within {:.0f} s.", options_.url, request, options_.answer_s));
    }
    pugi::xml_document document;
    if (stop.stop_requested()) return document;
    if (!download.failure().empty())
      throw ConnectionError(fmt::format("{}{}: {}.", options_.url, request, download.failure()));
    const pugi::xml_parse_result parsed = document.load_buffer(download.buffer.data(), download.buffer.size());
    // Errors of an agent come as documents, with any status.
    if (parsed && localName(document.document_element()) == "MTConnectError")
      throw ConnectionError(fmt::format("{}{} answers \"{}\".", options_.url, request, errorOf(document).second));
    if (download.status() != 200)
      throw ConnectionError(fmt::format("{}{} answers with status {}.", options_.url, request, download.status()));
    if (!parsed)
      throw ConnectionError(fmt::format("{}{} answers with no XML: {}.", options_.url, request, parsed.description()));
    return document;
  }

  /// Code and sentence. Version 1.0 has one Error below the root, later ones a list.
  static std::pair<std::string, std::string> errorOf(const pugi::xml_document& document) {
    const pugi::xml_node root = document.document_element();
    const pugi::xml_node list = childNamed(root, "Errors");
    pugi::xml_node error = childNamed(list ? list : root, "Error");
    if (!error) error = list.first_child();  // 2.x: <OutOfRange errorCode="OUT_OF_RANGE"> with <ErrorMessage>
    const pugi::xml_node message = childNamed(error, "ErrorMessage");
    return {error.attribute("errorCode").value(),
            std::string(trimmed(message ? message.text().get() : error.text().get()))};
  }

  void begin(RecordSink& sink) {
    const pugi::xml_document current = get("/current", stop_);
    if (stop_.stop_requested()) return;
    const pugi::xml_node header = childNamed(current.document_element(), "Header");
    instance_ = header.attribute("instanceId").value();
    next_ = header.attribute("nextSequence").as_ullong();
    if (next_ == 0) throw ConnectionError(fmt::format("{}/current has no nextSequence.", options_.url));
    active_.clear();
    deliver(current, true, sink);
  }

  void openStream() {
    if (steadySeconds() < reopen_s_) {
      // poll() is called with short waits.
      std::this_thread::sleep_for(std::chrono::duration<double>(std::min(0.05, reopen_s_ - steadySeconds())));
      return;
    }
    documents_ = 0;
    cutter_ = {};
    stream_ = std::make_unique<Download>(fmt::format(
        "{}/sample?from={}&count={}&interval={:.0f}&heartbeat={:.0f}", options_.url, next_, options_.sample_count,
        std::max(1.0, options_.interval_s * 1e3), std::max(1.0, options_.heartbeat_s * 1e3)));
  }

  void beginAgain(RecordSink& sink, const std::string& why) {
    stream_.reset();
    next_ = 0;
    sink.missed(why);
    begin(sink);
    reopen_s_ = 0.0;
    if (!stop_.stop_requested()) openStream();
  }

  /// False: the stream was begun again.
  bool take(const std::string& text, RecordSink& sink) {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size());
    if (!parsed) {
      // The same document will come again: after a few trials it is left out.
      if (++unreadable_ < 3)
        throw ConnectionError(
            fmt::format("{} sends a document that is not XML: {}.", options_.url, parsed.description()));
      unreadable_ = 0;
      beginAgain(sink, fmt::format("{} sends a document that is not XML.", options_.url));
      return false;
    }
    const pugi::xml_node root = document.document_element();
    const pugi::xml_node header = childNamed(root, "Header");
    const std::string instance = header.attribute("instanceId").value();
    if (localName(root) == "MTConnectError") {
      const auto [code, sentence] = errorOf(document);
      if (code == "OUT_OF_RANGE" || (code == "INVALID_REQUEST" && !instance.empty() && instance != instance_)) {
        beginAgain(sink, instance == instance_ || instance.empty()
                             ? fmt::format("{} no longer has what followed: {}.", options_.url, sentence)
                             : fmt::format("{} was started anew.", options_.url));
        return false;
      }
      throw ConnectionError(fmt::format("{}/sample answers \"{}\".", options_.url, sentence));
    }
    if (localName(root) != "MTConnectStreams") return true;
    ++documents_;
    unreadable_ = 0;
    if (instance != instance_) {
      beginAgain(sink, fmt::format("{} was started anew.", options_.url));
      return false;
    }
    if (header.attribute("firstSequence").as_ullong() > next_) {
      beginAgain(sink, fmt::format("{} has overwritten what followed.", options_.url));
      return false;
    }
    deliver(document, false, sink);
    next_ = std::max<unsigned long long>(next_, header.attribute("nextSequence").as_ullong());
    return true;
  }

  template <typename Body>
  void forEachObservation(const pugi::xml_document& document, const Body& body) {
    for (const pugi::xml_node device : childNamed(document.document_element(), "Streams").children()) {
      std::string key = device.attribute("uuid").value();
      if (key.empty()) key = device.attribute("name").value();
      const auto clock = clocks_.try_emplace(key, static_cast<std::uint16_t>(clocks_.size())).first->second;
      for (const pugi::xml_node component : device.children()) {
        for (const pugi::xml_node group : component.children()) {
          for (const pugi::xml_node node : group.children()) body(node, clock, localName(group));
        }
      }
    }
  }

  void deliver(const pugi::xml_document& document, bool snapshot, RecordSink& sink) {
    struct Found {
      unsigned long long sequence;
      Record record;
    };
    std::vector<Found> found;
    forEachObservation(document, [&](const pugi::xml_node& node, std::uint16_t clock, std::string_view group) {
      const auto wanted = wanted_.find(node.attribute("dataItemId").value());
      if (wanted == wanted_.end()) return;
      const auto sequence = node.attribute("sequence").as_ullong();
      // A stream that goes on may repeat what was read.
      if (!snapshot && sequence != 0 && sequence < next_) return;
      Record record;
      record.clock = clock;
      record.snapshot = snapshot;
      if (const auto stamped = parseUtc(node.attribute("timestamp").value())) record.source_s = *stamped;
      for (const Wanted& one : wanted->second) {
        record.item = one.item;
        if (group == "Condition") {
          condition(wanted->first, node, record);
          found.push_back({sequence, record});
        } else {
          const double rate = node.attribute("sampleRate").as_double();
          observation(trimmed(node.text().get()), one.part,
                      node.attribute("sampleCount") ? (rate > 0.0 ? rate : 1.0) : 0.0, record, [&](const Record& each) {
                        found.push_back({sequence, each});
                      });
        }
      }
    });
    // In the order in which it happened: components stand one after the other.
    std::stable_sort(found.begin(), found.end(),
                     [](const Found& a, const Found& b) { return a.sequence < b.sequence; });
    for (Found& one : found) sink.record(std::move(one.record));
  }

  void condition(const std::string& id, const pugi::xml_node& node, Record& record) {
    const std::string_view level = localName(node);
    std::map<std::string, int>& active = active_[id];
    const std::string code = node.attribute("nativeCode").value();
    if (level == "Unavailable") {
      active.clear();
      record.quality = Quality::Unavailable;
      return;
    }
    if (level == "Normal") {
      if (code.empty()) active.clear();
      active.erase(code);
    } else {
      active[code] = level == "Fault" ? 2 : 1;
    }
    int worst = 0;
    for (const auto& [each, value] : active) worst = std::max(worst, value);
    record.quality = Quality::Good;
    record.value = worst;
    record.text = worst == 0 ? "NORMAL" : worst == 1 ? "WARNING" : "FAULT";
  }

  /// `rate_hz` > 0: a time series whose last value has the stamp; else one value, or part `part` of several.
  static void observation(std::string_view text, int part, double rate_hz, Record& record,
                          const std::function<void(const Record&)>& out) {
    if (text == "UNAVAILABLE") {
      record.quality = Quality::Unavailable;
      out(record);
      return;
    }
    double value = 0.0;
    if (rate_hz <= 0.0 && part < 0) {
      if (parseNumber(text, value)) {
        record.value = value;
        record.quality = Quality::Good;
      } else {
        record.quality = Quality::Text;
        record.text = text;
      }
      out(record);
      return;
    }
    const std::vector<std::string> words = splitList(text, ' ');
    const double last_s = record.source_s;
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (rate_hz <= 0.0 && static_cast<int>(i) != part) continue;
      Record each = record;
      if (rate_hz > 0.0) each.source_s = last_s - static_cast<double>(words.size() - 1 - i) / rate_hz;
      if (parseNumber(words[i], value)) {
        each.value = value;
      } else {
        each.quality = Quality::Text;
        each.text = words[i];
      }
      out(each);
    }
  }

  MtconnectOptions options_;
  std::stop_token stop_;  ///< of the present subscription
  std::vector<DataItem> items_;
  std::unordered_map<std::string, std::vector<Wanted>> wanted_;  ///< id of the data item -> who wants it
  std::map<std::string, std::map<std::string, int>> active_;     ///< id of the condition -> native code -> level
  std::map<std::string, std::uint16_t> clocks_;                  ///< device -> clock
  std::string instance_;
  unsigned long long next_ = 0;  ///< sequence number; 0: begin at /current
  std::unique_ptr<Download> stream_;
  DocumentCutter cutter_;
  std::size_t documents_ = 0;  ///< of the present stream
  int unreadable_ = 0;         ///< documents one after the other that were no XML
  double reopen_s_ = 0.0;
};

}  // namespace

std::unique_ptr<Source> makeMtconnectSource(const MtconnectOptions& options) {
  return std::make_unique<MtconnectSource>(options);
}

}  // namespace spindrift
