// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/shell/welcome_page.h"

#include <QFileInfo>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QPainterPath>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "widgets/common/parts.h"
#include "widgets/theme/colour_map.h"
#include "widgets/theme/fonts.h"
#include "widgets/theme/icons.h"

namespace spindrift::gui {
namespace {

/// Small drawings of what each demo is about.
void drawPicture(QPainter& painter, const QRectF& area, const std::string& name) {
  const Theme& t = theme();
  painter.save();
  QPainterPath clip;
  clip.addRoundedRect(area, 6, 6);
  painter.setClipPath(clip);
  painter.fillRect(area, t.surface_alt);
  const double w = area.width();
  const double h = area.height();
  painter.translate(area.topLeft());
  if (name == "fiducials") {
    const ColourScale scale = ColourScale::symmetric(1, {}, {});
    QImage map(64, 28, QImage::Format_RGB32);
    for (int iy = 0; iy < map.height(); ++iy) {
      for (int ix = 0; ix < map.width(); ++ix) {
        map.setPixel(ix, iy,
                     scale.rgb(1.3 * ((ix + 0.5) / map.width() - 0.5) + 0.7 * (0.5 - (iy + 0.5) / map.height())));
      }
    }
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    painter.drawImage(QRectF(0, 0, w, h), map);
    painter.setPen(QPen(QColor(0x1B, 0x24, 0x29), 1.5));
    for (const QPointF p : {QPointF(0.12, 0.2), QPointF(0.88, 0.2), QPointF(0.88, 0.8), QPointF(0.12, 0.8)}) {
      painter.setBrush(Qt::white);
      painter.drawEllipse(QPointF(p.x() * w, p.y() * h), 5, 5);
    }
  } else if (name == "holes") {
    painter.setPen(QPen(t.body_edge, 1.5));
    painter.setBrush(t.surface);
    painter.drawEllipse(QPointF(w / 2, h / 2), h * 0.44, h * 0.44);
    painter.translate(w / 2, h / 2);
    painter.rotate(-18);
    painter.setBrush(t.body);
    painter.drawRoundedRect(QRectF(-w * 0.4, -h * 0.1, w * 0.8, h * 0.2), 5, 5);
    painter.setBrush(t.surface_alt);
    for (const double x : {-0.36, -0.26, -0.13, -0.02, 0.13, 0.25, 0.36}) {
      painter.setPen(QPen(x < -0.3 ? t.accent : t.body_edge, x < -0.3 ? 2.5 : 1.5));
      painter.drawEllipse(QPointF(x * w, 0), 5.5, 5.5);
    }
  } else if (name == "balls") {
    painter.setPen(QPen(t.body_edge, 2));
    const std::array<QPointF, 4> balls{QPointF(w * 0.22, h * 0.66), QPointF(w * 0.46, h * 0.36),
                                       QPointF(w * 0.62, h * 0.62), QPointF(w * 0.82, h * 0.28)};
    painter.drawLine(QPointF(w * 0.1, h * 0.86), QPointF(w * 0.92, h * 0.86));
    for (const QPointF& b : balls) painter.drawLine(b, QPointF(b.x(), h * 0.86));
    for (const QPointF& b : balls) {
      QRadialGradient shade(b - QPointF(3, 4), 12);
      shade.setColorAt(0, t.surface);
      shade.setColorAt(1, t.body_edge);
      painter.setBrush(shade);
      painter.setPen(Qt::NoPen);
      painter.drawEllipse(b, 11, 11);
    }
  } else if (name == "scans") {
    // Profiles over a free-form surface, warm above cold, and the fan of laser light that draws one of them.
    const auto height = [&](double u, double v) { return h * (0.10 * std::sin(9 * u) + 0.09 * std::sin(4.2 * v + 1)); };
    const auto at = [&](double u, double v, double lift) {
      return QPointF(w * (0.12 + 0.6 * u + 0.18 * v), h * (0.86 - 0.34 * v) - height(u, v) - lift);
    };
    for (const bool warm : {false, true}) {
      QColor line = t.series[warm ? 1 : 0];
      line.setAlphaF(warm ? 0.95F : 0.45F);
      painter.setBrush(Qt::NoBrush);
      for (int j = 0; j <= 7; ++j) {
        QPainterPath profile(at(0, j / 7.0, warm ? 7 : 0));
        for (int i = 1; i <= 40; ++i) profile.lineTo(at(i / 40.0, j / 7.0, warm ? 7 : 0));
        painter.setPen(QPen(line, warm && j == 4 ? 2.5 : 1.2));
        painter.drawPath(profile);
      }
    }
    QColor beam = t.series[1];
    beam.setAlphaF(0.16F);
    QPainterPath fan(QPointF(w * 0.52, h * 0.04));
    fan.lineTo(at(0, 4 / 7.0, 7));
    for (int i = 1; i <= 40; ++i) fan.lineTo(at(i / 40.0, 4 / 7.0, 7));
    fan.closeSubpath();
    painter.fillPath(fan, beam);
  } else {
    QPainterPath simulated;
    QPainterPath measured;
    for (int i = 0; i <= 60; ++i) {
      const double x = i / 60.0;
      const double model = 0.75 - 0.45 * (1 - std::exp(-3 * x));
      const double truth = model - 0.25 * std::max(0.0, x - 0.4);
      const QPointF a(12 + x * (w - 24), model * h);
      const QPointF b(12 + x * (w - 24), truth * h);
      if (i == 0) {
        simulated.moveTo(a);
        measured.moveTo(b);
      } else {
        simulated.lineTo(a);
        measured.lineTo(b);
      }
    }
    QPainterPath gap = measured;
    gap.connectPath(simulated.toReversed());
    QColor fill = t.attention;
    fill.setAlphaF(0.25F);
    painter.fillPath(gap, fill);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(t.series[0], 2, Qt::DashLine));
    painter.drawPath(simulated);
    painter.setPen(QPen(t.series[1], 2));
    painter.drawPath(measured);
  }
  painter.restore();
}

}  // namespace

