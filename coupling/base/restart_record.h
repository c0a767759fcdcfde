// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What a fix adds to a LIGGGHTS restart file: its length in bytes, then numbers. On rank 0 only.

#include <cstdio>
#include <vector>

namespace furrow::coupling {

inline void write_record(std::FILE* file, const std::vector<double>& numbers) {
  const int size = static_cast<int>(numbers.size() * sizeof(double));
  std::fwrite(&size, sizeof size, 1, file);
  std::fwrite(numbers.data(), sizeof(double), numbers.size(), file);
}

}  // namespace furrow::coupling
