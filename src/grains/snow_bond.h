// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Contact of two clusters of sintered snow that crush in place.
///
/// A cluster is a lump of snow as light as the snow around it allows (its packing is dense and
/// random), so snow is compacted by crushing contacts, not by rearranging clusters. Of a contact:
/// d = Ri + Rj, overlap u, unit normal n from j to i; stiffness k = E d along and across n.
///
///   state      u_p plastic overlap; X = (u_p - u_0)/d crushing, u_0 its value when sintered;
///              A area of the bond, A0 = pi (0.2 d)^2 that of a sintered one; shear force; moments
///   crush      Fy = d^2 (Y0 exp(p X) + Y1 (exp(q X) - 1))
///   bond       Fb = min(Fy, d^2 Y0 exp(pc X)) min(1, A/A0)
///   trial      Fn = k (u - u_p), Ft and moments grow by stiffness times relative motion
///   shear      |Ft| <= C + mu max(Fn, 0), C = chi Fb
///   crushing   Fn <= Fy
///   tension    Fn < -zeta Fb breaks the bond; without one there is no tension
///   bending    stiffness k a_s^2/4, |M| <= 4/(3 pi) a (zeta Fb + max(Fn, 0))
///   torsion    stiffness k a_s^2/2, |M| <= 2/3 a (chi Fb + mu max(Fn, 0))
///              a = max(sqrt(A/pi), 0.07 d), a_s = max(a, 0.2 d); limits of a fully plastic disc
///   sintering  A grows to w pi (d/4) (u_p - u_b) where clusters are pressed into one another; u_b
///              is u_p when the last bond broke
///
/// Where the trial is beyond the crush surface, Fn and Ft shrink in one ratio: force follows
/// displacement, which keeps lateral stress low (uniform strain, kt/kn = s: K0 = (1 - s)/(3 + 2
/// s)). Beyond the shear surface Ft shrinks by a share r and Fn by r C/(C + mu Fn): a bond yields
/// along the force, a dry contact slides at constant normal force. Both are implicit: the force
/// lies on the surface of the state after the step. Plastic displacement has the direction of the
/// force taken away, so plastic work is never negative.
///
/// Dampers act on the change of the elastic force, Fd = c/k dF/dt, c = 2 damping sqrt(m k) along
/// and half of that across the normal: in elastic motion that is -c v, and steady crushing and
/// sliding are independent of the rate.
///
/// Forces, moments and history are exactly opposite when i and j swap. Shear force and bending
/// moment are carried with the contact: turned with the normal, and about it by the mean spin.
///
/// Bonds with bending and torsion [Potyondy2004]; pressure sintering [Luding2008]; new bonds that
/// carry the hardening of compressed snow [Kry1975]. The law as a whole, and its values, are
/// Furrow's own.

#include <algorithm>
#include <cmath>

#include "core/types.h"
#include "grains/snow_bond_parameters.h"

namespace furrow {

/// How two clusters lie and move in a step of leapfrog: positions of its end, velocities of its
/// middle. A plane wall is half of a contact of two like clusters: twice its overlap and relative
/// velocities, d = 2 R, half of the mass; energies are then twice those of the wall.
struct SnowContact {
  double d;                     ///< [m] sum of the radii
  double mass;                  ///< [kg] effective
  double overlap;               ///< [m] > 0
  Vector3 normal;               ///< from j to i
  double normal_velocity;       ///< [m/s] of i against j along the normal: > 0 where they part
  Vector3 tangential_velocity;  ///< [m/s] of i against j where they touch, across the normal
  Vector3 rotation;             ///< [rad/s] angular velocity of i less that of j
  double spin;                  ///< [rad/s] mean angular velocity about the normal
  double dt;                    ///< [s]
  bool sinters = true;          ///< false: what it touches is not snow
};

/// What a contact remembers; all zero before the first touch.
struct SnowBondState {
  static constexpr int size = 12;  ///< values of load() and store()

  double plastic = 0.0;       ///< u_p [m]
  double at_sintering = 0.0;  ///< u_0 [m]
  double at_break = 0.0;      ///< u_b [m]
  double area = 0.0;          ///< A [m^2]
  bool bonded = false;
  Vector3 shear = Vector3::Zero();    ///< [N] elastic force on i across the normal
  Vector3 bending = Vector3::Zero();  ///< [N m] elastic moment on i across the normal
  double torsion = 0.0;               ///< [N m] along the normal

