// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/solid/brick8.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "furrow/core/options/check_number.h"
#include "furrow/core/error.h"
#include "furrow/core/symmetric_eigenvalues.h"
#include "furrow/simd/dispatch.h"
#include "furrow/solid/brick8_block.h"

namespace furrow {

namespace {

// Shapes count as the same when their nodes agree to this share of their size
constexpr double same_shape = 1e-9;

/// Repeated nodes: for each node of a brick the first that is the same, so that a wedge moves as
/// one.
using Repeats = std::array<std::size_t, 8>;

Repeats repeats_of(const Brick8::Hexahedron& nodes) {
  Repeats first;
  for (std::size_t n = 0; n < 8; ++n)
    first[n] =
        static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), nodes[n]) - nodes.begin());
  return first;
}

}  // namespace

// Members of Brick8::Alike have external linkage, as it has.
namespace brick8 {

/// Shape and repeated nodes of an element. Elements that agree in both share their coefficients.
struct Likeness {
  Matrix38 shape;
  Repeats repeats;

  bool operator==(const Likeness& other) const {
    return repeats == other.repeats &&
           (shape - other.shape).cwiseAbs().maxCoeff() < same_shape * shape.cwiseAbs().maxCoeff();
  }
};

/// Stiffness and mass of an element whose repeated nodes are merged into the first of them.
struct Merged {
  Matrix24 deviatoric = Matrix24::Zero(), volumetric = Matrix24::Zero();  // stiffness [N/m]
  std::array<double, 8> mass = {};                                        // [kg] its own

  Merged(const Brick8Shape& shape, const Rubber& rubber, const Repeats& first) {
    const Matrix24 of_shear = deviatoric_stiffness(shape, rubber.law.shear);
    const Matrix24 of_bulk = volumetric_stiffness(shape, rubber.law.bulk);
    const auto at = [](std::size_t node) { return 3 * static_cast<Eigen::Index>(node); };
    for (std::size_t a = 0; a < 8; ++a) {
      mass[first[a]] += rubber.density * shape.share[a];
      for (std::size_t b = 0; b < 8; ++b) {
        deviatoric.block<3, 3>(at(first[a]), at(first[b])) += of_shear.block<3, 3>(at(a), at(b));
        volumetric.block<3, 3>(at(first[a]), at(first[b])) += of_bulk.block<3, 3>(at(a), at(b));
      }
    }
  }
  /// Stiffness of the element against the motion of a node, others fixed [N/m]: the sum over the
  /// directions.
  double stiffness(std::size_t node) const {
    const auto at = 3 * static_cast<Eigen::Index>(node);
    return (deviatoric + volumetric).diagonal().segment<3>(at).sum();
  }
};

}  // namespace brick8

namespace {

using brick8::Likeness;
using brick8::Merged;

/// Largest omega^2 of K u = omega^2 M u [1/s^2] with 1/M of each node.
double highest_rate(Matrix24 K, const double (&inverse_mass)[8]) {
  for (Eigen::Index a = 0; a < 8; ++a)
    for (Eigen::Index b = 0; b < 8; ++b)
      K.block<3, 3>(3 * a, 3 * b) *= std::sqrt(inverse_mass[a] * inverse_mass[b]);
  return symmetric_eigenvalues(K).maxCoeff();
}

/// Kind of a brick, without its elements. @param mass [kg] that each distinct node brings into one
Brick8Kind make_kind(const Brick8Shape& shape, const Merged& merged, const Rubber& rubber,
                     const Repeats& first, const std::array<double, 8>& mass) {
  Brick8Kind kind = {};
  for (std::size_t n = 0; n < 8; ++n) {
    kind.weight[n] = shape.weight[n];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      const auto column = static_cast<Eigen::Index>(n);
      kind.mean_gradient[first[n]][k] += shape.mean_gradient(row, column);
      for (std::size_t q = 0; q < 8; ++q) kind.gradient[q][n][k] = shape.gradient[q](row, column);
    }
    kind.inverse_mass[n] = first[n] == n ? 1.0 / mass[n] : 0.0;
  }
  kind.volume = shape.volume;
  kind.shear = rubber.law.shear;
  kind.bulk = rubber.law.bulk;
  kind.deviatoric_rate = highest_rate(merged.deviatoric, kind.inverse_mass);
  kind.highest_rate = highest_rate(merged.deviatoric + merged.volumetric, kind.inverse_mass);
  return kind;
}

}  // namespace

/// Elements of one stress-free shape.
struct Brick8::Alike {
  Likeness likeness;
  Brick8Shape shape;
  Merged merged;
  std::vector<int> members;

  /// @throws StateError for a shape without volume or turned inside out
  Alike(const Likeness& of, const Rubber& rubber)
      : likeness(of), shape(of.shape), merged(shape, rubber, of.repeats) {}
};

