// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A folder that a test may fill and that is gone after it, and the texts that go there.

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "furrow/io/files/replace_file.h"

namespace furrow {

class Scratch {
 public:
  Scratch()
      : folder_(std::filesystem::temp_directory_path() /
                ("furrow_test_" + std::to_string(getpid()))) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~Scratch() { std::filesystem::remove_all(folder_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string folder() const { return folder_.string(); }
  /// Path of a file with that text.
  std::string file(const std::string& name, const std::string& text) const {
    write_text_file(path(name), text);
    return path(name);
  }
  /// A message whose files are named without the folder.
  std::string without_folder(std::string message) const {
    for (std::size_t at = 0; (at = message.find(folder() + "/")) != std::string::npos;)
      message.erase(at, folder().size() + 1);
    return message;
  }

 private:
  std::filesystem::path folder_;
};

/// A text with one part replaced, which it must have.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(std::min(at, text.size()), from.size(), to);
}

}  // namespace furrow
