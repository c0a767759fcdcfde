// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

namespace furrow {

/// Makes a folder for results, with those above it, unless it is there.
/// @throws Error naming it when that fails, or when it may not be written to
void make_folder(const std::string& folder);

}  // namespace furrow
