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

#include "material/elasticity/elasticity_parameters.h"
#include "material/material_model.h"

namespace furrow {

/// The section "elasticity" of a material file.
SectionSchema elasticity_section();
/// @throws InputError for a combination that cannot be
ElasticityParameters make_elasticity(const SectionOptions& section);
/// The pressure at which a run starts: 0, or p0 of porous elasticity [Pa].
double initial_pressure(const ElasticityParameters& parameters);
/// Tangent moduli at pressure p.
ElasticModuli moduli_at(const ElasticityParameters& parameters, double p);
/// The largest elastic wave speed of a block's points [m/s], from their pressure and volume.
/// @param density  rho0 [kg/m^3]
double largest_elastic_wave_speed(const ElasticityParameters& parameters, double density,
                                  const PointBlock& block);

}  // namespace furrow
