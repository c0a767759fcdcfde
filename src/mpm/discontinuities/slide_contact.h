// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Contact with friction between two pieces of ground that a slide surface divides.
///
/// Each side has a separate velocity field (Grid::fields) and is moved by it alone, as if the other
/// were not there. At nodes that particles of both sides reach, the two velocities are made
/// to agree with an impenetrable surface and Coulomb's law (S. G. Bardenhagen, J. U. Brackbill,
/// D. Sulsky, Comput. Methods Appl. Mech. Eng. 187, 2000). With w = v_1 - v_2 after the forces of
/// the step, n from side 1 to side 2 and the reduced mass m = m_1 m_2/(m_1 + m_2):
///   normal impulse      J_n = m w.n, if > 0: the sides press on each other; otherwise they part
///   tangential impulse  J_t = min(m |w_t|, mu J_n) against w_t = w - (w.n) n
///   m_1 v_1 -= J_n n + J_t w_t/|w_t|,  m_2 v_2 += the same
/// Momentum is kept at every node, and so is its moment. J_t takes the energy J_t |w_t'|, w_t' the
/// sliding that is left. A node that sticks has the velocity of ground of one piece.
///
/// The nodes are those of the grid: sides that have parted meet again as soon as no more than one
/// cell of the grid is empty between them, not when they touch.

#include <array>

#include "furrow/mpm/grid/boundary.h"
#include "furrow/mpm/grid/grid.h"
#include "furrow/mpm/discontinuities/slide_surface.h"

namespace furrow {

class SlideContact {
 public:
  explicit SlideContact(const SlideSurface& surface) : surface_(surface) {}

  /// Changes the velocities of the nodes that both sides reach. Components that a wall holds stay:
  /// there the sides slide along the wall.
  /// @return what friction takes at the owned nodes [J]
  double apply(Grid& grid, const Boundary& walls, const NodeBlock& local,
               const NodeBlock& owned) const;

 private:
  double apply(NodeMotion& inner, NodeMotion& outer, const Vector3& normal,
               const std::array<bool, 3>& is_free) const;

  SlideSurface surface_;
};

}  // namespace furrow
