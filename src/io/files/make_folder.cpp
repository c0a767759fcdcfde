// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/files/make_folder.h"

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

void make_folder(const std::string& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  std::error_code unknown;
  if (!std::filesystem::is_directory(folder, unknown))
    throw Error(fmt::format("{}: cannot be made as a folder ({}); name another one", folder,
                            failed ? failed.message() : "something else has this name"));
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    throw Error(fmt::format("{}: cannot be written to ({}); name another folder", folder,
                            std::generic_category().message(errno)));
}

}  // namespace furrow
