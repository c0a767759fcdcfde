// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/contact/symmetry_mirror.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

constexpr double mirror_tolerance = 1e-6;  // of the surface's size

}  // namespace

SymmetryMirror::SymmetryMirror(const Surface& surface, double plane, const std::string& where)
    : image_(surface.node_count(), -1) {
  const auto [low, high] = surface.bounds();
  const double tolerance = mirror_tolerance * (high - low).norm();
  // Nodes in the order of x: the image is found without comparing all with all.
  std::vector<Eigen::Index> order(surface.node_count());
  std::iota(order.begin(), order.end(), Eigen::Index(0));
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index a, Eigen::Index b) { return surface.x(0, a) < surface.x(0, b); });
  for (std::size_t n = 0; n < image_.size(); ++n) {
    const Vector3 node = surface.x.col(static_cast<Eigen::Index>(n));
    const Vector3 image(node.x(), 2.0 * plane - node.y(), node.z());
    auto other = std::lower_bound(order.begin(), order.end(), image.x() - tolerance,
                                  [&](Eigen::Index a, double x) { return surface.x(0, a) < x; });
    for (; other != order.end() && surface.x(0, *other) <= image.x() + tolerance; ++other)
      if ((surface.x.col(*other) - image).norm() <= tolerance) image_[n] = *other;
    if (image_[n] < 0)
      throw InputError(where,
                       fmt::format("needs a surface that is its own mirror image in the plane y = "
                                   "{:.4g} m of the half model; the node at "
                                   "{:.4g} {:.4g} {:.4g} m has none",
                                   plane, node.x(), node.y(), node.z()),
                       "a wheel in the middle, without slip angle or camber",
                       "or model the whole ground");
  }
}

void SymmetryMirror::add_image(Matrix3X& forces) const {
  const Matrix3X half = forces;
  for (Eigen::Index n = 0; n < half.cols(); ++n) {
    Vector3 image = half.col(image_[static_cast<std::size_t>(n)]);
    image.y() = -image.y();
    forces.col(n) += image;
  }
}

}  // namespace furrow
