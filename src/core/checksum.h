// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A checksum against damage, not against forgery.

#include <cstddef>
#include <cstdint>

namespace furrow {

/// FNV-1a, 64 bits (G. Fowler, L. C. Noll, K.-P. Vo), of bytes that come piece by piece. Each byte
/// changes the sum one to one, so that a change within a single byte never goes unnoticed, and
/// other damage with a chance of 2^-64.
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
