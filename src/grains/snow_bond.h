// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Contact of two clusters of sintered snow that crush in place (theory: grains, eqs. 5 to 12).
///
/// A cluster is a lump of snow as light as the surrounding snow allows: its packing is dense and
/// random, so snow compacts by crushing contacts, not by rearranging clusters.
///
/// The sum of the radii is d = Ri + Rj, the overlap is u, and the unit normal n points from j to i.
/// The contact remembers five things. Its plastic overlap is u_p, which was u_0 when the clusters
/// sintered, and X = (u_p - u_0)/d measures the crushing since then. The bond has the area A; a
/// freshly sintered one has A0 = pi (0.2 d)^2. Shear force and moments are remembered too.
///
/// The trial force is elastic: Fn = k (u - u_p) with k = E d, and shear force and moments grow by
/// stiffness times relative motion. These limits then hold:
///
///   crushing   Fn <= Fy,  Fy = d^2 (Y0 exp(p X) + Y1 (exp(q X) - 1)).
///   shear      |Ft| <= C + mu max(Fn, 0),  C = chi Fb.
///   tension    Fn >= -zeta Fb. The bond breaks below; a contact without a bond has no tension.
///   bending    |M| <= 4/(3 pi) a (zeta Fb + max(Fn, 0)), with the stiffness k a_s^2/4.
///   torsion    |M| <= 2/3 a (chi Fb + mu max(Fn, 0)), with the stiffness k a_s^2/2.
///
/// The strength of the bond is Fb = min(Fy, d^2 Y0 exp(pc X)) min(1, A/A0). Both moments are those
/// of a fully plastic disc of the radius a = max(sqrt(A/pi), 0.07 d), elastic with a_s = max(a, 0.2
/// d). Pressed clusters sinter: A grows to w pi (d/4) (u_p - u_b), where u_b is the plastic overlap
/// at which the last bond broke.
///
/// If the trial is beyond the crush surface, Fn and Ft shrink in one ratio: the force follows the
/// displacement, which keeps lateral stress low (theory: grains, eq. 9). Beyond the shear surface
/// Ft shrinks by a share r and Fn by r C/(C + mu Fn): a bond yields along the force, a dry contact
/// slides at constant normal force. Both returns are implicit: the force lies on the surface of the
/// state after the step. Plastic displacement has the direction of the removed force, so plastic
/// work is never negative.
///
/// Dampers act on the change of the elastic force, Fd = c/k dF/dt, c = 2 damping sqrt(m k) along
/// and half of that across the normal. In elastic motion this is -c v, and steady crushing and
/// sliding do not depend on the rate.
///
/// Forces, moments and history are exactly opposite when i and j swap. Shear force and bending
/// moment turn with the normal, and about it by the mean spin.
///
/// Bonds with bending and torsion [Potyondy2004]; pressure sintering [Luding2008]; new bonds that
/// carry the hardening of compressed snow [Kry1975]. The law as a whole and its values were
/// developed for Furrow.

#include <algorithm>
#include <utility>

#include "furrow/grains/snow_bond_law.h"
#include "furrow/grains/snow_bond_step.h"
#include "furrow/grains/snow_bond_trial.h"

namespace furrow {

inline bool SnowBond::advance_elastic(const SnowBondParameters& law, const SnowContact& contact,
                                      const SnowBondTrial& trial, SnowBondState& state,
                                      SnowBondResponse& response, SnowBondEnergy* energy) {
  if (!trial.is_elastic(law, contact, state)) return false;
  state.across = trial.across;
  state.torsion = trial.torsion;
  response = trial.response(law, contact, energy);
  return true;
}

inline SnowBondResponse SnowBond::advance(const SnowBondParameters& law, const SnowContact& contact,
                                          SnowBondState& state, SnowBondEnergy* energy) {
  const SnowBondTrial trial(law, contact, state);
  SnowBondResponse response;
  if (advance_elastic(law, contact, trial, state, response, energy)) return response;
  return advance_yielding(law, contact, trial, state, energy);
}

inline SnowBondResponse SnowBond::advance_yielding(const SnowBondParameters& law,
                                                   const SnowContact& contact,
                                                   const SnowBondTrial& trial, SnowBondState& state,
                                                   SnowBondEnergy* energy) {
  if (energy) *energy = {};
  return SnowBondStep(law, contact, trial, state).advance(energy);
}

inline SnowBondResponse SnowBond::hold(const SnowBondParameters& law, const SnowContact& contact,
                                       const SnowBondState& state, SnowBondEnergy* energy) {
  double normal = stiffness(law, contact.d) * (contact.overlap - state.plastic);
  if (!state.bonded) normal = std::max(0.0, normal);
  SnowBondResponse response;
  response.force = normal * contact.normal + state.across.first();
  response.moment = state.across.second() + state.torsion * contact.normal;
  if (energy) {
    *energy = {};
    energy->stored = stored(law, contact.d, state, normal);
  }
  return response;
}

inline SnowBondResponse SnowBond::sinter(const SnowBondParameters& law, const SnowContact& contact,
                                         SnowBondState& state, SnowBondEnergy* energy) {
  SnowBondResponse response;
  response.made = contact.sinters && !state.bonded;
  if (energy) {
    hold(law, contact, state, energy);
    energy->released = std::exchange(energy->stored, 0.0);
  }
  state = {};
  state.plastic = state.at_sintering = state.at_break = contact.overlap;
  state.area = contact.sinters ? sintered_area(contact.d) : 0.0;
  state.bonded = contact.sinters;
  return response;
}

inline double SnowBond::part(const SnowBondParameters& law, double d, SnowBondState& state) {
  SnowContact apart = {};
  apart.d = d;
  SnowBondEnergy energy;
  hold(law, apart, state, &energy);
  state = {};
  return energy.stored;
}

}  // namespace furrow
