// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/jobs/task_titles.h"

#include <QCoreApplication>

namespace spindrift::gui {
namespace {

struct Tasks {
  Q_DECLARE_TR_FUNCTIONS(Tasks)
};

}  // namespace

QString taskTitle(const std::string& task, const CampaignFacts& facts) {
  if (task == "check")
    return facts.images    ? Tasks::tr("Checking the captures")
           : facts.touches ? Tasks::tr("Checking the touches")
                           : Tasks::tr("Checking the scans");
  if (task == "evaluate")
    return facts.images    ? Tasks::tr("Evaluating the captures")
           : facts.touches ? Tasks::tr("Evaluating the touches")
                           : Tasks::tr("Evaluating the scans");
  if (task == "fit")
    return facts.touches ? Tasks::tr("Fitting all cycles")
           : facts.scans ? Tasks::tr("Finding the six errors")
                         : Tasks::tr("Fitting the nine-parameter model");
  if (task == "thermal") return Tasks::tr("Identifying the model");
  if (task == "log-compensation") return Tasks::tr("Running the compensator");
  if (task == "discrepancy") return Tasks::tr("Searching for what the simulation lacks");
  if (task == "compensation") return Tasks::tr("Calculating the compensation");
  if (task == "verify") return Tasks::tr("Comparing before and after");
  if (task == "simulation") return Tasks::tr("Searching with the simulator");
  if (task == "check-jogs") return Tasks::tr("Checking the jogs");
  if (task == "check-repeatability") return Tasks::tr("Checking the repeatability");
  return Tasks::tr("Writing the report");
}

QString outdatedTitle() {
  return Tasks::tr("Running what is outdated");
}

}  // namespace spindrift::gui
