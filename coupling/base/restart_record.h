// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Record of a fix in a LIGGGHTS restart file: its length in bytes (an int, which LIGGGHTS reads),
/// then a Checkpoint. On rank 0 only.

#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "furrow/core/checkpoint.h"
#include "furrow/core/error.h"

namespace furrow::coupling {

/// @throws Error when LIGGGHTS's record cannot be as long as the state is
inline void write_record(std::FILE* file, const Checkpoint& state) {
  const std::vector<char> bytes = state.bytes();
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw Error(
        fmt::format("{}: its state has {} bytes, and a LIGGGHTS restart file holds at most "
                    "2 GiB for a fix; use fewer cells or particles, or no checkpoints",
                    state.owner(), bytes.size()));
  const int size = static_cast<int>(bytes.size());
  std::fwrite(&size, sizeof size, 1, file);
  std::fwrite(bytes.data(), 1, bytes.size(), file);
}

/// @param buffer what LIGGGHTS read for the fix; it does not say how long it is, the header does
inline Checkpoint read_record(const std::string& owner, const char* buffer) {
  return {owner, buffer, Checkpoint::size(owner, buffer)};
}

}  // namespace furrow::coupling
