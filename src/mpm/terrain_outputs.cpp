// SPDX-License-Identifier: GPL-2.0-or-later
#include "mpm/terrain_outputs.h"

namespace furrow {

const Outputs<TerrainReading>& terrain_outputs() {
  using R = TerrainReading;
  static const Outputs<R> list = {
      {"particles", "", "number of particles, of all ranks",
       [](R& r) { return r.terrain().particle_count(); }},
      {"kinetic_energy", "J", "of the particles, affine part included",
       [](R& r) { return r.energy().kinetic_energy; }},
      {"stored_energy", "J", "elastic and frozen, since the start",
       [](R& r) { return r.energy().stored_energy; }},
      {"dissipated_energy", "J", "plastic and on a slide surface, turned into heat since the start",
       [](R& r) { return r.energy().dissipated_energy; }},
      {"contact_work", "J", "of contacts on the terrain",
       [](R& r) { return r.energy().contact_work; }},
      {"load_work", "J", "of gravity and absorbing faces on the terrain",
       [](R& r) { return r.energy().load_work; }},
      {"numerical_loss", "J", "kinetic energy taken by the discretisation",
       [](R& r) { return r.energy().numerical_loss; }},
      {"residual", "J", "work that is not found in any energy",
       [](R& r) { return r.energy().residual(); }},
      {"travelled", "m", "by the moving grid since the start",
       [](R& r) { return r.terrain().travelled(); }},
      {"stable_step", "s", "of the terrain now",
       [](R& r) { return r.terrain().stable_time_step(); }},
      {"base_impulse", "N s", "vertical impulse of the lower face on the terrain since the start",
       [](R& r) { return r.terrain().boundary_impulse(Face::z_lower).z(); }},
      {"slide_loss", "J", "the part of the dissipated energy that friction on a slide surface took",
       [](R& r) { return r.terrain().slide_loss(); }},
      {"halo_messages", "", "that a rank sends in a sub-step for nodes it shares, mean so far",
       [](R& r) { return r.halo().messages; }},
      {"halo_bytes", "B", "in these messages", [](R& r) { return r.halo().bytes; }},
  };
  return list;
}

}  // namespace furrow
