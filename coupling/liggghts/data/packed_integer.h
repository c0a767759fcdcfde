// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Integers in LIGGGHTS's buffers of doubles: 64 bits, copied as they are.

#include <cstdint>
#include <cstring>

namespace furrow::coupling {

inline double pack_integer(int value) {
  const std::int64_t wide = value;
  double packed;
  std::memcpy(&packed, &wide, sizeof packed);
  return packed;
}

inline int unpack_integer(double packed) {
  std::int64_t wide;
  std::memcpy(&wide, &packed, sizeof wide);
  return static_cast<int>(wide);
}

}  // namespace furrow::coupling
