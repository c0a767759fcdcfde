// SPDX-License-Identifier: GPL-2.0-or-later
#include "figure.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>

#include <fmt/format.h>

#include "core/error.h"

namespace furrow {

void draw_figure(const std::string& name, const std::string& folder) {
  const auto program = std::filesystem::read_symlink("/proc/self/exe");
  const std::string script = (program.parent_path().parent_path() / "share/furrow" / name).string();
  if (!std::filesystem::is_regular_file(script))
    throw Error(script + " is missing; reinstall Furrow, or use --no-plot");
  std::cout << std::flush;
  const pid_t child = fork();
  if (child < 0)
    throw Error("cannot start /usr/bin/python3 for the figure; the results are in " + folder);
  if (child == 0) {
    setenv("MPLBACKEND", "Agg", 1);
    execl("/usr/bin/python3", "python3", "-B", script.c_str(), folder.c_str(),
          static_cast<char*>(nullptr));
    _exit(127);
  }
  int status = 0;
  if (waitpid(child, &status, 0) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw Error(
        fmt::format("the figure could not be drawn (/usr/bin/python3 {} {}); the results are "
                    "complete in {}; --no-plot leaves it out",
                    script, folder, folder));
}

}  // namespace furrow
