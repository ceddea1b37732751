// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/capture/capture_tabs.h"

#include <QCoreApplication>
#include <QTabWidget>

#include "widgets/common/parts.h"
#include "widgets/panels/capture/arriving_panel.h"
#include "widgets/panels/capture/camera_panel.h"
#include "widgets/services/incoming_service.h"

namespace spindrift::gui {

QTabWidget* captureTabs(QWidget* parent, QWidget* captured, const PageContext& context, Instrument instrument) {
  const auto tr = [](const char* text) { return QCoreApplication::translate("CaptureTabs", text); };
  QTabWidget* tabs = makeTabs(parent);
  tabs->setObjectName(QStringLiteral("captureTabs"));
  tabs->addTab(captured, tr("Captures"));
  auto* arriving = new ArrivingPanel(context, instrument);
  tabs->addTab(arriving, tr("Arriving"));
  if (instrument == Instrument::Microscope) tabs->addTab(new CameraPanel(context), tr("Camera"));
  // While a capture runs, what arrives is what one wants to see.
  if (IncomingService::of(context.session).running()) tabs->setCurrentWidget(arriving);
  return tabs;
}

void chooseCaptureTab(QWidget& page, SessionModel& session) {
  auto* tabs = page.findChild<QTabWidget*>(QStringLiteral("captureTabs"));
  if (tabs != nullptr) tabs->setCurrentIndex(IncomingService::of(session).running() ? 1 : 0);
}

}  // namespace spindrift::gui
