// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Numbering of the nodes of a tread.

namespace furrow {

/// Lines of nodes around the tyre, next to one another. Node (i, j) is the i-th around from the
/// lowest point of the wheel as made towards +x, on the j-th line across towards +y; a half model
/// has the lines of y >= 0.
struct TreadGrid {
  int around = 0;  ///< elements, and nodes of a line
  int rows = 0;    ///< elements across that are computed
  bool half = false;

  int lines() const { return rows + 1; }
  int count() const { return around * lines(); }
  /// @param i any integer: counted on beyond a full turn, and backwards
  int node(int i, int j) const { return ((i % around + around) % around) * lines() + j; }
  /// the line in the middle of the whole tread, or the nearest one below
  int middle_line() const { return half ? 0 : rows / 2; }
  /// computed parts of the whole
  double copies() const { return half ? 2.0 : 1.0; }
};

}  // namespace furrow
