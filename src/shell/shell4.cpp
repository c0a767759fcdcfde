// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/shell/shell4.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/core/symmetric_eigenvalues.h"
#include "furrow/shell/shell4_block.h"
#include "furrow/simd/dispatch.h"

namespace furrow {

namespace {

// 4 cos^2(angle/2) of a node that is rotated by 120 degrees against its element
constexpr double folded_four_cos2 = 1.0;
constexpr double stability_reserve = 0.9;  // for stretch, pressure and the turning of the axes

double largest_eigenvalue(const Eigen::MatrixXd& symmetric) {
  return symmetric_eigenvalues(symmetric).maxCoeff();
}

/// Rotary inertia per mass of an element, and its highest frequency squared with it.
struct ElementDynamics {
  double inertia_per_mass = 0.0;  // [m^2]
  double omega_squared = 0.0;     // [1/s^2]

  ElementDynamics(const Matrix24& K, double nodal_mass, double thickness) {
    Eigen::Matrix<double, 12, 12> displacement;
    Eigen::Matrix<double, 12, 12> rotation;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        displacement.block<3, 3>(3 * i, 3 * j) = K.block<3, 3>(6 * i, 6 * j);
        rotation.block<3, 3>(3 * i, 3 * j) = K.block<3, 3>(6 * i + 3, 6 * j + 3);
      }
    inertia_per_mass = std::max(thickness * thickness / 12.0,
                                largest_eigenvalue(rotation) / largest_eigenvalue(displacement));
    Eigen::Matrix<double, 24, 1> scale;
    for (int i = 0; i < 4; ++i) {
      scale.segment<3>(6 * i).setConstant(1.0 / std::sqrt(nodal_mass));
      scale.segment<3>(6 * i + 3).setConstant(1.0 / std::sqrt(nodal_mass * inertia_per_mass));
    }
    omega_squared = largest_eigenvalue(scale.asDiagonal() * K * scale.asDiagonal());
  }
};

constexpr double same_stiffness = 1e-9;  // of the largest

/// K of the mirror image (Shell4Mirror).
Matrix24 mirror_image(const Matrix24& K) {
  std::array<int, 24> other;  // component of the node across the mirror
  for (int pair = 0; pair < 2; ++pair)
    for (int k = 0; k < 6; ++k) {
      const int own = 6 * Shell4Mirror::first[pair] + k, image = 6 * Shell4Mirror::second[pair] + k;
      other[static_cast<std::size_t>(own)] = image;
      other[static_cast<std::size_t>(image)] = own;
    }
  Matrix24 image;
  for (int i = 0; i < 24; ++i)
    for (int j = 0; j < 24; ++j)
      image(i, j) = Shell4Mirror::sign[i % 6] * Shell4Mirror::sign[j % 6] *
                    K(other[static_cast<std::size_t>(i)], other[static_cast<std::size_t>(j)]);
  return image;
}

/// With e = u + P u and o = u - P u of the first node of each pair, and both of K's blocks between
/// first nodes (A) and from second to first ones (B): g = (A + B P)/2 e + (A - B P)/2 o.
void split(const Matrix24& K, Shell4Kind& kind) {
  for (int pair = 0; pair < 2; ++pair)
    for (int from = 0; from < 2; ++from)
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) {
          const int row = 6 * Shell4Mirror::first[pair] + i;
          const double A = K(row, 6 * Shell4Mirror::first[from] + j),
                       BP = K(row, 6 * Shell4Mirror::second[from] + j) * Shell4Mirror::sign[j];
          kind.mirror_even[6 * pair + i][6 * from + j] = 0.5 * (A + BP);
          kind.mirror_odd[6 * pair + i][6 * from + j] = 0.5 * (A - BP);
        }
}

/// Kind of an element, without the place of its elements.
Shell4Kind make_kind(const Shell4Shape& shape, const Matrix24& K, Shell4Turning turning) {
  Shell4Kind kind = {};
  const Matrix24 image = mirror_image(K);
  kind.mirrored = (image - K).cwiseAbs().maxCoeff() < same_stiffness * K.cwiseAbs().maxCoeff();
  if (kind.mirrored) split(0.5 * (K + image), kind);
  for (int i = 0; i < 24; ++i)
    for (int j = 0; j < 24; ++j) kind.stiffness[i][j] = K(i, j);
  for (int n = 0; n < 4; ++n)
    for (int k = 0; k < 3; ++k) kind.x[n][k] = shape.x(k, n);
  const Vector3 a = first_median(shape.x);
  const Vector3 b = second_median(shape.x);
  const bool polar = turning == Shell4Turning::polar;
  kind.p1 = 1.0 / a[0];
  kind.p2 = polar ? -b[0] / (a[0] * b[1]) : 0.0;
  kind.q2 = polar ? 1.0 / b[1] : 0.0;
  return kind;
}

}  // namespace

