// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Vector types and the conventions that hold everywhere in Furrow.
///
/// Units: SI (m, kg, s, N, Pa); angles in radians inside, degrees in scripts and files. Axes: x
/// along the travel, y lateral, z up; a wheel that rolls forward (+x) spins with omega_y > 0.
/// Stress: tension positive; p = -tr(sigma)/3, s = sigma + p I, J2 = s:s/2, q = sqrt(3 J2), r^3 =
/// (27/2) det s. Strain: logarithmic; compressive volumetric plastic strain is positive in
/// hardening tables. Slip: driving positive, rig/slip.h. Drawing: theory: symbols.

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace furrow {

using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Vector3i = Eigen::Vector3i;
using Matrix3X = Eigen::Matrix<double, 3, Eigen::Dynamic>;  // one column a node
using VectorX = Eigen::VectorXd;
using Quaternion = Eigen::Quaterniond;

constexpr double pi = 3.14159265358979323846;
constexpr double radians(double degrees) { return degrees * pi / 180.0; }
constexpr double degrees(double radians) { return radians * 180.0 / pi; }
constexpr double standard_gravity = 9.80665;  // m/s^2, CGPM 1901

}  // namespace furrow
