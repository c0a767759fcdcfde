// SPDX-License-Identifier: GPL-2.0-or-later
#include "shell/shell4.h"

#include <cmath>
#include <limits>
#include <string>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "core/error.h"
#include "shell/shell4_block.h"
#include "simd/dispatch.h"

namespace furrow {

namespace {

constexpr double same_shape = 1e-9;  // of the element's size
// 1 + trace: a node turned by 120 degrees against its element
constexpr double straightest_limit = 1.0;
constexpr double stability_reserve = 0.9;  // for stretch, pressure and the turning of the axes

/// An element's stress-free axes in space, columns.
Matrix3 stress_free_axes(const Matrix34& x) {
  const Vector3 a = first_median(x), normal = a.cross(second_median(x));
  if (!(normal.norm() > 1e-10 * a.squaredNorm())) throw StateError("has no area");
  Matrix3 axes;
  axes.col(0) = a.normalized();
  axes.col(2) = normal.normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

Matrix34 corners(const Matrix3X& x, const Shell4::Quad& quad) {
  Matrix34 corner;
  for (int k = 0; k < 4; ++k) corner.col(k) = x.col(quad[static_cast<std::size_t>(k)]);
  return corner;
}

Vector3 corner_normal(const Matrix34& x, int k) {
  return (x.col((k + 1) % 4) - x.col(k)).cross(x.col((k + 3) % 4) - x.col(k)).normalized();
}

double largest_eigenvalue(const Eigen::MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

/// Rotary inertia per mass of an element, and its highest frequency squared with it.
struct ElementDynamics {
  double inertia_per_mass = 0.0, omega_squared = 0.0;

  ElementDynamics(const Matrix24& K, double nodal_mass, double thickness) {
    Eigen::Matrix<double, 12, 12> displacement, turn;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        displacement.block<3, 3>(3 * i, 3 * j) = K.block<3, 3>(6 * i, 6 * j);
        turn.block<3, 3>(3 * i, 3 * j) = K.block<3, 3>(6 * i + 3, 6 * j + 3);
      }
    inertia_per_mass = std::max(thickness * thickness / 12.0,
                                largest_eigenvalue(turn) / largest_eigenvalue(displacement));
    Eigen::Matrix<double, 24, 1> scale;
    for (int i = 0; i < 4; ++i) {
      scale.segment<3>(6 * i).setConstant(1.0 / std::sqrt(nodal_mass));
      scale.segment<3>(6 * i + 3).setConstant(1.0 / std::sqrt(nodal_mass * inertia_per_mass));
    }
    omega_squared = largest_eigenvalue(scale.asDiagonal() * K * scale.asDiagonal());
  }
};

}  // namespace

struct Shell4::Places {
  std::array<std::vector<int>, 4> node;
  std::array<std::vector<double>, 9> axes;
  std::vector<unsigned char> active;
  std::vector<int> element;

