// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// g(c) and its derivatives for several points (section.h has the equations).

#include "furrow/material/section/section_parameters.h"
#include "furrow/simd/lanes.h"

namespace furrow {
inline namespace FURROW_ISA {

template <SectionParameters::Kind kind>
struct SectionKernel;

template <>
struct SectionKernel<SectionParameters::Kind::abaqus> {
  const SectionParameters& section;

  double slope() const { return 0.5 * (1.0 / section.K - 1.0); }
  FURROW_INLINE Lanes shape(const Lanes& c) const {
    return Lanes(0.5 * (1.0 + 1.0 / section.K)) + Lanes(slope()) * c;
  }
  FURROW_INLINE Lanes first_derivative(const Lanes& /*g*/) const { return slope(); }
  FURROW_INLINE Lanes second_derivative(const Lanes& /*g*/, const Lanes& /*first*/) const {
    return 0.0;
  }
};

template <>
struct SectionKernel<SectionParameters::Kind::matsuoka_nakai> {
  const SectionParameters& section;

  /// Newton's method from the parabola through g(-1), g(0) and g(1). It is monotone after its first
  /// step, because the cubic is convex and rises at the root; five steps leave rounding for K =
  /// 0.6, three for K = 0.8.
  FURROW_INLINE Lanes shape(const Lanes& c) const {
    const double middle = 1.0 / __builtin_sqrt(1.0 - section.w), extension = 1.0 / section.K;
    const double odd = 0.5 * (extension - 1.0), even = 0.5 * (extension + 1.0) - middle;
    const Lanes cubic = 1.0 - section.w, constant = Lanes(section.w) * c;
    Lanes g = Lanes(middle) + c * (Lanes(odd) + c * Lanes(even));
    for (int i = 0; i < 5; ++i) {
      const Lanes square = cubic * g * g;
      const Lanes step = (square * g - g - constant) / (Lanes(3.0) * square - Lanes(1.0));
      g -= step;
      if (all(abs(step) <= Lanes(1e-9))) break;  // the next one would be below rounding
    }
    return g;
  }
  FURROW_INLINE Lanes first_derivative(const Lanes& g) const {
    return Lanes(section.w) / (Lanes(3.0 * (1.0 - section.w)) * g * g - Lanes(1.0));
  }
  FURROW_INLINE Lanes second_derivative(const Lanes& g, const Lanes& first) const {
    return Lanes(-6.0 * (1.0 - section.w) / section.w) * g * first * first * first;
  }
};

/// A kind as a type, for template arguments.
template <SectionParameters::Kind kind>
struct SectionKind {
  static constexpr SectionParameters::Kind value = kind;
};

/// Calls a function of the SectionKind of a section. @return its result
template <class Function>
auto for_section(const SectionParameters& section, const Function& function) {
  using Kind = SectionParameters::Kind;
  switch (section.kind) {
    case Kind::abaqus:
      return function(SectionKind<Kind::abaqus>{});
    case Kind::matsuoka_nakai:
      return function(SectionKind<Kind::matsuoka_nakai>{});
    case Kind::round:
      break;
  }
  return function(SectionKind<Kind::round>{});
}

}  // namespace FURROW_ISA
}  // namespace furrow
