// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Figures of results folders, drawn by furrow-post with the Python that CMake found.

#include <string>

namespace furrow {

/// Runs a subcommand of furrow-post, which lies beside this program, for a results folder.
/// @param subcommand "point", "sidewall" or "modes"
/// @throws Error when furrow-post is missing or fails; the results stay
void draw_figure(const std::string& subcommand, const std::string& folder);

}  // namespace furrow
