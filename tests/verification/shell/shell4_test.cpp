// SPDX-License-Identifier: GPL-2.0-or-later
// The shell against closed forms and conservation laws: patch tests, rigid turns, the exact
// gradient, pressure on a ring, inextensional bending, a strip rolled up, free vibration.

#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "furrow/core/error.h"
#include "furrow/core/symmetric_eigenvalues.h"
#include "shell_model.h"
#include "tests/support/max_error.h"
#include "tests/support/error_of.h"

namespace furrow::test::shell4_test {
namespace {

Vector3 along_x(const Vector3&) { return Vector3::UnitX(); }
Vector3 along_y(const Vector3&) { return Vector3::UnitY(); }

/// The belt of the tyre of [Shoop2001]: E1 3.62e10, E2 1.98e10 Pa, h 1.11 mm; nu12 and G assumed.
OrthotropicLayer belt() { return {3.62e10, 1.98e10, 0.3, 1e10, 1e10, 1e10, 1.11e-3}; }

/// MacNeal and Harder's patch of five distorted elements, 0.24 x 0.12.
ShellModel patch(const ShellSection& section) {
  Matrix3X x(3, 8);
  x << 0, 0.24, 0.24, 0, 0.04, 0.18, 0.16, 0.08,  //
      0, 0, 0.12, 0.12, 0.02, 0.03, 0.08, 0.08,   //
      0, 0, 0, 0, 0, 0, 0, 0;
  return ShellModel(x, {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}},
                    section, along_x);
}

/// Prescribes u and theta at the outer nodes as in a linear field and finds the inner ones; returns
/// the largest error there.
double patch_error(const ShellSection& section,
                   const std::function<Eigen::Matrix<double, 6, 1>(const Vector3&)>& field) {
  ShellModel model = patch(section);
  const Eigen::SparseMatrix<double>& K = model.stiffness;
  Matrix6X exact(6, 8), outer = Matrix6X::Zero(6, 8);
  for (Eigen::Index n = 0; n < 8; ++n) exact.col(n) = field(model.nodes.x.col(n));
  outer.leftCols<4>() = exact.leftCols<4>();
  const VectorX reaction = K * Eigen::Map<const VectorX>(outer.data(), 48);
  for (Eigen::Index n = 0; n < 4; ++n) model.nodes.hold(n);
  for (Eigen::Index i = 24; i < 48; ++i) model.load.data()[i] = -reaction[i];
  const Matrix6X found = model.solve();
  return (found - exact).rightCols<4>().cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff();
}

TEST(Shell4, MembranePatchTestPasses) {
  const ShellSection section(belt(), 1.0);
  for (int k = 0; k < 3; ++k)
    EXPECT_LT(patch_error(section,
                          [&](const Vector3& x) {
                            Eigen::Matrix<double, 6, 1> u = Eigen::Matrix<double, 6, 1>::Zero();
                            if (k == 0) u[0] = 1e-3 * x.x();
                            if (k == 1) u[1] = 1e-3 * x.y();
                            if (k == 2) u[0] = 1e-3 * x.y(), u[5] = -0.5e-3;
                            return u;
                          }),
              1e-10)
        << k;
}

/// w of constant curvatures, with rotations (dw/dy, -dw/dx).
TEST(Shell4, BendingAndTwistPatchTestPasses) {
  const ShellSection section(belt(), 1.0);
  for (int k = 0; k < 3; ++k)
    EXPECT_LT(patch_error(section,
                          [&](const Vector3& x) {
                            const double kxx = k == 0, kyy = k == 1, kxy = k == 2;
                            Eigen::Matrix<double, 6, 1> u = Eigen::Matrix<double, 6, 1>::Zero();
                            u[2] = 1e-3 * (0.5 * kxx * x.x() * x.x() + 0.5 * kyy * x.y() * x.y() +
                                           kxy * x.x() * x.y());
                            u[3] = 1e-3 * (kyy * x.y() + kxy * x.x());
                            u[4] = -1e-3 * (kxx * x.x() + kxy * x.y());
                            return u;
                          }),
              1e-8)
        << k;
}

/// Constant transverse shear: w = gamma x without rotation is no equilibrium of a plate (it needs a
/// moment), so the field is the thick plate's whose moment is carried at the nodes: only forces of
/// the shear at the inner nodes must vanish for a constant one.
TEST(Shell4, TransverseShearPatchTestPasses) {
  const ShellSection section(OrthotropicLayer::isotropic(1e6, 0.25, 0.05), 1.0);
  ShellModel model = patch(section);
  Matrix6X u = Matrix6X::Zero(6, 8);
  u.row(2) = 1e-3 * model.nodes.x.row(0);
  const VectorX f = model.stiffness * Eigen::Map<const VectorX>(u.data(), 48);
  double work = 0.0;
  for (Eigen::Index n = 4; n < 8; ++n) EXPECT_NEAR(f[6 * n + 2], 0.0, 1e-12 * section.shear(0, 0));
  work = 0.5 * f.dot(Eigen::Map<const VectorX>(u.data(), 48));
  EXPECT_NEAR(work / (0.5 * section.shear(0, 0) * 1e-6 * 0.24 * 0.12), 1.0, 1e-10);
}

TEST(Shell4, OnlyRigidMotionsHaveNoEnergy) {
  ShellModel model = mapped_shell(
      1, 1, [](double s, double t) { return Vector3(s + 0.1 * t, t - 0.2 * s * t, 0.15 * s * t); },
      ShellSection(OrthotropicLayer::isotropic(1e6, 0.3, 0.05), 1.0), along_x);
  const Eigen::MatrixXd K = Eigen::MatrixXd(model.stiffness);
  const VectorX eigenvalues = symmetric_eigenvalues(K);
  EXPECT_LT(std::abs(eigenvalues[5]), 1e-9 * eigenvalues[23]);
  EXPECT_GT(eigenvalues[6], 1e-6 * eigenvalues[23]);
}

TEST(Shell4, EqualShapesShareOneStiffness) {
  EXPECT_EQ(ring(0.3475, 0.157, 72, 6, ShellSection(belt(), 19.6)).shell.kind_count(), 1u);
}

/// The elements in motion have the assembled stiffness: small displacements and rotations of a
/// curved shell whose elements all differ.
TEST(Shell4, ForcesOfSmallMotionsAreTheAssembledStiffness) {
  ShellModel model = mapped_shell(
      4, 3,
      [](double s, double t) {
        return Vector3(s + 0.1 * t * t, 0.8 * t - 0.1 * s * t, 0.3 * s * s - 0.2 * s * t);
      },
      ShellSection(belt(), 19.6), along_y);
  ShellNodes& nodes = model.nodes;
  std::srand(7);
  const Matrix6X u = 1e-8 * Matrix6X::Random(6, nodes.count());
  nodes.x += u.topRows<3>();
  for (Eigen::Index n = 0; n < nodes.count(); ++n) {
    const Vector3 theta = u.col(n).tail<3>();
    nodes.set_rotation(n, Quaternion(Eigen::AngleAxisd(theta.norm(), theta.normalized())));
  }
  model.compute();
  const VectorX expected = -model.stiffness * Eigen::Map<const VectorX>(u.data(), u.size());
  Matrix6X found(6, nodes.count());
  found << nodes.force, nodes.moment;
  const Eigen::Map<const Matrix6X> linear(expected.data(), 6, nodes.count());
  const double error = (found - linear).cwiseAbs().maxCoeff();
  EXPECT_GT(linear.cwiseAbs().maxCoeff(), 0.0);
  EXPECT_LT(error, 1e-6 * linear.cwiseAbs().maxCoeff());
}

/// Forces are the gradient of the energy, at any rotation and deformation: central differences.
void check_gradient(ShellModel model) {
  ShellNodes& nodes = model.nodes;
  std::srand(5);
  nodes.x += 0.01 * Matrix3X::Random(3, nodes.count());
  const Quaternion whole(Eigen::AngleAxisd(2.5, Vector3(1, 2, -1).normalized()));
  for (Eigen::Index n = 0; n < nodes.count(); ++n) {
    nodes.x.col(n) = whole * nodes.x.col(n);
    const Vector3 turn = 0.2 * Vector3::Random();
    nodes.set_rotation(n, whole * Quaternion(Eigen::AngleAxisd(turn.norm(), turn.normalized())));
  }
  model.compute();
  const Matrix3X force = nodes.force, moment = nodes.moment;
  EXPECT_LT(force.rowwise().sum().norm(), 1e-12 * force.norm());
  Vector3 total = moment.rowwise().sum();
  for (Eigen::Index n = 0; n < nodes.count(); ++n)
    total += Vector3(nodes.x.col(n)).cross(Vector3(force.col(n)));
  EXPECT_LT(total.norm(), 1e-12 * force.norm());
  const double step = 1e-6;
  MaxError error;
  for (Eigen::Index n = 0; n < nodes.count(); n += 5)
    for (int k = 0; k < 6; ++k) {
      double energy[2];
      for (int side = 0; side < 2; ++side) {
        ShellNodes moved = nodes;
        const double h = side ? step : -step;
        if (k < 3)
          moved.x(k, n) += h;
        else
          moved.set_rotation(n, Quaternion(Eigen::AngleAxisd(h, Vector3::Unit(k - 3))) *
                                    moved.q[static_cast<std::size_t>(n)]);
        model.shell.add_forces(moved, 0.0);
        energy[side] = model.shell.energy();
      }
      const double gradient = (energy[1] - energy[0]) / (2.0 * step),
                   analytic = -(k < 3 ? force(k, n) : moment(k - 3, n));
      error.add((gradient - analytic) /
                (k < 3 ? force.cwiseAbs().maxCoeff() : moment.cwiseAbs().maxCoeff()));
    }
  EXPECT_LT(error.max(), 1e-7);
}

TEST(Shell4, ForcesAreTheGradientOfTheEnergy) {
  const ShellSection section(belt(), 19.6);
  check_gradient(ring(0.3, 0.2, 6, 2, section));
  const ShellModel polar = ring(0.3, 0.2, 6, 2, section);
  check_gradient(ShellModel(
      polar.nodes.x, polar.shell.quads(), section,
      [](const Vector3& at) { return Vector3(-at.z(), 0.0, at.x()); },
      Shell4Turning::first_median));
}

/// A square of fibres along x, stretched along them and sheared so that they slide past each other:
/// the closed form U = R^T F, and what the tension does in the shear (shell4.h).
TEST(Shell4, TensionReducesShearStiffnessInPolarAxesAlone) {
  const double stretch = 1e6, across = 2e4, G = 2e3, longer = 1.01;
  const double tension = stretch * (longer - 1.0);
  const ShellSection section(OrthotropicWall{stretch, across, G, 1.0, 1.0}, 1.0);
  Matrix3X x(3, 4);
  x << 0, 1, 1, 0,  //
      0, 0, 1, 1,   //
      0, 0, 0, 0;
  const auto angle_of = [&](double shear) { return std::atan2(shear, longer + 1.0); };
  const auto energy = [&](bool polar, double shear) {
    ShellModel model(x, {{0, 1, 2, 3}}, section, along_x,
                     polar ? Shell4Turning::polar : Shell4Turning::first_median);
    for (Eigen::Index n = 0; n < 4; ++n) {
      model.nodes.x(0, n) = longer * x(0, n) + shear * x(1, n);
      // with the mean turning of the material, which nothing holds against it
      model.nodes.set_rotation(n,
                               Quaternion(Eigen::AngleAxisd(-angle_of(shear), Vector3::UnitZ())));
    }
    model.compute();
    return model.shell.energy();
  };
  const auto closed_form = [&](bool polar, double shear) {
    const double angle = polar ? angle_of(shear) : 0.0;
    const double c = std::cos(angle), s = std::sin(angle);
    return 0.5 *
           (stretch * std::pow(longer * c - 1.0, 2) + across * std::pow(s * shear + c - 1.0, 2) +
            G * std::pow(c * shear + (longer - 1.0) * s, 2));
  };
  const double shear = 0.02;
  for (const bool polar : {true, false}) {
    EXPECT_NEAR(energy(polar, 0.3) / closed_form(polar, 0.3), 1.0, 1e-3) << polar;
    const double stiffness =
        (energy(polar, shear) + energy(polar, -shear) - 2.0 * energy(polar, 0.0)) / (shear * shear);
    EXPECT_NEAR(stiffness, polar ? G - 0.25 * tension : G, 0.02 * G) << polar;
  }
}

/// The pressure's forces are the gradient of p V of a closed shell.
TEST(Shell4, PressureIsTheGradientOfTheVolume) {
  Matrix3X x(3, 8);
  x << 0, 1, 1, 0, 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 1, 1;
  x += 0.1 * Matrix3X::Random(3, 8);
  ShellModel box(
      x, {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}},
      ShellSection(OrthotropicLayer::isotropic(1e6, 0.3, 0.01), 1.0),
      [](const Vector3&) { return Vector3(1, 2, 3); });
  box.compute(1000.0);
  const Matrix3X force = box.nodes.force;
  EXPECT_LT(force.rowwise().sum().norm(), 1e-12 * force.norm());
  const double step = 1e-6;
  ShellNodes undeformed = box.nodes;
  for (Eigen::Index n = 0; n < 8; ++n)
    for (int k = 0; k < 3; ++k) {
      double potential[2];
      for (int side = 0; side < 2; ++side) {
        ShellNodes moved = undeformed;
        moved.x(k, n) += side ? step : -step;
        box.shell.add_forces(moved, 0.0);
        potential[side] = 1000.0 * box.shell.volume() - box.shell.energy();
      }
      EXPECT_NEAR((potential[1] - potential[0]) / (2 * step), force(k, n),
                  1e-6 * force.cwiseAbs().maxCoeff());
    }
}

