// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/services/incoming_service.h"

#include <QDateTime>
#include <QDir>
#include <QFileInfo>
#include <algorithm>
#include <iterator>
#include <utility>

#include "core/base/error.h"
#include "core/imaging/image.h"
#include "widgets/common/core_sentence.h"
#include "widgets/image_view/decode_marks.h"
#include "widgets/models/cells.h"

namespace spindrift::gui {
namespace {

/// As many as the list of what arrives shows.
constexpr std::size_t most_pictures = 1000;

/// A small picture for the list; empty for what is no image.
QImage smallPicture(const std::filesystem::path& file, IncomingKind kind) {
  if (kind != IncomingKind::Image) return {};
  try {
    return toImage(readImage(file)).scaled(128, 72, Qt::KeepAspectRatio, Qt::SmoothTransformation);
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace

IncomingService::IncomingService(SessionModel& session) : QObject(&session), session_(session) {
  clock_.start();
  timer_.setInterval(500);
  connect(&timer_, &QTimer::timeout, this, &IncomingService::look);
  connect(&session_, &SessionModel::campaignLeaving, this, [this] {
    const QString lost = finishPictures();
    if (!lost.isEmpty()) Q_EMIT session_.storingFailed(lost);
  });
  connect(&session_, &SessionModel::campaignChanged, this, &IncomingService::follow);
  follow();  // the campaign may be there already
}

IncomingService& IncomingService::of(SessionModel& session) {
  auto* found = session.findChild<IncomingService*>(QString(), Qt::FindDirectChildrenOnly);
  return found != nullptr ? *found : *new IncomingService(session);
}

void IncomingService::setPace(int look_ms, double settle_s, double patience_s) {
  timer_.setInterval(look_ms);
  watch_.settle_s = settle_s;
  patience_s_ = patience_s;
}

std::string IncomingService::key(const char* what) const {
  return std::string(what) + "/" + std::to_string(session_.campaignId());
}

/// Forgets what belongs to another campaign. What had arrived of it lies in its folder.
void IncomingService::follow() {
  const std::string folder = session_.campaign() == nullptr ? std::string() : session_.campaign()->folder.string();
  if (folder == campaign_folder_) return;
  campaign_folder_ = folder;
  campaign_ = session_.campaignId();
  timer_.stop();
  jobs_.cancelAll();
  giveUpHanded();
  examining_ = false;
  folder_.reset();
  thumbnails_.clear();
  pictured_.clear();
  failure_.clear();
  unstored_touches_.clear();  // they are in the files that they came from
  plan_.reset();
  const bool there = session_.session() != nullptr && session_.campaign() != nullptr;
  intake_ = there ? CaptureIntake(incomingJournal(*session_.session(), campaign_)) : CaptureIntake();
  for (const Taken& taken : taken_)
    if (taken.context->campaignFolder() == campaign_folder_) examinePicture(taken);
  Q_EMIT changed();
  Q_EMIT planProgressed();
}

QString IncomingService::folder() const {
  if (folder_ != nullptr) return QString::fromStdString(folder_->folder().string());
  const nlohmann::json last = session_.setting(key("watched"), nlohmann::json::object());
  return fromCore(last.is_object() ? last.value("folder", "") : "");
}

QString IncomingService::templateFile() const {
  const nlohmann::json last = session_.setting(key("watched"), nlohmann::json::object());
  return fromCore(last.is_object() ? last.value("template", "") : "");
}

QString IncomingService::start(const QString& folder, const QString& template_file) {
  follow();
  if (session_.campaign() == nullptr) return tr("Open a session or a new measurement first.");
  const QFileInfo info(folder);
  if (folder.isEmpty() || !info.isDir()) {
    return tr("\"%1\" is not a folder; allowed: the folder into which the instrument writes.").arg(folder);
  }
  if (CaptureIntake::liesInside(folder.toStdString(), session_.folder())) {
    return tr("This folder belongs to the session itself; allowed: the folder into which the instrument writes.");
  }
  try {
    std::optional<JsonNode> pattern;
    if (!template_file.isEmpty()) {
      pattern = JsonNode::read(template_file.toStdString());
      pattern->requireFormat("spindrift-printed-text", 1);
    }
    intake_.expectTouches(*session_.campaign(), std::move(pattern));
    unstored_touches_.clear();  // they are read again
  } catch (const InputError& e) {
    return coreSentence(e.what());
  }
  failure_.clear();
  folder_ = std::make_unique<IncomingFolder>(QDir(folder).absolutePath().toStdString(), watch_, patience_s_);
  session_.setSetting(key("watched"), {{"folder", folder.toStdString()}, {"template", template_file.toStdString()}});
  timer_.start();
  look();
  Q_EMIT changed();
  return {};
}

void IncomingService::stop() {
  timer_.stop();
  flushTouches(true);
  folder_.reset();
  Q_EMIT changed();
}

QString IncomingService::problem() const {
  if (!failure_.isEmpty()) return failure_;
  if (folder_ != nullptr && !folder_->problem().empty()) return coreSentence(folder_->problem());
  if (touches() != nullptr) {
    const std::vector<std::string> problems = touches()->problems();
    if (!problems.empty()) return coreSentence(problems.back());
  }
  return {};
}

bool IncomingService::idle() const {
  return !examining_ && !jobs_.busy() && (folder_ == nullptr || folder_->idle());
}

QImage IncomingService::thumbnail(const std::string& name) const {
  const auto found = thumbnails_.find(name);
  return found == thumbnails_.end() ? QImage() : found->second;
}

QString IncomingService::checkedOnArrival(int listed) {
  const std::vector<IncomingItem>& seen = items();
  const auto accepted = std::count_if(seen.begin(), seen.end(),
                                      [](const IncomingItem& item) { return item.state == IncomingState::Accepted; });
  if (accepted == 0) return {};
  QString text = tr("%n of %1 captures were checked as they arrived and accepted.", nullptr, static_cast<int>(accepted))
                     .arg(std::max<qsizetype>(listed, std::ssize(seen)));
  const int again = static_cast<int>(retakes().size());
  if (again > 0) text += QLatin1Char(' ') + tr("%n are to be taken again.", nullptr, again);
  return text + QLatin1Char(' ') +
         tr("Check them all once they are complete: that compares them with one another too.");
}

QStringList IncomingService::retakes() {
  QStringList sentences;
  for (const CaptureIntake::Retake& retake : intake_.retakes(done())) {
    const QString why = coreSentence(retake.why.ends_with('.') ? retake.why : retake.why + ".");
    sentences << (retake.what.empty() ? why : tr("Take %1 again: %2").arg(fromCore(retake.what), why));
  }
  return sentences;
}

std::shared_ptr<const IncomingContext> IncomingService::contextNow() {
  if (generation_ != session_.captureGeneration()) {
    // Others added captures.
    generation_ = session_.captureGeneration();
    intake_.forgetContext();
  }
  return intake_.context(*session_.campaign(), plan());
}

void IncomingService::look() {
  if (folder_ == nullptr || session_.session() == nullptr) return;
  const QString before = problem();
  const bool news = folder_->look(now());
  for (const std::size_t i : folder_->waiting()) intake_.show(folder_->items()[i]);
  if (!unstored_touches_.empty()) flushTouches(false);
  if (news || before != problem()) Q_EMIT changed();
  examineNext();
}

void IncomingService::examineNext() {
  if (examining_ || folder_ == nullptr || session_.campaign() == nullptr) return;
  const auto task = folder_->next();
  if (!task) return;
  examining_ = true;
  Job job;
  job.title = tr("Checking %1").arg(fromCore(task->name));
  job.quiet = true;
  job.work = [this, task = *task, context = contextNow(), folder = campaign_folder_](JobContext&) {
    auto examined =
        std::make_shared<ExaminedFile>(examineArrival(task.file.file, task.name, task.file.written_ns, *context));
    const QImage picture = smallPicture(task.file.file, examined->item.kind);
    return std::function<void()>([this, task, examined, picture, folder] {
      if (folder == campaign_folder_) finished(task, std::move(*examined), picture);
    });
  };
  job.failed = [this, task = *task, folder = campaign_folder_](const QString& sentence) {
    examining_ = false;
    if (folder != campaign_folder_) return;
    failure_ = sentence;
    putOff(task);
    Q_EMIT changed();
  };
  job.cancelled = [this] { examining_ = false; };
  jobs_.run(std::move(job));
}

void IncomingService::putOff(const IncomingFolder::Task& task) {
  if (folder_ == nullptr) return;
  ExaminedFile not_stored;
  not_stored.item.name = task.name;
  not_stored.item.sentence = failure_.toStdString();
  intake_.show(folder_->finish(task, std::move(not_stored), now()));
}

void IncomingService::finished(const IncomingFolder::Task& task, ExaminedFile examined, const QImage& picture) {
  examining_ = false;
  if (folder_ == nullptr) return;
  keepPicture(task.name, picture);
  const ExaminedFile kept = examined;
  if (kept.item.kind == IncomingKind::Touches) {
    feed(kept);
    examined.item.sentence = intake_.touchSentence();
  }
  const IncomingItem& item = folder_->finish(task, std::move(examined), now());
  const IncomingItem shown = intake_.show(item);
  if (item.state != IncomingState::Waiting) {
    ExaminedFile answer = kept;
    answer.item = shown;
    if (!record(answer)) putOff(task);
  }
  Q_EMIT changed();
  examineNext();
}

void IncomingService::keepPicture(const std::string& name, const QImage& picture) {
  if (picture.isNull()) return;
  if (!thumbnails_.insert_or_assign(name, picture).second) return;
  pictured_.push_back(name);
  if (pictured_.size() <= most_pictures) return;
  thumbnails_.erase(pictured_.front());
  pictured_.pop_front();
}

bool IncomingService::record(const ExaminedFile& found) {
  ExaminedFile examined = found;
  if (!examined.row.empty() && done().contains(examined.item.plan_item)) {
    // Another one was faster: two pictures taken at once.
    examined.row.clear();
    examined.item.state = IncomingState::Twice;
    examined.item.sentence =
        tr("%1 is there already; this one is kept aside.").arg(fromCore(examined.item.plan_item)).toStdString();
    intake_.show(examined.item);
  }
  try {
    // What is told of it in between must not take this capture for one of others.
    if (!examined.row.empty()) ++generation_;
    session_.recordArrival(examined);
    failure_.clear();
  } catch (const InputError& e) {
    failure_ = coreSentence(e.what());
    return false;
  }
  intake_.remember(examined);
  if (!examined.row.empty()) Q_EMIT planProgressed();
  return true;
}

void IncomingService::feed(const ExaminedFile& examined) {
  try {
    if (intake_.takeTouches(examined) > 0) {
      flushTouches(false);
      Q_EMIT touchesChanged();
    }
  } catch (const InputError& e) {
    failure_ = coreSentence(e.what());
  }
}

void IncomingService::flushTouches(bool all) {
  std::vector<Touch>& touches = unstored_touches_;
  for (Touch& touch : intake_.takeFinished(all)) touches.push_back(std::move(touch));
  if (touches.empty()) return;
  try {
    ++generation_;
    session_.addCaptureRows("touches.csv", TouchFeed::header(), TouchFeed::rowsOf(touches));
    intake_.remember(std::exchange(touches, {}));
    failure_.clear();
    Q_EMIT planProgressed();
  } catch (const InputError& e) {
    failure_ = coreSentence(e.what());
  }
}

void IncomingService::take(const QString& name, std::shared_ptr<const GrayImage> image) {
  follow();
  if (session_.campaign() == nullptr || image == nullptr) return;
  // A number that no picture has, of those before a restart either.
  std::string id;
  do {
    id = QStringLiteral("%1 %2").arg(name).arg(++pictures_).toStdString();
  } while (intake_.knows(id));
  const std::int64_t written_ns = QDateTime::currentMSecsSinceEpoch() * 1'000'000;
  taken_.push_back({id, image, written_ns, contextNow()});
  examinePicture(taken_.back());
}

std::vector<IncomingService::Taken>::iterator IncomingService::pictureOfCampaign(const std::string& id) {
  return std::find_if(taken_.begin(), taken_.end(),
                      [&](const Taken& t) { return t.id == id && t.context->campaignFolder() == campaign_folder_; });
}

void IncomingService::examinePicture(const Taken& taken) {
  Job job;
  job.title = tr("Checking the picture");
  job.quiet = true;
  job.work = [this, taken](JobContext&) {
    auto examined = std::make_shared<ExaminedFile>(
        examineImage(encodePng(*taken.image), taken.id, taken.written_ns, *taken.context));
    const QImage picture = toImage(*taken.image).scaled(128, 72, Qt::KeepAspectRatio, Qt::SmoothTransformation);
    return std::function<void()>([this, id = taken.id, examined, picture] {
      if (pictureOfCampaign(id) == taken_.end()) return;  // recorded when the campaign was left
      keepPicture(id, picture);
      intake_.show(examined->item);
      if (record(*examined))
        taken_.erase(pictureOfCampaign(id));
      else
        examineLater(id);
      Q_EMIT changed();
    });
  };
  job.failed = [this, id = taken.id](const QString& sentence) {
    if (pictureOfCampaign(id) == taken_.end()) return;
    failure_ = sentence;
    examineLater(id);
    Q_EMIT changed();
  };
  jobs_.run(std::move(job));
}

void IncomingService::examineLater(const std::string& picture) {
  QTimer::singleShot(static_cast<int>(1e3 * patience_s_), this, [this, picture] {
    if (const auto waiting = pictureOfCampaign(picture); waiting != taken_.end()) examinePicture(*waiting);
  });
}

/// A picture is nowhere but in memory until it is recorded.
QString IncomingService::finishPictures() {
  if (session_.campaign() == nullptr) return {};
  for (Taken& t : std::exchange(taken_, {})) {
    // Those of a campaign that is not at hand wait until it is.
    if (t.context->campaignFolder() == campaign_folder_) {
      try {
        const ExaminedFile examined = examineImage(encodePng(*t.image), t.id, t.written_ns, *t.context);
        intake_.show(examined.item);
        if (record(examined)) continue;
      } catch (const InputError& e) {
        failure_ = coreSentence(e.what());
      }
      t.why_not = failure_;
    }
    taken_.push_back(std::move(t));
  }
  if (taken_.empty()) return {};
  Q_EMIT changed();
  return tr("Pictures of the camera that cannot be stored: %1. %2").arg(taken_.size()).arg(taken_.back().why_not);
}

void IncomingService::takeFiles(const QStringList& files, std::function<void(const std::vector<IncomingItem>&)> done) {
  follow();
  if (session_.campaign() == nullptr) return;
  handed_.push_back({files, {}, std::move(done)});
  if (!looking_) takeNext();
}

/// One after the other: each is held against those before it.
void IncomingService::takeNext() {
  while (!handed_.empty() && handed_.front().waiting.isEmpty()) {
    const Handed all = std::move(handed_.front());
    handed_.pop_front();
    all.done(all.answered);
  }
  if (handed_.empty() || looking_) return;  // whoever was answered may have given more
  looking_ = true;
  const QFileInfo file(handed_.front().waiting.front());
  Job job;
  job.title = tr("Checking %1").arg(file.fileName());
  job.quiet = true;
  job.work = [this, path = std::filesystem::path(file.absoluteFilePath().toStdString()),
              name = file.fileName().toStdString(), written_ns = file.lastModified().toMSecsSinceEpoch() * 1'000'000,
              context = contextNow(), folder = campaign_folder_](JobContext&) {
    auto examined = std::make_shared<ExaminedFile>(examineArrival(path, name, written_ns, *context));
    const QImage picture = smallPicture(path, examined->item.kind);
    return std::function<void()>([this, examined, picture, folder] {
      if (folder != campaign_folder_) return;  // given up
      keepPicture(examined->item.name, picture);
      ExaminedFile answer = *examined;
      answer.item = intake_.show(examined->item);
      IncomingItem told = examined->item;  // "there already", where the list keeps its first answer
      if (!record(answer)) {
        told.state = IncomingState::Ignored;
        told.sentence = failure_.toStdString();
        intake_.show(told);
      }
      Q_EMIT changed();
      answerHanded(std::move(told));
    });
  };
  job.failed = [this, name = file.fileName().toStdString(), folder = campaign_folder_](const QString& sentence) {
    if (folder != campaign_folder_) return;
    IncomingItem failed;
    failed.name = name;
    failed.state = IncomingState::Ignored;
    failed.sentence = sentence.toStdString();
    answerHanded(std::move(failed));
  };
  jobs_.run(std::move(job));
}

void IncomingService::answerHanded(IncomingItem item) {
  looking_ = false;
  Handed& handed = handed_.front();
  handed.waiting.removeFirst();
  handed.answered.push_back(std::move(item));
  takeNext();
}

/// Nothing of these files is lost: they lie where they came from.
void IncomingService::giveUpHanded() {
  looking_ = false;
  for (Handed& handed : std::exchange(handed_, {})) {
    for (const QString& file : handed.waiting) {
      IncomingItem left;
      left.name = QFileInfo(file).fileName().toStdString();
      left.state = IncomingState::Ignored;
      left.sentence = tr("not looked at, because another campaign was chosen meanwhile.").toStdString();
      handed.answered.push_back(std::move(left));
    }
    handed.done(handed.answered);
  }
}

const MeasurementPlan& IncomingService::plan() {
  if (!plan_) {
    plan_.emplace();
    try {
      if (session_.session() != nullptr) plan_ = storedPlan(*session_.session(), session_.campaignId());
    } catch (const InputError& e) {
      failure_ = coreSentence(e.what());
    }
  }
  return *plan_;
}

const PlanCaptures& IncomingService::captures() {
  static const PlanCaptures none;
  return session_.campaign() == nullptr ? none : contextNow()->captures();
}

const std::set<std::string>& IncomingService::done() {
  return captures().done;
}

double IncomingService::campaignTime() const {
  if (session_.campaign() == nullptr) return 0.0;
  const QDateTime start = QDateTime::fromString(fromCore(session_.campaign()->start_utc), Qt::ISODate);
  return 1e-3 * static_cast<double>(start.msecsTo(QDateTime::currentDateTimeUtc()));
}

PlanProgress IncomingService::progress() {
  const PlanCaptures& there = captures();
  return progressOf(plan(), there.done, campaignTime(), there.begun);
}

void IncomingService::planChanged() {
  plan_.reset();
  intake_.forgetContext();
  Q_EMIT planProgressed();
}

}  // namespace spindrift::gui
