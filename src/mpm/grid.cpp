#include "mpm/grid.h"

#include <algorithm>

namespace furrow {

Grid::Grid(Axis x, Axis y, Axis z) : axes_{std::move(x), std::move(y), std::move(z)} {
  nodes_.resize(static_cast<std::size_t>(nodes(0)) * plane_size());
}

double Grid::shortest_cell() const { return std::min({axis(0).shortest(), axis(1).shortest(), axis(2).shortest()}); }

void Grid::clear(const PlaneRange& planes) {
  if (planes.to > planes.from)
    std::fill(plane(planes.from), plane(planes.from) + plane_size() * static_cast<std::size_t>(planes.to - planes.from),
              GridNode{});
}

void Grid::solve(const PlaneRange& planes) {
  GridNode* const begin = plane(planes.from);
  GridNode* const end = begin + plane_size() * static_cast<std::size_t>(std::max(0, planes.to - planes.from));
  for (GridNode* n = begin; n != end; ++n) {
    const double inverse = n->mass > 0.0 ? 1.0 / n->mass : 0.0;
    for (double& p : n->momentum) p *= inverse;
  }
}

GridView Grid::view() { return {{axes_[0].view(), axes_[1].view(), axes_[2].view()}, nodes_.front().momentum}; }

}  // namespace furrow
