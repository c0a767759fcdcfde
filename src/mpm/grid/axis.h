// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// One direction of the background grid: quadratic B-splines on a graded knot vector with open
/// ends.
///
/// Cells lie between knots. The first and the last knot count three times:
///   t_0 = t_1 = t_2 < t_3 < ... < t_n = t_n+1 = t_n+2
/// Node i has the B-spline N_i of the knots t_i to t_i+3. Its place x_i is the Greville point
/// (t_i+1 + t_i+2)/2. On any knots sum N_i = 1 and sum N_i x_i = x: the grid carries linear fields,
/// force and moment exactly. At an end of the axis only the outermost node has a value: walls are
/// exactly there. C. de Boor, A Practical Guide to Splines (1978), ch. IX.

#include <cstddef>
#include <string>
#include <vector>

namespace furrow {

/// Layout of the cells of an axis.
struct AxisLayout {
  double lower = 0.0;  ///< [m]
  double upper = 1.0;  ///< [m]
  /// length in the fine stretch [m]; adjusted to a whole number of cells there
  double cell = 0.1;
  double fine_lower = 0.0;  ///< start of the fine stretch; outside of it cells grow [m]
  double fine_upper = 1.0;  ///< its end [m]
  /// ratio of the lengths of neighbouring cells outside the fine stretch, >= 1
  double growth = 1.0;
  /// Lengths of the cells outside, in fine cells: 1, 3/2, 2, 3, 4, 6 and so on. `growth` sets how
  /// often a length occurs. From an end of the axis to the fine stretch is a whole number of fine
  /// cells. Each cell then holds two or three whole particles, whose lengths double from 1 on.
  bool stepped = false;
  /// places where a body ends across the axis: a knot lies there, between short cells [m]
  std::vector<double> edges = {};
  /// length of the shortest cells at an edge [m]; they grow by a factor of at most 1.4
  double edge_cell = 0.0;
};

/// View of an axis for kernels (transfer/weights.h): arrays over cells and nodes, owned by the
/// axis.
struct AxisView {
  int cells;
  double lower;  ///< [m]
  /// Range of the particles [m]: the axis, or this rank's part of it.
  double particles_lower;
  double particles_upper;
  /// Table to find the cell of a position: bins of equal length, no longer than the shortest cell.
  int bins;
  double bins_per_length;  ///< [1/m]
  const int* cell_of_bin;  ///< the cell that holds the lower end of a bin
  const double* knot;      ///< cells + 1 distinct knots [m]
  const double* left;      ///< N_0 = left (t_c+1 - x)^2 [1/m^2], for each cell
  const double* right;     ///< N_2 = right (x - t_c)^2 [1/m^2], for each cell
  const double* node;      ///< cells + 2 nodes [m]; cell c is served by c, c+1, c+2
  /// 1 for a cell at an end or next to a cell of another length (transfer.h), else 0
  const int* irregular;
  /// The longest run of cells that are not irregular, all of one length.
  int regular_from;
  int regular_to;
  double regular_start;   ///< its lower end [m]
  double regular_length;  ///< of its cells [m]
};

class Axis {
 public:
  /// @throws InputError naming `where` for lengths or growth that make no axis
  Axis(const AxisLayout& layout, const std::string& where);

  /// Number of cells of a layout, without making them.
  static double cell_count(const AxisLayout& layout);

  int cells() const { return static_cast<int>(knot_.size()) - 1; }
  int nodes() const { return cells() + 2; }
  double lower() const { return knot_.front(); }
  double upper() const { return knot_.back(); }
  /// lower end of a cell [m]
  double knot(int cell) const { return knot_[static_cast<std::size_t>(cell)]; }
  double length(int cell) const { return knot(cell + 1) - knot(cell); }  ///< [m]
  double shortest() const { return shortest_; }                          ///< length of a cell [m]
  /// Shortest cell before any shift [m]: with the same bits wherever the axis has gone.
  double shortest_at_start() const { return shortest_at_start_; }
  double node(int i) const { return node_[static_cast<std::size_t>(i)]; }  ///< [m]
  /// integral of the node's B-spline [m]
  double extent(int i) const;
  bool uniform() const { return uniform_; }
  /// The cell that holds x; -1 outside.
  int cell_of(double x) const;
  AxisView view() const;

  /// Length of a cell of the fine stretch before any shift [m].
  double fine_cell() const { return fine_cell_; }
  /// Moves the whole axis by a number of fine cells.
  void shift(int cells);

 private:
  void tabulate();

  std::vector<double> knot_;
  std::vector<double> left_;
  std::vector<double> right_;
  std::vector<double> node_;
  // Knots before any shift: a position then has the same bits after any series of shifts.
  std::vector<double> initial_knot_;
  int shifted_ = 0;         // in fine cells
  double fine_cell_ = 0.0;  // [m]
  std::vector<int> cell_of_bin_;
  std::vector<int> irregular_;
  int regular_from_ = 0;
  int regular_to_ = 0;
  double shortest_ = 0.0, shortest_at_start_ = 0.0;  // [m]
  double bins_per_length_ = 0.0;                     // [1/m]
  bool uniform_ = true;
};

}  // namespace furrow