/// A thousand turns about a slanting axis, as the motion of a rolling tyre makes them: no strain,
/// no energy, no force.
TEST(Shell4, ManyRigidTurnsLeaveNoStrain) {
  ShellModel model = ring(0.3475, 0.157, 36, 3, ShellSection(belt(), 19.6));
  ShellNodes& nodes = model.nodes;
  const Matrix3X start = nodes.x;
  const Vector3 axis = Vector3(0.3, 1.0, -0.2).normalized(), centre(0.1, 0.2, 0.3);
  const int steps_a_turn = 97, turns = 1000;
  const double step = 2.0 * pi / steps_a_turn;
  for (Eigen::Index n = 0; n < nodes.count(); ++n) nodes.w.col(n) = axis;
  MaxError energy, force;
  for (int i = 1; i <= turns * steps_a_turn; ++i) {
    nodes.drift(step);  // turns the nodes by their spin; positions are set below
    if (i % 997 != 0) continue;
    const Matrix3 turned =
        Eigen::AngleAxisd(std::fmod(i * step, 2.0 * pi), axis).toRotationMatrix();
    nodes.x = (turned * (start.colwise() - centre)).colwise() + centre;
    model.compute();
    energy.add(model.shell.energy());
    force.add(nodes.force.cwiseAbs().maxCoeff<Eigen::PropagateNaN>());
  }
  // Scale: the energy and force of one per mille of strain
  const double area = 2.0 * pi * 0.3475 * 0.157, N = 1e-3 * 3.62e10 * 1.11e-3;
  EXPECT_LT(energy.max(), 1e-12 * 0.5 * N * 1e-3 * area);
  EXPECT_LT(force.max(), 1e-6 * N * 0.03);
}

