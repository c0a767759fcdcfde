// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Result of a check.

#include <string>

namespace furrow::coupling {

struct Finding {
  std::string text;              ///< fault, allowed values and remedy
  bool stops = false;            ///< the run must not begin; else a warning
  bool explains_errors = false;  ///< a later error of this run names it as a likely cause
};

/// Warning about something that may be meant but probably is not.
Finding warning(std::string text);
/// Error about something that cannot be right. The arguments are those of InputError.
Finding refusal(const std::string& where, const std::string& problem, const std::string& allowed,
                const std::string& remedy = "");

}  // namespace furrow::coupling
