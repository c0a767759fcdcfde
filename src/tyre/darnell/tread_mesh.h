// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The tread band as quadrilaterals.

#include <vector>

#include "furrow/shell/shell4.h"
#include "furrow/tyre/tread_grid.h"
#include "furrow/tyre/tyre_parameters.h"

namespace furrow {

struct TreadMesh {
  TreadGrid grid;
  Matrix3X x;  ///< [m] grid.count() nodes about the axle centre, stress-free
  /// grid.around times grid.rows, the rows fastest; counter-clockwise seen from outside
  std::vector<Shell4::Quad> quads;
};

/// Tread mesh, even in both directions; the crown is a parabola across.
/// @param across elements across the whole tread; even for a half model
/// @param half only y >= 0
TreadMesh make_tread_mesh(const TreadParameters& tread, int across, int around, bool half);

}  // namespace furrow
