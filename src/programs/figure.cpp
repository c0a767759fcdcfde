// SPDX-License-Identifier: GPL-2.0-or-later
#include "figure.h"

#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <vector>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

/// @param otherwise what the user can do without furrow-post
/// @throws Error where it is missing
std::string furrow_post(const std::string& otherwise) {
  const auto program = std::filesystem::read_symlink("/proc/self/exe");
  std::string post = (program.parent_path() / "furrow-post").string();
  if (!std::filesystem::is_regular_file(post))
    throw Error(post + " is missing; reinstall Furrow" + otherwise);
  return post;
}

}  // namespace

void become_furrow_post(const std::vector<std::string>& command, int argc, char** argv) {
  const std::string post = furrow_post("");
  std::vector<const char*> arguments{FURROW_PYTHON, "-B", post.c_str()};
  for (const std::string& word : command) arguments.push_back(word.c_str());
  arguments.insert(arguments.end(), argv, argv + argc);
  arguments.push_back(nullptr);
  execv(FURROW_PYTHON, const_cast<char**>(arguments.data()));
  throw Error("cannot start " FURROW_PYTHON "; install Python 3");
}

void draw_figure(const std::string& name, const std::string& folder) {
  const std::string post = furrow_post(", or use --no-plot");
  std::cout << std::flush;
  const pid_t child = fork();
  if (child < 0)
    throw Error("cannot start " FURROW_PYTHON " for the figure; the results are in " + folder);
  if (child == 0) {
    execl(FURROW_PYTHON, FURROW_PYTHON, "-B", post.c_str(), "figure", name.c_str(), folder.c_str(),
          static_cast<char*>(nullptr));
    _exit(127);
  }
  int status = 0;
  if (waitpid(child, &status, 0) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw Error(fmt::format(
        "the figure could not be drawn ({} {} figure {} {}); the results are complete in {}; "
        "--no-plot leaves it out",
        FURROW_PYTHON, post, name, folder, folder));
}

}  // namespace furrow