DemoCard::DemoCard(const Demo& demo, QWidget* parent) : QAbstractButton(parent), demo_(demo) {
  setText(demo.title);
  setAccessibleName(demo.title);
  setAccessibleDescription(demo.sentence);
  setCursor(Qt::PointingHandCursor);
  setFocusPolicy(Qt::StrongFocus);
  setAttribute(Qt::WA_Hover);
  // As high as the highest of the row.
  QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  policy.setHeightForWidth(true);
  setSizePolicy(policy);
}

int DemoCard::heightForWidth(int width) const {
  const QRect lines(0, 0, width - 28, 1000);
  const auto height = [&](const QFont& font, const QString& text) {
    return QFontMetrics(font).boundingRect(lines, Qt::TextWordWrap, text).height();
  };
  const int needed = 118 + height(textFont(sizes::font_body, QFont::DemiBold), demo_.title) +
                     height(textFont(sizes::font_secondary), demo_.sentence) + 12;
  return std::max(sizeHint().height(), needed);
}

void DemoCard::paintEvent(QPaintEvent*) {
  const Theme& t = theme();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF box = QRectF(rect()).adjusted(1, 1, -1, -1);
  painter.setPen(QPen(hasFocus() || underMouse() ? t.accent : t.border, hasFocus() ? 2 : 1));
  painter.setBrush(isDown() ? t.accent_soft : t.surface);
  painter.drawRoundedRect(box, 8, 8);
  drawPicture(painter, QRectF(12, 12, width() - 24, 96), demo_.name);
  painter.setPen(t.text);
  painter.setFont(textFont(sizes::font_body, QFont::DemiBold));
  const QRectF title_box(14, 114, width() - 28, 40);
  painter.drawText(title_box, Qt::AlignTop | Qt::TextWordWrap, demo_.title);
  const double title_height =
      painter.fontMetrics().boundingRect(title_box.toRect(), Qt::TextWordWrap, demo_.title).height();
  painter.setPen(t.text_secondary);
  painter.setFont(textFont(sizes::font_secondary));
  painter.drawText(QRectF(14, 118 + title_height, width() - 28, height() - 122 - title_height),
                   Qt::AlignTop | Qt::TextWordWrap, demo_.sentence);
}

