// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Is the step short enough for the stiffness of the grains?

#include <functional>
#include <optional>
#include <string>

#include "coupling/base/checks/finding.h"
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

/// Compares the step with the Rayleigh time of the worst grain: a warning above step_warning of it,
/// a refusal above step_limit. Collective. Without grains, or without the properties youngsModulus
/// and poissonsRatio (contact models that have none), there is nothing to compare.
std::optional<Finding> check_time_step(LAMMPS_NS::LAMMPS& lammps, const std::string& where);

// Shares of the contact time of snow (below): at 0.33 strengths are those of shorter steps, at 0.44
// bonds break of themselves, which nothing else shows.
inline constexpr double snow_step_warning = 0.22;
inline constexpr double snow_step_limit = 0.33;

/// sqrt(m/k) of a cluster whose contacts have the stiffness k = E d (model snow/bond) [s]:
///   T = d sqrt(pi/6 rho/E)
/// Its stiffest motion is to turn against the springs across its Z contacts, with the frequency
/// sqrt(2.5 Z)/T; leapfrog with dampers is stable to about 0.45 T.
double snow_contact_time(double radius, double density, double modulus);

/// Compares the step with the contact time of the worst grain: a warning above snow_step_warning of
/// it, a refusal above snow_step_limit. Collective.
/// @param modulus  E of the stiffest contact that grains of a type may have [Pa]
std::optional<Finding> check_snow_time_step(const LAMMPS_NS::LAMMPS& lammps,
                                            const std::string& where,
                                            const std::function<double(int type)>& modulus);

}  // namespace furrow::coupling
