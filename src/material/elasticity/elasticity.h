// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The elastic part of every law: declared options and queries. The update is in
/// elasticity_kernel.h. Linear elasticity: theory: laws, eq. 3; porous (ABAQUS *POROUS ELASTIC):
/// eq. 4, with G constant, or from nu with K at the start of the step.
///
/// Porous elasticity keeps p + p_t > 0 for every strain. A stored stress is rounded, however, so
/// that p + p_t may lose all digits. It is therefore at least 2^-52 (p0 + p_t). The law resolves
/// J_el up to 1 + 36 kappa/(1 + e0); a point stretched further stays at this limit and is
/// compressed from there.

#include <string>

#include "furrow/material/elasticity/elasticity_parameters.h"
#include "furrow/material/material_model.h"

namespace furrow {

/// The section "elasticity" of a material file.
SectionSchema elasticity_section();
/// @throws InputError for values that exclude each other
ElasticityParameters make_elasticity(const SectionOptions& section);
/// @param tensile  strength in hydrostatic tension at the start [Pa]
/// @throws InputError where porous elasticity does not reach it
void check_reaches_tension(const ElasticityParameters& parameters, double tensile);
/// @param law  its name; @param remedy  instead of porous elasticity
/// @throws InputError for porous elasticity
void require_linear(const ElasticityParameters& parameters, const std::string& law,
                    const std::string& remedy);
/// The pressure at which a run starts: 0, or p0 of porous elasticity [Pa].
double initial_pressure(const ElasticityParameters& parameters);
/// Plastic strains "eps_vol_pl" and "eps_dev_pl" of a law that yields. The latter is the sum of
/// sqrt(2/3 de:de) over the deviatoric plastic strains de = (s_trial - s_end)/(2 G) of its steps.
std::vector<StateVariable> plastic_strains(double eps_vol_pl_0 = 0.0);
/// Tangent moduli at pressure p.
ElasticModuli moduli_at(const ElasticityParameters& parameters, double p);
/// The largest elastic wave speed of a block's points [m/s], from their pressure and volume.
/// @param density  rho0 [kg/m^3]
double largest_elastic_wave_speed(const ElasticityParameters& parameters, double density,
                                  const PointBlock& block);

}  // namespace furrow