  void add(const Quad& quad, const Matrix3& element_axes, int number, bool is_active) {
    for (std::size_t k = 0; k < 4; ++k) node[k].push_back(quad[k]);
    for (std::size_t k = 0; k < 9; ++k) axes[k].push_back(element_axes.data()[k]);
    active.push_back(is_active);
    element.push_back(number);
  }
  Shell4Places view() const {
    Shell4Places places;
    for (std::size_t k = 0; k < 4; ++k) places.node[k] = node[k].data();
    for (std::size_t k = 0; k < 9; ++k) places.axes[k] = axes[k].data();
    places.active = active.data();
    return places;
  }
};

Shell4::~Shell4() = default;
Shell4::Shell4(Shell4&&) noexcept = default;
std::size_t Shell4::kind_count() const { return kinds_.size(); }

Shell4::Shell4(const Matrix3X& reference, std::vector<Quad> quads, const ShellSection& section,
               const std::function<Vector3(const Vector3&)>& fibre, double largest_kink)
    : quads_(std::move(quads)),
      places_(std::make_unique<Places>()),
      mass_(VectorX::Zero(reference.cols())),
      inertia_(VectorX::Zero(reference.cols())) {
  const double nearest = std::cos(largest_kink);
  std::vector<std::vector<std::pair<std::size_t, Vector3>>> around(
      static_cast<std::size_t>(reference.cols()));
  for (std::size_t e = 0; e < quads_.size(); ++e) {
    const Matrix34 x = corners(reference, quads_[e]);
    for (int k = 0; k < 4; ++k)
      around[static_cast<std::size_t>(quads_[e][static_cast<std::size_t>(k)])].emplace_back(
          e, corner_normal(x, k));
  }

  struct Prepared {
    Shell4Shape shape;
    Matrix3 axes;
  };
  std::vector<Prepared> prepared(quads_.size());
  std::vector<std::vector<std::size_t>> members;  // elements of each kind
  double fastest = 0.0;
  for (std::size_t e = 0; e < quads_.size(); ++e) {
    try {
      Prepared& p = prepared[e];
      const Matrix34 x = corners(reference, quads_[e]);
      const Vector3 centre = x.rowwise().mean();
      p.axes = stress_free_axes(x);
      p.shape.x = p.axes.transpose() * (x.colwise() - centre);
      p.shape.fibre = p.axes.transpose() * fibre(centre);
      const double across = p.shape.fibre.head<2>().norm();
      if (!(across > 1e-6 * p.shape.fibre.norm()))
        throw StateError("has its fibre along its normal");
      p.shape.fibre << p.shape.fibre.head<2>() / across, 0.0;
      for (int k = 0; k < 4; ++k) {
        const Vector3 own = corner_normal(x, k);
        Vector3 sum = Vector3::Zero();
        for (const auto& [other, normal] :
             around[static_cast<std::size_t>(quads_[e][static_cast<std::size_t>(k)])])
          if (normal.dot(own) >= nearest) sum += normal;
        p.shape.director.col(k) = p.axes.transpose() * sum.normalized();
      }
      const double size = p.shape.x.cwiseAbs().maxCoeff();
      const auto alike = [&](const std::vector<std::size_t>& kind) {
        const Shell4Shape& other = prepared[kind[0]].shape;
        return (other.x - p.shape.x).cwiseAbs().maxCoeff() < same_shape * size &&
               (other.director - p.shape.director).cwiseAbs().maxCoeff() < same_shape &&
               (other.fibre - p.shape.fibre).cwiseAbs().maxCoeff() < same_shape;
      };
      const auto found = std::find_if(members.begin(), members.end(), alike);
      if (found != members.end())
        found->push_back(e);
      else
        members.push_back({e});
    } catch (const StateError& error) {
      throw StateError(fmt::format("shell: element {} {}", e, error.what()));
    }
  }

  for (const std::vector<std::size_t>& kind_members : members) {
    const Prepared& first = prepared[kind_members[0]];
    Matrix24 K;
    try {
      K = shell4_stiffness(first.shape, section);
    } catch (const StateError& error) {
      throw StateError(fmt::format("{} (element {})", error.what(), kind_members[0]));
    }
    Shell4Kind kind;
    for (int i = 0; i < 24; ++i)
      for (int j = 0; j < 24; ++j) kind.stiffness[i][j] = K(i, j);
    for (int n = 0; n < 4; ++n)
      for (int k = 0; k < 3; ++k) kind.x[n][k] = first.shape.x(k, n);
    const Vector3 a = first_median(first.shape.x), b = second_median(first.shape.x);
    kind.p1 = 1.0 / a[0];
    kind.p2 = -b[0] / (a[0] * b[1]);
    kind.q2 = 1.0 / b[1];
    kind.first = places_->element.size();
    for (const std::size_t e : kind_members)
      places_->add(quads_[e], prepared[e].axes, static_cast<int>(e), true);
    while (places_->element.size() % shell4_padding != 0) {
      const std::size_t e = kind_members.back();
      places_->add(quads_[e], prepared[e].axes, static_cast<int>(e), false);
    }
    kind.end = places_->element.size();
    kinds_.push_back(kind);

    const double nodal_mass = 0.25 * section.areal_mass * a.cross(b).norm();
    const ElementDynamics dynamics(K, nodal_mass, section.thickness);
    fastest = std::max(fastest, dynamics.omega_squared);
    for (const std::size_t e : kind_members)
      for (const int node : quads_[e]) {
        mass_[node] += nodal_mass;
        inertia_[node] += nodal_mass * dynamics.inertia_per_mass;
      }
  }
  stable_step_ = stability_reserve * 2.0 / std::sqrt(fastest);
}

void Shell4::add_forces(ShellNodes& nodes, double pressure) {
  const Shell4Result result = kernels<Shell4Kernels>().forces(
      kinds_.data(), kinds_.size(), places_->view(), nodes.x.data(), nodes.rotation.data(),
      pressure, nodes.force.data(), nodes.moment.data());
  if (!result.finite || !(result.straightest > straightest_limit))
    throw StateError(fmt::format("shell: element {} is folded or its nodes are not finite",
                                 places_->element[result.worst_place]));
  energy_ = result.energy;
  volume_ = result.volume;
}

Eigen::SparseMatrix<double> Shell4::stiffness() const {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(quads_.size() * 576);
  for (const Shell4Kind& kind : kinds_) {
    const Eigen::Map<const Eigen::Matrix<double, 24, 24, Eigen::RowMajor>> K(&kind.stiffness[0][0]);
    for (std::size_t place = kind.first; place < kind.end; ++place) {
      if (!places_->active[place]) continue;
      Matrix3 axes;
      for (std::size_t k = 0; k < 9; ++k) axes.data()[k] = places_->axes[k][place];
      for (int i = 0; i < 8; ++i)
        for (int j = 0; j < 8; ++j) {
          const Matrix3 block = axes * K.block<3, 3>(3 * i, 3 * j) * axes.transpose();
          const int row = 6 * places_->node[static_cast<std::size_t>(i / 2)][place] + 3 * (i % 2),
                    column =
                        6 * places_->node[static_cast<std::size_t>(j / 2)][place] + 3 * (j % 2);
          for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c) entries.emplace_back(row + r, column + c, block(r, c));
        }
    }
  }
  Eigen::SparseMatrix<double> matrix(6 * mass_.size(), 6 * mass_.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace furrow
