// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Transposes four numbers of each of several points, stored point by point, into lanes and back.
/// This needs fewer loads and shuffles than gathering single numbers.

#include "furrow/simd/lanes.h"

namespace furrow {
inline namespace FURROW_ISA {

#ifdef __AVX2__
using Record = double __attribute__((vector_size(32)));
using StoredRecord = double __attribute__((vector_size(32), aligned(8), may_alias));
FURROW_INLINE Record load_record(const double* numbers) {
  return *reinterpret_cast<const StoredRecord*>(numbers);
}
FURROW_INLINE void add_record(const Record& record, double* numbers) {
  *reinterpret_cast<StoredRecord*>(numbers) += record;
}
FURROW_INLINE void store_record(const Record& record, double* numbers) {
  *reinterpret_cast<StoredRecord*>(numbers) = record;
}
FURROW_INLINE void store_triple(const Record& record, double* numbers) {
  using StoredPair = double __attribute__((vector_size(16), aligned(8), may_alias));
  *reinterpret_cast<StoredPair*>(numbers) = __builtin_shufflevector(record, record, 0, 1);
  numbers[2] = record[2];
}
#else
struct Record {
  double number[4];
};
FURROW_INLINE Record load_record(const double* numbers) {
  return {numbers[0], numbers[1], numbers[2], numbers[3]};
}
FURROW_INLINE void add_record(const Record& record, double* numbers) {
  for (int k = 0; k < 4; ++k) numbers[k] += record.number[k];
}
FURROW_INLINE void store_record(const Record& record, double* numbers) {
  for (int k = 0; k < 4; ++k) numbers[k] = record.number[k];
}
FURROW_INLINE void store_triple(const Record& record, double* numbers) {
  for (int k = 0; k < 3; ++k) numbers[k] = record.number[k];
}
#endif
/// Three numbers and a zero.
FURROW_INLINE Record load_triple(const double* numbers) {
  return Record{numbers[0], numbers[1], numbers[2], 0.0};
}

#if defined(__AVX512F__)
#define FURROW_EVEN_PAIRS 0, 8, 2, 10, 4, 12, 6, 14
#define FURROW_ODD_PAIRS 1, 9, 3, 11, 5, 13, 7, 15
#define FURROW_LOW_HALVES 0, 1, 8, 9, 4, 5, 12, 13
#define FURROW_HIGH_HALVES 2, 3, 10, 11, 6, 7, 14, 15
#elif defined(__AVX2__)
#define FURROW_EVEN_PAIRS 0, 4, 2, 6
#define FURROW_ODD_PAIRS 1, 5, 3, 7
#define FURROW_LOW_HALVES 0, 1, 4, 5
#define FURROW_HIGH_HALVES 2, 3, 6, 7
#endif

#ifdef FURROW_EVEN_PAIRS
/// Transposes 4 x 4 numbers in each half of the registers.
FURROW_INLINE void transpose(Register (&rows)[4]) {
  const Register even01 = __builtin_shufflevector(rows[0], rows[1], FURROW_EVEN_PAIRS),
                 odd01 = __builtin_shufflevector(rows[0], rows[1], FURROW_ODD_PAIRS),
                 even23 = __builtin_shufflevector(rows[2], rows[3], FURROW_EVEN_PAIRS),
                 odd23 = __builtin_shufflevector(rows[2], rows[3], FURROW_ODD_PAIRS);
  rows[0] = __builtin_shufflevector(even01, even23, FURROW_LOW_HALVES);
  rows[1] = __builtin_shufflevector(odd01, odd23, FURROW_LOW_HALVES);
  rows[2] = __builtin_shufflevector(even01, even23, FURROW_HIGH_HALVES);
  rows[3] = __builtin_shufflevector(odd01, odd23, FURROW_HIGH_HALVES);
}
#undef FURROW_EVEN_PAIRS
#undef FURROW_ODD_PAIRS
#undef FURROW_LOW_HALVES
#undef FURROW_HIGH_HALVES

/// @param record of a lane
template <class RecordOf>
FURROW_INLINE void to_lanes(RecordOf record, Lanes (&numbers)[4]) {
  Register rows[4];
#ifdef __AVX512F__
  for (int k = 0; k < 4; ++k)
    rows[k] = __builtin_shufflevector(record(k), record(k + 4), 0, 1, 2, 3, 4, 5, 6, 7);
#else
  for (int k = 0; k < 4; ++k) rows[k] = record(k);
#endif
  transpose(rows);
  for (int k = 0; k < 4; ++k) numbers[k] = Lanes(rows[k]);
}

FURROW_INLINE void to_records(const Lanes (&numbers)[4], Record (&records)[lane_count]) {
  Register rows[4];
  for (int k = 0; k < 4; ++k) rows[k] = numbers[k].numbers();
  transpose(rows);
  for (int k = 0; k < 4; ++k) {
#ifdef __AVX512F__
    records[k] = __builtin_shufflevector(rows[k], rows[k], 0, 1, 2, 3);
    records[k + 4] = __builtin_shufflevector(rows[k], rows[k], 4, 5, 6, 7);
#else
    records[k] = rows[k];
#endif
  }
}
#else
template <class RecordOf>
FURROW_INLINE void to_lanes(RecordOf record, Lanes (&numbers)[4]) {
  for (int lane = 0; lane < lane_count; ++lane) {
    const Record one = record(lane);
    for (int k = 0; k < 4; ++k) numbers[k][lane] = one.number[k];
  }
}
FURROW_INLINE void to_records(const Lanes (&numbers)[4], Record (&records)[lane_count]) {
  for (int lane = 0; lane < lane_count; ++lane)
    for (int k = 0; k < 4; ++k) records[lane].number[k] = numbers[k][lane];
}
#endif

}  // namespace FURROW_ISA
}  // namespace furrow
