// SPDX-License-Identifier: GPL-2.0-or-later
#include "parse_options.h"

#include <cstdio>

#include <fmt/format.h>

namespace furrow {

std::optional<int> parse_options(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    if (problem.get_exit_code() == 0) return app.exit(problem);
    fmt::print(stderr, "{}: {}; see --help\n", app.get_name(), problem.what());
    return 1;
  }
  return std::nullopt;
}

}  // namespace furrow
