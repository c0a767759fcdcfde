// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/replace_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/error.h"

namespace furrow {

namespace fs = std::filesystem;

void replace_file(const std::string& path, const std::function<void(const std::string&)>& write) {
  const fs::path target(path);
  const fs::path part =
      target.parent_path() / (target.stem().string() + ".part" + target.extension().string());
  std::error_code ignored, failed;
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
