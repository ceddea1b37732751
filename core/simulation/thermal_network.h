// SPDX-License-Identifier: Apache-2.0
// Heat flow in a network of finite volumes.
//
// Model: C_i dT_i/dt = Q_i + sum_j G_ij (T_j - T_i), with heat capacities C (J/K), conductances G (W/K) and sources Q
// (W). Some nodes are boundaries whose temperature is prescribed (room, coolant). Temperatures degC, time s. Rods and
// plates are rows and grids of such volumes.
//
// Integrated by Heun's rule with sub-steps below 0.7 of the stability limit, so the slow part of a warm-up (the part
// that matters for a machine) is accurate to about 1e-4, and the energy balance closes to rounding. Source: Patankar,
// Numerical Heat Transfer and Fluid Flow (1980), chapters 3 and 4.
#pragma once

#include <cstddef>
#include <vector>

namespace spindrift {

class ThermalNetwork {
 public:
  /// A volume; capacity > 0. Returns its index.
  int addNode(double capacity_J_per_K, double temperature_degC);
  /// A node of prescribed temperature.
  int addBoundary(double temperature_degC);
  /// A conductance >= 0 between two nodes. Returns the index of the link.
  int addLink(int from, int to, double conductance_W_per_K);
  /// `count` equal volumes in a row, linked by `between_W_per_K`. Returns the index of the first.
  int addRod(int count, double capacity_J_per_K, double between_W_per_K, double temperature_degC);

  void setConductance(int link, double conductance_W_per_K);
  void setTemperature(int node, double temperature_degC);
  /// Heat into each node (W), reset by the caller.
  void setHeat(int node, double heat_W);
  void addHeat(int node, double heat_W);
  void clearHeat();

  /// Advances by `duration_s` with as many equal sub-steps as stability asks for.
  void advance(double duration_s);

  [[nodiscard]] std::size_t size() const noexcept { return temperature_.size(); }
  [[nodiscard]] double temperature(int node) const { return temperature_[static_cast<std::size_t>(node)]; }
  [[nodiscard]] const std::vector<double>& temperatures() const noexcept { return temperature_; }
  /// Largest explicit step that is stable: min C_i / sum_j G_ij, with conductances as they are now.
  [[nodiscard]] double stabilityLimit_s() const;

  /// Energy since construction (J): from sources, through boundaries into the volumes, and change of what is stored.
  [[nodiscard]] double sourceEnergy_J() const noexcept { return source_energy_J_; }
  [[nodiscard]] double boundaryEnergy_J() const noexcept { return boundary_energy_J_; }
  [[nodiscard]] double storedEnergy_J() const;

 private:
  /// Heat flow into every node (W); returns what enters through boundaries.
  double flows(const std::vector<double>& temperature, std::vector<double>& flow) const;

  std::vector<double> capacity_;  // 0 for a boundary
  std::vector<double> temperature_;
  std::vector<double> initial_;
  std::vector<double> heat_;
  std::vector<int> from_;
  std::vector<int> to_;
  std::vector<double> conductance_;
  mutable double limit_s_ = 0.0;  // of the conductances when it was last computed
  mutable bool limit_known_ = false;
  std::vector<double> first_;
  std::vector<double> second_;
  std::vector<double> trial_;
  double source_energy_J_ = 0.0;
  double boundary_energy_J_ = 0.0;
};

}  // namespace spindrift
