// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/incoming.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <mutex>
#include <new>
#include <span>

#include "core/base/atomic_file.h"
#include "core/base/csv.h"
#include "core/base/error.h"
#include "core/base/file_end.h"
#include "core/base/file_reader.h"
#include "core/base/sha256.h"
#include "core/base/text.h"
#include "core/base/untrusted_text.h"
#include "core/base/utc_time.h"
#include "core/imaging/capture_verdict.h"
#include "core/imaging/evaluate_fiducials.h"
#include "core/imaging/fiducial_captures.h"
#include "core/imaging/image.h"
#include "core/scanning/cloud_file.h"
#include "core/scanning/scan_check.h"
#include "core/scanning/scan_evaluation.h"
#include "core/session/session.h"

namespace spindrift {
namespace {

constexpr const char* fiducial_header = "time_s,state,fiducial,role,index,x_mm,y_mm,z_mm,spindle_deg,image";
constexpr const char* scan_header = "time_s,cycle,artefact,y_mm,cloud";
constexpr std::size_t longest_header = 100'000;

std::string endingOf(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

/// The first line that is no comment; empty where it cannot be read.
std::string firstLineOf(const std::filesystem::path& file) {
  std::string line;
  try {
    FileReader reader(file);
    std::array<char, 4096> buffer;
    while (const std::size_t count = reader.read(buffer)) {
      for (const char c : std::span(buffer).first(count)) {
        if (c != '\n') {
          if (line.size() < longest_header) line += c;
        } else if (line.starts_with('#')) {
          line.clear();
        } else {
          return line;
        }
      }
    }
  } catch (const InputError&) {
    return {};
  }
  return line.starts_with('#') ? std::string() : line;
}

IncomingKind kindOf(const std::filesystem::path& file, bool printed) {
  const std::string ending = endingOf(file);
  for (const char* image : {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp", ".pgm"}) {
    if (ending == image) return IncomingKind::Image;
  }
  if (ending == ".pcd" || ending == ".ply") return IncomingKind::Cloud;
  if (printed && (ending == ".txt" || ending == ".log" || ending == ".prn")) return IncomingKind::Touches;
  if (ending != ".csv") return IncomingKind::Other;
  const std::string header = firstLineOf(file);
  if (header.find("nx") != std::string::npos && header.find("touch") != std::string::npos) return IncomingKind::Touches;
  if (header.find("x_mm") != std::string::npos && header.find("z_mm") != std::string::npos &&
      header.find("time_s") == std::string::npos) {
    return IncomingKind::Cloud;
  }
  return IncomingKind::Other;
}

/// What stored names carry of a hash.
std::string shortHash(const std::string& hash) {
  return hash.substr(0, 8);
}

/// The hash in the name of a stored file; empty if it has none.
std::string hashInName(const std::filesystem::path& file) {
  const std::string stem = file.stem().string();
  const std::size_t at = stem.rfind('_');
  return at != std::string::npos && stem.size() - at == 9 ? stem.substr(at + 1) : std::string();
}

std::string safeName(const std::string& name) {
  std::string safe;
  for (const char c : std::filesystem::path(name).filename().string()) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '_';
    safe += plain ? c : '_';
  }
  return safe;
}

/// Throws InputError where the campaign is gone. Its folder is not made anew: a disk that was pulled out would leave
/// captures in a folder of its name that nobody looks into.
void requireInPlace(const IncomingContext& context) {
  std::error_code error;
  if (std::filesystem::exists(context.campaignFolder() / "campaign.json", error)) return;
  throw InputError(
      {context.campaignFolder(), ""},
      "is not there any more (removed, renamed, or its disk or network folder is gone). Nothing was stored; "
      "bring the folder back, and what has arrived meanwhile is stored.");
}

/// Copies into the campaign unless it is there already. Another file of that name and hash, as far as the name carries
/// it, keeps its place.
void keep(const IncomingContext& context, IncomingItem& item, const std::string& folder, const std::string& stem,
          const std::string& ending, const std::string& bytes) {
  requireInPlace(context);
  for (const std::string& digits : {shortHash(item.hash), item.hash}) {
    item.stored = fmt::format("captures/{}/{}_{}{}", folder, stem, digits, ending);
    const std::filesystem::path target = context.campaignFolder() / item.stored;
    std::error_code error;
    const bool there = std::filesystem::exists(target, error);
    if (!there) return writeFileAtomically(target, bytes);
    if (std::filesystem::file_size(target, error) == bytes.size() && !error && readFile(target) == bytes) return;
  }
}

const PlannedItem* itemOf(const IncomingContext& context, const std::string& name, PlannedKind kind) {
  const PlannedItem* named = context.plan().ofName(name);
  return named != nullptr && named->kind == kind ? named : context.firstOpen(kind);
}

/// Finds the item of the plan, or says in `out` why there is none; true if it is open.
const PlannedItem* openItem(const IncomingContext& context, PlannedKind kind, ExaminedFile& out) {
  const PlannedItem* planned = itemOf(context, out.item.name, kind);
  if (planned == nullptr) {
    out.item.state = IncomingState::Ignored;
    out.item.sentence = context.plan().plan().empty()
                            ? "There is no plan that says what it is; make one, it is kept meanwhile."
                            : fmt::format("The plan has no {} left to take; it is kept aside.", toString(kind));
    return nullptr;
  }
  out.item.plan_item = planned->id;
  if (context.isDone(planned->id)) {
    out.item.state = IncomingState::Twice;
    out.item.sentence = fmt::format("{} is there already; this one is kept aside.", planned->id);
    return nullptr;
  }
  return planned;
}

/// Whether a known file with the same first digits of its hash has the same content indeed.
bool sameContent(const IncomingContext& context, const ArrivedFile& known, const IncomingItem& item, std::size_t size) {
  if (!known.hash.empty()) return known.hash == item.hash;
  const std::filesystem::path copy = context.campaignFolder() / known.stored;
  std::error_code error;
  if (std::filesystem::file_size(copy, error) != size || error) return false;
  return sha256OfFile(copy) == item.hash;
}

bool foundTwice(const IncomingContext& context, IncomingItem& item, std::size_t size) {
  for (const ArrivedFile& file : context.alike(item.hash)) {
    if (!sameContent(context, file, item, size)) continue;
    item.state = IncomingState::Twice;
    item.sentence = file.name == item.name ? std::string("It is there already.")
                                           : fmt::format("It has the same content as {}.", file.name);
    return true;
  }
  return false;
}

SeenCapture seenOf(const PlannedItem& planned, const std::optional<ImagePose>& pose, double sharpness) {
  SeenCapture seen;
  seen.fiducial = planned.fiducial;
  seen.state = planned.state;
  seen.role = captureRole(planned.role).value_or(CaptureRole::Rotation);
  seen.index = planned.index;
  seen.position_mm = planned.position_mm;
  seen.spindle_deg = planned.spindle_deg;
  seen.pose = pose;
  seen.sharpness = sharpness;
  return seen;
}

/// The images of the same state; of the same fiducial they are read again where the journal does not know them.
std::vector<SeenCapture> comparable(const IncomingContext& context, const SeenCapture& seen) {
  std::vector<SeenCapture> others;
  for (const ListedImage& listed : context.imagesOf(seen.state)) {
    SeenCapture other = listed.seen;
    if (!listed.known) {
      if (other.fiducial != seen.fiducial) continue;
      try {
        const GrayImage image = readImage(context.campaignFolder() / listed.image);
        const auto pattern = campaignPattern(context.campaignFolder());
        other.pose = poseOf(decodeImage(image, *pattern), *pattern);
        other.sharpness = measureFocus(image).normalised;
      } catch (const InputError&) {
        continue;  // the check of all captures says so
      }
    }
    others.push_back(std::move(other));
  }
  return others;
}

void examineImageBytes(const std::string& bytes, const std::string& ending, const IncomingContext& context,
                       ExaminedFile& out) {
  GrayImage image;
  try {
    image = decodeImageBytes(bytes, out.item.name);
  } catch (const InputError& e) {
    out.unreadable = true;
    out.item.state = IncomingState::Retake;
    out.item.sentence = e.what();
    keep(context, out.item, "kept", std::filesystem::path(safeName(out.item.name)).stem().string(), ending, bytes);
    return;
  }
  const PlannedItem* planned = openItem(context, PlannedKind::Image, out);
  const std::string stem =
      planned != nullptr ? safeName(planned->id) : std::filesystem::path(safeName(out.item.name)).stem().string();
  if (planned == nullptr) return keep(context, out.item, "kept", stem, ending, bytes);
  const auto pattern = campaignPattern(context.campaignFolder());
  CaptureVerdict verdict = judgeCapture(image, planned->role == "focus", *pattern);
  if (verdict.good) {
    const SeenCapture seen = seenOf(*planned, poseOf(verdict.decoded, *pattern), verdict.focus.normalised);
    out.item.pose = seen.pose;
    out.item.sharpness = seen.sharpness;
    const std::string contradiction = contradictionOf(seen, comparable(context, seen));
    if (!contradiction.empty()) {
      verdict.good = false;
      verdict.sentence = contradiction;
    }
  }
  out.item.sentence = verdict.sentence;
  out.item.state = verdict.good ? IncomingState::Accepted : IncomingState::Retake;
  keep(context, out.item, verdict.good ? "images" : "kept", stem, ending, bytes);
  if (!verdict.good) return;
  out.list = "fiducials.csv";
  out.header = fiducial_header;
  const Eigen::Vector3d& p = planned->position_mm;
  out.row =
      fmt::format("{},{},{},{},{},{},{},{},{},{}", exactNumber(out.item.time_s), csvField(planned->state),
                  csvField(planned->fiducial), planned->role, planned->index, exactNumber(p.x()), exactNumber(p.y()),
                  exactNumber(p.z()), exactNumber(planned->spindle_deg), csvField(out.item.stored));
}

void examineCloud(const std::filesystem::path& file, const std::string& bytes, const IncomingContext& context,
                  ExaminedFile& out) {
  const std::string ending = endingOf(file);
  const std::string own = std::filesystem::path(safeName(out.item.name)).stem().string();
  PointCloud cloud;
  try {
    cloud = readCloud(file);
    requireUsableCloud(cloud);
  } catch (const InputError& e) {
    out.unreadable = true;
    out.item.state = IncomingState::Retake;
    out.item.sentence = e.what();
    return keep(context, out.item, "kept", own, ending, bytes);
  }
  const PlannedItem* planned = openItem(context, PlannedKind::Scan, out);
  if (planned == nullptr) return keep(context, out.item, "kept", own, ending, bytes);
  out.artefact = planned->artefact;
  out.points = cloud.size();
  const std::size_t fullest = context.fullest(planned->artefact);
  const double share = fullest == 0 ? 1.0 : static_cast<double>(out.points) / static_cast<double>(fullest);
  if (share < complete_scan) {
    out.item.state = IncomingState::Retake;
    out.item.sentence = fmt::format("Only {:.0f} % of the points of the fullest scan of {}: cut short or hidden.",
                                    100.0 * share, planned->artefact);
    return keep(context, out.item, "kept", safeName(planned->id), ending, bytes);
  }
  out.item.state = IncomingState::Accepted;
  out.item.sentence = fmt::format("Complete: {} points in {} profiles.", out.points, cloud.profileCount());
  keep(context, out.item, "clouds", safeName(planned->id), ending, bytes);
  out.list = "scans.csv";
  out.header = scan_header;
  out.row = fmt::format("{},{},{},{},{}", exactNumber(out.item.time_s), csvField(planned->state),
                        csvField(planned->artefact), exactNumber(planned->y_mm), csvField(out.item.stored));
}

/// Milliseconds are enough, and a row stays readable.
double secondsSinceStart(std::int64_t written_ns, const IncomingContext& context) {
  return std::round((static_cast<double>(written_ns / 1'000'000) - 1e3 * context.startUnix_s())) * 1e-3;
}

ExaminedFile begin(const std::string& bytes, const std::string& name, std::int64_t written_ns,
                   const IncomingContext& context) {
  ExaminedFile out;
  out.item.name = name;
  out.item.hash = sha256(bytes);
  out.item.time_s = secondsSinceStart(written_ns, context);
  return out;
}

}  // namespace

std::string toString(IncomingState state) {
  switch (state) {
    case IncomingState::Waiting:
      return "waiting";
    case IncomingState::Accepted:
      return "accepted";
    case IncomingState::Retake:
      return "take again";
    case IncomingState::Twice:
      return "twice";
    case IncomingState::Ignored:
      return "left aside";
  }
  return {};
}

IncomingContext::IncomingContext(const Campaign& campaign, MeasurementPlan plan,
                                 const std::vector<IncomingItem>& journal, bool printed)
    : campaign_folder_(campaign.folder),
      start_unix_s_(parseUtc(campaign.start_utc).value_or(0.0)),
      printed_(printed),
      excluded_(campaign.excluded_captures),
      plan_(std::move(plan)),
      tally_(plan_, campaign) {
  addListed(campaign, journal);
  for (const IncomingItem& item : journal) {
    if (item.hash.empty() || item.kind == IncomingKind::Touches) continue;
    std::vector<ArrivedFile>& known = files_[shortHash(item.hash)];
    // What the lists know by the name of its copy alone.
    std::erase_if(known, [&](const ArrivedFile& file) { return file.stored == item.stored; });
    known.push_back({item.name, item.stored, item.hash});
  }
}

/// Files of the lists by the hash in their names: what a crash kept out of the journal is known all the same.
void IncomingContext::addListed(const Campaign& campaign, const std::vector<IncomingItem>& journal) {
  std::unordered_map<std::string, const IncomingItem*> measured;
  for (const IncomingItem& item : journal) {
    if (item.sharpness > 0.0) measured[shortHash(item.hash)] = &item;
  }
  std::vector<std::string> files;
  try {
    if (const auto file = campaign.captureList("fiducials.csv")) {
      for (const FiducialCapture& c : readFiducialCaptures(*file).captures) {
        files.push_back(c.image);
        if (excluded_.contains(c.image)) continue;
        ListedImage listed;
        listed.seen = {c.fiducial, c.state, c.role, c.index, c.position_mm, c.spindle_deg, std::nullopt, 0.0};
        listed.image = c.image;
        if (const auto found = measured.find(hashInName(c.image)); found != measured.end()) {
          listed.seen.pose = found->second->pose;
          listed.seen.sharpness = found->second->sharpness;
          listed.known = true;
        }
        images_[c.state].push_back(std::move(listed));
      }
    }
    if (campaign.captureList("scans.csv")) {
      for (const ScanCapture& c : readScanList(campaign)) files.push_back(c.cloud);
    }
  } catch (const InputError&) {
    // The page of the captures says what is wrong with the list.
  }
  for (const std::string& name : files) {
    const std::filesystem::path path(name);
    const std::string hash = hashInName(path);
    if (!hash.empty()) files_[hash].push_back({path.filename().string(), name, ""});
  }
}

bool IncomingContext::isDone(const std::string& plan_item) const {
  const std::shared_lock lock(mutex_);
  return tally_.captures().done.contains(plan_item);
}

const PlannedItem* IncomingContext::firstOpen(PlannedKind kind) const {
  const std::shared_lock lock(mutex_);
  return tally_.firstOpen(kind);
}

std::vector<ArrivedFile> IncomingContext::alike(const std::string& hash) const {
  const std::shared_lock lock(mutex_);
  const auto known = files_.find(shortHash(hash));
  return known == files_.end() ? std::vector<ArrivedFile>() : known->second;
}

std::vector<ListedImage> IncomingContext::imagesOf(const std::string& state) const {
  const std::shared_lock lock(mutex_);
  const auto known = images_.find(state);
  return known == images_.end() ? std::vector<ListedImage>() : known->second;
}

std::size_t IncomingContext::fullest(const std::string& artefact) const {
  const std::shared_lock lock(mutex_);
  const auto known = fullest_.find(artefact);
  return known == fullest_.end() ? 0 : known->second;
}

std::shared_ptr<const ReadPosition> IncomingContext::positionOf(const std::string& name) const {
  const std::shared_lock lock(mutex_);
  const auto known = positions_.find(name);
  return known == positions_.end() ? nullptr : known->second;
}

void IncomingContext::recordPosition(const ExaminedFile& examined) {
  const std::unique_lock lock(mutex_);
  positions_[examined.item.name] = examined.position;
}

void IncomingContext::record(const ExaminedFile& answer) {
  const IncomingItem& item = answer.item;
  if (item.hash.empty() || item.kind == IncomingKind::Touches) return;
  const std::unique_lock lock(mutex_);
  std::vector<ArrivedFile>& known = files_[shortHash(item.hash)];
  const bool there = std::any_of(known.begin(), known.end(), [&](const ArrivedFile& file) {
    return file.name == item.name && file.stored == item.stored && file.hash == item.hash;
  });
  if (!there) known.push_back({item.name, item.stored, item.hash});
  if (answer.row.empty() || item.state != IncomingState::Accepted) return;
  const std::optional<std::size_t> at = plan_.find(item.plan_item);
  if (!at) return;
  const PlannedItem& planned = plan_.plan().items[*at];
  tally_.add(planned);
  if (planned.kind == PlannedKind::Image)
    images_[planned.state].push_back({seenOf(planned, item.pose, item.sharpness), item.stored, item.sharpness > 0.0});
  if (answer.points > 0) {
    std::size_t& most = fullest_[answer.artefact];
    most = std::max(most, answer.points);
  }
}

void IncomingContext::forgetPositions() {
  const std::unique_lock lock(mutex_);
  positions_.clear();
}

void IncomingContext::goOnFrom(const IncomingContext& before) {
  const std::scoped_lock lock(mutex_, before.mutex_);
  fullest_ = before.fullest_;
  positions_ = before.positions_;
}

void IncomingContext::record(const std::vector<Touch>& touches) {
  const std::unique_lock lock(mutex_);
  for (const Touch& t : touches) tally_.add(t);
}

namespace {

ExaminedFile unreadable(const std::string& name, const std::string& sentence) {
  ExaminedFile out;
  out.item.name = name;
  out.unreadable = true;
  out.item.state = IncomingState::Retake;
  out.item.sentence = sentence;
  return out;
}

constexpr std::size_t most_of_end = 4096;

/// Reads on, to the end of the file.
std::string restOf(FileReader& reader) {
  std::string text;
  std::array<char, 1 << 16> buffer;
  while (const std::size_t count = reader.read(buffer)) text.append(buffer.data(), count);
  return text;
}

/// True if the file is the one that was read so far, and has not become shorter; the reader then stands behind that.
bool goesOn(FileReader& reader, const ReadPosition& before) {
  if (reader.identity() != before.file) return false;
  reader.seek(before.size - before.end.size());
  std::string end(before.end.size(), '\0');
  for (std::size_t done = 0; done < end.size();) {
    const std::size_t count = reader.read(std::span(end).subspan(done));
    if (count == 0) return false;
    done += count;
  }
  return end == before.end;
}

/// Where the copy of a list of touches lies. Lists of one name in two folders have two copies.
std::string copyOfTouches(const std::string& name) {
  const std::string safe = safeName(name);
  if (safe == name) return "captures/kept/" + safe;
  const std::filesystem::path file(safe);
  return fmt::format("captures/kept/{}_{}{}", file.stem().string(), shortHash(sha256(name)), file.extension().string());
}

/// Reads what a list of touches grew by, and adds it to its copy.
ExaminedFile examineTouches(const std::filesystem::path& file, const std::string& name, std::int64_t written_ns,
                            const IncomingContext& context) {
  ExaminedFile out;
  auto position = std::make_shared<ReadPosition>();
  try {
    FileReader reader(file);
    const std::shared_ptr<const ReadPosition> before = context.positionOf(name);
    if (before != nullptr && goesOn(reader, *before)) {
      *position = *before;
    } else {
      position->file = reader.identity();
      reader.seek(0);
    }
    out.from = position->size;
    out.text = restOf(reader);
  } catch (const InputError& e) {
    return unreadable(name, e.what());
  }
  position->size += out.text.size();
  position->digest.add(out.text);
  if (out.text.size() >= most_of_end) position->end.clear();
  position->end += out.text;
  if (position->end.size() > most_of_end) position->end.erase(0, position->end.size() - most_of_end);
  out.item.name = name;
  out.item.kind = IncomingKind::Touches;
  out.item.hash = position->digest.text();
  out.item.time_s = secondsSinceStart(written_ns, context);
  out.item.state = IncomingState::Accepted;
  out.item.stored = copyOfTouches(name);
  requireInPlace(context);
  const std::filesystem::path copy = context.campaignFolder() / out.item.stored;
  std::error_code error;
  if (out.from > 0 && std::filesystem::file_size(copy, error) == out.from && !error) {
    if (!out.text.empty()) replaceEnd(copy, out.from, out.text);
  } else {
    writeFileAtomically(copy, out.from == 0 ? out.text : readFile(file).substr(0, position->size));
  }
  out.position = std::move(position);
  return out;
}

ExaminedFile examine(const std::filesystem::path& file, const std::string& name, std::int64_t written_ns,
                     const IncomingContext& context) {
  const IncomingKind kind = kindOf(file, context.printed());
  if (kind == IncomingKind::Touches) return examineTouches(file, name, written_ns, context);
  std::string bytes;
  try {
    bytes = readFile(file, largest_cloud_file);
  } catch (const InputError& e) {
    return unreadable(name, e.what());
  }
  ExaminedFile out = begin(bytes, name, written_ns, context);
  out.item.kind = kind;
  switch (out.item.kind) {
    case IncomingKind::Image:
      if (!foundTwice(context, out.item, bytes.size())) examineImageBytes(bytes, endingOf(file), context, out);
      break;
    case IncomingKind::Cloud:
      if (!foundTwice(context, out.item, bytes.size())) examineCloud(file, bytes, context, out);
      break;
    case IncomingKind::Touches:
    case IncomingKind::Other:
      out.item.state = IncomingState::Ignored;
      out.item.sentence = "Not an image, point cloud or touch list.";
      break;
  }
  return out;
}

}  // namespace

ExaminedFile examineArrival(const std::filesystem::path& file, const std::string& name, std::int64_t written_ns,
                            const IncomingContext& context) {
  try {
    return examine(file, name, written_ns, context);
  } catch (const std::bad_alloc&) {
    return unreadable(name, "There is not enough memory to read it.");
  }
}

ExaminedFile examineImage(const std::string& bytes, const std::string& name, std::int64_t written_ns,
                          const IncomingContext& context) {
  ExaminedFile out = begin(bytes, name, written_ns, context);
  out.item.kind = IncomingKind::Image;
  try {
    if (!foundTwice(context, out.item, bytes.size())) examineImageBytes(bytes, ".png", context, out);
    return out;
  } catch (const std::bad_alloc&) {
    return unreadable(name, "There is not enough memory to read it.");
  }
}

IncomingFolder::IncomingFolder(const std::filesystem::path& folder, const FolderWatchOptions& watch, double patience_s)
    : watch_(folder, watch), patience_s_(patience_s) {}

std::size_t IncomingFolder::indexOf(const std::string& name) {
  const auto [at, fresh] = index_.try_emplace(name, items_.size());
  if (fresh) {
    items_.emplace_back().name = name;
    waiting_.insert(at->second);
  }
  return at->second;
}

void IncomingFolder::set(const std::string& name, IncomingState state, std::string sentence) {
  const std::size_t index = indexOf(name);
  items_[index].state = state;
  items_[index].sentence = std::move(sentence);
  if (state == IncomingState::Waiting) {
    waiting_.insert(index);
  } else {
    waiting_.erase(index);
  }
}

void IncomingFolder::plan(Task task) {
  drop(task.name);
  task_of_[task.name] = next_task_;
  tasks_.emplace(next_task_++, std::move(task));
}

void IncomingFolder::drop(const std::string& name) {
  const auto known = task_of_.find(name);
  if (known == task_of_.end()) return;
  tasks_.erase(known->second);
  task_of_.erase(known);
}

bool IncomingFolder::look(double now_s) {
  bool changed = false;
  for (const WatchedFile& file : watch_.look(now_s)) {
    changed = true;
    const std::string name = nameAsText(file.file.lexically_relative(watch_.folder()).generic_string());
    const IncomingItem& item = items_[indexOf(name)];
    // Lists of touches grow by design and are read as they do; what was read needs no second look when it settles.
    const bool list = kindOf(file.file, true) == IncomingKind::Touches;
    if (list && (file.state == FileState::Settled || file.state == FileState::Empty)) continue;
    again_.erase(name);
    drop(name);
    if (file.state == FileState::Vanished) {
      if (item.state == IncomingState::Waiting) {
        set(name, IncomingState::Ignored, "It vanished or was renamed before it was complete.");
      }
      continue;
    }
    if (file.state == FileState::Empty) {
      set(name, IncomingState::Waiting, "It is empty: nothing has been written into it.");
      continue;
    }
    if (file.state == FileState::Growing && !list) {
      set(name, IncomingState::Waiting, fmt::format("It is being written: {} bytes so far.", file.size));
      continue;
    }
    plan({file, name, false});
  }
  for (auto at = again_.begin(); at != again_.end();) {
    if (at->second.first > now_s) {
      ++at;
      continue;
    }
    plan(at->second.second);
    at = again_.erase(at);
  }
  return changed;
}

std::optional<IncomingFolder::Task> IncomingFolder::next() {
  if (tasks_.empty()) return std::nullopt;
  Task task = std::move(tasks_.begin()->second);
  drop(task.name);
  return task;
}

const IncomingItem& IncomingFolder::finish(const Task& task, ExaminedFile examined, double now_s) {
  IncomingItem& item = items_[indexOf(task.name)];
  item = std::move(examined.item);
  // It could not be stored: it lies where it came from, and is examined as often as that takes.
  const bool put_off = item.state == IncomingState::Waiting;
  const bool again = examined.unreadable && !task.last_chance && !put_off;
  if (again || put_off) {
    Task once_more = task;
    once_more.last_chance = task.last_chance || again;
    again_[task.name] = {now_s + patience_s_, once_more};
  }
  set(task.name, again ? IncomingState::Waiting : item.state,
      again ? fmt::format("It cannot be read yet; waiting for the rest. {}", item.sentence) : item.sentence);
  return item;
}

}  // namespace spindrift
