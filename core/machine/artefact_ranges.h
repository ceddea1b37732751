// SPDX-License-Identifier: Apache-2.0
// What the certificate of an artefact can say: a number outside is one in another unit (1/K, K, °F).
#pragma once

#include <array>

namespace spindrift {

constexpr std::array<double, 2> artefact_expansion_range_um_per_m_K{-5.0, 100.0};
/// Size of an expansion that is not zero, at least: glass ceramics are certified to some 0.01 um/(m K), and steel
/// is 1.15e-5 in 1/K.
constexpr double least_artefact_expansion_um_per_m_K = 0.001;
constexpr std::array<double, 2> artefact_temperature_range_degC{-20.0, 80.0};
/// At which nominal lengths hold: 20 degC (ISO 1), here and there another room temperature.
constexpr std::array<double, 2> reference_temperature_range_degC{0.0, 40.0};
/// Standard uncertainties of the two; 0: exact.
constexpr double most_artefact_expansion_uncertainty_um_per_m_K = 20.0;
constexpr double most_artefact_temperature_uncertainty_K = 20.0;

}  // namespace spindrift