  static SnowBondState load(const double* values);
  void store(double* values) const;
};

/// What a step of a contact does with energy [J].
struct SnowBondEnergy {
  double stored = 0.0;    ///< in the springs after the step
  double crushed = 0.0;   ///< plastic work: crushing, slip, yielding of bonds
  double damped = 0.0;    ///< taken by dampers
  double released = 0.0;  ///< lost with springs that were let go: bonds that broke or were sintered
};

struct SnowBondResponse {
  Vector3 force = Vector3::Zero();  ///< [N] on i; j has the opposite
  /// [N m] on i beside that of the force; j has the opposite
  Vector3 moment = Vector3::Zero();
  SnowBondEnergy energy;
  bool broken = false;  ///< in this step
  bool made = false;    ///< in this step
};

/// Crush strength and strength of a whole bond, with their growth.
struct SnowStrength {
  double Fy, dFy;  ///< [N], [N/m] by u_p
  double Fb, dFb;  ///< likewise, for A >= A0
};

class SnowBond {
 public:
  static constexpr double bond_radius = 0.2;    ///< of a sintered bond, of d
  static constexpr double least_radius = 0.07;  ///< that resists rolling, of d
  static constexpr double bending_limit = 4.0 / (3.0 * pi);
  static constexpr double torsion_limit = 2.0 / 3.0;

  static double sintered_area(double d) { return pi * bond_radius * bond_radius * d * d; }
  static double stiffness(const SnowBondParameters& law, double d) { return law.E * d; }

  /// Strengths at the crushing X.
  static SnowStrength strength(const SnowBondParameters& law, double d, double X);
  /// The part of Fb that the area gives.
  static double bonded_share(const SnowBondState& state, double d) {
    return state.bonded ? std::min(1.0, state.area / sintered_area(d)) : 0.0;
  }

  /// One step.
  static SnowBondResponse advance(const SnowBondParameters& law, const SnowContact& contact,
                                  SnowBondState& state);
  /// Forces of a state as it is, without dampers.
  static SnowBondResponse hold(const SnowBondParameters& law, const SnowContact& contact,
                               const SnowBondState& state);
  /// A whole bond without stress; where there can be none, a touch without stress.
  static SnowBondResponse sinter(const SnowBondParameters& law, const SnowContact& contact,
                                 SnowBondState& state);
  /// The clusters have parted: the state begins anew. @return its energy, which is lost [J]
  static double part(const SnowBondParameters& law, double d, SnowBondState& state);

