// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Numbers for several points at once: one Lanes holds a value of each of lane_count neighbouring
/// points.
///
/// All code of a kernel is in the inline namespace FURROW_ISA. Each instruction set of the kernel
/// units (simd/kernel_unit.cpp.in) has a separate one, so that the linker never mixes code of two
/// instruction sets. Only kernel units include headers of kernels, and these use no other header
/// with code (no <vector>, no <string>, no Eigen). Otherwise an inline function compiled for
/// AVX-512 could become the copy that the linker keeps for all callers.

#include <experimental/simd>

#include "simd/kernel_units_only.h"

#if defined(__clang__) && defined(__AVX512F__) && defined(__GLIBCXX__)
#error \
    "clang and libstdc++'s simd choose wrongly among lanes of AVX-512: build with gcc, or for AVX2"
#endif

/// Lanes stay in registers only if a call is inlined, which gcc 12 does too rarely without the
/// attribute.
#define FURROW_INLINE [[gnu::always_inline]] inline

namespace furrow {
inline namespace FURROW_ISA {

namespace stdx = std::experimental;
using Lanes = stdx::native_simd<double>;
using Mask = Lanes::mask_type;
constexpr int lane_count = static_cast<int>(Lanes::size());

FURROW_INLINE Lanes select(const Mask& mask, const Lanes& yes, const Lanes& no) {
  Lanes result = no;
  stdx::where(mask, result) = yes;
  return result;
}
FURROW_INLINE bool any(const Mask& mask) { return stdx::any_of(mask); }
FURROW_INLINE bool all(const Mask& mask) { return stdx::all_of(mask); }
FURROW_INLINE Lanes min(const Lanes& a, const Lanes& b) { return stdx::min(a, b); }
FURROW_INLINE Lanes max(const Lanes& a, const Lanes& b) { return stdx::max(a, b); }
FURROW_INLINE Lanes square(const Lanes& a) { return a * a; }
FURROW_INLINE Lanes sqrt(const Lanes& a) { return stdx::sqrt(a); }
FURROW_INLINE Lanes abs(const Lanes& a) { return stdx::abs(a); }
FURROW_INLINE Mask finite(const Lanes& a) { return a - a == Lanes(0.0); }

/// A function of one number, lane by lane: for what is rare, or has no faster form.
template <class Function>
FURROW_INLINE Lanes per_lane(const Lanes& a, Function function) {
  return Lanes([&](auto lane) { return function(static_cast<double>(a[lane])); });
}

}  // namespace FURROW_ISA
}  // namespace furrow
