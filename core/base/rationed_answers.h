// SPDX-License-Identifier: Apache-2.0
// Answers about files that are asked for at every change of anything (what does this folder hold?): a short look is
// taken every time, a long one no more often than every ten times as long as it took, so that whoever asks works nine
// tenths of the time.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>

namespace spindrift {

class RationedAnswers {
 public:
  /// `look(place)`, or what it gave a short while ago. Any thread; one look at a time.
  template <class Look>
  [[nodiscard]] std::string about(const std::filesystem::path& place, const Look& look) {
    using Clock = std::chrono::steady_clock;
    const std::lock_guard lock(mutex_);
    const Clock::time_point begun = Clock::now();
    const auto before = answers_.find(place);
    if (before != answers_.end() && begun < before->second.holds_until) return before->second.text;
    std::string text = look(place);
    const Clock::time_point ended = Clock::now();
    const bool long_one = ended - begun > short_look;
    answers_[place] = {text, long_one ? ended + 9 * (ended - begun) : ended};
    return text;
  }

 private:
  static constexpr std::chrono::milliseconds short_look{5};
  struct Answer {
    std::string text;
    std::chrono::steady_clock::time_point holds_until;
  };
  std::mutex mutex_;
  std::map<std::filesystem::path, Answer> answers_;
};

}  // namespace spindrift
