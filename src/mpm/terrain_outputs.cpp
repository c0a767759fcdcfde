// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/terrain_outputs.h"

namespace furrow {

const Outputs<TerrainReading>& terrain_outputs() {
  using R = TerrainReading;
  static const Outputs<R> list = {
      {"particles", "", "number of particles on all ranks",
       [](R& r) { return r.terrain().particle_count(); }},
      {"kinetic_energy", "J", "kinetic energy of the particles, affine part included",
       [](R& r) { return r.energy().kinetic_energy; }},
      {"stored_energy", "J", "elastic and frozen energy, since the start",
       [](R& r) { return r.energy().stored_energy; }},
      {"dissipated_energy", "J", "energy dissipated by plastic work and on a slide surface",
       [](R& r) { return r.energy().dissipated_energy; }},
      {"contact_work", "J", "work of contacts on the terrain",
       [](R& r) { return r.energy().contact_work; }},
      {"load_work", "J", "work of gravity and absorbing faces on the terrain",
       [](R& r) { return r.energy().load_work; }},
      {"numerical_loss", "J", "kinetic energy dissipated by the discretisation",
       [](R& r) { return r.energy().numerical_loss; }},
      {"residual", "J", "error of the energy balance", [](R& r) { return r.energy().residual(); }},
      {"travelled", "m", "distance that the moving grid has travelled",
       [](R& r) { return r.terrain().travelled(); }},
      {"stable_step", "s", "present stable step of the terrain",
       [](R& r) { return r.terrain().stable_time_step(); }},
      {"base_impulse", "N s", "vertical impulse of the base on the terrain",
       [](R& r) { return r.terrain().boundary_impulse(Face::z_lower).z(); }},
      {"slide_loss", "J", "part of dissipated_energy from friction on a slide surface",
       [](R& r) { return r.terrain().slide_loss(); }},
      {"halo_messages", "", "messages per rank and sub-step for shared nodes, mean so far",
       [](R& r) { return r.halo().messages; }},
      {"halo_bytes", "B", "size of these messages", [](R& r) { return r.halo().bytes; }},
      {"awake_share", "", "share of the particles that are computed",
       [](R& r) { return r.terrain().active() ? r.terrain().active()->awake_share() : 1.0; }},
      {"neglected_force", "N", "force that holds sleeping ground at rest, mean over a period",
       [](R& r) { return r.neglect().force; }},
      {"largest_neglected_force", "N", "largest of these means so far",
       [](R& r) { return r.neglect().largest_force; }},
      {"neglected_energy", "J", "kinetic energy of ground that fell asleep, since the start",
       [](R& r) { return r.neglect().energy; }},
  };
  return list;
}

}  // namespace furrow
