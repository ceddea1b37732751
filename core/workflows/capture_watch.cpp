// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/capture_watch.h"

#include <fmt/format.h>

namespace spindrift {
namespace {

std::filesystem::path allowedFolder(const std::filesystem::path& folder, const std::filesystem::path& session) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error))
    throw InputError({folder, ""}, "is not a folder; allowed: the folder into which the instrument writes.");
  if (CaptureIntake::liesInside(folder, session))
    throw InputError({folder, ""},
                     "belongs to the session itself; allowed: the folder into which the instrument writes.");
  return std::filesystem::canonical(folder);
}

}  // namespace

CaptureWatch::CaptureWatch(Session& session, std::int64_t campaign, const std::filesystem::path& folder,
                           std::optional<JsonNode> pattern, const FolderWatchOptions& watch, double patience_s)
    : session_(session),
      campaign_(campaign),
      data_(Campaign::read(session.campaign(campaign).folder)),
      plan_(storedPlan(session, campaign)),
      intake_(incomingJournal(session, campaign)),
      folder_(allowedFolder(folder, session.folder()), watch, patience_s) {
  intake_.expectTouches(data_, std::move(pattern));
  context_ = intake_.context(data_, plan_);
}

std::vector<IncomingItem> CaptureWatch::turn(double now_s) {
  std::vector<IncomingItem> decided;
  folder_.look(now_s);
  while (const auto task = folder_.next()) {
    ExaminedFile examined = examineArrival(task->file.file, task->name, task->file.written_ns, *context_);
    if (examined.item.kind == IncomingKind::Touches && !examined.unreadable) {
      intake_.takeTouches(examined);
      storeTouches(false);
      examined.item.sentence = intake_.touchSentence();
    }
    ExaminedFile answer = examined;
    answer.item = folder_.finish(*task, std::move(examined), now_s);
    if (answer.item.state == IncomingState::Waiting) continue;
    decided.push_back(answer.item);
    answer.item = intake_.show(answer.item);
    recordArrival(session_, campaign_, answer);
    intake_.remember(answer);
  }
  return decided;
}

std::vector<IncomingItem> CaptureWatch::undecided() const {
  std::vector<IncomingItem> items;
  for (const std::size_t i : folder_.waiting()) items.push_back(folder_.items()[i]);
  return items;
}

void CaptureWatch::finish() {
  intake_.finishTouches();
  storeTouches(true);
}

void CaptureWatch::storeTouches(bool all) {
  const std::vector<Touch> touches = intake_.takeFinished(all);
  if (touches.empty()) return;
  session_.addCaptureRows(campaign_, "touches.csv", TouchFeed::header(), TouchFeed::rowsOf(touches));
  intake_.remember(touches);
}

std::vector<std::string> CaptureWatch::retakes() const {
  std::vector<std::string> sentences;
  for (const CaptureIntake::Retake& retake : intake_.retakes(done()))
    sentences.push_back(retake.what.empty() ? retake.why : fmt::format("Take {} again: {}", retake.what, retake.why));
  return sentences;
}

}  // namespace spindrift