struct Brick8::Places {
  std::array<std::vector<int>, 8> node;
  std::vector<unsigned char> active;
  std::vector<int> element;

  void add(const Hexahedron& nodes, int number, bool is_active) {
    for (std::size_t k = 0; k < 8; ++k) node[k].push_back(nodes[k]);
    active.push_back(is_active);
    element.push_back(number);
  }
  Brick8Places view() const {
    Brick8Places places;
    for (std::size_t k = 0; k < 8; ++k) places.node[k] = node[k].data();
    places.active = active.data();
    return places;
  }
};

Brick8::~Brick8() = default;
Brick8::Brick8(Brick8&&) noexcept = default;
std::size_t Brick8::kind_count() const { return kinds_.size(); }
double Brick8::stable_time_step() const { return 2.0 / std::sqrt(highest_rate_); }
void Brick8::checkpoint(Checkpoint& state) { state.value("highest_rate", highest_rate_); }

Brick8::Brick8(const Matrix3X& reference, std::vector<Hexahedron> bricks, const Rubber& rubber)
    : bricks_(std::move(bricks)),
      places_(std::make_unique<Places>()),
      mass_(VectorX::Zero(reference.cols())) {
  check_number(rubber.law.shear, Range::positive(), "rubber, shear modulus", "Pa");
  check_number(rubber.law.bulk, Range::positive(), "rubber, bulk modulus", "Pa");
  check_number(rubber.density, Range::positive(), "rubber, density", "kg/m3");
  std::vector<Alike> kinds;
  for (std::size_t e = 0; e < bricks_.size(); ++e) {
    Matrix38 nodes;
    for (std::size_t n = 0; n < 8; ++n)
      nodes.col(static_cast<Eigen::Index>(n)) = reference.col(bricks_[e][n]);
    const Likeness own = {in_own_axes(nodes), repeats_of(bricks_[e])};
    auto kind = std::find_if(kinds.begin(), kinds.end(),
                             [&](const Alike& other) { return other.likeness == own; });
    try {
      if (kind == kinds.end()) kind = kinds.insert(kinds.end(), Alike(own, rubber));
    } catch (const StateError& error) {
      throw StateError(fmt::format("brick: element {} {}", e, error.what()));
    }
    kind->members.push_back(static_cast<int>(e));
  }
  VectorX stiffness = VectorX::Zero(reference.cols());  // [N/m] of all elements at a node
  for (const Alike& kind : kinds)
    for (const int e : kind.members)
      for (std::size_t n = 0; n < 8; ++n) {
        if (kind.likeness.repeats[n] != n) continue;
        mass_[nodes_of(e)[n]] += kind.merged.mass[n];
        stiffness[nodes_of(e)[n]] += kind.merged.stiffness(n);
      }
  for (const Alike& kind : kinds) add_kind(kind, stiffness, rubber);
}

/// No motion of the mesh is faster than that of its fastest element, for any division of the mass
/// of a node among its elements: u.K u = sum u.K_e u <= sum omega_e^2 u.M_e u <= max omega_e^2 u.M
/// u. It is divided in proportion to the stiffness, so that the mass of neighbouring bricks
/// stabilises a thin wedge.
void Brick8::add_kind(const Alike& alike, const VectorX& stiffness, const Rubber& rubber) {
  std::array<double, 8> mass;
  mass.fill(std::numeric_limits<double>::infinity());
  for (const int e : alike.members)  // minimum over the elements of one kind
    for (std::size_t n = 0; n < 8; ++n) {
      const int node = nodes_of(e)[n];
      mass[n] = std::min(mass[n], mass_[node] * alike.merged.stiffness(n) / stiffness[node]);
    }
  Brick8Kind kind = make_kind(alike.shape, alike.merged, rubber, alike.likeness.repeats, mass);
  kind.first = places_->element.size();
  for (const int e : alike.members) places_->add(nodes_of(e), e, true);
  while (places_->element.size() % brick8_padding != 0)
    places_->add(nodes_of(alike.members.back()), alike.members.back(), false);
  kind.end = places_->element.size();
  highest_rate_ = std::max(highest_rate_, kind.highest_rate);
  kinds_.push_back(kind);
}

void Brick8::add_forces(const Matrix3X& x, Matrix3X& force) {
  const Brick8Result result = kernels<Brick8Kernels>().forces(
      kinds_.data(), kinds_.size(), places_->view(), x.data(), force.data());
  if (!result.finite || !(result.minimum_ratio > 0.0))
    throw StateError(
        fmt::format("brick: element {} is turned inside out or its nodes are not "
                    "finite",
                    places_->element[result.most_squeezed]));
  energy_ = result.energy;
  minimum_ratio_ = result.minimum_ratio;
  highest_rate_ = result.highest_rate;
}

}  // namespace furrow
