// SPDX-License-Identifier: GPL-3.0-or-later
// What a page shows of the observations to fit, such as their states: they are marked and read on a thread of its own,
// however many there are. Until it is known the page shows what it showed.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "core/tasks/campaign_state.h"
#include "widgets/jobs/latest_work.h"

namespace spindrift::gui {

template <class Answer>
class FromObservations {
 public:
  /// Runs on a worker thread and must not throw.
  using Find = std::function<Answer(const ObservationSet&)>;

  /// `found` is called when an answer is there that `ask` did not have; it asks again.
  explicit FromObservations(std::function<void()> found) : found_(std::move(found)) {}

  /// What `find` finds in these observations, of which there are some; null until it is found. `about`: on what else
  /// the answer depends. What was asked for before is not wanted any more. GUI thread.
  [[nodiscard]] std::shared_ptr<const Answer> ask(const ObservationsToFit& observations, const std::string& about,
                                                  Find find) {
    const Question question{observations, about};
    if (answer_ != nullptr && question == answered_) {
      work_.forget();
      asked_ = {};
      return answer_;
    }
    if (question == asked_) return nullptr;
    asked_ = question;
    work_.ask([this, question, find = std::move(find)]() -> std::function<void()> {
      auto answer = std::make_shared<const Answer>(find(*question.observations));
      return [this, question, answer = std::move(answer)] {
        answered_ = question;
        answer_ = answer;
        asked_ = {};
        found_();
      };
    });
    return nullptr;
  }
  /// The answer to the last question is still to come.
  [[nodiscard]] bool busy() const { return asked_.observations.has_value(); }

 private:
  struct Question {
    ObservationsToFit observations;
    std::string about;
    bool operator==(const Question&) const = default;
  };

  std::function<void()> found_;
  Question asked_;  ///< none: there is nothing to come
  Question answered_;
  std::shared_ptr<const Answer> answer_;
  LatestWork work_;  ///< last: it ends before what it fills
};

}  // namespace spindrift::gui
