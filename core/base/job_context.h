// SPDX-License-Identifier: Apache-2.0
// Progress and cancel for everything that takes time: the only seam between a computation and whoever waits for it.
//
// A long function takes a `JobContext&`, reports now and then and polls; it knows neither threads nor windows.
// Example: for (...) { job.report(i / double(n), "decoding"); job.throwIfCancelled(); ... }
#pragma once

#include <functional>
#include <stop_token>
#include <string>
#include <string_view>

namespace spindrift {

/// Receives progress. `report` may be called from any thread.
class ProgressSink {
 public:
  virtual ~ProgressSink() = default;
  /// `fraction` in [0, 1]; `stage` is a short text for the user ("decoding images").
  virtual void report(double fraction, std::string_view stage) = 0;
};

/// Handed down to a long computation. Copies share the same sink and stop token; a part of a job gets a part of the
/// bar.
class JobContext {
 public:
  /// No progress, never cancelled.
  JobContext() = default;
  JobContext(std::stop_token token, ProgressSink* sink) : token_(std::move(token)), sink_(sink) {}

  /// A context for a sub-step that maps its own 0..1 to `from`..`to` of this one.
  [[nodiscard]] JobContext part(double from, double to) const;

  void report(double fraction, std::string_view stage) const;
  [[nodiscard]] bool cancelled() const noexcept { return token_.stop_requested(); }
  /// Throws Cancelled if the user asked to stop.
  void throwIfCancelled() const;

 private:
  std::stop_token token_;
  ProgressSink* sink_ = nullptr;
  double from_ = 0.0;
  double to_ = 1.0;
};

/// Number of threads a parallel loop should use: SPINDRIFT_THREADS if set, else what the machine has, at least 1.
[[nodiscard]] unsigned threadCount();

/// Runs body(0..count-1) in no order on up to `threadCount()` threads: the caller and the workers of one pool, which
/// all loops of the process share and which starts at the first loop. Loops inside bodies take the workers that are
/// free and never wait for one that is not. Polls for cancel between items; the first exception thrown by a body is
/// rethrown here after all threads have left the loop. Threads that wait, for a job, a camera or a socket, are not of
/// the pool.
void parallelFor(std::size_t count, const JobContext& job, const std::function<void(std::size_t)>& body);

}  // namespace spindrift