/// A narrow ring under pressure: T = p R, radial growth p R^2/(E1 h); polygon and tension of the
/// ring in equilibrium.
TEST(Shell4, PressureOnARingGivesTensionPR) {
  const double R = 0.3475, width = 0.05, p = 241e3;
  for (const int n : {36, 72, 144}) {
    ShellModel model = ring(R, width, n, 1, ShellSection(belt(), 19.6));
    ShellNodes& nodes = model.nodes;
    // grown evenly, without turning: equilibrium is where the radial force vanishes
    const Matrix3X start = nodes.x;
    const auto radial_force = [&](double growth) {
      nodes.x = start;
      nodes.x.row(0) *= 1.0 + growth;
      nodes.x.row(2) *= 1.0 + growth;
      model.compute(p);
      return nodes.force(2, 0);
    };
    const double a = radial_force(0.0), b = radial_force(1e-3), growth = 1e-3 * a / (a - b);
    EXPECT_NEAR(radial_force(growth) / a, 0.0, 1e-6);
    // Closed form of a membrane free to contract sideways; held in width here, so the plane-strain
    // stiffness.
    const double stiffness = 3.62e10 * 1.11e-3 / (1.0 - 0.3 * 0.3 * 1.98 / 3.62);
    // p R (1 + g) = stiffness g
    const double exact = p * R / stiffness / (1.0 - p * R / stiffness);
    EXPECT_NEAR(growth / exact, 1.0, 1.5 * std::pow(2.0 * pi / n, 2)) << n;
    RecordProperty(fmt::format("growth_over_closed_form_{}", n),
                   fmt::format("{:.5f}", growth / exact));
  }
}

