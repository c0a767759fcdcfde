// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The brick of nearly incompressible rubber, several elements at once. Included by kernel units
/// only (simd/lanes.h explains why).
///
/// Mean dilatation (J. C. Nagtegaal, D. M. Parks, J. R. Rice, Comput. Methods Appl. Mech. Eng. 4,
/// 153; J. C. Simo, R. L. Taylor, K. S. Pister, ibid. 51, 177) of the neo-Hookean law (theory:
/// tyres, eq. 6). The shape is resisted at each Gauss point and the volume as a whole, so the
/// element does not lock. Only rigid motions have no energy, so there are no hourglass modes. An
/// element that turned inside out would pass J_q = 0, where W is infinite.
///
/// Forces are the exact gradient -dW/dx, so momentum, moment of momentum and energy are kept.

#include "furrow/simd/exponential.h"
#include "furrow/simd/inverse_cube_root.h"
#include "furrow/simd/triple.h"
#include "furrow/solid/brick8_block.h"

namespace furrow {
inline namespace FURROW_ISA {

/// Rows of a deformation gradient, of its cofactors, or of a stress.
struct Rows {
  Triple x, y, z;
};

FURROW_INLINE Rows cofactors(const Rows& F) {
  return {cross(F.y, F.z), cross(F.z, F.x), cross(F.x, F.y)};
}
FURROW_INLINE Lanes squared_norm(const Rows& a) {
  return dot(a.x, a.x) + dot(a.y, a.y) + dot(a.z, a.z);
}
FURROW_INLINE Lanes dot(const Triple& a, const double (&g)[3]) {
  return a.x * Lanes(g[0]) + a.y * Lanes(g[1]) + a.z * Lanes(g[2]);
}
FURROW_INLINE Triple product(const Rows& a, const double (&g)[3]) {
  return {dot(a.x, g), dot(a.y, g), dot(a.z, g)};
}
FURROW_INLINE Rows combination(const Lanes& s, const Rows& a, const Lanes& t, const Rows& b) {
  return {s * a.x + t * b.x, s * a.y + t * b.y, s * a.z + t * b.z};
}

/// F = sum over the nodes of x_n (x) gradient_n
FURROW_INLINE Rows deformation_gradient(const Triple (&node)[8], const double (&gradient)[8][3]) {
  const Lanes zero = 0.0;
  Rows F = {{zero, zero, zero}, {zero, zero, zero}, {zero, zero, zero}};
  for (int n = 0; n < 8; ++n) {
    const Triple g = {Lanes(gradient[n][0]), Lanes(gradient[n][1]), Lanes(gradient[n][2])};
    F.x = F.x + node[n].x * g;
    F.y = F.y + node[n].y * g;
    F.z = F.z + node[n].z * g;
  }
  return F;
}

/// Square of an element's highest frequency over the stress-free one. The volume contributes its
/// stiffness K(J) dV/dx (x) dV/dx, of rank one. The contribution of the shape is estimated to grow
/// with the distortion (|F|^2 |F^-1|^2/9)^(3/2), which is 1 without distortion.
FURROW_INLINE Lanes rate_now(const Triple (&node)[8], const Brick8Kind& kind, const Lanes& J,
                             const Lanes& distortion) {
  const Rows cofactor = cofactors(deformation_gradient(node, kind.mean_gradient));
  Lanes now = 0.0;
  double stress_free = 0.0;
  for (int n = 0; n < 8; ++n) {
    const double(&g)[3] = kind.mean_gradient[n];
    const Triple b = product(cofactor, g);
    now += dot(b, b) * Lanes(kind.inverse_mass[n]);
    stress_free += (g[0] * g[0] + g[1] * g[1] + g[2] * g[2]) * kind.inverse_mass[n];
  }
  const double unit = kind.bulk * kind.volume;
  const Lanes volumetric = Lanes(0.5 * unit) * (Lanes(1.0) + Lanes(1.0) / (J * J)) * now;
  const Lanes deviatoric = Lanes(kind.deviatoric_rate) * distortion * sqrt(distortion);
  return Lanes(kind.highest_rate / (unit * stress_free + kind.deviatoric_rate)) *
         (volumetric + deviatoric);
}

/// Energy and its gradient for the elements of one block.
struct BrickBlock {
  Triple force[8];  // dW/dx [N]
  Lanes energy;     // [J]
  Lanes minimum_ratio = 1e30;
  Lanes rate;

  FURROW_INLINE BrickBlock(const Triple (&node)[8], const Brick8Kind& kind) {
    Rows F[8], cofactor[8];
    Lanes ratio[8];
    Lanes volume = 0.0;
    Lanes distortion = 1.0;
    for (int q = 0; q < 8; ++q) {
      F[q] = deformation_gradient(node, kind.gradient[q]);
      cofactor[q] = cofactors(F[q]);
      ratio[q] = dot(F[q].x, cofactor[q].x);
      minimum_ratio = min(minimum_ratio, ratio[q]);
      volume += Lanes(kind.weight[q]) * ratio[q];
    }
    const Lanes J = volume * Lanes(1.0 / kind.volume);
    const Lanes p = Lanes(0.5 * kind.bulk) * (J - Lanes(1.0) / J);
    const Lanes log_J = logarithm(J);
    energy = Lanes(0.25 * kind.bulk * kind.volume) * (J * J - Lanes(1.0) - Lanes(2.0) * log_J);
    const Lanes zero = 0.0;
    for (int n = 0; n < 8; ++n) force[n] = {zero, zero, zero};
    for (int q = 0; q < 8; ++q) {
      const Lanes weight = kind.weight[q];
      const Lanes z = inverse_cube_root(ratio[q]);
      const Lanes mu = Lanes(kind.shear) * z * z;
      const Lanes trace = squared_norm(F[q]);  // of C
      const Lanes inverse = Lanes(1.0) / ratio[q];
      energy += Lanes(0.5) * weight * (mu * trace - Lanes(3.0 * kind.shear));
      distortion =
          max(distortion, trace * squared_norm(cofactor[q]) * inverse * inverse * Lanes(1.0 / 9.0));
      const Rows P = combination(
          weight * mu, F[q], weight * (p - mu * trace * inverse * Lanes(1.0 / 3.0)), cofactor[q]);
      for (int n = 0; n < 8; ++n) force[n] = force[n] + product(P, kind.gradient[q][n]);
    }
    rate = rate_now(node, kind, J, distortion);
  }
};

/// Adds -dW/dx to the nodes of the active elements and records extremes.
FURROW_INLINE void hand_over(const BrickBlock& block, const Brick8Places& places, std::size_t first,
                             double* force, Brick8Result& result) {
  for (int lane = 0; lane < lane_count; ++lane) {
    const std::size_t place = first + static_cast<std::size_t>(lane);
    if (!places.active[place]) continue;
    for (int n = 0; n < 8; ++n) {
      double* at = force + 3 * places.node[n][place];
      at[0] -= block.force[n].x[lane];
      at[1] -= block.force[n].y[lane];
      at[2] -= block.force[n].z[lane];
    }
    result.energy += block.energy[lane];
    // NaN is kept
    if (result.minimum_ratio == result.minimum_ratio &&
        !(block.minimum_ratio[lane] >= result.minimum_ratio)) {
      result.minimum_ratio = block.minimum_ratio[lane];
      result.most_squeezed = place;
    }
    if (block.rate[lane] > result.highest_rate) result.highest_rate = block.rate[lane];
  }
}

/// Brick8Kernels::forces.
inline Brick8Result brick8_forces(const Brick8Kind* kinds, std::size_t kind_count,
                                  const Brick8Places& places, const double* x, double* force) {
  Brick8Result result;
  for (std::size_t k = 0; k < kind_count; ++k) {
    const Brick8Kind& kind = kinds[k];
    for (std::size_t i = kind.first; i < kind.end; i += lane_count) {
      Triple node[8];
      for (int n = 0; n < 8; ++n) {
        const int* index = places.node[n] + i;
        node[n] = {gather(x, index, 3, 0), gather(x, index, 3, 1), gather(x, index, 3, 2)};
      }
      const Triple origin = node[0];  // far from it, the sums over nodes would lose digits
      for (int n = 0; n < 8; ++n) node[n] = node[n] - origin;
      hand_over(BrickBlock(node, kind), places, i, force, result);
    }
  }
  result.finite = result.energy - result.energy == 0.0;
  return result;
}

constexpr void fill(Brick8Kernels& kernels) { kernels.forces = brick8_forces; }

}  // namespace FURROW_ISA
}  // namespace furrow
