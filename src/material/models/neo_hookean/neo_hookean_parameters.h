// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Constants of the neo-Hookean law, as plain data for the kernels.

namespace furrow {

struct NeoHookeanParameters {
  double shear = 0.0;  ///< mu [Pa]
  double bulk = 0.0;   ///< K [Pa]
};

}  // namespace furrow