/// A thin ring pulled at two opposite points: growth of the loaded diameter P R^3/EI (pi/4 - 2/pi),
/// inextensional.
TEST(Shell4, InextensionalBendingOfARingIsTheClosedForm) {
  const double R = 1.0, width = 0.1, h = 0.005, E = 1e9;
  ShellModel model =
      ring(R, width, 64, 2, ShellSection(OrthotropicLayer::isotropic(E, 0.0, h), 1.0));
  const double tiny = 1e-6;
  // A quarter would do; the whole ring with supports that take no force
  model.symmetry(0, [&](const Vector3& x) { return std::abs(x.x()) < tiny; });
  model.symmetry(2, [&](const Vector3& x) { return std::abs(x.z()) < tiny; });
  model.symmetry(1, [&](const Vector3& x) { return std::abs(x.y()) < tiny; });
  const double P = 1.0;
  const double share[3] = {0.25, 0.5, 0.25};
  for (int j = 0; j < 3; ++j) {
    model.load(2, model.nearest({0, width * (0.5 * j - 0.5), R})) = P * share[j];
    model.load(2, model.nearest({0, width * (0.5 * j - 0.5), -R})) = -P * share[j];
  }
  const Matrix6X u = model.solve();
  const double EI = E * width * h * h * h / 12.0,
               exact = P * R * R * R / EI * (pi / 4.0 - 2.0 / pi);
  EXPECT_NEAR(2.0 * u(2, model.nearest({0, 0, R})) / exact, 1.0, 5e-3);
}

