// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What a mode of a tyre is called by: its waves around the tread and where its motion goes.

#include "tyre/tyre.h"

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
