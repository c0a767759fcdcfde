// SPDX-License-Identifier: GPL-2.0-or-later
#include "mpm/discretisation.h"

namespace furrow {

GridView Discretisation::local_view(int field) {
  GridView view = grid.view(field);
  view.axis[0].particles_lower = grid.axis(0).knot(partition.first_local_cell());
  view.axis[0].particles_upper = grid.axis(0).knot(partition.last_local_cell() + 1);
  return view;
}

}  // namespace furrow