/// A cantilever strip with an end moment 2 pi EI/L rolls up into a circle: finite rotations. Its
/// nodes are put on that circle; what is left over as force must vanish with the square of the
/// element's turn.
TEST(Shell4, StripRolledIntoACircleIsInEquilibrium) {
  const double L = 1.0, width = 0.05, E = 1e9, h = 0.002, R = L / (2.0 * pi);
  double before = 0.0;
  for (const int n : {24, 48}) {
    ShellModel model = mapped_shell(
        n, 1, [&](double s, double t) { return Vector3(L * s, width * t, 0.0); },
        ShellSection(OrthotropicLayer::isotropic(E, 0.0, h), 1.0), along_x);
    ShellNodes& nodes = model.nodes;
    // chords keep their length: the polygon of n sides of L/n
    const double radius = 0.5 * (L / n) / std::sin(pi / n);
    for (Eigen::Index i = 0; i < nodes.count(); ++i) {
      const double angle = nodes.x(0, i) / R;
      nodes.x.col(i) << radius * std::sin(angle), nodes.x(1, i), radius * (1.0 - std::cos(angle));
      nodes.set_rotation(i, Quaternion(Eigen::AngleAxisd(-angle, Vector3::UnitY())));
    }
    // rotations at the ends are those of tangents to the circle; the first chord is half a step
    // ahead
    model.compute();
    const double moment = E * width * h * h * h / 12.0 / R;
    MaxError inner;
    for (Eigen::Index i = 0; i < nodes.count(); ++i) {
      const double at_end = i % (n + 1) == 0 || i % (n + 1) == n;
      if (at_end) continue;
      inner.add(nodes.moment.col(i).norm());
      inner.add(nodes.force.col(i).norm() * L);
    }
    EXPECT_LT(inner.max(), 1e-9 * moment * n);
    // both end nodes
    const double end = 2.0 * nodes.moment.col(n).norm(), error = std::abs(end / moment - 1.0);
    if (before > 0.0) {
      EXPECT_LT(error, 0.3 * before);
    }
    before = error;
    RecordProperty(fmt::format("end_moment_over_EI_R_{}", n), fmt::format("{:.6f}", end / moment));
  }
  EXPECT_LT(before, 2e-3);
}

