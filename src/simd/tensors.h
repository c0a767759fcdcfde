// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Tensors of several points at once.

#include "furrow/simd/lanes.h"

namespace furrow {
inline namespace FURROW_ISA {

/// Symmetric 3x3 tensor.
struct Symmetric {
  Lanes xx, yy, zz, xy, yz, xz;

  FURROW_INLINE Lanes trace() const { return xx + yy + zz; }
  FURROW_INLINE Symmetric operator*(const Lanes& f) const {
    return {xx * f, yy * f, zz * f, xy * f, yz * f, xz * f};
  }
  FURROW_INLINE Symmetric operator+(const Symmetric& b) const {
    return {xx + b.xx, yy + b.yy, zz + b.zz, xy + b.xy, yz + b.yz, xz + b.xz};
  }
  FURROW_INLINE Symmetric operator-(const Symmetric& b) const {
    return {xx - b.xx, yy - b.yy, zz - b.zz, xy - b.xy, yz - b.yz, xz - b.xz};
  }
  FURROW_INLINE Symmetric plus_identity(const Lanes& f) const {
    return {xx + f, yy + f, zz + f, xy, yz, xz};
  }
  FURROW_INLINE Symmetric deviator() const { return plus_identity(trace() * Lanes(-1.0 / 3.0)); }
};

FURROW_INLINE Lanes contract(const Symmetric& a, const Symmetric& b) {  // a : b
  return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz +
         Lanes(2.0) * (a.xy * b.xy + a.yz * b.yz + a.xz * b.xz);
}

/// a b for tensors that commute, so that the product is symmetric.
FURROW_INLINE Symmetric commuting_product(const Symmetric& a, const Symmetric& b) {
  return {a.xx * b.xx + a.xy * b.xy + a.xz * b.xz, a.xy * b.xy + a.yy * b.yy + a.yz * b.yz,
          a.xz * b.xz + a.yz * b.yz + a.zz * b.zz, a.xx * b.xy + a.xy * b.yy + a.xz * b.yz,
          a.xy * b.xz + a.yy * b.yz + a.yz * b.zz, a.xx * b.xz + a.xy * b.yz + a.xz * b.zz};
}

FURROW_INLINE Lanes determinant(const Symmetric& a) {
  return a.xx * (a.yy * a.zz - a.yz * a.yz) - a.xy * (a.xy * a.zz - a.yz * a.xz) +
         a.xz * (a.xy * a.yz - a.yy * a.xz);
}

FURROW_INLINE Symmetric inverse(const Symmetric& a) {
  const Lanes cxx = a.yy * a.zz - a.yz * a.yz, cxy = a.yz * a.xz - a.xy * a.zz,
              cxz = a.xy * a.yz - a.yy * a.xz;
  const Lanes f = Lanes(1.0) / (a.xx * cxx + a.xy * cxy + a.xz * cxz);
  return {cxx * f, (a.xx * a.zz - a.xz * a.xz) * f, (a.xx * a.yy - a.xy * a.xy) * f,
          cxy * f, (a.xy * a.xz - a.xx * a.yz) * f, cxz * f};
}

/// General 3x3 tensor, row by row.
struct Tensor {
  Lanes m[9];
};

/// r a r^T
FURROW_INLINE Symmetric rotated(const Symmetric& a, const Tensor& r) {
  const Lanes* m = r.m;
  Lanes b[9];  // r a
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    b[3 * i] = m[3 * i] * a.xx + m[3 * i + 1] * a.xy + m[3 * i + 2] * a.xz;
    b[3 * i + 1] = m[3 * i] * a.xy + m[3 * i + 1] * a.yy + m[3 * i + 2] * a.yz;
    b[3 * i + 2] = m[3 * i] * a.xz + m[3 * i + 1] * a.yz + m[3 * i + 2] * a.zz;
  }
  const auto entry = [&](int i, int j) {
    return b[3 * i] * m[3 * j] + b[3 * i + 1] * m[3 * j + 1] + b[3 * i + 2] * m[3 * j + 2];
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(0, 2)};
}

}  // namespace FURROW_ISA
}  // namespace furrow
