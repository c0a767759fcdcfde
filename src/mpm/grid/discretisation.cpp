// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/grid/discretisation.h"

namespace furrow {

GridView Discretisation::local_view(int field) {
  GridView view = grid.view(field);
  for (int a = 0; a < 2; ++a) {
    const CellRange cells = partition.local_cells(a);
    view.axis[a].particles_lower = grid.axis(a).knot(cells.from);
    view.axis[a].particles_upper = grid.axis(a).knot(cells.to);
  }
  return view;
}

}  // namespace furrow
