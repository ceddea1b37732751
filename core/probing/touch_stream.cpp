// SPDX-License-Identifier: Apache-2.0
#include "core/probing/touch_stream.h"

#include "core/base/error.h"
#include "core/base/text.h"

namespace spindrift {

TouchStream::TouchStream(std::filesystem::path name, const MachineDescription& machine, std::optional<JsonNode> pattern)
    : name_(std::move(name)), machine_(machine), pattern_(std::move(pattern)) {}

void TouchStream::restart() {
  printed_.reset();
  rest_.clear();
  header_.clear();
  lines_ = 0;
  problems_.clear();
}

std::vector<Touch> TouchStream::update(std::string_view more) {
  if (pattern_ && printed_ == nullptr) printed_ = std::make_unique<PrintedTextReader>(name_, *pattern_, machine_);
  std::vector<Touch> fresh;
  for (std::size_t end = more.find('\n'); end != std::string_view::npos; end = more.find('\n')) {
    rest_ += more.substr(0, end);
    more.remove_prefix(end + 1);
    ++lines_;
    readLine(rest_, fresh);
    rest_.clear();
  }
  rest_ += more;
  return fresh;
}

void TouchStream::readLine(std::string_view whole, std::vector<Touch>& fresh) {
  try {
    if (printed_ != nullptr) {
      if (auto touch = printed_->read(whole)) fresh.push_back(std::move(*touch));
      return;
    }
    const std::string line(trimmed(whole));
    if (line.empty() || line.front() == '#') return;
    if (header_.empty()) {
      header_ = line;
      return;
    }
    TouchList list = TouchList::parse(header_ + "\n" + line + "\n", name_);
    Touch& touch = list.touches.front();
    touch.line = lines_;
    fresh.push_back(std::move(touch));
  } catch (const InputError& e) {
    SourcePlace where = e.where();
    // A row of a list was read by itself, as the second line of a text.
    if (printed_ == nullptr && where.line == 2) where.line = lines_;
    std::string sentence = InputError(where, e.sentence()).what();
    // A header that cannot be used is wrong once, and not in every row.
    const bool of_header = printed_ == nullptr && where.line == 1;
    if (of_header && !problems_.empty() && problems_.back().sentence == sentence) return;
    problems_.push_back({lines_, std::move(sentence)});
  }
}

}  // namespace spindrift
