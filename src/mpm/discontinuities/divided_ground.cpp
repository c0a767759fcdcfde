// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/discontinuities/divided_ground.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace furrow {

namespace {

// Cells on each side: nodes up to one and a half cells away are divided, in whatever direction;
// particles reach them from as far, and travel by half a cell until they are sorted, as do parts.
constexpr int reach_of_nodes = 3;
constexpr int reach_of_particles = 2;
constexpr double nowhere = std::numeric_limits<double>::infinity();
// Cells: ground in a wider gap reaches no node that two parts divide.
constexpr double largest_gap = 8.0;

}  // namespace

std::vector<ThinPart> DividedGround::parts_of(const Surface& surface, double cell) {
  return find_thin_parts(surface, largest_thickness * cell, largest_gap * cell, fields);
}

std::size_t DividedGround::Box::size() const {
  if (empty()) return 0;
  std::size_t size = 1;
  for (std::size_t a = 0; a < 3; ++a) size *= static_cast<std::size_t>(to[a] - from[a]);
  return size;
}

bool DividedGround::Box::empty() const {
  return to[0] <= from[0] || to[1] <= from[1] || to[2] <= from[2];
}

bool DividedGround::Box::contains(int i, int j, int k) const {
  return i >= from[0] && i < to[0] && j >= from[1] && j < to[1] && k >= from[2] && k < to[2];
}

std::size_t DividedGround::Box::index(int i, int j, int k) const {
  return (static_cast<std::size_t>(i - from[0]) * static_cast<std::size_t>(to[1] - from[1]) +
          static_cast<std::size_t>(j - from[1])) *
             static_cast<std::size_t>(to[2] - from[2]) +
         static_cast<std::size_t>(k - from[2]);
}

void DividedGround::Box::include(const Box& other) {
  if (other.empty()) return;
  if (empty()) {
    *this = other;
    return;
  }
  for (std::size_t a = 0; a < 3; ++a) {
    from[a] = std::min(from[a], other.from[a]);
    to[a] = std::max(to[a], other.to[a]);
  }
}

DividedGround::DividedGround(Discretisation& discretisation,
                             const FaceArray<BoundaryKind>& boundary)
    : discretisation_(discretisation), boundary_(boundary) {
  discretisation_.grid.store_copies({});
}

void DividedGround::divide_by(const Surface& surface, const std::vector<ThinPart>& parts) {
  if (parts.empty()) return;
  bodies_.push_back({&surface, &parts});
  speed_ = std::max(speed_, std::sqrt(surface.v.colwise().squaredNorm().maxCoeff()));
}

/// Cells of the grid around a part; none when it is beside the grid.
DividedGround::Box DividedGround::cells_near(const BodyParts& body, const ThinPart& part,
                                             int margin) const {
  const auto [lower, upper] = part.bounds(body.surface->x);
  Box box;
  for (int a = 0; a < 3; ++a) {
    const auto n = static_cast<std::size_t>(a);
    const Axis& axis = discretisation_.grid.axis(a);
    if (upper[a] < axis.lower() || lower[a] > axis.upper()) return {};
    box.from[n] =
        std::max(0, axis.cell_of(std::clamp(lower[a], axis.lower(), axis.upper())) - margin);
    box.to[n] = std::min(
        axis.cells(), axis.cell_of(std::clamp(upper[a], axis.lower(), axis.upper())) + margin + 1);
  }
  return box;
}

