// SPDX-License-Identifier: GPL-3.0-or-later
// Step Warm-up: has the instrument settled? Temperatures and the drift of what was measured again and again.
#pragma once

#include "widgets/pages/page.h"

namespace spindrift::gui {

class Plot;
class RowsModel;

class WarmUpPage : public Page {
  Q_OBJECT
 public:
  explicit WarmUpPage(PageContext context, QWidget* parent = nullptr);
  void refresh() override;
  [[nodiscard]] std::vector<Exportable> exportables() override;

 private:
  void confirm();

  QPushButton* confirm_;
  RowsModel* verdicts_;
  Plot* drift_;
  Plot* temperature_;
};

}  // namespace spindrift::gui
