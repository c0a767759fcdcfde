// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Register for several points at once: one Lanes holds a value of each of lane_count neighbouring
/// points, in a register as the vector extension of gcc and clang names it.
///
/// All code of a kernel is in the inline namespace FURROW_ISA. Each instruction set of the kernel
/// units (simd/kernel_unit.cpp.in) has a separate one, so that the linker never mixes code of two
/// instruction sets. Only kernel units include headers of kernels, and these use no other header
/// with code (no <vector>, no <string>, no Eigen). Otherwise an inline function compiled for
/// AVX-512 could become the copy that the linker keeps for all callers.

#include <cstdint>
#include <type_traits>
#include <utility>

#ifdef __SSE2__
#include <immintrin.h>
#endif

#include "furrow/simd/kernel_units_only.h"

/// Lanes stay in registers only if a call is inlined, which gcc 12 does too rarely without the
/// attribute.
#define FURROW_INLINE [[gnu::always_inline]] inline

namespace furrow {
inline namespace FURROW_ISA {

#if defined(__AVX512F__)
constexpr int lane_count = 8;
#elif defined(__AVX2__)
constexpr int lane_count = 4;
#else
constexpr int lane_count = 2;
#endif

/// A register, the same as integers, and the same numbers anywhere in memory.
typedef double Register __attribute__((vector_size(8 * lane_count)));
typedef std::uint64_t Integers __attribute__((vector_size(8 * lane_count)));
typedef double StoredRegister __attribute__((vector_size(8 * lane_count), aligned(8), may_alias));

/// One lane of a Lanes or Mask, for writing.
template <class Whole, class Value>
class Lane {
 public:
  FURROW_INLINE Lane(Whole& whole, int lane) : whole_(whole), lane_(lane) {}
  FURROW_INLINE operator Value() const { return whole_.get(lane_); }
  FURROW_INLINE void operator=(Value value) { whole_.set(lane_, value); }

 private:
  Whole& whole_;
  int lane_;
};

/// True or false in each lane.
class Mask {
 public:
#ifdef __AVX512F__
  using Bits = __mmask8;
#else
  using Bits = Integers;  // of a lane all or none
#endif
  Mask() = default;
  FURROW_INLINE explicit Mask(bool value) : bits_(all_or_none(value)) {}
  FURROW_INLINE explicit Mask(const Bits& bits) : bits_(bits) {}

  FURROW_INLINE const Bits& bits() const { return bits_; }
  FURROW_INLINE bool operator[](int lane) const { return get(lane); }
  FURROW_INLINE Lane<Mask, bool> operator[](int lane) { return {*this, lane}; }
  FURROW_INLINE friend Mask operator&&(const Mask& a, const Mask& b) {
    return Mask(static_cast<Bits>(a.bits_ & b.bits_));
  }
  FURROW_INLINE friend Mask operator||(const Mask& a, const Mask& b) {
    return Mask(static_cast<Bits>(a.bits_ | b.bits_));
  }
  FURROW_INLINE Mask operator!() const { return Mask(static_cast<Bits>(~bits_)); }

  /// A bit for each lane.
  FURROW_INLINE unsigned number() const {
#if defined(__AVX512F__)
    return bits_;
#elif defined(__AVX2__)
    return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(bits_)));
#elif defined(__SSE2__)
    return static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<__m128d>(bits_)));
#else
    unsigned number = 0;
    for (int lane = 0; lane < lane_count; ++lane) number |= get(lane) ? 1u << lane : 0u;
    return number;
#endif
  }
#ifdef __AVX512F__
  FURROW_INLINE bool get(int lane) const { return (bits_ >> lane) & 1; }
  FURROW_INLINE void set(int lane, bool value) {
    bits_ = static_cast<Bits>((bits_ & ~(1u << lane)) | (value ? 1u << lane : 0u));
  }

 private:
  FURROW_INLINE static Bits all_or_none(bool value) { return value ? 0xFF : 0; }
#else
  FURROW_INLINE bool get(int lane) const { return bits_[lane] != 0; }
  FURROW_INLINE void set(int lane, bool value) {
    bits_[lane] = value ? ~std::uint64_t{0} : std::uint64_t{0};
  }

 private:
  FURROW_INLINE static Bits all_or_none(bool value) {
    return Bits{} - (value ? std::uint64_t{1} : std::uint64_t{0});
  }
