// SPDX-License-Identifier: GPL-2.0-or-later
#include "figure.h"

#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>

#include <fmt/format.h>

#include "core/error.h"

namespace furrow {

void draw_figure(const std::string& subcommand, const std::string& folder) {
  const auto program = std::filesystem::read_symlink("/proc/self/exe");
  const std::string post = (program.parent_path() / "furrow-post").string();
  if (!std::filesystem::is_regular_file(post))
    throw Error(post + " is missing; reinstall Furrow, or use --no-plot");
  std::cout << std::flush;
  const pid_t child = fork();
  if (child < 0)
    throw Error("cannot start " FURROW_PYTHON " for the figure; the results are in " + folder);
  if (child == 0) {
    execl(FURROW_PYTHON, FURROW_PYTHON, "-B", post.c_str(), subcommand.c_str(), folder.c_str(),
          static_cast<char*>(nullptr));
    _exit(127);
  }
  int status = 0;
  if (waitpid(child, &status, 0) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw Error(
        fmt::format("the figure could not be drawn ({} {} {} {}); the results are complete in {}; "
                    "--no-plot leaves it out",
                    FURROW_PYTHON, post, subcommand, folder, folder));
}

}  // namespace furrow
