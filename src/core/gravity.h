// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "furrow/core/options/options.h"

namespace furrow {

/// Gravity that a user may give [m/s^2], up to that of a large centrifuge; 9806 would be mm/s^2.
inline Range admissible_gravity() { return {0.0, 2000.0, true, false}; }

}  // namespace furrow
