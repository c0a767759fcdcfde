// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/cache.h"

#include <cstdint>
#include <cstdlib>

#include <fmt/format.h>

namespace furrow {

namespace fs = std::filesystem;

fs::path cache_folder() {
  if (const char* chosen = std::getenv("FURROW_CACHE")) return chosen;
  if (const char* cache = std::getenv("XDG_CACHE_HOME")) return fs::path(cache) / "furrow";
  const char* initial_position = std::getenv("HOME");
  return fs::path(initial_position ? initial_position : ".") / ".cache" / "furrow";
}

std::string content_hash(const std::string& text) {
  std::uint64_t hash = 14695981039346656037u;
  for (const unsigned char c : text) hash = (hash ^ c) * 1099511628211u;
  return fmt::format("{:016x}", hash);
}

}  // namespace furrow
