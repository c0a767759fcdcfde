// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Hardening of a yield surface by compressive volumetric plastic strain eps = eps_vol_pl: declared
/// options and queries.
///
///   table:        the strength through given points, straight in p or in ln p
///   by_density:   the same with densities rho instead of strains, eps = ln(rho/density), density
///                 that of the law: one curve for every initial density
///   exponential:  theory: laws, eq. 18
///
/// The strength is positive and increasing for every eps. Below the data it decays as
///   p(eps) = p(first) exp( (eps - first) p'(first)/p(first) ),
/// which continues value and slope and never reaches zero; the exponential law does the same below
/// eps = 0. Beyond the last row the chosen rule applies: extrapolate the last segment, or stop the
/// run.

#include "furrow/material/hardening/hardening_parameters.h"
#include "furrow/material/material_model.h"

namespace furrow {

/// The section "hardening" of a material file.
SectionSchema hardening_section();
/// @param density          at the start [kg/m^3]
/// @param offset           [Pa] of the exponential law (the tensile strength of a foam); tables do
///                         not use it
/// @param includes_offset  the key pc0 is p_c0 + offset, not p_c0
/// @throws InputError for rows that do not increase, a table of one row, densities that do not
///         include the initial one, lambda <= kappa
HardeningParameters make_hardening(const SectionOptions& section, double density,
                                   double offset = 0.0, bool includes_offset = false);
/// Strength at eps_vol_pl [Pa].
double strength_at(const HardeningParameters& hardening, double eps_vol_pl);
/// @param key  of the options: the initial eps_vol_pl
/// @throws InputError when it is outside the data
void check_initial(const HardeningParameters& hardening, const Options& options,
                   const std::string& key);

}  // namespace furrow
