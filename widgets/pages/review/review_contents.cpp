// SPDX-License-Identifier: GPL-3.0-or-later
// What the panes of a review show: worked out in the background, applied to all panes together.
#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QSlider>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/error.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/models/cells.h"
#include "widgets/pages/review/review_page.h"
#include "widgets/panels/review/review_pane.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

/// What a pane asks for.
struct PaneRequest {
  std::shared_ptr<const ReviewSource> source;  ///< null: the pane shows no state
  ReviewRequest request;
  bool difference = false;
  QString problem;
};

/// What it gets: a picture or a sentence.
struct PaneAnswer {
  std::optional<ReviewPicture> picture;
  QString problem;
};

const ReviewPrediction* predictionFor(const PaneRequest& r) {
  switch (r.request.quantity) {
    case ReviewQuantity::Simulation:
    case ReviewQuantity::SimulationLeft:
      return &r.source->simulation();
    case ReviewQuantity::Completed:
    case ReviewQuantity::CompletedLeft:
      return &r.source->completed();
    default:
      return nullptr;
  }
}

std::vector<PaneAnswer> answersTo(const std::vector<PaneRequest>& requests, const JobContext& job) {
  std::vector<PaneAnswer> answers(requests.size());
  for (std::size_t i = 0; i < requests.size(); ++i) {
    const PaneRequest& r = requests[i];
    answers[i].problem = r.problem;
    if (r.source == nullptr || !r.problem.isEmpty()) continue;
    job.throwIfCancelled();
    try {
      ReviewPicture picture =
          reviewOf(*r.source->observations, r.source->campaign->machine, r.request, predictionFor(r));
      if (r.difference && answers[0].picture) picture = reviewDifference(*answers[0].picture, picture);
      answers[i].picture = std::move(picture);
    } catch (const InputError& e) {
      answers[i].problem = coreSentence(e.what());
    }
  }
  return answers;
}

}  // namespace

void ReviewPage::showAll() {
  if (filling_ || session().campaign() == nullptr) return;
  fillAngles();
  const std::string at_slider = stateAtSlider();
  slider_text_->setText(
      states_.empty() ? QString()
                      : tr("%1 (%2 of %3)").arg(fromCore(at_slider)).arg(slider_->value() + 1).arg(states_.size()));
  std::vector<PaneRequest> requests;
  for (const ReviewPane* pane : panes_) {
    PaneRequest r;
    if (!pane->isHidden() && !pane->isScan()) {
      r.source = pane->source();
      if (sources_.reading(pane->campaignChoice()->currentData().toLongLong()))
        r.problem = tr("This campaign is being read.");
      else if (r.source == nullptr || !r.source->observations)
        r.problem = tr("This campaign has no observations yet: evaluate its captures first.");
      r.request.state = pane->state(at_slider);
      if (r.source != nullptr) r.request.fit = r.source->fit;
      r.request.component = static_cast<Component>(component_->current());
      r.difference = pane->content() == PaneContent::Difference;
      r.request.heat_map = heat_maps_->isChecked();
      r.request.c_deg = angle();
      if (const auto quantity = quantityOf(r.difference ? panes_[0]->content() : pane->content()))
        r.request.quantity = *quantity;
      else
        r.problem = tr("Pane 1 shows a scan; let it show a state to subtract it.");
    }
    requests.push_back(std::move(r));
  }
  const int request = ++*states_request_;
  display(tr("Comparing states"),
          [this, requests, request, latest = states_request_](JobContext& job) -> std::function<void()> {
            if (latest->load() != request) return [] {};
            const auto answers = std::make_shared<std::vector<PaneAnswer>>(answersTo(requests, job));
            return [this, answers, request] {
              if (request != states_request_->load()) return;
              double limit = 0.01;
              for (const PaneAnswer& a : *answers)
                if (a.picture) limit = std::max(limit, a.picture->largest);
              for (int pass = 0; pass < (arrows_->isChecked() ? 2 : 1);
                   ++pass) {  // arrows: the factor is that of all panes
                for (std::size_t i = 0; i < panes_.size(); ++i) {
                  if (!(*answers)[i].picture) continue;
                  panes_[i]->show(*(*answers)[i].picture, limit, arrows_->isChecked(), exaggeration(),
                                  machine_->isChecked(), count_->current() == 0);
                  panes_[i]->view()->setSelected(selected_);
                }
              }
              for (std::size_t i = 0; i < panes_.size(); ++i)
                if (!(*answers)[i].problem.isEmpty())
                  panes_[i]->showMessage(tr("Nothing to show"), (*answers)[i].problem);
              // Only now the panes have the sizes that they keep.
              if (std::exchange(refit_, false)) lookAgain();
              showTable();
              showSection();
            };
          });
  showScans();
}

void ReviewPage::showScans() {
  struct Wanted {
    ReviewPane* pane;
    std::shared_ptr<const ReviewSource> source;
    std::string cloud, reference;
    QString title;
    ScanColouring colouring;
  };
  std::vector<Wanted> wanted;
  for (ReviewPane* pane : panes_) {
    if (pane->isHidden() || !pane->isScan()) continue;
    const auto source = pane->source();
    if (sources_.reading(pane->campaignChoice()->currentData().toLongLong())) {
      pane->showMessage(tr("Nothing to show"), tr("This campaign is being read."));
      continue;
    }
    if (source == nullptr || source->scans.empty()) {
      pane->showMessage(tr("Nothing to show"), tr("This campaign has no scans."));
      continue;
    }
    // The artefact that is selected, else the first one of the list.
    std::string artefact = source->scans.front().artefact;
    for (const ScanCapture& c : source->scans)
      if (fromCore(c.artefact) == selected_) artefact = c.artefact;
    const std::string state = pane->state(stateAtSlider());
    Wanted w{pane,
             source,
             {},
             {},
             fromCore(artefact + " " + state),
             pane->content() == PaneContent::ScanChange ? ScanColouring::Measured : ScanColouring::Registered};
    for (const ScanCapture& c : source->scans) {
      if (c.artefact != artefact || source->campaign->excluded_captures.contains(c.cloud)) continue;
      if (w.reference.empty()) w.reference = c.cloud;
      if (c.cycle == state) w.cloud = c.cloud;
    }
    if (w.cloud.empty()) {
      pane->showMessage(tr("Nothing to show"), tr("%1 was not scanned, or the scan is excluded.").arg(w.title));
      continue;
    }
    wanted.push_back(std::move(w));
  }
  const int request = ++*request_;
  if (wanted.empty()) return;
  display(tr("Comparing scans"), [this, wanted, request, latest = request_](JobContext& job) -> std::function<void()> {
    auto pictures = std::make_shared<std::vector<ScanPicture>>();
    for (const Wanted& w : wanted) {
      if (latest->load() != request) return [] {};
      const auto& profiler = w.source->campaign->machine.profiler;
      pictures->push_back(pictureOfScan(*w.source->campaign, w.cloud, w.reference, w.colouring,
                                        scanModelFromString(profiler ? profiler->scan_model : "rigid"), job,
                                        ScanPart::AsUsed));
    }
    return [this, wanted, pictures, request] {
      if (request != request_->load()) return;
      double limit = 0.1;
      for (const ScanPicture& p : *pictures)
        if (p.colouring != ScanColouring::Height) limit = std::max({limit, std::abs(p.low), std::abs(p.high)});
      for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i].pane->showScan((*pictures)[i], wanted[i].title, limit);
    };
  });
}

}  // namespace spindrift::gui
