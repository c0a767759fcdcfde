// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Helpers that fuzz targets share.

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "furrow/core/error.h"

namespace furrow::fuzz {

/// A folder for one run of the program, laid out as inputs/, for readers that want a path.
class InputFolder {
 public:
  InputFolder()
      : folder_(std::filesystem::temp_directory_path() /
                ("furrow_fuzz_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_ / "points");
    std::filesystem::copy(FURROW_SOURCE_DIR "/inputs/materials", folder_ / "materials",
                          std::filesystem::copy_options::recursive);
    std::filesystem::copy(FURROW_SOURCE_DIR "/inputs/validation/snow_oedometer", folder_ / "data");
  }
  ~InputFolder() { std::filesystem::remove_all(folder_); }
  InputFolder(const InputFolder&) = delete;
  InputFolder& operator=(const InputFolder&) = delete;

  /// @param name "materials/input.yaml" @returns its path
  std::string write(const std::string& name, const std::uint8_t* data, std::size_t size) const {
    const std::filesystem::path path = folder_ / name;
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    return path.string();
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_;
};

constexpr std::size_t longest_message = 20'000;

/// Calls a reader, which may refuse with a message that can be read; anything else that it throws
/// ends the program.
template <class Refusal, class Reader>
void read_or_refuse(Reader reader) {
  try {
    reader();
  } catch (const Refusal& error) {
    if (std::string(error.what()).size() > longest_message) std::abort();
  }
}

}  // namespace furrow::fuzz
