// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// LIGGGHTS's pair style for a contact model, with a loop over pairs for the usual case.

#include <cmath>
#include <cstdint>

// in this order: the first headers lack includes of their own
#include "pair.h"
#include "neigh_list.h"
#include "fix_insert_stream.h"
#include "granular_pair_style.h"
#include "contact_models.h"
#include "pair_gran_base.h"

#include "atom.h"
#include "coupling/liggghts/data/expose.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "furrow/simd/dispatch.h"

namespace furrow::coupling {

/// Short loop over pairs of spheres with separate masses, when nothing else needs the single
/// contacts: compiled in one with the model. Values that pass between the two are local, so the
/// compiler keeps in registers what LIGGGHTS's loop writes to memory for each pair. Every sum has
/// LIGGGHTS's order: forces are the same to the last bit. In any other case LIGGGHTS's loop runs.
/// For a model whose beginPass does nothing, and whose endPass takes nothing from the last contact.
///
/// Where the processor has AVX2, the loop is compiled for it, whose instructions have three
/// operands and so move less; without fused multiplication the bits stay the same.
/// @tparam Place  tag of Expose for &Granular<Model>::cmodel, the model that the pair style keeps
template <class Model, class Place>
class ShortPairLoop final : public LIGGGHTS::PairStyles::Granular<Model> {
  using Pairs = LIGGGHTS::PairStyles::Granular<Model>;
  using Compute = void (ShortPairLoop::*)(LAMMPS_NS::PairGran&);
  using Touching = LIGGGHTS::ContactModels::SurfacesIntersectData;
  using Force = LIGGGHTS::ContactModels::ForceData;

 public:
  ShortPairLoop(LAMMPS_NS::LAMMPS* lammps, LAMMPS_NS::PairGran* pair, std::int64_t hash)
      : Pairs(lammps, pair, hash), lammps_(*lammps), model_(this->*member(Place())) {}

  void compute_force(LAMMPS_NS::PairGran* pair, int energy, int virial, int local) override {
    if (!is_usual(*pair, local)) return Pairs::compute_force(pair, energy, virial, local);
    if (energy || virial)
      pair->ev_setup(energy, virial);
    else
      pair->evflag = pair->vflag_fdotr = 0;
    (this->*compute_)(*pair);
  }

 private:
  bool is_usual(LAMMPS_NS::PairGran& pair, int local) const {
    const LAMMPS_NS::Atom& grains = *lammps_.atom;
    return grains.sphere_flag && !grains.shapetype_flag && grains.rmass && pair.listgranhistory &&
           !lammps_.force->newton_pair && !pair.fr_pair() && !(pair.cpl() && local) &&
           !pair.storeContactForces() && !pair.storeContactForcesStress() &&
           !pair.storeSumDelta() && !pair.store_sum_normal_force() &&
           lammps_.modify->n_fixes_style("insert/stream/predefined") == 0;
  }

  void compute(LAMMPS_NS::PairGran& pair) {
    const LAMMPS_NS::NeighList &list = *pair.list, &contacts = *pair.listgranhistory;
    LAMMPS_NS::Atom& grains = *lammps_.atom;
    double *const *f = grains.f, *const *torque = grains.torque;
    const int own = grains.nlocal, values = pair.dnum();
    const double factor = lammps_.neighbor->contactDistanceFactor;
    const double squared_factor = factor * factor;
    for (int n = 0; n < list.inum; ++n) {
      const int i = list.ilist[n];
      const int *others = list.firstneigh[i], count = list.numneigh[i];
      const double x = grains.x[i][0], y = grains.x[i][1], z = grains.x[i][2],
                   radius = grains.radius[i];
      for (int k = 0; k < count; ++k) {
        const int j = others[k] & NEIGHMASK;
        const double dx = x - grains.x[j][0], dy = y - grains.x[j][1], dz = z - grains.x[j][2];
        const double squared = dx * dx + dy * dy + dz * dz, sum = radius + grains.radius[j];
        const bool touch = squared < sum * sum;
        if (!touch && !(squared < squared_factor * sum * sum)) continue;
        Touching touching;
        touching.i = i;
        touching.j = j;
        touching.radi = radius;
        touching.radj = grains.radius[j];
        touching.radsum = sum;
        touching.rsq = squared;
        touching.delta[0] = dx;
        touching.delta[1] = dy;
        touching.delta[2] = dz;
        touching.itype = grains.type[i];
        touching.jtype = grains.type[j];
        touching.v_i = grains.v[i];
        touching.v_j = grains.v[j];
        touching.computeflag = pair.computeflag();
        touching.shearupdate = pair.shearupdate();
        touching.contact_flags = contacts.firstneigh[i] + k;
        touching.contact_history = contacts.firstdouble[i] + values * k;
        Force on_i, on_j;
        if (!touch) {
          model_.surfacesClose(touching, on_i, on_j);
          continue;
        }
        const double distance = std::sqrt(squared), inverse = 1.0 / distance;
        touching.r = distance;
        touching.rinv = inverse;
        touching.en[0] = dx * inverse;
        touching.en[1] = dy * inverse;
        touching.en[2] = dz * inverse;
        touching.mi = grains.rmass[i];
        touching.mj = grains.rmass[j];
        touching.meff = effective_mass(pair, touching);
        touching.omega_i = grains.omega[i];
        touching.omega_j = grains.omega[j];
        model_.surfacesIntersect(touching, on_i, on_j);
        if (touching.computeflag) {
          add(pair.relax(i), on_i, f[i], torque[i]);
          if (j < own) add(pair.relax(j), on_j, f[j], torque[j]);
        }
        if (pair.evflag)
          pair.ev_tally_xyz(i, j, own, 0, 0.0, 0.0, on_i.delta_F[0], on_i.delta_F[1],
                            on_i.delta_F[2], dx, dy, dz);
      }
    }
    Touching last;
    Force on_i, on_j;
    model_.endPass(last, on_i, on_j);
  }

  /// A frozen grain is as good as infinitely heavy.
  double effective_mass(const LAMMPS_NS::PairGran& pair, const Touching& touching) const {
    const int frozen = pair.freeze_group_bit(), *mask = lammps_.atom->mask;
    if (mask[touching.j] & frozen) return touching.mi;
    if (mask[touching.i] & frozen) return touching.mj;
    return touching.mi * touching.mj / (touching.mi + touching.mj);
  }

  static void add(double relax, const Force& force, double* f, double* torque) {
    for (int c = 0; c < 3; ++c) f[c] += relax * force.delta_F[c];
    for (int c = 0; c < 3; ++c) torque[c] += relax * force.delta_torque[c];
  }

  [[gnu::flatten]] void baseline(LAMMPS_NS::PairGran& pair) { compute(pair); }
#ifdef FURROW_X86_KERNELS
  [[gnu::flatten, gnu::target("avx2")]] void avx2(LAMMPS_NS::PairGran& pair) { compute(pair); }
  Compute compute_ = chosen_instruction_set() == InstructionSet::baseline ? &ShortPairLoop::baseline
                                                                          : &ShortPairLoop::avx2;
#else
  Compute compute_ = &ShortPairLoop::baseline;
#endif
  LAMMPS_NS::LAMMPS& lammps_;
  Model& model_;
};

}  // namespace furrow::coupling
