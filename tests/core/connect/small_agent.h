// SPDX-License-Identifier: GPL-3.0-or-later
// A small MTConnect agent on loopback that answers in the form of several versions and misbehaves on command.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace spindrift::testing {

class SmallAgent {
 public:
  struct Manners {
    std::string version = "1.4";       ///< of the namespace
    std::string prefix;                ///< "m:" before every name
    bool chunked = true;               ///< the stream, in the chunks of HTTP
    bool multipart = true;             ///< false: knows no streams, answers /sample with one document
    bool true_lengths = true;          ///< false: Content-length of the parts is wrong
    bool lower_case = false;           ///< names of the headers
    std::size_t buffer = 1024;         ///< observations kept
    std::size_t most_parts = 1 << 30;  ///< of one stream, then the connection is cut within a document
    std::size_t levels = 0;            ///< of components without items that stand in each other
    std::size_t pad = 0;               ///< documents are filled up to a multiple of this
  };
  SmallAgent();
  ~SmallAgent();
  SmallAgent(const SmallAgent&) = delete;
  SmallAgent& operator=(const SmallAgent&) = delete;

  [[nodiscard]] std::string url() const { return "http://127.0.0.1:" + std::to_string(port_); }
  /// Sample T1 (degC), Events EXEC and S1 (rpm), PathPosition P1 (3 numbers), series V1, Condition C1.
  void observe(const std::string& id, const std::string& text, double stamp_s, const std::string& extra = "");
  /// On the same port as before.
  void start();
  /// Cuts all connections and closes the port.
  void stop();
  /// What stop and start of a real agent do: another instance, an empty buffer, numbers from 1.
  void forget();
  void freeze(bool frozen) { frozen_ = frozen; }  ///< connections stay, nothing is sent
  void set(const Manners& manners);
  /// The next part of a stream is this text in place of a document.
  void nextPart(const std::string& text);
  [[nodiscard]] std::uint64_t sequence() const;
  [[nodiscard]] int requests(const std::string& of) const;

 private:
  struct Observation {
    std::uint64_t sequence;
    std::string id, text, stamp, extra;
  };
  void serve(int listener);
  void answer(int connection);
  void stream(int connection, std::uint64_t from, double interval_s, double heartbeat_s);
  [[nodiscard]] std::string probe() const;
  /// `current`: the newest of each; else from `from` on. `next` gets the number after the last.
  [[nodiscard]] std::string document(bool current, std::uint64_t from, std::uint64_t& next) const;
  [[nodiscard]] std::string outOfRange() const;
  [[nodiscard]] std::string header(std::uint64_t next) const;

  mutable std::mutex mutex_;
  Manners manners_;
  std::deque<Observation> buffer_;
  std::vector<Observation> newest_;
  std::vector<std::string> asked_;
  std::vector<std::string> in_place_;
  std::uint64_t next_ = 1;
  std::uint64_t instance_ = 1000;
  int port_ = 0;
  int listener_ = -1;
  std::atomic<bool> stopping_{false};
  std::atomic<bool> frozen_{false};
  std::thread server_;
  std::vector<std::thread> connections_;
};

}  // namespace spindrift::testing
