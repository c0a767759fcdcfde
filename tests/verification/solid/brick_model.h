// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Bricks for tests: a mesh of a parameter cube mapped into space, its supports and loads, at rest
/// by Newton's method.

#include <functional>
#include <vector>

#include <Eigen/SparseCholesky>
#include <gtest/gtest.h>

#include "furrow/solid/brick8.h"

namespace furrow::test {

/// Young's modulus and Poisson's ratio as the law has them.
inline Rubber rubber_of(double E, double nu, double density = 1000.0) {
  return {{0.5 * E / (1.0 + nu), E / (3.0 * (1.0 - 2.0 * nu))}, density};
}

/// Stiffness of every brick at some positions, by central differences of its forces: the elements
/// are taken apart, so that each can be moved by itself, all at once.
class ElementTangents {
 public:
  ElementTangents(const Matrix3X& x, const std::vector<Brick8::Hexahedron>& bricks,
                  const Rubber& rubber)
      : bricks_(bricks), apart_(spread(x), separate(bricks.size()), rubber) {}

  std::vector<Matrix24> operator()(const Matrix3X& x) {
    const Matrix3X start = spread(x);
    const double h = 1e-6 * (start.col(6) - start.col(0)).norm();
    std::vector<Matrix24> K(bricks_.size());
    for (int n = 0; n < 8; ++n)
      for (int k = 0; k < 3; ++k) {
        const Matrix3X change = forces(start, n, k, -h) - forces(start, n, k, h);
        for (std::size_t e = 0; e < bricks_.size(); ++e)
          K[e].col(3 * n + k) = Eigen::Map<const Eigen::Matrix<double, 24, 1>>(
                                    change.data() + 24 * static_cast<Eigen::Index>(e)) /
                                (2.0 * h);
      }
    return K;
  }

 private:
  static std::vector<Brick8::Hexahedron> separate(std::size_t count) {
    std::vector<Brick8::Hexahedron> bricks(count);
    for (std::size_t e = 0; e < count; ++e)
      for (std::size_t n = 0; n < 8; ++n) bricks[e][n] = static_cast<int>(8 * e + n);
    return bricks;
  }
  Matrix3X spread(const Matrix3X& x) const {
    Matrix3X all(3, 8 * static_cast<Eigen::Index>(bricks_.size()));
    for (Eigen::Index e = 0; e < all.cols() / 8; ++e)
      for (Eigen::Index n = 0; n < 8; ++n)
        all.col(8 * e + n) =
            x.col(bricks_[static_cast<std::size_t>(e)][static_cast<std::size_t>(n)]);
    return all;
  }
  Matrix3X forces(Matrix3X x, int n, int k, double h) {
    for (Eigen::Index e = 0; e < x.cols() / 8; ++e) x(k, 8 * e + n) += h;
    Matrix3X f = Matrix3X::Zero(3, x.cols());
    apart_.add_forces(x, f);
    return f;
  }

  const std::vector<Brick8::Hexahedron>& bricks_;
  Brick8 apart_;
};

struct BrickModel {
  BrickModel(const Matrix3X& start, std::vector<Brick8::Hexahedron> bricks, const Rubber& material)
      : mesh(start, std::move(bricks), material),
        rubber(material),
        reference(start),
        x(start),
        load(Matrix3X::Zero(3, start.cols())),
        is_free(Matrix3X::Ones(3, start.cols())) {}
  Brick8 mesh;
  Rubber rubber;
  Matrix3X reference, x;  // [m]
  Matrix3X load;          // [N]
  Matrix3X is_free;       // 1, or 0 for a component that is held

  Matrix3X forces() {
    Matrix3X f = Matrix3X::Zero(3, x.cols());
    mesh.add_forces(x, f);
    return f;
  }
  void hold(const std::function<bool(const Vector3&)>& pick, std::initializer_list<int> axes) {
    for (Eigen::Index n = 0; n < x.cols(); ++n)
      if (pick(reference.col(n)))
        for (const int k : axes) is_free(k, n) = 0.0;
  }
  Eigen::Index nearest(const Vector3& point) const {
    Eigen::Index best = 0;
    (reference.colwise() - point).colwise().squaredNorm().minCoeff(&best);
    return best;
  }
  /// Newton's method from the present positions to rest under the load, applied in equal parts.
  void solve(int parts = 1) {
    ElementTangents tangents(reference, mesh.bricks(), rubber);
    const double size = (reference.rowwise().maxCoeff() - reference.rowwise().minCoeff()).norm();
    for (int part = 1; part <= parts; ++part) {
      double change = size;
      for (int pass = 0; pass < 30 && change > 1e-10 * size; ++pass) {
        const Matrix3X applied = double(part) / parts * load;
        const Matrix3X u = step(tangents(x), (forces() + applied).cwiseProduct(is_free));
        x += u;
        change = u.cwiseAbs().maxCoeff();
      }
      EXPECT_LE(change, 1e-10 * size) << "Newton's method does not converge";
    }
  }

 private:
  Matrix3X step(const std::vector<Matrix24>& tangents, const Matrix3X& residual) const {
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t e = 0; e < tangents.size(); ++e)
      for (int i = 0; i < 24; ++i)
        for (int j = 0; j < 24; ++j) {
          const auto row = 3 * mesh.bricks()[e][static_cast<std::size_t>(i / 3)] + i % 3;
          const auto column = 3 * mesh.bricks()[e][static_cast<std::size_t>(j / 3)] + j % 3;
          if (is_free.data()[row] * is_free.data()[column] != 0.0)
            entries.emplace_back(row, column, 0.5 * (tangents[e](i, j) + tangents[e](j, i)));
        }
    for (Eigen::Index i = 0; i < is_free.size(); ++i)
      if (is_free.data()[i] == 0.0)
        entries.emplace_back(static_cast<int>(i), static_cast<int>(i), 1.0);
    Eigen::SparseMatrix<double> K(residual.size(), residual.size());
    K.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(K);
    Matrix3X u(3, residual.cols());
    Eigen::Map<VectorX>(u.data(), u.size()) =
        factor.solve(Eigen::Map<const VectorX>(residual.data(), residual.size()));
    return u;
  }
};

/// (n + 1)(m + 1)(l + 1) nodes of map(r, s, t), each from 0 to 1.
inline BrickModel mapped_bricks(int n, int m, int l,
                                const std::function<Vector3(double, double, double)>& map,
                                const Rubber& rubber) {
  Matrix3X x(3, (n + 1) * (m + 1) * (l + 1));
  std::vector<Brick8::Hexahedron> bricks;
  const auto node = [&](int i, int j, int k) { return (k * (m + 1) + j) * (n + 1) + i; };
  for (int k = 0; k <= l; ++k)
    for (int j = 0; j <= m; ++j)
      for (int i = 0; i <= n; ++i)
        x.col(node(i, j, k)) = map(double(i) / n, double(j) / m, double(k) / l);
  for (int k = 0; k < l; ++k)
    for (int j = 0; j < m; ++j)
      for (int i = 0; i < n; ++i)
        bricks.push_back({node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k),
                          node(i, j + 1, k), node(i, j, k + 1), node(i + 1, j, k + 1),
                          node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)});
  return BrickModel(x, std::move(bricks), rubber);
}

}  // namespace furrow::test
