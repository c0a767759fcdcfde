// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Layout by which the ranks of a run share the ground: rows and columns of blocks, each over the
/// full height.

#include <string>

namespace furrow {

struct BlockLayout {
  int x = 1;  ///< blocks along x
  int y = 1;
};

/// Columns of nodes of the largest of equal blocks, those included that it shares.
/// @param cells_x, cells_y  of the whole grid; real numbers, for grids too large to be made
double columns_of_largest(const BlockLayout& layout, double cells_x, double cells_y);

/// The layout whose largest block has the fewest columns of nodes: among blocks of equal size, the
/// one with the least halo; among equals, the one with more along x.
BlockLayout choose_layout(int ranks, double cells_x, double cells_y);

/// @throws InputError naming `where` when there are not as many blocks as ranks
void check_layout(const BlockLayout& layout, int ranks, const std::string& where);

}  // namespace furrow
