// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// How the ranks of a run share the ground: as rows and columns of blocks, each over the full
/// height.

#include <string>

#include "mpm/grid.h"

namespace furrow {

struct BlockLayout {
  int x = 1;  ///< blocks along x
  int y = 1;
};

/// The layout whose largest block has the fewest columns of nodes, those included that it shares:
/// of blocks of equal size, the one with the least halo. Of equals, the one with more along x.
BlockLayout choose_layout(int ranks, const Grid& grid);

/// @throws InputError naming `where` when there are not as many blocks as ranks
void check_layout(const BlockLayout& layout, int ranks, const std::string& where);

}  // namespace furrow