 private:
  struct Stiffness {
    double bending, torsion;  // [N m/rad]
  };
  static Stiffness of_rotation(double k, double d, double area);
  static double stored(double k, double d, double normal, const SnowBondState& state);
  static void carry(Vector3& vector, const Vector3& normal, double turn);
  static double scale_to(double limit, double size) { return size > limit ? limit / size : 1.0; }
  template <class Excess>
  static double solve(double start, Excess&& excess);
};

inline SnowBondState SnowBondState::load(const double* values) {
  SnowBondState state;
  state.plastic = values[0];
  state.at_sintering = values[1];
  state.at_break = values[2];
  state.area = values[3];
  state.bonded = values[4] != 0.0;
  state.shear = Eigen::Map<const Vector3>(values + 5);
  state.bending = Eigen::Map<const Vector3>(values + 8);
  state.torsion = values[11];
  return state;
}

inline void SnowBondState::store(double* values) const {
  values[0] = plastic;
  values[1] = at_sintering;
  values[2] = at_break;
  values[3] = area;
  values[4] = bonded ? 1.0 : 0.0;
  Eigen::Map<Vector3>(values + 5) = shear;
  Eigen::Map<Vector3>(values + 8) = bending;
  values[11] = torsion;
}

inline SnowStrength SnowBond::strength(const SnowBondParameters& law, double d, double X) {
  const double soft = law.Y0 * std::exp(law.p * X), dense = law.Y1 * std::exp(law.q * X),
               bond = law.Y0 * std::exp(law.pc * X);
  SnowStrength found;
  found.Fy = d * d * (soft + dense - law.Y1);
  found.dFy = d * (law.p * soft + law.q * dense);
  const double Fb = d * d * bond;
  const bool capped = Fb > found.Fy;
  found.Fb = capped ? found.Fy : Fb;
  found.dFb = capped ? found.dFy : d * law.pc * bond;
  return found;
}

inline SnowBond::Stiffness SnowBond::of_rotation(double k, double d, double area) {
  const double squared_radius = std::max(area / pi, bond_radius * bond_radius * d * d);
  return {0.25 * k * squared_radius, 0.5 * k * squared_radius};
}

inline double SnowBond::stored(double k, double d, double normal, const SnowBondState& state) {
  const Stiffness rotation = of_rotation(k, d, state.area);
  return 0.5 * ((normal * normal + state.shear.squaredNorm()) / k +
                state.bending.squaredNorm() / rotation.bending +
                state.torsion * state.torsion / rotation.torsion);
}

/// Turned about the normal, and then into the plane across it, at constant length.
inline void SnowBond::carry(Vector3& vector, const Vector3& normal, double turn) {
  const double before = vector.squaredNorm();
  if (before == 0.0) return;
  vector += turn * normal.cross(vector);
  vector -= normal.dot(vector) * normal;
  const double after = vector.squaredNorm();
  vector *= after > 0.0 ? std::sqrt(before / after) : 0.0;
}

/// Newton's method for the root of a growing concave function, from where it is not positive: no
/// iterate passes the root. @param excess of x gives the function and its slope
template <class Excess>
inline double SnowBond::solve(double start, Excess&& excess) {
  constexpr int most_iterations = 60;
  constexpr double tolerance = 1e-14;  // of x
  double x = start;
  for (int n = 0; n < most_iterations; ++n) {
    const auto [value, slope] = excess(x);
    const double change = -value / slope;
    x += change;
    if (!(std::abs(change) > tolerance * x)) break;
  }
  return x;
}

inline SnowBondResponse SnowBond::advance(const SnowBondParameters& law, const SnowContact& contact,
                                          SnowBondState& state) {
  SnowBondResponse response;
  SnowBondEnergy& energy = response.energy;
  const double d = contact.d, k = stiffness(law, d), dt = contact.dt;
  const Vector3& n = contact.normal;

  // Elastic force and moment before the step, on today's axes.
  const double turn = contact.spin * dt;
  carry(state.shear, n, turn);
  carry(state.bending, n, turn);
  const double overlap_before = contact.overlap + contact.normal_velocity * dt;
  const Vector3 shear_before = state.shear, bending_before = state.bending;
  const double torsion_before = state.torsion;

  // Trial: all motion is elastic.
  const Stiffness rotation = of_rotation(k, d, state.area);
  const double trial_normal = k * (contact.overlap - state.plastic);
  const Vector3 trial_shear = state.shear - k * dt * contact.tangential_velocity;
  const double twist = contact.rotation.dot(n);
  const Vector3 trial_bending =
      state.bending - rotation.bending * dt * (contact.rotation - twist * n);
  const double trial_torsion = state.torsion - rotation.torsion * dt * twist;

  double X = (state.plastic - state.at_sintering) / d;
  SnowStrength strong = strength(law, d, X);
  const double share = bonded_share(state, d);
  // not beyond the surface, where a change of parameters between runs may have left it
  const double normal_before =
      std::clamp(k * (overlap_before - state.plastic), -law.zeta * share * strong.Fb, strong.Fy);
  const double shear_size = trial_shear.norm();
  double normal = trial_normal, shear_left = 1.0;  // of the trial's

  if (trial_normal <= 0.0) {
    if (!state.bonded || -trial_normal > law.zeta * share * strong.Fb) {
      energy.released = stored(k, d, state.bonded ? normal_before : 0.0, state);
      response.broken = state.bonded;
      if (state.bonded) state.at_break = state.plastic;
      state.bonded = false;
      state.area = state.torsion = 0.0;
      state.shear.setZero();
      state.bending.setZero();
      return response;
    }
    shear_left = scale_to(law.chi * share * strong.Fb, shear_size);
  } else {
    const auto crushing = [&](double force) {
      return (state.plastic + (trial_normal - force) / k - state.at_sintering) / d;
    };
    const double cohesion = law.chi * share * strong.Fb;
    if (shear_size > cohesion + law.mu * trial_normal) {
      // share of the plastic displacement along the force
      const double along = cohesion > 0.0 ? cohesion / (cohesion + law.mu * trial_normal) : 0.0;
      const auto normal_at = [&](double left) {
        return trial_normal * (1.0 - along * (1.0 - left));
      };
      const double slope = shear_size - law.mu * along * trial_normal;
      if (along > 0.0) {
        shear_left = solve(
            std::max(0.0, (cohesion + law.mu * (1.0 - along) * trial_normal) / slope),
            [&](double left) {
              const double force = normal_at(left);
              strong = strength(law, d, crushing(force));
              const double growth = law.chi * share * strong.dFb * along * trial_normal / k;
              return std::pair(left * shear_size - law.mu * force - law.chi * share * strong.Fb,
                               slope + growth);
            });
        shear_left = std::min(1.0, shear_left);
      } else {
        shear_left = law.mu * trial_normal / shear_size;
      }
      normal = normal_at(shear_left);
    }
    if (normal > strong.Fy) {
      const double limit = solve(strong.Fy, [&](double force) {
        strong = strength(law, d, crushing(force));
        return std::pair(force - strong.Fy, 1.0 + strong.dFy / k);
      });
      shear_left *= limit / normal;
      normal = limit;
    }
    state.plastic += (trial_normal - normal) / k;
  }
  state.shear = shear_left * trial_shear;
  energy.crushed = (normal * (trial_normal - normal) +
                    shear_left * (1.0 - shear_left) * shear_size * shear_size) /
                   k;

  // Sintering under pressure.
  if (contact.sinters) {
    const double area = law.w * 0.25 * pi * d * (state.plastic - state.at_break);
    if (area > state.area) {
      state.area = area;
      response.made = !state.bonded;
      state.bonded = true;
    }
  }

  // Moments, against the strength of the bond as it is now.
  const double pressing = std::max(0.0, normal);
  const double Fb = bonded_share(state, d) * strong.Fb;
  const double radius = std::max(std::sqrt(state.area / pi), least_radius * d);
  const double bending_left =
      scale_to(bending_limit * radius * (law.zeta * Fb + pressing), trial_bending.norm());
  const double torsion_left = scale_to(torsion_limit * radius * (law.chi * Fb + law.mu * pressing),
                                       std::abs(trial_torsion));
  state.bending = bending_left * trial_bending;
  state.torsion = torsion_left * trial_torsion;
  const double bending_energy = state.bending.squaredNorm() / rotation.bending,
               torsion_energy = state.torsion * state.torsion / rotation.torsion;
  if (bending_left < 1.0 && bending_left > 0.0)
    energy.crushed += bending_energy * (1.0 / bending_left - 1.0);
  if (torsion_left < 1.0 && torsion_left > 0.0)
    energy.crushed += torsion_energy * (1.0 / torsion_left - 1.0);
  // A bond that has grown holds the same moment with less energy.
  const Stiffness grown = of_rotation(k, d, state.area);
  energy.crushed +=
      0.5 * (bending_energy + torsion_energy) * (1.0 - rotation.bending / grown.bending);
  energy.stored = stored(k, d, normal, state);

  // Dampers; those of a dry contact neither pull nor overcome friction.
  const double relaxation = 2.0 * law.damping * std::sqrt(contact.mass / k) / dt;
  double normal_damping = relaxation * (normal - normal_before);
  Vector3 shear_damping = 0.5 * relaxation * (state.shear - shear_before);
  if (!state.bonded) {
    normal_damping = std::max(normal_damping, -normal);
    const Vector3 all = state.shear + shear_damping;
    shear_damping = scale_to(law.mu * (normal + normal_damping), all.norm()) * all - state.shear;
  }
  const Vector3 moment_damping =
      0.5 * relaxation * (state.bending - bending_before + (state.torsion - torsion_before) * n);
  energy.damped =
      -dt * (normal_damping * contact.normal_velocity +
             shear_damping.dot(contact.tangential_velocity) + moment_damping.dot(contact.rotation));
  response.force = (normal + normal_damping) * n + state.shear + shear_damping;
  response.moment = state.bending + state.torsion * n + moment_damping;
  return response;
}

inline SnowBondResponse SnowBond::hold(const SnowBondParameters& law, const SnowContact& contact,
                                       const SnowBondState& state) {
  const double k = stiffness(law, contact.d);
  double normal = k * (contact.overlap - state.plastic);
  if (!state.bonded) normal = std::max(0.0, normal);
  SnowBondResponse response;
  response.force = normal * contact.normal + state.shear;
  response.moment = state.bending + state.torsion * contact.normal;
  response.energy.stored = stored(k, contact.d, normal, state);
  return response;
}

inline SnowBondResponse SnowBond::sinter(const SnowBondParameters& law, const SnowContact& contact,
                                         SnowBondState& state) {
  SnowBondResponse response;
  response.energy.released = hold(law, contact, state).energy.stored;
  response.made = contact.sinters && !state.bonded;
  state = {};
  state.plastic = state.at_sintering = state.at_break = contact.overlap;
  state.area = contact.sinters ? sintered_area(contact.d) : 0.0;
  state.bonded = contact.sinters;
  return response;
}

inline double SnowBond::part(const SnowBondParameters& law, double d, SnowBondState& state) {
  const double k = stiffness(law, d);
  const double lost = stored(k, d, state.bonded ? -k * state.plastic : 0.0, state);
  state = {};
  return lost;
}

}  // namespace furrow
