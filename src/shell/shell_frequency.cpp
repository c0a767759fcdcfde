// SPDX-License-Identifier: GPL-2.0-or-later
#include "shell/shell_frequency.h"

#include <cmath>
#include <random>

#include <Eigen/Eigenvalues>

namespace furrow {

namespace {

constexpr int lanczos_steps = 60;

/// M^-1/2 K M^-1/2 of the whole mesh.
class ScaledStiffness {
 public:
  ScaledStiffness(const std::vector<Shell4Element>& elements, const std::vector<ShellGroup>& groups,
                  const VectorX& mass, const VectorX& inertia)
      : elements_(elements), groups_(groups), scale_(6 * mass.size()) {
    const auto inverse_root = [](double m) { return m > 0.0 ? 1.0 / std::sqrt(m) : 0.0; };
    for (Eigen::Index n = 0; n < mass.size(); ++n) {
      scale_.segment<3>(6 * n).setConstant(inverse_root(mass[n]));
      scale_.segment<3>(6 * n + 3).setConstant(inverse_root(inertia[n]));
    }
  }

  VectorX operator*(const VectorX& u) const {
    const VectorX scaled = scale_.cwiseProduct(u);
    VectorX sum = VectorX::Zero(u.size());
    Eigen::Matrix<double, 24, 1> local;
    for (const ShellGroup& group : groups_)
      for (const int e : group.members) {
        const Shell4Element& element = elements_[static_cast<std::size_t>(e)];
        visit(element, [&](int own, int of_mesh) {
          local.segment<3>(own) = element.axes.transpose() * scaled.segment<3>(of_mesh);
        });
        local = (group.K * local).eval();
        visit(element, [&](int own, int of_mesh) {
          sum.segment<3>(of_mesh) += element.axes * local.segment<3>(own);
        });
      }
    return scale_.cwiseProduct(sum);
  }
  Eigen::Index size() const { return scale_.size(); }
  VectorX random() const {
    std::minstd_rand engine(1);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    VectorX u(size());
    for (Eigen::Index i = 0; i < size(); ++i) u[i] = scale_[i] > 0.0 ? uniform(engine) : 0.0;
    return u;
  }

 private:
  /// Where the displacements and rotations of an element's nodes begin, its own and the mesh's.
  template <class Visit>
  static void visit(const Shell4Element& element, Visit visit_three) {
    for (int n = 0; n < 4; ++n)
      for (int k = 0; k < 6; k += 3)
        visit_three(6 * n + k, 6 * element.nodes[static_cast<std::size_t>(n)] + k);
  }

  const std::vector<Shell4Element>& elements_;
  const std::vector<ShellGroup>& groups_;
  VectorX scale_;
};

}  // namespace

double highest_frequency_squared(const std::vector<Shell4Element>& elements,
                                 const std::vector<ShellGroup>& groups, const VectorX& mass,
                                 const VectorX& inertia) {
  const ScaledStiffness A(elements, groups, mass, inertia);
  VectorX before = VectorX::Zero(A.size());
  VectorX now = A.random().normalized();
  Eigen::MatrixXd tridiagonal = Eigen::MatrixXd::Zero(lanczos_steps, lanczos_steps);
  for (int k = 0; k < lanczos_steps; ++k) {
    VectorX next = A * now;
    tridiagonal(k, k) = next.dot(now);
    if (k > 0) next -= tridiagonal(k, k - 1) * before;
    next -= tridiagonal(k, k) * now;
    const double norm = next.norm();
    if (k + 1 == lanczos_steps || !(norm > 1e-12 * tridiagonal(0, 0))) break;
    tridiagonal(k, k + 1) = tridiagonal(k + 1, k) = norm;
    before = now;
    now = next / norm;
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(tridiagonal, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

}  // namespace furrow
