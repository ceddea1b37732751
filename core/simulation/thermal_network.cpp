// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/thermal_network.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"

namespace spindrift {
namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

}  // namespace

int ThermalNetwork::addNode(double capacity_J_per_K, double temperature_degC) {
  SPINDRIFT_ASSERT(capacity_J_per_K > 0.0, "a volume without heat capacity");
  capacity_.push_back(capacity_J_per_K);
  temperature_.push_back(temperature_degC);
  initial_.push_back(temperature_degC);
  heat_.push_back(0.0);
  limit_known_ = false;
  return static_cast<int>(capacity_.size()) - 1;
}

int ThermalNetwork::addBoundary(double temperature_degC) {
  const int node = addNode(1.0, temperature_degC);
  capacity_.back() = 0.0;
  return node;
}

int ThermalNetwork::addLink(int from, int to, double conductance_W_per_K) {
  SPINDRIFT_ASSERT(at(from) < size() && at(to) < size() && from != to, "a link between nodes that do not exist");
  SPINDRIFT_ASSERT(conductance_W_per_K >= 0.0, "a negative conductance");
  from_.push_back(from);
  to_.push_back(to);
  conductance_.push_back(conductance_W_per_K);
  limit_known_ = false;
  return static_cast<int>(from_.size()) - 1;
}

int ThermalNetwork::addRod(int count, double capacity_J_per_K, double between_W_per_K, double temperature_degC) {
  SPINDRIFT_ASSERT(count > 0, "a rod without cells");
  const int first = addNode(capacity_J_per_K, temperature_degC);
  for (int i = 1; i < count; ++i) {
    const int node = addNode(capacity_J_per_K, temperature_degC);
    addLink(node - 1, node, between_W_per_K);
  }
  return first;
}

void ThermalNetwork::setConductance(int link, double conductance_W_per_K) {
  SPINDRIFT_ASSERT(conductance_W_per_K >= 0.0, "a negative conductance");
  if (conductance_[at(link)] == conductance_W_per_K) return;
  conductance_[at(link)] = conductance_W_per_K;
  limit_known_ = false;
}

void ThermalNetwork::setTemperature(int node, double temperature_degC) {
  temperature_[at(node)] = temperature_degC;
}

void ThermalNetwork::setHeat(int node, double heat_W) {
  heat_[at(node)] = heat_W;
}

void ThermalNetwork::addHeat(int node, double heat_W) {
  heat_[at(node)] += heat_W;
}

void ThermalNetwork::clearHeat() {
  std::fill(heat_.begin(), heat_.end(), 0.0);
}

double ThermalNetwork::stabilityLimit_s() const {
  if (limit_known_) return limit_s_;
  std::vector<double> sum(size(), 0.0);
  for (std::size_t l = 0; l < conductance_.size(); ++l) {
    sum[at(from_[l])] += conductance_[l];
    sum[at(to_[l])] += conductance_[l];
  }
  limit_s_ = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < size(); ++i) {
    if (capacity_[i] > 0.0 && sum[i] > 0.0) limit_s_ = std::min(limit_s_, capacity_[i] / sum[i]);
  }
  limit_known_ = true;
  return limit_s_;
}

double ThermalNetwork::storedEnergy_J() const {
  double energy = 0.0;
  for (std::size_t i = 0; i < size(); ++i) energy += capacity_[i] * (temperature_[i] - initial_[i]);
  return energy;
}

double ThermalNetwork::flows(const std::vector<double>& temperature, std::vector<double>& flow) const {
  flow = heat_;
  for (std::size_t l = 0; l < conductance_.size(); ++l) {
    const auto a = at(from_[l]);
    const auto b = at(to_[l]);
    const double q = conductance_[l] * (temperature[a] - temperature[b]);
    flow[a] -= q;
    flow[b] += q;
  }
  double through_boundaries = 0.0;
  for (std::size_t i = 0; i < flow.size(); ++i) {
    if (capacity_[i] > 0.0) {
      flow[i] /= capacity_[i];
    } else {
      through_boundaries -= flow[i] - heat_[i];
      flow[i] = 0.0;
    }
  }
  return through_boundaries;
}

void ThermalNetwork::advance(double duration_s) {
  SPINDRIFT_ASSERT(duration_s >= 0.0, "time does not run backwards");
  if (duration_s == 0.0) return;
  const double limit_s = 0.7 * stabilityLimit_s();
  const int steps = std::max(1, static_cast<int>(std::ceil(duration_s / limit_s)));
  const double h = duration_s / steps;
  double source_W = 0.0;
  for (std::size_t i = 0; i < size(); ++i) {
    if (capacity_[i] > 0.0) source_W += heat_[i];
  }
  source_energy_J_ += source_W * duration_s;
  trial_.resize(size());
  for (int step = 0; step < steps; ++step) {
    const double boundary_first = flows(temperature_, first_);
    for (std::size_t i = 0; i < size(); ++i) trial_[i] = temperature_[i] + h * first_[i];
    const double boundary_second = flows(trial_, second_);
    for (std::size_t i = 0; i < size(); ++i) temperature_[i] += 0.5 * h * (first_[i] + second_[i]);
    boundary_energy_J_ += 0.5 * h * (boundary_first + boundary_second);
  }
}

}  // namespace spindrift
