// SPDX-License-Identifier: GPL-3.0-or-later
// The first screen: demo sessions with a small picture each, recent sessions, opening one, a new measurement.
#pragma once

#include <QAbstractButton>
#include <QWidget>

#include "widgets/shell/demo.h"

class QVBoxLayout;

namespace spindrift::gui {

/// A demo as a card that can be pressed.
class Callout;

class DemoCard : public QAbstractButton {
  Q_OBJECT
 public:
  explicit DemoCard(const Demo& demo, QWidget* parent = nullptr);
  [[nodiscard]] QSize sizeHint() const override { return {230, 228}; }
  /// Picture, title and sentence in as many lines as they need.
  [[nodiscard]] bool hasHeightForWidth() const override { return true; }
  [[nodiscard]] int heightForWidth(int width) const override;
  [[nodiscard]] QSize minimumSizeHint() const override { return {200, 200}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  Demo demo_;
};

class WelcomePage : public QWidget {
  Q_OBJECT
 public:
  explicit WelcomePage(QWidget* parent = nullptr);
  void setRecent(const QStringList& folders);
  /// Says that the session was not closed the last time and offers to open it; empty: nothing to say.
  void offerRecovery(const QString& folder);
  [[nodiscard]] Callout* recovery() const { return recovery_; }
  [[nodiscard]] DemoCard* demoCard(std::size_t index) const { return cards_[index]; }

 Q_SIGNALS:
  void demoChosen(const QString& name);
  void openSession();
  void openCampaign();
  void newMeasurement();
  void openPlant();
  void recentChosen(const QString& folder);

 private:
  std::vector<DemoCard*> cards_;
  QVBoxLayout* recent_;
  Callout* recovery_;
};

}  // namespace spindrift::gui
