// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/files/replace_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fcntl.h>
#include <unistd.h>

#include "furrow/core/error.h"

namespace furrow {

namespace fs = std::filesystem;

namespace {

/// Empty, in the place of what has this name.
void make_part(const std::string& part, const std::string& path) {
  unlink(part.c_str());
  const int file = open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (file < 0) throw Error(fmt::format("{}: cannot be written ({})", path, std::strerror(errno)));
  close(file);
}

}  // namespace

void replace_file(const std::string& path, const std::function<void(const std::string&)>& write) {
  const fs::path target(path);
  const fs::path part =
      target.parent_path() / (target.stem().string() + ".part" + target.extension().string());
  std::error_code ignored, failed;
  make_part(part.string(), path);
  try {
    write(part.string());
  } catch (...) {
    fs::remove(part, ignored);
    throw;
  }
  fs::rename(part, target, failed);
  if (failed) {
    fs::remove(part, ignored);
    throw Error(fmt::format("{}: cannot be replaced ({})", path, failed.message()));
  }
}

void write_text_file(const std::string& path, const std::string& text) {
  replace_file(path, [&](const std::string& part) {
    std::ofstream file(part, std::ios::binary);
    file << text;
    file.close();
    if (!file) throw Error(fmt::format("{}: cannot be written", path));
  });
}

std::string read_text_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(fmt::format("{}: cannot be read", path));
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace furrow
