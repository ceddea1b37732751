// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/incoming.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <new>

#include "core/base/atomic_file.h"
#include "core/base/csv.h"
#include "core/base/error.h"
#include "core/base/sha256.h"
#include "core/base/text.h"
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

std::string endingOf(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

std::string firstLineOf(const std::filesystem::path& file) {
  std::string text;
  try {
    text = readFile(file, largest_cloud_file);
  } catch (const InputError&) {
    return {};
  }
  std::size_t begin = 0;
  while (begin < text.size() && text[begin] == '#') {
    begin = text.find('\n', begin);
    if (begin == std::string::npos) return {};
    ++begin;
  }
  return text.substr(begin, text.find('\n', begin) - begin);
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

double unixSeconds(const std::string& utc) {
  std::tm parts{};
  if (::strptime(utc.c_str(), "%Y-%m-%dT%H:%M:%S", &parts) == nullptr) return 0.0;
  return static_cast<double>(::timegm(&parts));
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

ListedImage listedImage(const FiducialCapture& c, const std::vector<IncomingItem>& journal) {
  ListedImage listed;
  listed.seen = {c.fiducial, c.state, c.role, c.index, c.position_mm, c.spindle_deg, std::nullopt, 0.0};
  listed.image = c.image;
  const std::string hash = hashInName(c.image);
  for (const IncomingItem& item : journal) {
    if (hash.empty() || !(item.sharpness > 0.0) || shortHash(item.hash) != hash) continue;
    listed.seen.pose = item.pose;
    listed.seen.sharpness = item.sharpness;
    listed.known = true;
  }
  return listed;
}

/// Files of the lists by the hash in their names: what a crash kept out of the journal is known all the same.
void addListed(const Campaign& campaign, const std::vector<IncomingItem>& journal, IncomingContext& context) {
  std::vector<std::string> files;
  try {
    if (const auto file = campaign.captureList("fiducials.csv")) {
      for (const FiducialCapture& c : readFiducialCaptures(*file).captures) {
        files.push_back(c.image);
        if (!campaign.excluded_captures.contains(c.image)) context.images.push_back(listedImage(c, journal));
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
    if (!hash.empty()) context.known[hash].push_back({path.filename().string(), name, ""});
  }
}

std::string safeName(const std::string& name) {
  std::string safe;
  for (const char c : std::filesystem::path(name).filename().string()) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '_';
    safe += plain ? c : '_';
  }
  return safe;
}

/// Copies into the campaign unless it is there already. Another file of that name and hash, as far as the name carries
/// it, keeps its place.
void keep(const IncomingContext& context, IncomingItem& item, const std::string& folder, const std::string& stem,
          const std::string& ending, const std::string& bytes) {
  for (const std::string& digits : {shortHash(item.hash), item.hash}) {
    item.stored = fmt::format("captures/{}/{}_{}{}", folder, stem, digits, ending);
    const std::filesystem::path target = context.campaign_folder / item.stored;
    std::error_code error;
    const bool there = std::filesystem::exists(target, error);
    if (!there) return writeFileAtomically(target, bytes);
    if (std::filesystem::file_size(target, error) == bytes.size() && !error && readFile(target) == bytes) return;
  }
}

const PlannedItem* itemOf(const IncomingContext& context, const std::string& name, PlannedKind kind, bool& by_name) {
  const PlannedItem* named = context.plan.ofName(name);
  by_name = named != nullptr && named->kind == kind;
  if (by_name) return named;
  for (const PlannedItem& item : context.plan.items) {
    if (item.kind == kind && !context.done.contains(item.id)) return &item;
  }
  return nullptr;
}

/// Finds the item of the plan, or says in `out` why there is none; true if it is open.
const PlannedItem* openItem(const IncomingContext& context, PlannedKind kind, ExaminedFile& out) {
  bool by_name = false;
  const PlannedItem* planned = itemOf(context, out.item.name, kind, by_name);
  if (planned == nullptr) {
    out.item.state = IncomingState::Ignored;
    out.item.sentence = context.plan.empty()
                            ? "There is no plan that says what it is; make one, it is kept meanwhile."
                            : fmt::format("The plan has no {} left to take; it is kept aside.", toString(kind));
    return nullptr;
  }
  out.item.plan_item = planned->id;
  if (context.done.contains(planned->id)) {
    out.item.state = IncomingState::Twice;
    out.item.sentence = fmt::format("{} is there already; this one is kept aside.", planned->id);
    return nullptr;
  }
  return planned;
}

/// Whether a known file with the same first digits of its hash has the same content indeed.
bool sameContent(const IncomingContext& context, const KnownFile& known, const IncomingItem& item, std::size_t size) {
  if (!known.hash.empty()) return known.hash == item.hash;
  const std::filesystem::path copy = context.campaign_folder / known.stored;
  std::error_code error;
  if (std::filesystem::file_size(copy, error) != size || error) return false;
  return sha256OfFile(copy) == item.hash;
}

bool foundTwice(const IncomingContext& context, IncomingItem& item, std::size_t size) {
  const auto known = context.known.find(shortHash(item.hash));
  if (known == context.known.end()) return false;
  for (const KnownFile& file : known->second) {
    if (!sameContent(context, file, item, size)) continue;
    item.state = IncomingState::Twice;
    item.sentence = file.name == item.name ? std::string("It is there already.")
                                           : fmt::format("It has the same content as {}.", file.name);
    return true;
  }
  return false;
}

SeenCapture seenOf(const PlannedItem& planned, const CaptureVerdict& verdict, const FiducialPattern& pattern) {
  SeenCapture seen;
  seen.fiducial = planned.fiducial;
  seen.state = planned.state;
  seen.role = captureRole(planned.role).value_or(CaptureRole::Rotation);
  seen.index = planned.index;
  seen.position_mm = planned.position_mm;
  seen.spindle_deg = planned.spindle_deg;
  seen.pose = poseOf(verdict.decoded, pattern);
  seen.sharpness = verdict.focus.normalised;
  return seen;
}

/// The images of the same state; of the same fiducial they are read again where the journal does not know them.
std::vector<SeenCapture> comparable(const IncomingContext& context, const SeenCapture& seen) {
  std::vector<SeenCapture> others;
  for (const ListedImage& listed : context.images) {
    if (listed.seen.state != seen.state) continue;
    SeenCapture other = listed.seen;
    if (!listed.known) {
      if (other.fiducial != seen.fiducial) continue;
      try {
        const GrayImage image = readImage(context.campaign_folder / listed.image);
        const auto pattern = campaignPattern(context.campaign_folder);
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
  const auto pattern = campaignPattern(context.campaign_folder);
  CaptureVerdict verdict = judgeCapture(image, planned->role == "focus", *pattern);
  if (verdict.good) {
    const SeenCapture seen = seenOf(*planned, verdict, *pattern);
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
  const auto fullest = context.fullest.find(planned->artefact);
  const double share =
      fullest == context.fullest.end() ? 1.0 : static_cast<double>(out.points) / static_cast<double>(fullest->second);
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

ExaminedFile begin(const std::string& bytes, const std::string& name, std::int64_t written_ns,
                   const IncomingContext& context) {
  ExaminedFile out;
  out.item.name = name;
  out.item.hash = sha256(bytes);
  // Milliseconds are enough, and a row stays readable.
  out.item.time_s = std::round((static_cast<double>(written_ns / 1'000'000) - 1e3 * context.start_unix_s)) * 1e-3;
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

IncomingContext incomingContext(const Campaign& campaign, const MeasurementPlan& plan,
                                const std::vector<IncomingItem>& journal, bool printed) {
  IncomingContext context;
  context.campaign_folder = campaign.folder;
  context.start_unix_s = unixSeconds(campaign.start_utc);
  context.plan = plan;
  context.done = capturedItems(plan, campaign);
  context.printed = printed;
  addListed(campaign, journal, context);
  for (const IncomingItem& item : journal) {
    if (item.hash.empty() || item.kind == IncomingKind::Touches) continue;
    std::vector<KnownFile>& known = context.known[shortHash(item.hash)];
    // What the lists know by the name of its copy alone.
    std::erase_if(known, [&](const KnownFile& file) { return file.stored == item.stored; });
    known.push_back({item.name, item.stored, item.hash});
  }
  return context;
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

ExaminedFile examine(const std::filesystem::path& file, const std::string& name, std::int64_t written_ns,
                     const IncomingContext& context) {
  std::string bytes;
  try {
    bytes = readFile(file, largest_cloud_file);
  } catch (const InputError& e) {
    return unreadable(name, e.what());
  }
  ExaminedFile out = begin(bytes, name, written_ns, context);
  out.item.kind = kindOf(file, context.printed);
  const std::string stem = std::filesystem::path(safeName(name)).stem().string();
  switch (out.item.kind) {
    case IncomingKind::Image:
      if (!foundTwice(context, out.item, bytes.size())) examineImageBytes(bytes, endingOf(file), context, out);
      break;
    case IncomingKind::Cloud:
      if (!foundTwice(context, out.item, bytes.size())) examineCloud(file, bytes, context, out);
      break;
    case IncomingKind::Touches:
      // One copy a file, replaced as it grows.
      out.item.stored = "captures/kept/" + safeName(name);
      writeFileAtomically(context.campaign_folder / out.item.stored, bytes);
      out.item.state = IncomingState::Accepted;
      out.text = std::move(bytes);
      break;
    case IncomingKind::Other:
      out.item.state = IncomingState::Ignored;
      out.item.sentence = "It is no image, no cloud and no list of touches.";
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

IncomingItem& IncomingFolder::itemOf(const std::string& name) {
  for (IncomingItem& item : items_) {
    if (item.name == name) return item;
  }
  items_.emplace_back().name = name;
  return items_.back();
}

bool IncomingFolder::look(double now_s) {
  bool changed = false;
  for (const WatchedFile& file : watch_.look(now_s)) {
    changed = true;
    const std::string name = file.file.lexically_relative(watch_.folder()).generic_string();
    IncomingItem& item = itemOf(name);
    // Lists of touches grow by design and are read as they do; what was read needs no second look when it settles.
    const bool list = kindOf(file.file, true) == IncomingKind::Touches;
    if (list && file.state == FileState::Settled) continue;
    std::erase_if(again_, [&](const auto& a) { return a.second.name == name; });
    std::erase_if(tasks_, [&](const Task& t) { return t.name == name; });
    if (file.state == FileState::Vanished) {
      if (item.state == IncomingState::Waiting) {
        item.state = IncomingState::Ignored;
        item.sentence = "It vanished or was renamed before it was complete.";
      }
      continue;
    }
    if (file.state == FileState::Growing && !list) {
      item.state = IncomingState::Waiting;
      item.sentence = fmt::format("It is being written: {} bytes so far.", file.size);
      continue;
    }
    tasks_.push_back({file, name, false});
  }
  for (auto at = again_.begin(); at != again_.end();) {
    if (at->first > now_s) {
      ++at;
      continue;
    }
    tasks_.push_back(at->second);
    at = again_.erase(at);
  }
  return changed;
}

std::optional<IncomingFolder::Task> IncomingFolder::next() {
  if (tasks_.empty()) return std::nullopt;
  Task task = tasks_.front();
  tasks_.pop_front();
  return task;
}

const IncomingItem& IncomingFolder::finish(const Task& task, ExaminedFile examined, double now_s) {
  IncomingItem& item = itemOf(task.name);
  item = std::move(examined.item);
  if (examined.unreadable && !task.last_chance) {
    item.state = IncomingState::Waiting;
    item.sentence = fmt::format("It cannot be read yet; waiting for the rest. {}", item.sentence);
    Task again = task;
    again.last_chance = true;
    again_.emplace_back(now_s + patience_s_, again);
  }
  return item;
}

}  // namespace spindrift