/// Calls visit(i, j, k, near part) for nodes that ground of both sides of a part may reach; several
/// times for a node between parts.
template <class Visit>
void DividedGround::for_divided_nodes(Visit&& visit) const {
  const Grid& grid = discretisation_.grid;
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    for (std::size_t p = 0; p < bodies_[b].parts->size(); ++p) {
      const ThinPart& part = (*bodies_[b].parts)[p];
      const Box cells = cells_near(bodies_[b], part, reach_of_nodes);
      if (cells.empty()) continue;
      for (int i = cells.from[0]; i < cells.to[0] + 2; ++i)
        for (int j = cells.from[1]; j < cells.to[1] + 2; ++j)
          for (int k = cells.from[2]; k < cells.to[2] + 2; ++k) {
            const Vector3 x(grid.axis(0).node(i), grid.axis(1).node(j), grid.axis(2).node(k));
            const PlaceAtPart place = part.place(bodies_[b].surface->x, x);
            if (!place.beside) continue;
            double reach = 0.0;
            const int node[3] = {i, j, k};
            for (int a = 0; a < 3; ++a) {
              if (is_absorbing(a, node[a])) reach = -nowhere;
              const Axis& axis = grid.axis(a);
              const double low = axis.knot(std::max(0, node[a] - 2)),
                           high = axis.knot(std::min(axis.cells(), node[a] + 1));
              reach += std::abs(place.normal[a]) * std::max(x[a] - low, high - x[a]);
            }
            if (std::abs(place.height) < reach)
              visit(i, j, k,
                    NearPart{place.distance, static_cast<std::uint32_t>(b),
                             static_cast<std::uint32_t>(p)});
          }
    }
}

bool DividedGround::is_absorbing(int axis, int node) const {
  if (node != 0 && node != discretisation_.grid.nodes(axis) - 1) return false;
  return boundary_[static_cast<Face>(2 * axis + (node == 0 ? 0 : 1))] == BoundaryKind::absorbing;
}

void DividedGround::sort() {
  sorted_ = !bodies_.empty();
  const Grid& grid = discretisation_.grid;
  Box box = {};
  for (const BodyParts& body : bodies_)
    for (const ThinPart& part : *body.parts)
      box.include(cells_near(body, part, reach_of_nodes + 2 + reach_of_particles));
  std::vector<NearPart> near(box.size(), {nowhere, 0, 0});
  for_divided_nodes([&](int i, int j, int k, const NearPart& part) {
    constexpr int r = reach_of_particles;
    for (int x = i - 2 - r + 1; x < i + r; ++x)
      for (int y = j - 2 - r + 1; y < j + r; ++y)
        for (int z = k - 2 - r + 1; z < k + r; ++z)
          if (box.contains(x, y, z)) {
            NearPart& here = near[box.index(x, y, z)];
            if (part.distance < here.distance) here = part;
          }
  });
  std::vector<ParticleGroup>& groups = discretisation_.groups;
  const std::size_t layers = groups.size() / fields;
  std::vector<std::vector<double>> moved(groups.size());
  std::vector<std::size_t> staying;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    Particles& particles = groups[g].particles;
    staying.clear();
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const Vector3 x = particles.position(p);
      int cell[3];
      for (int a = 0; a < 3; ++a) cell[a] = box.empty() ? -1 : grid.axis(a).cell_of(x[a]);
      int field = 0;
      if (box.contains(cell[0], cell[1], cell[2])) {
        const NearPart& next = near[box.index(cell[0], cell[1], cell[2])];
        if (next.distance < nowhere) {
          const ThinPart& part = (*bodies_[next.body].parts)[next.part];
          field = part.region[part.place(bodies_[next.body].surface->x, x).height >= 0.0 ? 0 : 1];
        }
      }
      if (field == groups[g].field)
        staying.push_back(p);
      else
        particles.pack(p, moved[static_cast<std::size_t>(field) * layers + groups[g].layer]);
    }
    if (staying.size() < particles.size()) particles.reorder(staying);
  }
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (std::size_t n = 0; n < moved[g].size(); n += groups[g].particles.record_length())
      groups[g].particles.unpack(moved[g].data() + n);
}

