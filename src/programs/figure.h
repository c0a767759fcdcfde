// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Figures of results folders, drawn by the system's Python, which has matplotlib and h5py.

#include <string>

namespace furrow {

/// Runs a script of share/furrow, which lies beside the bin folder of this program, for a results
/// folder.
/// @throws Error when the script is missing or fails; the results stay
void draw_figure(const std::string& script, const std::string& folder);

}  // namespace furrow
