// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Refuses scenes in other units than SI, and flat ones.

#include <string>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "domain.h"
#include "lammps.h"
#include "update.h"

namespace furrow::coupling {

/// @param where names the line in the error
/// @throws InputError for a scene in other units, or a flat one
inline void check_settings(const LAMMPS_NS::LAMMPS& lammps, const std::string& where) {
  const std::string units = lammps.update->unit_style;
  if (units != "si")
    throw InputError(where, fmt::format("is used in a scene with units {}", units), "units si",
                     "write 'units si' before the box is made; LIGGGHTS's default is lj");
  const int dimension = lammps.domain->dimension;
  if (dimension != 3)
    throw InputError(where, fmt::format("is used in a scene with dimension {}", dimension),
                     "dimension 3", "remove the line 'dimension'; for a slice, make a narrow box");
}

}  // namespace furrow::coupling
