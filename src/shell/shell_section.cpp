// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/shell/shell_section.h"

#include <cmath>

#include <fmt/format.h>

#include "furrow/core/options/check_number.h"
#include "furrow/core/error.h"

namespace furrow {

namespace {

void check_positive(double value, const char* name, const char* unit) {
  check_number(value, Range::positive(), fmt::format("shell section, {}", name), unit);
}

}  // namespace

OrthotropicLayer OrthotropicLayer::isotropic(double E, double nu, double thickness) {
  const double G = 0.5 * E / (1.0 + nu);
  return {E, E, nu, G, G, G, thickness};
}

ShellSection::ShellSection(const OrthotropicLayer& layer, double mass)
    : thickness(layer.thickness), areal_mass(mass) {
  check_positive(layer.E1, "E1", "Pa");
  check_positive(layer.E2, "E2", "Pa");
  check_positive(layer.G12, "G12", "Pa");
  check_positive(layer.G13, "G13", "Pa");
  check_positive(layer.G23, "G23", "Pa");
  check_positive(layer.thickness, "thickness", "m");
  check_positive(mass, "areal_mass", "kg/m^2");
  const double nu21 = layer.nu12 * layer.E2 / layer.E1;
  const double definite = 1.0 - layer.nu12 * nu21;
  if (!(definite > 0.0))
    throw InputError(
        "shell section", fmt::format("has nu12 = {}, which makes it indefinite", layer.nu12),
        fmt::format("below sqrt(E1/E2) = {:.4g} in size", std::sqrt(layer.E1 / layer.E2)));
  Matrix3 plane_stress = Matrix3::Zero();
  plane_stress(0, 0) = layer.E1 / definite;
  plane_stress(1, 1) = layer.E2 / definite;
  plane_stress(0, 1) = plane_stress(1, 0) = nu21 * layer.E1 / definite;
  plane_stress(2, 2) = layer.G12;
  membrane = layer.thickness * plane_stress;
  bending = std::pow(layer.thickness, 3) / 12.0 * plane_stress;
  shear.diagonal() << 5.0 / 6.0 * layer.thickness * layer.G13,
      5.0 / 6.0 * layer.thickness * layer.G23;
}

ShellSection::ShellSection(const OrthotropicWall& wall, double mass)
    : thickness(std::sqrt(12.0 * wall.bending2 / wall.stretch2)), areal_mass(mass) {
  check_positive(wall.stretch1, "stretch1", "N/m");
  check_positive(wall.stretch2, "stretch2", "N/m");
  check_positive(wall.shear, "shear", "N/m");
  check_positive(wall.bending1, "bending1", "N m");
  check_positive(wall.bending2, "bending2", "N m");
  check_positive(mass, "areal_mass", "kg/m^2");
  membrane.diagonal() << wall.stretch1, wall.stretch2, wall.shear;
  bending.diagonal() << wall.bending1, wall.bending2,
      0.5 * std::sqrt(wall.bending1 * wall.bending2);
  shear.diagonal().setConstant(5.0 / 6.0 * wall.shear);
}

}  // namespace furrow
