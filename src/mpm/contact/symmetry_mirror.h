// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The other half of a half model: a whole surface on a terrain that ends in its plane of symmetry.

#include <string>
#include <vector>

#include "furrow/core/types.h"
#include "furrow/geometry/surface.h"

namespace furrow {

class SymmetryMirror {
 public:
  /// @param plane  y of the plane of symmetry [m]; @param where  names the contact in errors
  /// @throws InputError when the surface is not its own mirror image in the plane
  SymmetryMirror(const Surface& surface, double plane, const std::string& where);

  /// Adds to the force on each node the mirror image of the force on its image.
  /// @param forces  3 x nodes of the surface [N]
  void add_image(Matrix3X& forces) const;

 private:
  std::vector<Eigen::Index> image_;  // the node at the mirror image of each node
};

}  // namespace furrow
