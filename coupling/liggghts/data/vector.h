// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// LIGGGHTS's three numbers as a vector.

#include "furrow/core/types.h"

namespace furrow::coupling {

inline Vector3 vector(const double* values) { return {values[0], values[1], values[2]}; }

}  // namespace furrow::coupling
