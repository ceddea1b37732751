// SPDX-License-Identifier: Apache-2.0
#include "core/plant/batch_plan.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/error.h"
#include "core/base/json_reader.h"

namespace spindrift {
namespace {

const std::vector<std::string> works{"evaluate", "fit",           "identify", "discrepancy",
                                     "simulate", "hidden_effect", "command"};

std::filesystem::path besides(const std::filesystem::path& folder, const std::string& path) {
  return (folder / path).lexically_normal();
}

std::int64_t whole(const JsonNode& node, double low, double high) {
  const double value = node.number();
  if (!(value >= low) || !(value <= high) || value != std::floor(value))
    node.reject(fmt::format("a whole number from {:.0f} to {:.0f}", low, high));
  return static_cast<std::int64_t>(value);
}

BatchPlan parsed(const JsonNode& root, const std::filesystem::path& folder) {
  root.requireFormat("spindrift-batch", 1);
  BatchPlan plan;
  plan.name = root.at("name").name();
  plan.work = root.at("work").oneOf(works);
  if (const auto campaigns = root.find("campaigns")) {
    for (const JsonNode& c : campaigns->items()) plan.campaigns.push_back(besides(folder, c.name()));
  }
  if (const auto seeds = root.find("seeds")) {
    const auto range = seeds->items();
    if (range.size() != 2) seeds->reject("two whole numbers, the first and the last seed");
    const std::int64_t first = whole(range[0], 0.0, 9e15);
    const std::int64_t last = whole(range[1], static_cast<double>(first), static_cast<double>(first) + 1e7);
    plan.first_seed = static_cast<std::uint64_t>(first);
    plan.seeds = last - first + 1;
  }
  const bool of_seeds = plan.work == "simulate" || plan.work == "hidden_effect";
  const bool of_campaigns = !of_seeds && plan.work != "command";
  if (plan.campaigns.empty() == (plan.seeds == 0) || (of_seeds && plan.seeds == 0) ||
      (of_campaigns && plan.campaigns.empty()))
    root.reject(of_seeds       ? "\"seeds\":[FIRST,LAST] and no \"campaigns\" with this work"
                : of_campaigns ? "a list \"campaigns\" and no \"seeds\" with this work"
                               : "one of \"campaigns\" and \"seeds\"");
  if (const auto options = root.find("options")) {
    if (!options->value().is_object()) options->reject("an object");
    plan.options = options->value();
    for (const char* key : {"scenario", "out"}) {
      if (const auto path = options->find(key)) plan.options[key] = besides(folder, path->name()).string();
    }
  }
  if (const auto n = root.find("chunk")) plan.chunk = whole(*n, 1, 1e6);
  if (const auto n = root.find("retries")) plan.retries = static_cast<int>(whole(*n, 0, 100));
  if (const auto n = root.find("item_time_limit_s")) plan.item_time_limit_s = n->positiveNumber();
  if (const auto n = root.find("lease_s")) plan.lease_s = n->positiveNumber();
  const auto needs = [&](const char* key) {
    if (!plan.options.contains(key))
      throw InputError(root.place(), fmt::format("the work {} needs the option \"{}\".", plan.work, key));
  };
  if (plan.work == "simulate") {
    needs("scenario");
    needs("out");
  }
  if (plan.work == "identify") {
    for (const char* key : {"output", "train", "test"}) needs(key);
  }
  if (plan.work == "command") {
    needs("run");
    const auto& run = plan.options["run"];
    if (!run.is_array() || run.empty() ||
        !std::all_of(run.begin(), run.end(), [](const nlohmann::json& a) { return a.is_string(); }))
      root.at("options").at("run").reject("a list of texts, the program first");
  }
  return plan;
}

}  // namespace

BatchPlan BatchPlan::read(const std::filesystem::path& file) {
  return parsed(JsonNode::read(file), std::filesystem::absolute(file).parent_path());
}

BatchPlan BatchPlan::parse(const std::string& text, const std::string& what) {
  return parsed(JsonNode::parse(text, what), "/");
}

nlohmann::json BatchPlan::json() const {
  nlohmann::json out = {{"format", "spindrift-batch"},
                        {"version", 1},
                        {"name", name},
                        {"work", work},
                        {"options", options},
                        {"chunk", chunk},
                        {"item_time_limit_s", item_time_limit_s},
                        {"retries", retries},
                        {"lease_s", lease_s}};
  for (const std::filesystem::path& c : campaigns) out["campaigns"].push_back(c.string());
  if (seeds > 0) out["seeds"] = {first_seed, first_seed + static_cast<std::uint64_t>(seeds) - 1};
  return out;
}

std::int64_t BatchPlan::items() const {
  return seeds > 0 ? seeds : static_cast<std::int64_t>(campaigns.size());
}

std::string BatchPlan::itemName(std::int64_t item) const {
  return seeds > 0 ? fmt::format("seed {}", first_seed + static_cast<std::uint64_t>(item))
                   : campaigns.at(static_cast<std::size_t>(item)).string();
}

void BatchPlan::requireFiles() const {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  const auto require = [&](const std::filesystem::path& path) {
    std::error_code none;
    if (!std::filesystem::exists(path, none))
      throw InputError({path, ""}, fmt::format("is not on the computer {}; allowed: a folder that all computers of the "
                                               "batch see under the same name.",
                                               host.data()));
  };
  for (const std::filesystem::path& c : campaigns) require(c);
  if (options.contains("scenario")) require(options.at("scenario").get<std::string>());
}

}  // namespace spindrift