#endif
  Bits bits_;
};

class Lanes {
 public:
  Lanes() = default;
  /// Sets all lanes to one number. (A difference, because a sum would lose the sign of -0.)
  FURROW_INLINE Lanes(double number) : numbers_(number - Register{}) {}
  FURROW_INLINE explicit Lanes(const Register& numbers) : numbers_(numbers) {}
  /// function(lane) in each.
  template <class Function, class = std::enable_if_t<std::is_invocable_v<Function&, int>>>
  FURROW_INLINE explicit Lanes(Function&& function)
      : numbers_(generate(function, std::make_integer_sequence<int, lane_count>())) {}
  /// From memory, and back.
  FURROW_INLINE static Lanes load(const double* first) {
    return Lanes(Register(*reinterpret_cast<const StoredRegister*>(first)));
  }
  /// Loads as many numbers as there are; 0 in the other lanes.
  FURROW_INLINE static Lanes load_some(const double* first, int count) {
#if defined(__AVX512F__)
    return Lanes(Register(_mm512_maskz_loadu_pd(static_cast<__mmask8>((1u << count) - 1), first)));
#elif defined(__AVX2__)
    const Register place = {0.0, 1.0, 2.0, 3.0};
    return Lanes(Register(_mm256_maskload_pd(
        first, reinterpret_cast<__m256i>(place < static_cast<double>(count) - Register{}))));
#else
    return Lanes([&](int lane) { return lane < count ? first[lane] : 0.0; });
#endif
  }
  FURROW_INLINE void store(double* first) const {
    *reinterpret_cast<StoredRegister*>(first) = numbers_;
  }

  FURROW_INLINE const Register& numbers() const { return numbers_; }
  FURROW_INLINE double operator[](int lane) const { return get(lane); }
  FURROW_INLINE Lane<Lanes, double> operator[](int lane) { return {*this, lane}; }
  FURROW_INLINE double get(int lane) const { return numbers_[lane]; }
  FURROW_INLINE void set(int lane, double number) { numbers_[lane] = number; }

