// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The part of a body's surface that faces the ground, cut along the cells of a height field.

#include <vector>

#include "furrow/geometry/surface.h"
#include "furrow/scm/height_field.h"

namespace furrow {

/// A piece is the part of a triangle within a cell, seen from above. The pieces of a body have the
/// area of its outline, for cells of any size. A cell carries no more than its area: where the body
/// lies above itself, the lowest pieces count. A piece higher than the lowest one of its cell by
/// more than three cells does not count. All arrays keep their memory between steps.
class Footprint {
 public:
  /// Height by which a piece may be above the lowest one of its cell [cells]. A steeper face over a
  /// cell counts with its foot only.
  static constexpr double highest_piece = 3.0;

  struct Pieces {
    std::vector<int> slot;         // place of the cell in Cells
    std::vector<int> triangle;     // ascending
    std::vector<double> area;      // seen from above [m^2]
    std::vector<double> height;    // z of its centroid [m]
    std::vector<double> weight_b;  // barycentric, of the triangle's second node
    std::vector<double> weight_c;  // weight of the third corner
    std::vector<std::size_t>
        outline;  // index of the first corner of each piece, and the end of the last
    std::vector<Vector2> corners;  // [m]
    std::size_t size() const { return area.size(); }
  };
  struct Cells {
    std::vector<std::size_t> cell;  // number in the field
    std::vector<double> area;       // covered [m^2]
    std::vector<double> height;     // mean z of the pieces [m]
    std::size_t size() const { return cell.size(); }
  };

  /// Finds the pieces of triangles that reach below the highest surface of the field, and of those
  /// next to them: the height of a cell is the mean over all that covers it.
  /// @throws StateError when one of them reaches an edge of the field
  void find(const Surface& body, const HeightField& field);
  const Pieces& pieces() const { return pieces_; }
  const Cells& cells() const { return cells_; }
  /// Place of a cell of the field in cells(); -1: not covered.
  int slot(std::size_t cell) const { return slot_of_[cell]; }

 private:
  struct Polygon;
  void clear();
  void cut(const Surface& body, const HeightField& field, int triangle);
  void add(const Polygon& polygon, std::size_t cell, int triangle, const Surface& body);
  void drop_high(double allowed);
  void drop_covered(double cell_area);
  void find_heights();

  Pieces pieces_;
  Cells cells_;
  std::vector<int> slot_of_;        // of every cell of the field; -1: not covered
  std::vector<double> lowest_;      // piece of each covered cell [m]
  std::vector<std::size_t> order_;  // of the pieces of an overfull cell
};

}  // namespace furrow
