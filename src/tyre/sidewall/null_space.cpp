// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/tyre/sidewall/null_space.h"

#include <cmath>

namespace furrow {

namespace {

void reflect(VectorX& vector, const VectorX& reflector) {
  vector -= 2.0 * reflector.dot(vector) * reflector;
}

}  // namespace

NullSpace::NullSpace(Eigen::Index n) : n_(n), factor_(n - 2, n - 2), work_(VectorX::Zero(n)) {
  for (VectorX& reflector : reflector_) reflector.setZero(n);
}

void NullSpace::set_constraints(const VectorX& first_gradient, const VectorX& second_gradient) {
  VectorX& first = reflector_[0];
  VectorX& second = reflector_[1];
  first = first_gradient;
  second = second_gradient;
  triangle_.setZero();
  triangle_(0, 0) = first[0] > 0.0 ? -first.norm() : first.norm();
  first[0] -= triangle_(0, 0);
  first /= first.norm();
  second -= 2.0 * first.dot(second) * first;
  triangle_(0, 1) = second[0];
  second[0] = 0.0;
  triangle_(1, 1) = second[1] > 0.0 ? -second.norm() : second.norm();
  second[1] -= triangle_(1, 1);
  second /= second.norm();
}

void NullSpace::to_axes(VectorX& vector) const {
  reflect(vector, reflector_[0]);
  reflect(vector, reflector_[1]);
}

void NullSpace::from_axes(VectorX& vector) const {
  reflect(vector, reflector_[1]);
  reflect(vector, reflector_[0]);
}

// P H P = H - 2 (v w^T + w v^T) + 4 (v.w) v v^T, w = H v
void NullSpace::to_axes(Eigen::MatrixXd& symmetric) {
  for (const VectorX& v : reflector_) {
    work_.noalias() = symmetric * v;
    const double vw = v.dot(work_);
    for (Eigen::Index m = 0; m < n_; ++m) {
      const double a = 4.0 * vw * v[m] - 2.0 * work_[m];
      const double b = -2.0 * v[m];
      for (Eigen::Index k = 0; k < n_; ++k) symmetric(k, m) += a * v[k] + b * work_[k];
    }
  }
}

bool NullSpace::factorise(const Eigen::MatrixXd& hessian, double shift) {
  const Eigen::Index m = n_ - 2;
  for (Eigen::Index j = 0; j < m; ++j) {
    double pivot = hessian(j + 2, j + 2) + shift;
    for (Eigen::Index k = 0; k < j; ++k) pivot -= factor_(j, k) * factor_(j, k);
    if (!(pivot > 0.0)) return false;
    factor_(j, j) = std::sqrt(pivot);
    for (Eigen::Index i = j + 1; i < m; ++i) {
      double sum = hessian(i + 2, j + 2);
      for (Eigen::Index k = 0; k < j; ++k) sum -= factor_(i, k) * factor_(j, k);
      factor_(i, j) = sum / factor_(j, j);
    }
  }
  return true;
}

void NullSpace::solve(VectorX& vector) const {
  const Eigen::Index m = n_ - 2;
  for (Eigen::Index i = 0; i < m; ++i) {
    double sum = vector[i + 2];
    for (Eigen::Index k = 0; k < i; ++k) sum -= factor_(i, k) * vector[k + 2];
    vector[i + 2] = sum / factor_(i, i);
  }
  for (Eigen::Index i = m - 1; i >= 0; --i) {
    double sum = vector[i + 2];
    for (Eigen::Index k = i + 1; k < m; ++k) sum -= factor_(k, i) * vector[k + 2];
    vector[i + 2] = sum / factor_(i, i);
  }
}

}  // namespace furrow