WelcomePage::WelcomePage(QWidget* parent) : QWidget(parent) {
  setAccessibleName(tr("Welcome"));
  auto* outer = new QVBoxLayout(this);
  outer->setContentsMargins(0, 0, 0, 0);
  auto* scroll = new QScrollArea;
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  auto* inner = new QWidget;
  scroll->setWidget(inner);
  outer->addWidget(scroll);
  auto* centre = new QHBoxLayout(inner);
  centre->addStretch(1);
  auto* body = new QWidget;
  body->setMaximumWidth(1280);
  body->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  centre->addWidget(body, 20);
  centre->addStretch(1);
  auto* column = new QVBoxLayout(body);
  column->setContentsMargins(32, 32, 32, 32);
  column->setSpacing(16);

  auto* head = new QHBoxLayout;
  head->setSpacing(16);
  auto* logo = new QLabel;
  logo->setPixmap(iconPixmap(QStringLiteral("spindrift"), Qt::black, 56, devicePixelRatioF()));
  head->addWidget(logo);
  auto* titles = new QVBoxLayout;
  titles->setSpacing(2);
  titles->addWidget(makeLabel(QStringLiteral("Spindrift"), "bigNumber"));
  titles->addWidget(
      makeLabel(tr("Measure, understand and compensate the thermal errors of machine tools."), "instruction"));
  head->addLayout(titles, 1);
  column->addLayout(head);
  recovery_ = new Callout;
  recovery_->hide();
  column->addWidget(recovery_);

  auto* start = new QHBoxLayout;
  start->setSpacing(8);
  auto* new_measurement = makeButton(tr("New measurement …"), nullptr, "primary");
  auto* open_session = makeButton(tr("Open session …"), "folder-open");
  auto* open_campaign = makeButton(tr("Open campaign folder …"), "folder-open");
  start->addWidget(new_measurement);
  start->addWidget(open_session);
  start->addWidget(open_campaign);
  auto* plant = makeButton(tr("Plant …"), "machine");
  plant->setToolTip(tr("All machines of a plant: due dates, trends, batches"));
  start->addWidget(plant);
  connect(plant, &QPushButton::clicked, this, &WelcomePage::openPlant);
  start->addStretch();
  column->addLayout(start);

  column->addSpacing(8);
  column->addWidget(makeLabel(tr("Try it on the virtual machine"), "pageTitle"));
  auto* grid = new QGridLayout;
  grid->setSpacing(16);
  int index = 0;
  for (const Demo& demo : demos()) {
    if (!demo.on_first_screen) continue;
    auto* card = new DemoCard(demo);
    cards_.push_back(card);
    grid->addWidget(card, 0, index++);
    connect(card, &DemoCard::clicked, this,
            [this, name = demo.name] { Q_EMIT demoChosen(QString::fromStdString(name)); });
  }
  column->addLayout(grid);
  column->addSpacing(8);
  column->addWidget(makeLabel(tr("Recent sessions"), "pageTitle"));
  recent_ = new QVBoxLayout;
  recent_->setSpacing(4);
  column->addLayout(recent_);
  column->addStretch(1);
  connect(new_measurement, &QPushButton::clicked, this, &WelcomePage::newMeasurement);
  connect(open_session, &QPushButton::clicked, this, &WelcomePage::openSession);
  connect(open_campaign, &QPushButton::clicked, this, &WelcomePage::openCampaign);
  setRecent({});
}

void WelcomePage::offerRecovery(const QString& folder) {
  if (folder.isEmpty()) {
    recovery_->set(Tone::Neutral, {});
    return;
  }
  recovery_->show(Tone::Attention, tr("Session %1 was not closed properly. Everything that was captured is there; a "
                                      "calculation that was running must be started again.")
                                       .arg(QFileInfo(folder).fileName()));
  recovery_->setAction(tr("Open it again"), [this, folder] { Q_EMIT recentChosen(folder); });
}

void WelcomePage::setRecent(const QStringList& folders) {
  while (QLayoutItem* item = recent_->takeAt(0)) {
    delete item->widget();
    delete item;
  }
  if (folders.isEmpty()) {
    recent_->addWidget(makeLabel(
        tr("Sessions you open appear here. Everything measured is kept in its session's folder."), "instruction"));
    return;
  }
  for (const QString& folder : folders.mid(0, 5)) {
    const QFileInfo info(folder);
    auto* button = makeButton(info.fileName() + QStringLiteral("   ·   ") + info.path(), "folder-open", "quiet");
    button->setSizePolicy(QSizePolicy::Maximum, QSizePolicy::Fixed);
    connect(button, &QPushButton::clicked, this, [this, folder] { Q_EMIT recentChosen(folder); });
    recent_->addWidget(button);
  }
}

}  // namespace spindrift::gui
