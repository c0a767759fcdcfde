// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A checksum against damage, not against forgery.

#include <cstddef>
#include <cstdint>

namespace furrow {

/// FNV-1a, 64 bits (G. Fowler, L. C. Noll, K.-P. Vo), of bytes in pieces. It detects every change
/// within a single byte, and misses other damage with a probability of 2^-64.
class Checksum {
 public:
  void add(const void* bytes, std::size_t count) {
    const auto* next = static_cast<const unsigned char*>(bytes);
    for (std::size_t i = 0; i < count; ++i) sum_ = (sum_ ^ next[i]) * 1099511628211u;
  }
  std::uint64_t value() const { return sum_; }

 private:
  std::uint64_t sum_ = 14695981039346656037u;
};

}  // namespace furrow
