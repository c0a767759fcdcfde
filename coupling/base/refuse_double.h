// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Two lines that do the same work: forces would count twice, files would be written over.

#include <string>

#include <fmt/format.h>

#include "core/error.h"
#include "coupling/liggghts/fixes_of.h"

namespace furrow::coupling {

/// For the constructor of a FixStyle.
/// @param where    the line or keyword that is one too many
/// @param deed     what it does: "presses 'wheel' on 'soil'"
/// @param allowed  "one contact for each pair"
/// @param same     bool(FixStyle& other): whether a fix that is there does this already
/// @throws InputError
template <class FixStyle, class Same>
void refuse_double(const LAMMPS_NS::Modify& modify, const std::string& where,
                   const std::string& deed, const std::string& allowed, Same&& same) {
  for (FixStyle* other : fixes_of<FixStyle>(modify))
    if (same(*other))
      throw InputError(
          where, fmt::format("{}, as fix '{}' does already", deed, other->id), allowed,
          fmt::format("remove one of the lines, or write 'unfix {}' before", other->id));
}

}  // namespace furrow::coupling
