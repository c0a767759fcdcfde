// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The elastic part of every law: declared options and queries. The update is in
/// elasticity_kernel.h.
///
/// Compression positive; eps_el is the logarithmic elastic volumetric strain, J_el = exp(-eps_el).
///   linear:  p = p_n + K (increment of eps_el),      K = E/(3(1 - 2 nu))
///            s = s_n + 2 G (increment of e_el),      G = E/(2(1 + nu))
///   porous:  kappa/(1 + e0) ln((p0 + p_t)/(p + p_t)) = J_el - 1     (ABAQUS *POROUS ELASTIC)
///            K = dp/d eps_el = (p + p_t) J_el (1 + e0)/kappa
///            G constant, or from nu with K at the start of the step
///
/// In porous elasticity p + p_t > 0 for every strain, but shrinks like exp(-(1 + e0)/kappa (J_el -
/// 1)), while the stress that a point keeps is rounded: of p + p_t there remain some 2^-53 of p_t
/// and of the deviator, of either sign or 0, which have no logarithm. So p + p_t is taken to be
/// 2^-52 (p0 + p_t) at least: J_el is told up to 1 + 36 kappa/(1 + e0), and a point stretched
/// further stays at the limit and answers compression from there.

#include "material/elasticity/elasticity_parameters.h"
#include "material/material_model.h"

namespace furrow {

/// The section "elasticity" of a material file.
SectionSchema elasticity_section();
/// @throws InputError for a combination that cannot be
ElasticityParameters make_elasticity(const SectionOptions& section);
/// The pressure at which a run starts: 0, or p0 of porous elasticity [Pa].
double initial_pressure(const ElasticityParameters& parameters);
/// "eps_dev_pl" of a law that yields: the sum of sqrt(2/3 de:de) over the deviatoric plastic
/// strains de = (s_trial - s_end)/(2 G) of its steps.
StateVariable equivalent_plastic_strain();
/// Tangent moduli at pressure p.
ElasticModuli moduli_at(const ElasticityParameters& parameters, double p);
/// The largest elastic wave speed of a block's points [m/s], from their pressure and volume.
/// @param density  rho0 [kg/m^3]
double largest_elastic_wave_speed(const ElasticityParameters& parameters, double density,
                                  const PointBlock& block);

}  // namespace furrow
