// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The folder that a fix writes its results to.

#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/core/options/options.h"

namespace furrow::coupling {

/// Makes the folder of the keyword 'folder' unless it is there. @throws InputError
inline void make_results_folder(const Options& options) {
  const std::string& folder = options.text("folder");
  if (folder == "~" || folder.rfind("~/", 0) == 0)
    throw InputError(options.where("folder"),
                     fmt::format("is '{}', which would make a folder with the name '~'", folder),
                     "a path from here, or from '/'", "write the path of your home folder");
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed)
    throw InputError(options.where("folder"),
                     fmt::format("is '{}', which cannot be made ({})", folder, failed.message()),
                     "a folder that you may write in");
}

}  // namespace furrow::coupling
