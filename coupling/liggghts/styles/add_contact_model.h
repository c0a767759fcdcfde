// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Contact models of grains that the library does not have, for pairs and for walls.

#include <cstdint>
#include <string>

// in this order: the first headers lack includes of their own
#include "pair.h"
#include "neigh_list.h"
#include "fix_insert_stream.h"
#include "granular_pair_style.h"
#include "granular_wall.h"
#include "contact_models.h"
#include "fix_wall_gran_base.h"

#include "coupling/liggghts/styles/short_pair_loop.h"

namespace furrow::coupling {

/// Adds a normal model that stands alone: with tangential, cohesion and rolling models off and the
/// default surface. LIGGGHTS::ContactModels::NormalModel<id> is specialised for it, id below 64 and
/// none of LIGGGHTS's (surface, normal_model_*.h).
/// LIGGGHTS keeps its tables for the whole process, also over `clear`, and complains of what is
/// added twice.
/// @tparam Place  see ShortPairLoop
template <int id, class Place>
void add_normal_model(const std::string& name) {
  namespace liggghts = LIGGGHTS;
  using Combination = liggghts::ContactModels::GranStyle<id>;
  using Model = liggghts::ContactModels::ContactModel<Combination>;
  static const bool once = [&name] {
    liggghts::ContactModels::Factory::instance().addNormalModel(name, id);
    liggghts::PairStyles::Factory::instance().addStyle(
        "gran", Combination::HASHCODE,
        [](LAMMPS_NS::LAMMPS* lammps, LAMMPS_NS::PairGran* pair,
           std::int64_t hash) -> liggghts::PairStyles::IGranularPairStyle* {
          return new ShortPairLoop<Model, Place>(lammps, pair, hash);
        });
    liggghts::Walls::Factory::instance().addStyle(
        "gran", Combination::HASHCODE,
        [](LAMMPS_NS::LAMMPS* lammps, LAMMPS_NS::FixWallGran* wall,
           std::int64_t hash) -> liggghts::Walls::IGranularWall* {
          return new liggghts::Walls::Granular<Model>(lammps, wall, hash);
        });
    return true;
  }();
  static_cast<void>(once);
}

}  // namespace furrow::coupling
