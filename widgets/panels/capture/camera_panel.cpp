// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/capture/camera_panel.h"

#include <fmt/format.h>

#include <QHBoxLayout>
#include <QLineEdit>
#include <QSplitter>
#include <QVBoxLayout>
#include <chrono>
#include <optional>
#include <string_view>

#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/connect/genicam_source.h"
#include "core/connect/source.h"
#include "core/imaging/camera.h"
#include "core/imaging/evaluate_fiducials.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/image_view/decode_marks.h"
#include "widgets/image_view/image_view.h"
#include "widgets/models/cells.h"
#include "widgets/panels/capture/machine_state_line.h"
#include "widgets/plots/plot.h"
#include "widgets/services/connections_service.h"
#include "widgets/services/incoming_service.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {
namespace {

constexpr std::size_t history_length = 300;
/// "genicam:" alone is the first camera that answers.

}  // namespace

CameraPanel::CameraPanel(PageContext page_context, QWidget* parent)
    : QWidget(parent), context_(std::move(page_context)), service_(IncomingService::of(context_.session)) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 8, 0, 0);
  column->setSpacing(8);
  auto* line = new QHBoxLayout;
  source_ = new QLineEdit;
  source_->setAccessibleName(tr("Camera"));
  source_->setPlaceholderText(tr("Device number (0), genicam:NAME, video file, or address (rtsp://…)"));
  source_->setMinimumHeight(sizes::control_height);
  open_ = makeButton(tr("Open camera"), "play");
  take_ = makeButton(tr("Take picture"), nullptr, "primary");
  take_->setShortcut(QKeySequence(Qt::Key_Space));
  take_->setEnabled(false);
  line->addWidget(source_, 1);
  line->addWidget(open_);
  line->addWidget(take_);
  column->addLayout(line);
  state_ = new Callout;
  column->addWidget(state_);
  column->addWidget(new MachineStateLine(context_.session));
  state_->show(Tone::Neutral, tr("Open the camera of the microscope: focus while the sharpness rises, then take the "
                                 "picture. The plan says which one it is."));
  auto* left = new Card(tr("Live"));
  view_ = new ImageView;
  view_->setEmptyText(tr("The picture of the camera will appear here"), tr("What is decoded is drawn on top."));
  left->body()->addWidget(view_, 1);
  auto* right = new Card(tr("Focus"));
  auto* tiles = new QHBoxLayout;
  sharp_ = new NumberTile(tr("Sharpness"));
  best_ = new NumberTile(tr("Best so far"));
  decoded_ = new NumberTile(tr("Ellipses"));
  for (NumberTile* tile : {sharp_, best_, decoded_}) tiles->addWidget(tile, 1);
  right->body()->addLayout(tiles);
  plot_ = new Plot;
  plot_->setAxes(tr("Picture"), tr("Sharpness (ratio of contrasts)"));
  plot_->setEmptyText(tr("Sharpness over time will appear here"), tr("It is largest in focus."));
  right->body()->addWidget(plot_, 1);
  column->addWidget(makeSplitter(this, left, right, 8, 4), 1);
  poll_.setInterval(40);
  connect(&poll_, &QTimer::timeout, this, &CameraPanel::showLatest);
  connect(open_, &QPushButton::clicked, this, [this] {
    if (reading_ != nullptr) {
      close();
    } else {
      open(source_->text().trimmed());
    }
  });
  connect(source_, &QLineEdit::returnPressed, open_, &QPushButton::click);
  connect(take_, &QPushButton::clicked, this, &CameraPanel::take);
}

CameraPanel::~CameraPanel() {
  close();
}

void CameraPanel::open(const QString& source) {
  close();
  source_->setText(source);
  history_.clear();
  peak_ = 0.0;
  shown_frames_ = 0;
  auto reading = std::make_unique<Reading>();
  state_->show(Tone::Neutral, tr("Opening %1 …").arg(source));
  open_->setText(QChar(0x2009) + tr("Close camera"));
  const auto campaign = context_.session.campaign();
  try {
    reading->pattern = campaign ? campaignPattern(campaign->folder) : campaignPattern({});
  } catch (const InputError& e) {
    reading->pattern = campaignPattern({});
    state_->show(Tone::Attention, coreSentence(e.what()));
  }
  GenicamSettings settings;
  try {
    settings = settingsOf(source.toStdString());
  } catch (const InputError& e) {
    state_->show(Tone::Attention, coreSentence(e.what()));
  }
  reading_ = std::move(reading);
  reading_->thread = std::jthread([own = reading_.get(), before = std::move(closing_), name = source.toStdString(),
                                   settings](std::stop_token stop) mutable {
    before.reset();  // the same camera is not to be had twice
    own->read(std::move(stop), name, settings);
  });
  poll_.start();
}

/// As the tab Connections has them for this camera.
GenicamSettings CameraPanel::settingsOf(const std::string& source) const {
  const nlohmann::json description = ConnectionsService::of(context_.session).description();
  for (const nlohmann::json& each : description["sources"]) {
    if (each.value("url", std::string()) == source && source.starts_with(genicam_prefix))
      return readGenicamSettings(JsonNode::parse(each.dump(), "connections.json"));
  }
  return {};
}

