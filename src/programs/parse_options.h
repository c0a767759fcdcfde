// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The command line of a program.

#include <optional>

#include <CLI/CLI.hpp>

namespace furrow {

/// @return the status that ends the program: 0 after --help or --version, 1 after one sentence
/// about a wrong command line; nothing for a program that goes on
std::optional<int> parse_options(CLI::App& app, int argc, char** argv);

}  // namespace furrow
