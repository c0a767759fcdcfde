// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// NorSand, a critical state law of sand: strength and dilatancy depend on density and pressure,
/// and dense sand peaks and falls to the critical state. Surface and flow are those of
/// [Jefferies1993], the hardening is that of [Jefferies2005]. Equations: theory: sand, eqs. 1
/// to 7.
///
/// Pressures count from the tensile strength, P = p + pt. The size of the surface is the image
/// pressure P_i, and x = P/P_i. The section gives the yield measure t (section.h). D is the
/// dilatancy d(eps_v)/d(eps_q) of plastic flow, compaction positive.
///
/// Yield is at t = eta P, with the stress ratio eta.
///
///   eta = M - (1 - N) D,  x = (1 + N D/M)^((1 - N)/N)
///
/// Flow is associated. D falls from M/(1 - N) at the tip, where t = 0, through 0 at the image.
/// D is at least D_l: the void ratio e decides how fast sand can dilate.
///   D_l = chi_i psi_i,  psi_i = e - e_c(P_i)
/// So eta is at most M - (1 - N) chi psi. Plastic shear hardens the surface until x falls to x_l,
/// the x of D_l.
///
///   d(ln P_i) = h (x^2/x_l - x) d(eps_q),  h = (H - H_psi psi_i) (P_i/100 kPa)^-m
///
/// With m = 1 - n plastic and elastic stiffness have one ratio at all pressures (theory: sand).
///
/// The shear modulus grows with the pressure, and the bulk modulus in proportion.
///   G = G_ref (P/100 kPa)^n,  K = G 2 (1 + nu)/(3 (1 - 2 nu))
///
/// At the limit, x < x_l, the surface is a cone. P_i then falls by d(ln P_i) = -h (1 - x/x_l)
/// d(eps_q). At the tip flow may be volumetric, and (1 - N) d(eps_v)/M takes the place
/// of d(eps_q). Sand with D_l >= M/(1 - N) is too loose to bear shear, and compression softens it.
/// Grains that had separated thus bear a load only after the void ratio has fallen again.
///
/// A shear band of dense sand is narrower than the piece of ground that a point stands for. The key
/// shear_band gives the width of the band. From the peak on, the void ratio is that of the band. It
/// grows by the dilation times w/shear_band, where w is the width of the piece: in a continuum, the
/// cell (TerrainFill). The strength then falls over a slip that does not depend on the cell.
///
/// psi_i in D_l and h, and the power in h, have the P_i of the start of a step. The void ratio is
/// that of its end.
/// Tension beyond P = 0 opens the sand. The dissipation is (M + N D) P d(eps_q) >= 0; the work
/// against pt counts as frozen energy.
///
/// K and G are those of the pressure at the start of the step (hypoelastic): closed elastic cycles
/// of pressure and shear together do not conserve energy exactly.

#include "furrow/material/kernel_law.h"
#include "furrow/material/models/norsand/norsand_parameters.h"

namespace furrow {

class NorSand : public KernelLaw<NorSandParameters, NorSandKernels> {
 public:
  /// Indices of the internal variables in the state.
  enum : std::size_t { void_ratio = field::internal, image_pressure, eps_dev_pl, band_width };

  static MaterialModel model();
  /// @param density     rho0 [kg/m^3]
  /// @param void_ratio, image_pressure  at the start; [Pa]
  /// @param width  of a band in a point alone [m]
  NorSand(double density, const NorSandParameters& parameters, double void_ratio,
          double image_pressure, double width);

  ElasticModuli moduli(const VectorX& state) const override;
  double largest_wave_speed(const PointBlock& block) const override;
  double yield_function(const VectorX& state) const override;
  double stress_scale(const VectorX& state) const override;
  std::vector<Vector2> yield_surface(const VectorX& state, std::size_t points = 200) const override;

  /// Void ratio of the critical state at P = p + pt [Pa].
  double critical_void_ratio(double pressure) const;

 private:
  double strength(double P, const VectorX& state) const;  ///< t on the surface [Pa]
};

}  // namespace furrow
