// SPDX-License-Identifier: GPL-2.0-or-later
#include "solid/brick8.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "core/check_number.h"
#include "core/error.h"
#include "simd/dispatch.h"
#include "solid/brick8_block.h"

namespace furrow {

namespace {

// Shapes count as the same when their nodes agree to this share of their size
constexpr double same_shape = 1e-9;

/// For each node of a brick the first that is the same, so that a wedge moves as one.
using Repeats = std::array<std::size_t, 8>;

Repeats repeats_of(const Brick8::Hexahedron& nodes) {
  Repeats first;
  for (std::size_t n = 0; n < 8; ++n)
    first[n] =
        static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), nodes[n]) - nodes.begin());
  return first;
}

struct Likeness {
  Matrix38 shape;
  Repeats repeats;

  bool operator==(const Likeness& other) const {
    return repeats == other.repeats &&
           (shape - other.shape).cwiseAbs().maxCoeff() < same_shape * shape.cwiseAbs().maxCoeff();
  }
};

/// Largest omega^2 of K u = omega^2 M u [1/s^2], nodes that are repeated taken as one.
double highest_rate(const Matrix24& K, const std::array<double, 8>& mass, const Repeats& first) {
  Matrix24 merged = Matrix24::Zero();  // of the distinct nodes; zero elsewhere
  for (std::size_t a = 0; a < 8; ++a)
    for (std::size_t b = 0; b < 8; ++b) {
      const auto at = [](std::size_t node) { return 3 * static_cast<Eigen::Index>(node); };
      merged.block<3, 3>(at(first[a]), at(first[b])) +=
          K.block<3, 3>(at(a), at(b)) / std::sqrt(mass[first[a]] * mass[first[b]]);
    }
  return Eigen::SelfAdjointEigenSolver<Matrix24>(merged, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

/// All but where its elements are.
Brick8Kind make_kind(const Brick8Shape& shape, const Rubber& rubber, const Repeats& first) {
  Brick8Kind kind = {};
  std::array<double, 8> mass = {};  // a repeated node's stands at its first place
  for (std::size_t n = 0; n < 8; ++n) {
    mass[first[n]] += rubber.density * shape.share[n];
    kind.weight[n] = shape.weight[n];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      const auto column = static_cast<Eigen::Index>(n);
      kind.mean_gradient[first[n]][k] += shape.mean_gradient(row, column);
      for (std::size_t q = 0; q < 8; ++q) kind.gradient[q][n][k] = shape.gradient[q](row, column);
    }
  }
  for (std::size_t n = 0; n < 8; ++n) kind.inverse_mass[n] = mass[n] > 0.0 ? 1.0 / mass[n] : 0.0;
  kind.volume = shape.volume;
  kind.shear = rubber.law.shear;
  kind.bulk = rubber.law.bulk;
  const Matrix24 deviatoric = deviatoric_stiffness(shape, kind.shear);
  const Matrix24 volumetric = volumetric_stiffness(shape, kind.bulk);
  kind.deviatoric_rate = highest_rate(deviatoric, mass, first);
  kind.highest_rate = highest_rate(deviatoric + volumetric, mass, first);
  return kind;
}

}  // namespace

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
  std::vector<Likeness> kinds;            // what the elements of each have in common
  std::vector<std::vector<int>> members;  // elements of each
  for (std::size_t e = 0; e < bricks_.size(); ++e) {
    Matrix38 nodes;
    for (std::size_t n = 0; n < 8; ++n)
      nodes.col(static_cast<Eigen::Index>(n)) = reference.col(bricks_[e][n]);
    const Likeness own = {in_own_axes(nodes), repeats_of(bricks_[e])};
    const auto kind = std::find(kinds.begin(), kinds.end(), own);
    if (kind == kinds.end()) {
      kinds.push_back(own);
      members.push_back({static_cast<int>(e)});
    } else {
      members[static_cast<std::size_t>(kind - kinds.begin())].push_back(static_cast<int>(e));
    }
  }
  for (std::size_t k = 0; k < kinds.size(); ++k) add_kind(members[k], kinds[k].shape, rubber);
}

/// @param members elements that are alike
void Brick8::add_kind(const std::vector<int>& members, const Matrix38& shape,
                      const Rubber& rubber) {
  const auto nodes_of = [&](int e) -> const Hexahedron& {
    return bricks_[static_cast<std::size_t>(e)];
  };
  try {
    const Brick8Shape functions(shape);
    Brick8Kind kind = make_kind(functions, rubber, repeats_of(nodes_of(members[0])));
    for (const int e : members)
      for (std::size_t n = 0; n < 8; ++n)
        mass_[nodes_of(e)[n]] += rubber.density * functions.share[n];
    kind.first = places_->element.size();
    for (const int e : members) places_->add(nodes_of(e), e, true);
    while (places_->element.size() % brick8_padding != 0)
      places_->add(nodes_of(members.back()), members.back(), false);
    kind.end = places_->element.size();
    highest_rate_ = std::max(highest_rate_, kind.highest_rate);
    kinds_.push_back(kind);
  } catch (const StateError& error) {
    throw StateError(fmt::format("brick: element {} {}", members[0], error.what()));
  }
}

void Brick8::add_forces(const Matrix3X& x, Matrix3X& force) {
  const Brick8Result result = kernels<Brick8Kernels>().forces(
      kinds_.data(), kinds_.size(), places_->view(), x.data(), force.data());
  if (!result.finite || !(result.least_ratio > 0.0))
    throw StateError(
        fmt::format("brick: element {} is turned inside out or its nodes are not "
                    "finite",
                    places_->element[result.most_squeezed]));
  energy_ = result.energy;
  least_ratio_ = result.least_ratio;
  highest_rate_ = result.highest_rate;
}

}  // namespace furrow
