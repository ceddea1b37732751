// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/plots/plot_grid.h"

#include <QGridLayout>
#include <QLabel>
#include <algorithm>
#include <cmath>

#include "widgets/common/parts.h"
#include "widgets/theme/shown_units.h"

namespace spindrift::gui {
namespace {

/// Smaller than a plot that stands alone.
constexpr QSize least_panel(150, 104);

}  // namespace

PlotGrid::PlotGrid(QWidget* parent) : QWidget(parent), grid_(new QGridLayout(this)) {
  grid_->setContentsMargins(0, 0, 0, 0);
  grid_->setSpacing(4);
  addPanel();
  panels_[0].title->hide();
}

void PlotGrid::addPanel() {
  Panel panel{makeLabel(QString(), "secondaryText"), new Plot};
  panel.plot->setMinimumSize(least_panel);
  connect(panel.plot, &Plot::hovered, this, &PlotGrid::hovered);
  panels_.push_back(panel);
}

void PlotGrid::setEmptyText(const QString& title, const QString& how) {
  panels_[0].plot->setEmptyText(title, how);
  grid_->addWidget(panels_[0].plot, 1, 0);
}

void PlotGrid::setAxes(const QString& x_title, const QString& y_title) {
  x_title_ = x_title;
  y_title_ = y_title;
  titleAxes();
}

/// Titles at the left and below only: the axes are the same.
void PlotGrid::titleAxes() {
  for (int i = 0; i < std::max(shown_, 1); ++i) {
    const bool last_row = i + columns_ >= shown_;
    const bool first_column = i % columns_ == 0;
    Plot* plot = panels_[static_cast<std::size_t>(i)].plot;
    plot->setAxes(x_title_, y_title_);
    plot->setTitlesShown(last_row, first_column);
  }
}

void PlotGrid::setContent(std::vector<Series> series) {
  std::vector<std::vector<Series>> contents;
  if (series.size() > most_panels) {
    contents.push_back(std::move(series));
  } else {
    for (Series& s : series) contents.push_back({std::move(s)});
  }
  double low = 0.0;  // zero is always there
  double high = 0.0;
  for (const auto& content : contents) {
    for (const Series& s : content) {
      for (std::size_t i = 0; i < s.y.size(); ++i) {
        const double half = i < s.sigma.size() && std::isfinite(s.sigma[i]) ? s.sigma_factor * s.sigma[i] : 0.0;
        if (!std::isfinite(s.y[i])) continue;
        low = std::min(low, s.y[i] - half);
        high = std::max(high, s.y[i] + half);
      }
    }
  }
  const double room = 0.05 * std::max(high - low, 1e-9);
  shown_ = static_cast<int>(contents.size());
  columns_ = std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(shown_)))));
  while (panels_.size() < contents.size()) addPanel();
  titleAxes();
  for (std::size_t i = 0; i < panels_.size(); ++i) {
    const Panel& panel = panels_[i];
    const bool used = i < contents.size();
    grid_->removeWidget(panel.title);
    grid_->removeWidget(panel.plot);
    panel.title->setVisible(used && contents.size() > 1);
    panel.plot->setVisible(used || i == 0);
    const int place = static_cast<int>(i);
    grid_->addWidget(panel.title, 2 * (place / columns_), place % columns_);
    grid_->addWidget(panel.plot, 2 * (place / columns_) + 1, place % columns_);
    if (!used) {
      panel.plot->setContent({});
      continue;
    }
    panel.title->setText(onScreen(contents[i].front().name));
    panel.plot->setAccessibleName(contents[i].front().name);
    panel.plot->setRange(std::pair(low - room, high + room));
    panel.plot->setContent(std::move(contents[i]));
  }
}

std::vector<Plot*> PlotGrid::panels() const {
  std::vector<Plot*> plots;
  for (int i = 0; i < shown_; ++i) plots.push_back(panels_[static_cast<std::size_t>(i)].plot);
  return plots;
}

QString PlotGrid::titleOf(int panel) const {
  return panels_[static_cast<std::size_t>(panel)].title->text();
}

}  // namespace spindrift::gui