struct Shell4::Places {
  std::array<std::vector<int>, 4> node;
  std::array<std::vector<double>, 4> axes;
  std::vector<int> element;
  std::vector<double> on_node;  // 8 numbers each

  void add(const Shell4Element& added, int number) {
    const Quaternion turn(added.axes);
    for (std::size_t k = 0; k < 4; ++k) node[k].push_back(added.nodes[k]);
    for (std::size_t k = 0; k < 4; ++k) axes[k].push_back(turn.coeffs()[Eigen::Index(k)]);
    element.push_back(number);
  }
  Shell4Places view() const {
    Shell4Places places;
    for (std::size_t k = 0; k < 4; ++k) {
      places.node[k] = node[k].data();
      places.axes[k] = axes[k].data();
    }
    return places;
  }
};

Shell4::~Shell4() = default;
Shell4::Shell4(Shell4&&) noexcept = default;
std::size_t Shell4::kind_count() const { return kinds_.size(); }

Shell4::Shell4(const Matrix3X& reference, std::vector<Quad> quads, const ShellSection& section,
               const std::function<Vector3(const Vector3&)>& fibre, Shell4Turning turning,
               double largest_kink)
    : quads_(std::move(quads)),
      places_(std::make_unique<Places>()),
      mass_(VectorX::Zero(reference.cols())),
      inertia_(VectorX::Zero(reference.cols())) {
  const std::vector<Shell4Element> elements =
      shell4_elements(reference, quads_, fibre, largest_kink);
  std::vector<std::vector<int>> kinds;  // elements of each
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const auto kind =
        std::find_if(kinds.begin(), kinds.end(), [&](const std::vector<int>& members) {
          return alike(elements[static_cast<std::size_t>(members[0])].shape, elements[e].shape);
        });
    if (kind != kinds.end())
      kind->push_back(static_cast<int>(e));
    else
      kinds.push_back({static_cast<int>(e)});
  }
  stable_step_ = std::numeric_limits<double>::infinity();
  for (const std::vector<int>& members : kinds) add_kind(elements, members, section, turning);
}

/// @param members elements that are alike
void Shell4::add_kind(const std::vector<Shell4Element>& elements, const std::vector<int>& members,
                      const ShellSection& section, Shell4Turning turning) {
  const Shell4Shape& shape = elements[static_cast<std::size_t>(members[0])].shape;
  Matrix24 K;
  try {
    K = shell4_stiffness(shape, section);
  } catch (const StateError& error) {
    throw StateError(fmt::format("{} (element {})", error.what(), members[0]));
  }
  Shell4Kind kind = make_kind(shape, K, turning);
  kind.first = places_->element.size();
  for (const int e : members) places_->add(elements[static_cast<std::size_t>(e)], e);
  kind.last = places_->element.size();
  while (places_->element.size() % shell4_padding != 0)
    places_->add(elements[static_cast<std::size_t>(members.back())], members.back());
  kinds_.push_back(kind);

  const double area = first_median(shape.x).cross(second_median(shape.x)).norm();
  const double nodal_mass = 0.25 * section.areal_mass * area;
  const ElementDynamics dynamics(K, nodal_mass, section.thickness);
  stable_step_ =
      std::min(stable_step_, stability_reserve * 2.0 / std::sqrt(dynamics.omega_squared));
  for (const int e : members)
    for (const int node : quads_[static_cast<std::size_t>(e)]) {
      mass_[node] += nodal_mass;
      inertia_[node] += nodal_mass * dynamics.inertia_per_mass;
    }
}

void Shell4::add_forces(ShellNodes& nodes, double pressure) {
  std::vector<double>& on_node = places_->on_node;
  on_node.assign(8 * nodes.q.size(), 0.0);
  const Shell4Result result =
      kernels<Shell4Kernels>().forces(kinds_.data(), kinds_.size(), places_->view(), nodes.x.data(),
                                      nodes.q[0].coeffs().data(), pressure, on_node.data());
  if (!result.finite || !(result.minimum_four_cos2 > folded_four_cos2))
    throw StateError(fmt::format("shell: element {} is folded or its nodes are not finite",
                                 places_->element[result.most_rotated]));
  for (Eigen::Index n = 0; n < nodes.count(); ++n) {
    const double* sum = on_node.data() + 8 * n;
    for (int k = 0; k < 3; ++k) {
      nodes.force(k, n) += sum[k];
      nodes.moment(k, n) += sum[4 + k];
    }
  }
  energy_ = result.energy;
  volume_ = result.volume;
}

}  // namespace furrow
