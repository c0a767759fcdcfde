// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What a check finds.

#include <string>

namespace furrow::coupling {

struct Finding {
  std::string text;              ///< what is wrong, what is allowed, what to do
  bool stops = false;            ///< the run must not begin; else a warning
  bool explains_errors = false;  ///< a later error of this run names it as a likely cause
};

/// What may be meant but probably is not.
Finding warning(std::string text);
/// What cannot be right. The arguments are those of InputError.
Finding refusal(const std::string& where, const std::string& problem, const std::string& allowed,
                const std::string& remedy = "");

}  // namespace furrow::coupling