void CameraPanel::close() {
  poll_.stop();
  if (reading_ != nullptr) {
    reading_->thread.request_stop();
    closing_ = std::move(reading_);  // not waited for: a camera that gives no picture takes seconds to notice
  }
  open_->setText(QChar(0x2009) + tr("Open camera"));
  take_->setEnabled(false);
}

/// On the reader's thread: the newest picture is decoded, those that come meanwhile are passed over.
void CameraPanel::Reading::read(std::stop_token stop, const std::string& source, const GenicamSettings& settings) {
  const auto show = [this](GrayImage image) {
    Frame frame;
    frame.image = std::make_shared<GrayImage>(std::move(image));
    frame.verdict = judgeCapture(*frame.image, false, *pattern);
    const std::lock_guard lock(mutex);
    latest = std::move(frame);
  };
  const auto fail = [this](const char* sentence) {
    const std::lock_guard lock(mutex);
    failure = coreSentence(sentence);
  };
  try {
    if (source.starts_with(genicam_prefix)) {
      GenicamCamera camera(source.substr(genicam_prefix.size()), settings);
      constexpr double patience_s = 5.0;
      double waited_s = 0.0;
      while (!stop.stop_requested() && waited_s < patience_s) {
        if (settings.trigger == "Software") camera.trigger();
        // Frames of which packets are missing are counted, and never shown or taken.
        std::optional<GrayImage> image = camera.read(0.25);
        waited_s = image ? 0.0 : waited_s + 0.25;
        if (image) show(std::move(*image));
      }
      if (!stop.stop_requested())
        throw ConnectionError(tr("The camera has sent no complete frame for %1 s and %n frames with missing packets.",
                                 nullptr, static_cast<int>(camera.counts().incomplete))
                                  .arg(decimalText(patience_s, 'f', 0))
                                  .toStdString());
    } else {
      CameraSource camera = CameraSource::open(source);
      const double rate = camera.framesPerSecond();
      while (!stop.stop_requested()) {
        const auto began = std::chrono::steady_clock::now();
        auto image = camera.read();
        if (!image) break;
        show(std::move(*image));
        if (camera.isFile() && rate > 0.0) {
          std::this_thread::sleep_until(began + std::chrono::duration<double>(1.0 / rate));
        }
      }
    }
  } catch (const InputError& e) {
    fail(e.what());
  } catch (const ConnectionError& e) {
    fail(e.what());
  }
  ended = true;
}

void CameraPanel::showLatest() {
  if (reading_ == nullptr) return;
  std::optional<Frame> frame;
  QString failure;
  {
    const std::lock_guard lock(reading_->mutex);
    frame.swap(reading_->latest);
    failure = reading_->failure;
  }
  if (!failure.isEmpty()) {
    close();
    state_->show(Tone::Bad, failure);
    return;
  }
  if (!frame) {
    if (reading_->ended) {
      const bool had_picture = image_ != nullptr;
      close();
      take_->setEnabled(had_picture);
      state_->show(Tone::Attention, tr("The camera gives no more pictures; the last one is shown."));
    }
    return;
  }
  ++shown_frames_;
  image_ = frame->image;
  verdict_ = std::move(frame->verdict);
  const double sharpness = verdict_.focus.normalised;
  peak_ = std::max(peak_, sharpness);
  history_.push_back(sharpness);
  if (history_.size() > history_length) history_.pop_front();
  view_->setImage(toImage(*image_));
  view_->setMarks(marksOf(verdict_.decoded, *reading_->pattern));
  sharp_->set(decimalText(sharpness, 'f', 3), tr("contrast over coarse contrast"),
              sharpness > 0.97 * peak_ ? Tone::Good : Tone::Neutral);
  best_->set(decimalText(peak_, 'f', 3),
             tr("%1 % of it now").arg(decimalText(100 * sharpness / std::max(peak_, 1e-9), 'f', 0)));
  decoded_->set(QString::number(verdict_.decoded.subpatterns.size()),
                tr("blur %1 px").arg(decimalText(verdict_.decoded.exposure.blur_sigma_px, 'f', 1)),
                verdict_.good ? Tone::Good : Tone::Attention);
  Series series;
  series.name = tr("Sharpness");
  series.style = SeriesStyle::Line;
  for (std::size_t i = 0; i < history_.size(); ++i) {
    series.x.push_back(static_cast<double>(shown_frames_) - static_cast<double>(history_.size() - i));
    series.y.push_back(history_[i]);
  }
  plot_->setContent({series});
  take_->setEnabled(true);
  state_->show(verdict_.good ? Tone::Good : Tone::Attention, coreSentence(verdict_.sentence));
  Q_EMIT frameShown();
}

void CameraPanel::take() {
  if (image_ != nullptr) service_.take(tr("camera"), image_);
}

void CameraPanel::hideEvent(QHideEvent* event) {
  close();  // a camera is not kept from other programs while nobody looks
  QWidget::hideEvent(event);
}

}  // namespace spindrift::gui
