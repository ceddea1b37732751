// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <stdexcept>

#include "core/plant/batch_plan.h"
#include "tests/fuzz/readers.h"

namespace spindrift::testing {
namespace {

/// A plan that is taken is kept in the store as it was understood, and read from there by every worker: it must say the
/// same again, and every item must have a name.
void batchPlan(std::string_view bytes) {
  const BatchPlan read = BatchPlan::read(scratchFile("batch/plan.json", bytes));
  const nlohmann::json kept = read.json();
  const BatchPlan again = BatchPlan::parse(kept.dump(), "plan of the batch");
  if (again.json() != kept) throw std::logic_error("a plan says something else when it is read again");
  if (read.items() < 1 || read.itemName(0).empty() || read.itemName(read.items() - 1).empty())
    throw std::logic_error("a plan without items was taken");
}

constexpr Reader readers[] = {{"batch_plan", batchPlan}};

}  // namespace

std::span<const Reader> plantReaders() {
  return readers;
}

}  // namespace spindrift::testing