/// Free vibration and tumbling with large displacements. Momentum and angular momentum stay to
/// round-off. The energy at full steps swings with the square of the step, as the leapfrog has it,
/// and does not drift.
TEST(Shell4, FreeMotionKeepsEnergyAndMomentum) {
  double swing_before = 0.0;
  for (const double share : {0.8, 0.2}) {
    ShellModel model = ring(0.3475, 0.157, 24, 2, ShellSection(belt(), 19.6));
    ShellNodes& nodes = model.nodes;
    for (Eigen::Index n = 0; n < nodes.count(); ++n) {
      const double angle = std::atan2(nodes.x(0, n), -nodes.x(2, n));
      // flies and rolls,
      nodes.v.col(n) = Vector3(2, 1, 0) + Vector3(0, 20, 0).cross(Vector3(nodes.x.col(n)));
      // and ovalises by centimetres
      nodes.v.col(n) += 3.0 * std::cos(2.0 * angle) * Vector3(nodes.x.col(n)).normalized();
      nodes.w.col(n) << 0, 20, 0;
    }
    const auto momentum = [&] { return Vector3(nodes.v * nodes.mass); };
    const auto angular = [&] {
      Vector3 sum = nodes.w * nodes.inertia;
      for (Eigen::Index n = 0; n < nodes.count(); ++n)
        sum += nodes.mass[n] * Vector3(nodes.x.col(n)).cross(Vector3(nodes.v.col(n)));
      return sum;
    };
    const double dt = share * model.shell.stable_time_step();
    const Vector3 p0 = momentum(), L0 = angular();
    MaxError swings;
    double first = 0.0, deflection = 0.0, elastic = 0.0, early = 0.0, late = 0.0;
    const long steps = std::lround(0.5 / dt);
    for (long i = 0; i < steps; ++i) {
      model.compute();
      nodes.kick(0.5 * dt);
      const double total = nodes.kinetic_energy() + model.shell.energy();
      nodes.kick(0.5 * dt);
      nodes.drift(dt);
      if (i == 0) first = total;
      swings.add(total - first);
      (2 * i < steps ? early : late) += (total - first) / (0.5 * static_cast<double>(steps));
      elastic = std::max(elastic, model.shell.energy());
      deflection = std::max(
          deflection, std::abs((nodes.x.col(0) - nodes.x.col(nodes.count() / 2)).norm() - 0.695));
    }
    const double swing = swings.max();
    EXPECT_GT(deflection, 0.02);
    EXPECT_LT(std::abs(late - early), 2e-3 * elastic);
    if (swing_before > 0.0) {
      EXPECT_LT(swing, swing_before / 10.0);
      EXPECT_LT(swing, 5e-3 * elastic);
    }
    swing_before = swing;
    EXPECT_LT((momentum() - p0).norm(), 1e-10 * p0.norm());
    EXPECT_LT((angular() - L0).norm(), 1e-10 * L0.norm());
    RecordProperty(fmt::format("at_{:.0f}_percent_of_the_stable_step", 100 * share),
                   fmt::format("energy swings by {:.1e}, drifts by {:.1e} of the elastic; ovalised "
                               "by {:.3f} m",
                               swing / elastic, std::abs(late - early) / elastic, deflection));
  }
}

