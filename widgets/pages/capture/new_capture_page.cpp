// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/capture/new_capture_page.h"

#include <QTabWidget>
#include <QVBoxLayout>
#include <algorithm>

#include "widgets/common/parts.h"
#include "widgets/panels/capture/arriving_panel.h"
#include "widgets/panels/capture/camera_panel.h"
#include "widgets/services/incoming_service.h"

namespace spindrift::gui {

NewCapturePage::NewCapturePage(PageContext page_context, QWidget* parent)
    : Page(std::move(page_context), StepId::Capture, parent) {
  setInstruction(tr("Say what measures, make a plan, and let every capture be checked as it arrives."));
  instrument_ = new Segments({tr("Microscope"), tr("Touch probe"), tr("Laser profiler")}, tr("Instrument"));
  addAction(instrument_);
  tabs_ = makeTabs(this);
  arriving_ = new ArrivingPanel(context(), Instrument::Microscope);
  camera_ = new CameraPanel(context());
  tabs_->addTab(arriving_, tr("Arriving"));
  tabs_->addTab(camera_, tr("Camera"));
  content()->addWidget(tabs_, 1);
  connect(&IncomingService::of(session()), &IncomingService::changed, this, [this] {
    if (isVisible()) refresh();
  });
  connect(&IncomingService::of(session()), &IncomingService::planProgressed, this, [this] {
    if (isVisible()) refresh();
  });
  connect(instrument_, &Segments::chosen, this, [this](int index) { setInstrument(static_cast<Instrument>(index)); });
}

void NewCapturePage::setInstrument(Instrument instrument) {
  instrument_->setCurrent(static_cast<int>(instrument));
  arriving_->setInstrument(instrument);
  tabs_->setTabVisible(1, instrument == Instrument::Microscope);
}

void NewCapturePage::refresh() {
  const auto campaign = session().campaign();
  if (campaign == nullptr) return;
  if (noticeCampaign()) {
    const MachineDescription& machine = campaign->machine;
    const bool surfaces = std::any_of(machine.points.begin(), machine.points.end(),
                                      [](const MachinePoint& p) { return p.kind == "surface"; });
    setInstrument(machine.profiler && surfaces ? Instrument::Profiler
                  : !machine.artefacts.empty() ? Instrument::TouchProbe
                                               : Instrument::Microscope);
  }
  IncomingService& service = IncomingService::of(session());
  callout()->show(Tone::Accent, service.plan().empty()
                                    ? tr("Nothing is captured yet. Make a plan, then watch the folder into which the "
                                         "instrument writes.")
                                : !service.running()
                                    ? tr("The plan is made. Watch the folder into which the instrument writes.")
                                    : tr("Ready: take the captures of the plan. Each is checked as it arrives."));
  arriving_->refresh();
}

}  // namespace spindrift::gui
