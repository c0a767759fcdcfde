// SPDX-License-Identifier: GPL-2.0-or-later
#include "material/kernels.h"

#include <cstdlib>
#include <string>

#include <Eigen/Eigenvalues>

#include "core/error.h"
#include "core/types.h"

namespace furrow {

std::vector<const Kernels*> available_kernels() {
  std::vector<const Kernels*> list{&kernels_baseline()};
#ifdef FURROW_X86_KERNELS
  __builtin_cpu_init();
  const bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                  __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
                  __builtin_cpu_supports("f16c") && __builtin_cpu_supports("lzcnt") &&
                  __builtin_cpu_supports("movbe");
  const bool v4 = v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                  __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
                  __builtin_cpu_supports("avx512cd");
  if (v3) list.push_back(&kernels_avx2());
  if (v4) list.push_back(&kernels_avx512());
#endif
  return list;
}

namespace {

const Kernels& choose() {
  const std::vector<const Kernels*> available = available_kernels();
  const char* wish = std::getenv("FURROW_ISA");
  if (!wish) return *available.back();
  std::string names;
  for (const Kernels* kernels : available) {
    if (kernels->instruction_set == std::string(wish)) return *kernels;
    names += (names.empty() ? "" : ", ") + std::string(kernels->instruction_set);
  }
  throw InputError("environment variable FURROW_ISA",
                   "is '" + std::string(wish) + "', which this processor or build does not have",
                   names, "leave it unset to take the fastest");
}

}  // namespace

const Kernels& kernels() {
  static const Kernels& chosen = choose();
  return chosen;
}

bool large_stretch(const double* x, double* log_u, double* inverse_u) {
  Matrix3 c;
  c << 1.0 + x[0], x[3], x[5], x[3], 1.0 + x[1], x[4], x[5], x[4], 1.0 + x[2];
  if (!c.allFinite()) return false;
  const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(c);
  if (!(eigen.eigenvalues().minCoeff() > 0.0)) return false;
  const Matrix3& v = eigen.eigenvectors();
  const Matrix3 l =
      v * (0.5 * eigen.eigenvalues().array().log()).matrix().asDiagonal() * v.transpose();
  const Matrix3 u = v * eigen.eigenvalues().array().rsqrt().matrix().asDiagonal() * v.transpose();
  const int row[6] = {0, 1, 2, 0, 1, 0}, column[6] = {0, 1, 2, 1, 2, 2};
  for (int k = 0; k < 6; ++k) log_u[k] = l(row[k], column[k]), inverse_u[k] = u(row[k], column[k]);
  return true;
}

}  // namespace furrow
