// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/formats/grains.h"

#include <fmt/format.h>

#include <cmath>
#include <unordered_map>

#include "furrow/core/error.h"

namespace furrow {

void Grains::resize(std::size_t grains) {
  id.assign(grains, 0);
  x = Matrix3X::Zero(3, Eigen::Index(grains));
  v = x;
  radius = VectorX::Zero(Eigen::Index(grains));
}

Matrix3X Grains::displacement_from(const Grains& reference) const {
  std::unordered_map<std::int64_t, Eigen::Index> place;
  place.reserve(reference.size());
  for (std::size_t i = 0; i < reference.size(); ++i)
    place.emplace(reference.id[i], Eigen::Index(i));

  Matrix3X displacement(3, Eigen::Index(size()));
  for (std::size_t i = 0; i < size(); ++i) {
    const auto found = place.find(id[i]);
    if (found == place.end()) {
      displacement.col(Eigen::Index(i)).setConstant(std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    Vector3 moved = x.col(Eigen::Index(i)) - reference.x.col(found->second);
    for (int axis = 0; axis < 3; ++axis)
      if (reference.period[axis] > 0.0)
        moved[axis] = std::remainder(moved[axis], reference.period[axis]);
    displacement.col(Eigen::Index(i)) = moved;
  }
  return displacement;
}

Vector3 Grains::shift_to_image(const Vector3& place) const {
  Vector3 shift = Vector3::Zero();
  if (size() == 0) return shift;
  const Vector3 offset = place - 0.5 * (x.rowwise().minCoeff() + x.rowwise().maxCoeff());
  for (int axis = 0; axis < 3; ++axis)
    if (period[axis] > 0.0) shift[axis] = std::remainder(offset[axis], period[axis]) - offset[axis];
  return shift;
}

void Grains::check() const {
  const auto count = Eigen::Index(size());
  if (x.cols() != count || v.cols() != count || radius.size() != count)
    throw StateError(
        fmt::format("grains: {} ids, {} positions, {} velocities, {} radii; these must be as many",
                    size(), x.cols(), v.cols(), radius.size()));
  std::unordered_map<std::int64_t, Eigen::Index> seen;
  seen.reserve(size());
  for (Eigen::Index i = 0; i < count; ++i) {
    if (!seen.emplace(id[std::size_t(i)], i).second)
      throw StateError(fmt::format("grains: id {} is there twice", id[std::size_t(i)]));
    if (!x.col(i).allFinite() || !v.col(i).allFinite() || !std::isfinite(radius[i]))
      throw StateError(fmt::format("grains: position, velocity or radius of grain {} is not finite",
                                   id[std::size_t(i)]));
  }
  if (virial.cols() != 0 && virial.cols() != count)
    throw StateError(
        fmt::format("grains: {} virials for {} ids; one each, or none", virial.cols(), size()));
  if (!virial.allFinite()) throw StateError("grains: the virial of a grain is not finite");
}

}  // namespace furrow
