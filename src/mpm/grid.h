#pragma once
/// The background grid: momentum, then velocity, and mass at the nodes of three axes. It holds nothing from one step to the next.

#include <array>
#include <cstddef>
#include <vector>

#include "mpm/axis.h"
#include "mpm/transfer.h"

namespace furrow {

struct alignas(32) GridNode {
  double momentum[3];  ///< [kg m/s]; after solve() the velocity [m/s]
  double mass;         ///< [kg]
};

/// A half-open range of planes of nodes across x.
struct PlaneRange {
  int from = 0, to = 0;
  bool contains(int plane) const { return plane >= from && plane < to; }
};

class Grid {
 public:
  Grid(Axis x, Axis y, Axis z);

  const Axis& axis(int a) const { return axes_[static_cast<std::size_t>(a)]; }
  int nodes(int a) const { return axis(a).nodes(); }
  PlaneRange all_planes() const { return {0, nodes(0)}; }
  std::size_t plane_size() const { return static_cast<std::size_t>(nodes(1)) * static_cast<std::size_t>(nodes(2)); }
  double shortest_cell() const;  ///< [m]

  GridNode& node(int i, int j, int k) { return nodes_[index(i, j, k)]; }
  const GridNode& node(int i, int j, int k) const { return nodes_[index(i, j, k)]; }
  GridNode* plane(int i) { return nodes_.data() + static_cast<std::size_t>(i) * plane_size(); }

  void clear(const PlaneRange& planes);
  void solve(const PlaneRange& planes);  ///< momentum -> velocity
  void shift_x(int cells) { axes_[0].shift(cells); }
  GridView view();

 private:
  std::size_t index(int i, int j, int k) const {
    return (static_cast<std::size_t>(i) * static_cast<std::size_t>(nodes(1)) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(nodes(2)) +
           static_cast<std::size_t>(k);
  }

  std::array<Axis, 3> axes_;
  std::vector<GridNode> nodes_;
};

}  // namespace furrow
