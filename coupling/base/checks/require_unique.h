// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Refuses a second line that does the work of an earlier one: forces would count twice, or files
/// would be overwritten.

#include <string>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "coupling/liggghts/styles/fixes_of.h"

namespace furrow::coupling {

/// Requires that a new FixStyle is the only one with its task; for its constructor.
/// @param where    the line or keyword that is one too many
/// @param action   what it does: "presses 'wheel' on 'soil'"
/// @param rule     "one contact for each pair"
/// @param matches  bool(FixStyle& other): whether an existing fix does this already
/// @throws InputError when one does
template <class FixStyle, class Matches>
void require_unique(const LAMMPS_NS::Modify& modify, const std::string& where,
                    const std::string& action, const std::string& rule, Matches&& matches) {
  for (FixStyle* other : fixes_of<FixStyle>(modify))
    if (matches(*other))
      throw InputError(
          where, fmt::format("{}, as fix '{}' does already", action, other->id), rule,
          fmt::format("remove one of the lines, or write 'unfix {}' before", other->id));
}

}  // namespace furrow::coupling
