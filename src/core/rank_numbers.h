// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Numbers that each rank of a run keeps in a checkpoint by itself: together they may be too many
/// for the memory of one rank, or for one record of a restart file.

#include <cstddef>
#include <cstdint>

namespace furrow {

class RankNumbers {
 public:
  virtual ~RankNumbers() = default;
  /// Adds to the numbers of this rank. A failure is kept until the checkpoint is closed.
  virtual void append(const double* numbers, std::size_t count) = 0;
  /// Compares the numbers that a rank wrote with their checksum. @throws Error naming what is
  /// missing or damaged
  virtual void check(int rank) = 0;
  /// Reads numbers that a rank wrote, from the given one on. @throws Error
  virtual void read(int rank, std::uint64_t first, double* numbers, std::size_t count) = 0;
};

}  // namespace furrow