  FURROW_INLINE Lanes operator-() const { return Lanes(-numbers_); }
  FURROW_INLINE friend Lanes operator+(const Lanes& a, const Lanes& b) {
    return Lanes(a.numbers_ + b.numbers_);
  }
  FURROW_INLINE friend Lanes operator-(const Lanes& a, const Lanes& b) {
    return Lanes(a.numbers_ - b.numbers_);
  }
  FURROW_INLINE friend Lanes operator*(const Lanes& a, const Lanes& b) {
    return Lanes(a.numbers_ * b.numbers_);
  }
  FURROW_INLINE friend Lanes operator/(const Lanes& a, const Lanes& b) {
    return Lanes(a.numbers_ / b.numbers_);
  }
  FURROW_INLINE Lanes& operator+=(const Lanes& b) { return *this = *this + b; }
  FURROW_INLINE Lanes& operator-=(const Lanes& b) { return *this = *this - b; }
  FURROW_INLINE Lanes& operator*=(const Lanes& b) { return *this = *this * b; }
  FURROW_INLINE Lanes& operator/=(const Lanes& b) { return *this = *this / b; }

#ifdef __AVX512F__
#define FURROW_COMPARISON(sign, name)                                       \
  FURROW_INLINE friend Mask operator sign(const Lanes& a, const Lanes& b) { \
    return Mask(_mm512_cmp_pd_mask(a.numbers_, b.numbers_, _CMP_##name));   \
  }
#else
#define FURROW_COMPARISON(sign, name)                                       \
  FURROW_INLINE friend Mask operator sign(const Lanes& a, const Lanes& b) { \
    return Mask(reinterpret_cast<Integers>(a.numbers_ sign b.numbers_));    \
  }
#endif
  FURROW_COMPARISON(==, EQ_OQ)
  FURROW_COMPARISON(!=, NEQ_UQ)
  FURROW_COMPARISON(<, LT_OS)
  FURROW_COMPARISON(<=, LE_OS)
  FURROW_COMPARISON(>, GT_OS)
  FURROW_COMPARISON(>=, GE_OS)
#undef FURROW_COMPARISON

 private:
  template <class Function, int... lane>
  FURROW_INLINE static Register generate(Function& function, std::integer_sequence<int, lane...>) {
    return Register{static_cast<double>(function(lane))...};
  }
  Register numbers_;
};

FURROW_INLINE Lanes select(const Mask& mask, const Lanes& yes, const Lanes& no) {
#if defined(__AVX512F__)
  return Lanes(Register(_mm512_mask_blend_pd(mask.bits(), no.numbers(), yes.numbers())));
#elif defined(__AVX2__)
  return Lanes(Register(
      _mm256_blendv_pd(no.numbers(), yes.numbers(), reinterpret_cast<__m256d>(mask.bits()))));
#else
  return Lanes(
      reinterpret_cast<Register>((mask.bits() & reinterpret_cast<Integers>(yes.numbers())) |
                                 (~mask.bits() & reinterpret_cast<Integers>(no.numbers()))));
#endif
}

/// where(mask, a) = b changes the lanes of the mask.
class Where {
 public:
  FURROW_INLINE Where(const Mask& mask, Lanes& lanes) : mask_(mask), lanes_(lanes) {}
  FURROW_INLINE void operator=(const Lanes& value) { lanes_ = select(mask_, value, lanes_); }
  FURROW_INLINE void operator+=(const Lanes& value) {
    lanes_ = select(mask_, lanes_ + value, lanes_);
  }

 private:
  const Mask& mask_;
  Lanes& lanes_;
};
FURROW_INLINE Where where(const Mask& mask, Lanes& lanes) { return {mask, lanes}; }

FURROW_INLINE bool any(const Mask& mask) { return mask.number() != 0; }
FURROW_INLINE bool all(const Mask& mask) { return mask.number() == (1u << lane_count) - 1; }
FURROW_INLINE int count(const Mask& mask) { return __builtin_popcount(mask.number()); }

FURROW_INLINE Lanes min(const Lanes& a, const Lanes& b) {
#if defined(__AVX512F__)
  return Lanes(Register(_mm512_min_pd(a.numbers(), b.numbers())));
#elif defined(__AVX2__)
  return Lanes(Register(_mm256_min_pd(a.numbers(), b.numbers())));
#elif defined(__SSE2__)
  return Lanes(Register(_mm_min_pd(a.numbers(), b.numbers())));
#else
  return select(a < b, a, b);
#endif
}
FURROW_INLINE Lanes max(const Lanes& a, const Lanes& b) {
#if defined(__AVX512F__)
  return Lanes(Register(_mm512_max_pd(a.numbers(), b.numbers())));
#elif defined(__AVX2__)
  return Lanes(Register(_mm256_max_pd(a.numbers(), b.numbers())));
#elif defined(__SSE2__)
  return Lanes(Register(_mm_max_pd(a.numbers(), b.numbers())));
#else
  return select(a > b, a, b);
#endif
}
FURROW_INLINE Lanes square(const Lanes& a) { return a * a; }
FURROW_INLINE Lanes sqrt(const Lanes& a) {
#if defined(__AVX512F__)
  return Lanes(Register(_mm512_sqrt_pd(a.numbers())));
#elif defined(__AVX2__)
  return Lanes(Register(_mm256_sqrt_pd(a.numbers())));
#elif defined(__SSE2__)
  return Lanes(Register(_mm_sqrt_pd(a.numbers())));
#else
  return Lanes([&](int lane) { return __builtin_sqrt(a[lane]); });
#endif
}
FURROW_INLINE Lanes abs(const Lanes& a) {
  return Lanes(reinterpret_cast<Register>(reinterpret_cast<Integers>(a.numbers()) &
                                          (~std::uint64_t{0} >> 1)));
}
FURROW_INLINE Mask finite(const Lanes& a) { return a - a == Lanes(0.0); }

/// Sum of the lanes: lower and upper half, until one number is left.
FURROW_INLINE double sum(const Lanes& a) {
  const Register& n = a.numbers();
#if defined(__AVX512F__)
  return ((n[0] + n[4]) + (n[2] + n[6])) + ((n[1] + n[5]) + (n[3] + n[7]));
#elif defined(__AVX2__)
  return (n[0] + n[2]) + (n[1] + n[3]);
#else
  return n[0] + n[1];
#endif
}

/// A function of one number, lane by lane: for what is rare, or has no faster form.
template <class Function>
FURROW_INLINE Lanes per_lane(const Lanes& a, Function function) {
  return Lanes([&](int lane) { return function(a[lane]); });
}

}  // namespace FURROW_ISA
}  // namespace furrow
