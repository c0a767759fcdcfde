// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The words of a fix line after "fix id group style".

#include <algorithm>
#include <string>
#include <vector>

namespace furrow::coupling {

inline std::vector<std::string> args_after_style(int narg, char** arg) {
  return {arg + std::min(narg, 3), arg + narg};
}

}  // namespace furrow::coupling
