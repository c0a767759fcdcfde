// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Classification of a mode of a tyre: number of waves around the tread and direction of motion.

#include "furrow/tyre/tyre.h"

namespace furrow {

struct ModeKind {
  /// around the tread, of the largest Fourier component; 0: the whole tread alike, 1: it shakes
  int waves = 0;
  double wave_share = 0.0;  ///< of the tread's motion (squared) in that component
  // shares of the tread's motion (squared); they sum to 1
  double radial = 0.0, circumferential = 0.0, axial = 0.0;
};

/// @param shape of the nodes of the tread, from Tyre::natural_modes
ModeKind kind_of(const Tyre& tyre, const Matrix3X& shape);

}  // namespace furrow
