// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Figures of results folders and other work that furrow-post does, with the Python that CMake
/// found.

#include <string>
#include <vector>

namespace furrow {

/// Runs "furrow-post figure", which lies in the folder of this program, for a results folder.
/// @param name "point", "sidewall" or "modes"
/// @throws Error when furrow-post is missing or fails; the results stay
void draw_figure(const std::string& name, const std::string& folder);

/// Replaces this program by a command of furrow-post with these arguments. Returns never.
/// @throws Error when furrow-post or Python is missing
[[noreturn]] void become_furrow_post(const std::vector<std::string>& command, int argc,
                                     char** argv);

}  // namespace furrow