/// The stated step is stable and not far below the limit.
TEST(Shell4, StableStepIsTheLimitOfStability) {
  for (const double share : {1.0, 1.4}) {
    ShellModel model = ring(0.3475, 0.157, 24, 2, ShellSection(belt(), 19.6));
    ShellNodes& nodes = model.nodes;
    nodes.v = 1e-3 * Matrix3X::Random(3, nodes.count());
    const double start = nodes.kinetic_energy();
    bool grew = false;
    for (int i = 0; i < 3000 && !grew; ++i) {
      try {
        model.compute();
      } catch (const StateError&) {
        grew = true;
        break;
      }
      nodes.kick(share * model.shell.stable_time_step());
      nodes.drift(share * model.shell.stable_time_step());
      grew = !(nodes.kinetic_energy() < 100.0 * start);
    }
    EXPECT_EQ(grew, share > 1.0);
  }
}

TEST(Shell4, InvalidShellsAreRefused) {
  const ShellSection section(belt(), 19.6);
  Matrix3X x(3, 4);
  x << 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0;
  try {
    Shell4(x, {{0, 1, 3, 2}}, section, along_x);
    FAIL();
  } catch (const StateError& error) {
    EXPECT_NE(std::string(error.what()).find("element 0"), std::string::npos) << error.what();
  }
  OrthotropicLayer bad = belt();
  bad.nu12 = 1.5;
  EXPECT_THROW(ShellSection(bad, 1.0), InputError);
  EXPECT_THROW(ShellSection(belt(), 0.0), InputError);
  const OrthotropicWall wall{1e6, 1e6, 4e5, 1.0, 1.0};
  EXPECT_NO_THROW(ShellSection(wall, 1.0));
  for (double OrthotropicWall::*stiffness :
       {&OrthotropicWall::stretch1, &OrthotropicWall::stretch2, &OrthotropicWall::shear,
        &OrthotropicWall::bending1, &OrthotropicWall::bending2}) {
    OrthotropicWall slack = wall;
    slack.*stiffness = 0.0;
    EXPECT_THROW(ShellSection(slack, 1.0), InputError);
  }

  ShellModel model = mapped_shell(
      2, 2, [](double s, double t) { return Vector3(s, t, 0); }, section, along_y);
  model.nodes.set_rotation(4, Quaternion(Eigen::AngleAxisd(2.5, Vector3::UnitX())));
  EXPECT_THAT(test::error_of<StateError>([&] { model.compute(); }),
              ::testing::HasSubstr("is folded"));
  EXPECT_THROW(model.solve(), StateError);  // no supports
}

}  // namespace
}  // namespace furrow::test::shell4_test
