// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Finite strain, once for every law: from the displacement gradient H of a step to the logarithm
/// of its stretch and its rotation.
///
/// The step splits into a stretch U and a rotation R. Both follow from X = C - I. Computed from H
/// as here, X keeps its digits where H is small:
///
///   Delta F = I + H = R U,   C = U^2 = I + X,   X = H + H^T + H^T H,   R = Delta F U^-1
///
/// ln U and U^-1 are functions of C. The size of X, its Frobenius norm, decides how they are found:
///
///   - Up to 1e-4 by four terms of a series in X. It needs no division.
///   - Up to 0.004 by three terms of a series in Z. Most steps of an explicit computation end here.
///   - Up to 0.1 by seven terms of the series in Z. This is a strain of 5 % in one step.
///   - Above by the eigenvalues of C, point by point.
///
/// In its range the relative error of each series is below 1e-16. The series in X:
///
///   ln U = X/2 - X^2/4 + X^3/6 - X^4/8
///   U^-1 = I - X/2 + 3 X^2/8 - 5 X^3/16
///
/// The series in Z = X (2I + X)^-1, with Y = Z^2. It is that of atanh, as C = (I + Z)(I - Z)^-1:
///
///   ln U = Z (I + Y/3 + Y^2/5 + ...)
///   U^-1 = (I - Z)(I + Y/2 + 3 Y^2/8 + ...)

#include "furrow/material/large_stretch.h"
#include "furrow/simd/tensors.h"