void DividedGround::begin_interval() {
  box_ = {};
  for (const BodyParts& body : bodies_)
    for (const ThinPart& part : *body.parts) {
      Box nodes = cells_near(body, part, reach_of_nodes);
      for (int& to : nodes.to) to += nodes.empty() ? 0 : 2;
      box_.include(nodes);
    }
  nodes_.assign(box_.size(), {0, 0});
  std::vector<double> distance(box_.size(), nowhere);
  for_divided_nodes([&](int i, int j, int k, const NearPart& near) {
    const std::size_t n = box_.index(i, j, k);
    if (!(near.distance < distance[n])) return;
    distance[n] = near.distance;
    const std::array<int, 2>& region = (*bodies_[near.body].parts)[near.part].region;
    nodes_[n] = {static_cast<std::int16_t>(region[0]), static_cast<std::int16_t>(region[1])};
  });
  link();
}

/// Field that another field copies at a node.
int DividedGround::field_at(int i, int j, int k, int field) const {
  if (!box_.contains(i, j, k)) return 0;
  const DividedNode& node = nodes_[box_.index(i, j, k)];
  if (node.before == node.behind) return 0;
  return field == node.behind ? field : node.before;
}

/// Finds the nodes that this rank's particles of each field reach, and which of them have copies.
void DividedGround::link() {
  Grid& grid = discretisation_.grid;
  links_.clear();
  Box copies = box_;
  for (const ParticleGroup& group : discretisation_.groups) {
    Box box = {};
    if (group.field == 0) {
      box = box_;
    } else {
      for (std::size_t p = 0; p < group.particles.size(); ++p) {
        const Vector3 x = group.particles.quadrature_position(p);
        Box nodes;
        for (int a = 0; a < 3; ++a) {
          const int cell = grid.axis(a).cell_of(x[a]);
          nodes.from[static_cast<std::size_t>(a)] = cell;
          nodes.to[static_cast<std::size_t>(a)] = cell + 3;
        }
        box.include(nodes);
      }
      copies.include(box);
    }
    if (box.empty()) continue;
    for (int i = std::max(box.from[0], grid.stored().x.from);
         i < std::min(box.to[0], grid.stored().x.to); ++i)
      for (int j = std::max(box.from[1], grid.stored().y.from);
           j < std::min(box.to[1], grid.stored().y.to); ++j)
        for (int k = box.from[2]; k < box.to[2]; ++k)
          if (const int to = field_at(i, j, k, group.field); to != group.field)
            links_.push_back({i, j, k, group.field, to});
  }
  grid.store_copies({{copies.from[0], copies.to[0]}, {copies.from[1], copies.to[1]}});
}

void DividedGround::join_sums() {
  Grid& grid = discretisation_.grid;
  for (const Link& link : links_) {
    NodeSum& from = grid.sum(link.i, link.j, link.k, link.from);
    NodeSum& to = grid.sum(link.i, link.j, link.k, link.to);
    for (int c = 0; c < 3; ++c) to.total[c] += from.total[c];
    to.mass += from.mass;
    from = NodeSum{};
  }
}

void DividedGround::copy_motion() {
  Grid& grid = discretisation_.grid;
  for (const Link& link : links_) grid.copy_motion(link.i, link.j, link.k, link.to, link.from);
}

void DividedGround::checkpoint(Checkpoint& state) {
  state.value("divided_ground_sorted", sorted_);
  std::vector<int> box(box_.from.begin(), box_.from.end());
  box.insert(box.end(), box_.to.begin(), box_.to.end());
  state.values("box_of_divided_nodes", box);
  std::vector<int> fields;
  for (const DividedNode& node : nodes_) fields.push_back(node.before * 16 + node.behind);
  state.values("divided_nodes", fields);
  if (state.saving()) return;
  std::copy_n(box.begin(), 3, box_.from.begin());
  std::copy_n(box.begin() + 3, 3, box_.to.begin());
  nodes_.clear();
  for (const int field : fields)
    nodes_.push_back(
        {static_cast<std::int16_t>(field / 16), static_cast<std::int16_t>(field % 16)});
}

}  // namespace furrow
