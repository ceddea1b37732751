// SPDX-License-Identifier: GPL-3.0-or-later
// What the parts of the page Plant share.
#pragma once

#include <QHBoxLayout>
#include <QString>
#include <QVBoxLayout>
#include <QWidget>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "widgets/jobs/job_runner.h"

namespace spindrift::gui {

inline QString text(const std::string& s) {
  return QString::fromStdString(s);
}

/// What `work` gives is shown by `shown`, on the GUI thread.
template <typename Work, typename Shown>
Job displayJob(const QString& title, const char* key, Work work, Shown shown) {
  Job job;
  job.title = title;
  job.queue = JobQueue::Display;
  job.key = key;
  job.quiet = true;
  job.work = [work, shown](JobContext&) -> std::function<void()> {
    auto found = std::make_shared<decltype(work())>(work());
    return [shown, found] { shown(*found); };
  };
  return job;
}

inline QWidget* row(const std::vector<QWidget*>& widgets, int stretched) {
  auto* whole = new QWidget;
  auto* layout = new QHBoxLayout(whole);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  for (std::size_t i = 0; i < widgets.size(); ++i)
    layout->addWidget(widgets[i], static_cast<int>(i) == stretched ? 1 : 0);
  return whole;
}

inline QWidget* column(const std::vector<QWidget*>& widgets) {
  auto* whole = new QWidget;
  auto* layout = new QVBoxLayout(whole);
  layout->setContentsMargins(12, 12, 12, 12);
  layout->setSpacing(8);
  for (QWidget* w : widgets) layout->addWidget(w);
  return whole;
}

}  // namespace spindrift::gui
