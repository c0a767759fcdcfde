// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/files/cache.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>

#include <fmt/format.h>

#include "furrow/core/checksum.h"

namespace furrow {

namespace fs = std::filesystem;

fs::path cache_folder() {
  if (const char* chosen = std::getenv("FURROW_CACHE")) return chosen;
  if (const char* cache = std::getenv("XDG_CACHE_HOME")) return fs::path(cache) / "furrow";
  const char* initial_position = std::getenv("HOME");
  return fs::path(initial_position ? initial_position : ".") / ".cache" / "furrow";
}

std::string distrust(const fs::path& path) {
  struct stat found = {};
  if (lstat(path.c_str(), &found) != 0) return "";
  if (S_ISLNK(found.st_mode)) return "is a link";
  if (found.st_uid != geteuid() && found.st_uid != 0)
    return fmt::format("belongs to the user with number {}", found.st_uid);
  if (found.st_mode & S_IWOTH) return "may be written by all users";
  return "";
}

std::string content_hash(const std::string& text) {
  Checksum sum;
  sum.add(text.data(), text.size());
  return fmt::format("{:016x}", sum.value());
}

}  // namespace furrow
