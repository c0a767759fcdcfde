// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Crushable foam, as [Shoop2001] (eq 17, 18) takes it from ABAQUS 5.8. Compression positive; t as
/// in drucker_prager_cap.h.
///
///   yield (17):  f = sqrt( ((pt - pc)/2 + p)^2 + (t/M)^2 ) - (pc + pt)/2 = 0
///                M = sigma0 / sqrt( pt pc0 + sigma0 (pc0 - pt)/3 - sigma0^2/9 )
///   flow (18):   g = sqrt( (9/2) p^2 + q^2 ), not associated: compaction under p > 0 without
///                lateral strain in uniaxial stress
/// pt is constant; pc(eps_vol_pl) hardens by compaction: exponential (hardening.h, offset pt) or a
/// table. pc0 = pc(0). sigma0 is the initial strength in uniaxial compression; it must stay below
/// 3 pc0, where M becomes infinite.
///
/// Table 1 of [Shoop2001] can be read as pc0 or as pc0 + pt: the key pc0_reading says what pc0 of
/// the hardening is. All plastic work is dissipated: sigma : d(eps_pl) = Lambda g^2 >= 0.

#include "material/material_model.h"
#include "material/models/crushable_foam/crushable_foam_parameters.h"

namespace furrow {

class CrushableFoam : public Material {
 public:
  /// Indices of the law's own variables in the state.
  enum : std::size_t { eps_vol_pl = field::internal, eps_dev_pl };

  static MaterialModel model();
  /// @param density  rho0 [kg/m^3]
  CrushableFoam(double density, const CrushableFoamParameters& parameters);

  bool stress_has_jumps() const override { return true; }
  UpdateReport update_block(const PointBlock& block) const override;
  ElasticModuli moduli(const VectorX& state) const override;
  double largest_wave_speed(const PointBlock& block) const override;
  double yield_function(const VectorX& state) const override;
  double stress_scale(const VectorX& state) const override;
  std::vector<Vector2> yield_surface(const VectorX& state, std::size_t points = 200) const override;

  const CrushableFoamParameters& parameters() const { return parameters_; }
  double pc(double eps) const;  ///< yield strength in hydrostatic compression [Pa]

 private:
  CrushableFoamParameters parameters_;
};

}  // namespace furrow
