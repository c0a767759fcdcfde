// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Is the step short enough for the stiffness of the grains?

#include <string>

#include "lammps.h"

namespace furrow::coupling {

// Shares of the Rayleigh time: 0.1 to 0.3 is common practice, and beyond half a contact of several
// grains gains energy.
inline constexpr double step_warning = 0.25;
inline constexpr double step_limit = 0.5;

/// The time in which a Rayleigh wave runs over the surface of a grain [s],
///   T = pi r sqrt(rho / G) / (0.1631 nu + 0.8766),  G = E / (2 (1 + nu))
/// (C. Thornton and C. W. Randall, in: Micromechanics of granular materials, Elsevier 1988;
/// LIGGGHTS's check/timestep/gran uses it too).
double rayleigh_time(double radius, double density, double young, double poisson);

/// Compares the step with the Rayleigh time of the worst grain. Warns above step_warning of it.
/// Collective. Without grains, or without the properties youngsModulus and poissonsRatio (contact
/// models that have none), there is nothing to compare.
/// @throws StateError above step_limit of it
void check_time_step(LAMMPS_NS::LAMMPS& lammps, const std::string& where);

}  // namespace furrow::coupling