namespace furrow {

inline namespace FURROW_ISA {

/// det(I + H)
FURROW_INLINE Lanes volume_change(const Tensor& h) {
  Lanes f[9];
#pragma GCC unroll 9
  for (int k = 0; k < 9; ++k) f[k] = k % 4 == 0 ? h.m[k] + Lanes(1.0) : h.m[k];
  return f[0] * (f[4] * f[8] - f[5] * f[7]) - f[1] * (f[3] * f[8] - f[5] * f[6]) +
         f[2] * (f[3] * f[7] - f[4] * f[6]);
}

struct Motion {
  Symmetric strain;  ///< ln U, in the frame of the start of the step
  Tensor rotation;   ///< R
  Lanes volume;      ///< det Delta F
  Mask admissible;   ///< Delta F finite with positive determinant
};

/// ln U and U^-1 by the series in Z. @param size  X : X
FURROW_INLINE void find_stretch(const Symmetric& x, const Lanes& size, Symmetric& log_u,
                                Symmetric& inverse_u) {
  const Symmetric z = commuting_product(x, inverse(x.plus_identity(2.0)));
  const Symmetric y = commuting_product(z, z), y2 = commuting_product(y, y);
  constexpr double atanh_terms[7] = {1.0, 1.0 / 3, 1.0 / 5, 1.0 / 7, 1.0 / 9, 1.0 / 11, 1.0 / 13};
  constexpr double root_terms[7] = {1.0,        1.0 / 2,    3.0 / 8,     5.0 / 16,
                                    35.0 / 128, 63.0 / 256, 231.0 / 1024};

  const auto low = [&](const double* c) __attribute__((always_inline)) {  // c0 I + c1 Y + c2 Y^2
    return (y * Lanes(c[1]) + y2 * Lanes(c[2])).plus_identity(c[0]);
  };
  Symmetric log_u_over_z = low(atanh_terms), root = low(root_terms);
  if (any(!(size <= Lanes(1.6e-5)))) {
    const Symmetric y3 = commuting_product(y2, y);
    // c3 Y^3 + ... + c6 Y^6
    const auto rest = [&](const double* c) __attribute__((always_inline)) {
      const Symmetric high = y * Lanes(c[4]) + y2 * Lanes(c[5]) + y3 * Lanes(c[6]);
      return commuting_product(y3, high.plus_identity(c[3]));
    };
    log_u_over_z = log_u_over_z + rest(atanh_terms);
    root = root + rest(root_terms);
  }
  log_u = commuting_product(z, log_u_over_z);
  inverse_u = commuting_product((z * Lanes(-1.0)).plus_identity(1.0), root);
}

/// Sets ln U and U^-1 by the series in X.
FURROW_INLINE void find_small_stretch(const Symmetric& x, Symmetric& log_u, Symmetric& inverse_u) {
  const Symmetric x2 = commuting_product(x, x);
  const Symmetric log_rest = x * Lanes(1.0 / 6) - x2 * Lanes(1.0 / 8),
                  root_rest = x * Lanes(-5.0 / 16);
  log_u = x * Lanes(0.5) + commuting_product(x2, log_rest.plus_identity(-0.25));
  inverse_u =
      (commuting_product(x2, root_rest.plus_identity(3.0 / 8)) - x * Lanes(0.5)).plus_identity(1.0);
}

/// ln U and U^-1 by the eigenvalues of C. A separate function, because reads of single lanes would
/// keep the caller's numbers in memory.
struct LargeStretch {
  Symmetric x, log_u, inverse_u;

  /// Replaces the lanes of the mask. @return where the stretch exists
  [[gnu::noinline, gnu::cold]] Mask find(Mask large) {
    Mask admissible(true);
    for (int lane = 0; lane < lane_count; ++lane) {
      if (!large[lane]) continue;
      const double entries[6] = {x.xx[lane], x.yy[lane], x.zz[lane],
                                 x.xy[lane], x.yz[lane], x.xz[lane]};
      double log[6] = {}, inv[6] = {};
      if (!large_stretch(entries, log, inv)) admissible[lane] = false;
      Lanes* strain[6] = {&log_u.xx, &log_u.yy, &log_u.zz, &log_u.xy, &log_u.yz, &log_u.xz};
      Lanes* u[6] = {&inverse_u.xx, &inverse_u.yy, &inverse_u.zz,
                     &inverse_u.xy, &inverse_u.yz, &inverse_u.xz};
      for (int k = 0; k < 6; ++k) {
        (*strain[k])[lane] = log[k];
        (*u[k])[lane] = inv[k];
      }
    }
    return admissible;
  }
};

FURROW_INLINE void find_motion(const Tensor& h, Motion& motion) {
  const Lanes* m = h.m;
  const auto column = [&](int i, int j) __attribute__((always_inline)) {
    return m[i] * m[j] + m[3 + i] * m[3 + j] + m[6 + i] * m[6 + j];
  };
  const Symmetric x{m[0] + m[0] + column(0, 0), m[4] + m[4] + column(1, 1),
                    m[8] + m[8] + column(2, 2), m[1] + m[3] + column(0, 1),
                    m[5] + m[7] + column(1, 2), m[2] + m[6] + column(0, 2)};
  const Lanes size = contract(x, x);
  Symmetric inverse_u;
  if (all(size <= Lanes(1e-8)))
    find_small_stretch(x, motion.strain, inverse_u);
  else
    find_stretch(x, size, motion.strain, inverse_u);
  motion.admissible = Mask(true);

  const Mask large = !(size <= Lanes(0.01));  // true also for NaN
  if (any(large)) {
    LargeStretch stretch{x, motion.strain, inverse_u};
    motion.admissible = stretch.find(large);
    motion.strain = stretch.log_u;
    inverse_u = stretch.inverse_u;
  }
  Lanes f[9], *r = motion.rotation.m;
#pragma GCC unroll 9
  for (int k = 0; k < 9; ++k) f[k] = k % 4 == 0 ? m[k] + Lanes(1.0) : m[k];
#pragma GCC unroll 3
  for (int i = 0; i < 9; i += 3) {
    r[i] = f[i] * inverse_u.xx + f[i + 1] * inverse_u.xy + f[i + 2] * inverse_u.xz;
    r[i + 1] = f[i] * inverse_u.xy + f[i + 1] * inverse_u.yy + f[i + 2] * inverse_u.yz;
    r[i + 2] = f[i] * inverse_u.xz + f[i + 1] * inverse_u.yz + f[i + 2] * inverse_u.zz;
  }
  motion.volume = volume_change(h);
  motion.admissible = motion.admissible && motion.volume > Lanes(0.0);
}

}  // namespace FURROW_ISA
}  // namespace furrow
