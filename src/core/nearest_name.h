// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What the user may have meant.

#include <string>
#include <vector>

namespace furrow {

/// The name that is at most two wrong, missing or superfluous letters away; empty when there is
/// none.
std::string nearest_name(const std::vector<std::string>& names, const std::string& written);

}  // namespace furrow
