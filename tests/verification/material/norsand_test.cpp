// SPDX-License-Identifier: GPL-2.0-or-later
// NorSand against closed forms of its equations (norsand.h) and against an integration of its rate
// equations by SciPy (norsand_reference.py).

#include "furrow/material/models/norsand/norsand.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "furrow/io/formats/csv_file.h"
#include "tests/support/paths.h"

namespace furrow::norsand_test {
namespace {

using testing_paths::excess_of_cone;
using testing_paths::material_of;
using testing_paths::mixed_step;
using testing_paths::strain_of;
using testing_paths::stretch;

constexpr double M = 1.25, gamma_1kPa = 0.82, lambda = 0.02, chi = 4.0;

std::string sand(double void_ratio, double N = 0.35, const std::string& more = "H_psi 300") {
  return fmt::format(
      "norsand density 1600 e0 {} M {} gamma {} lambda {} chi {} N {} H 100 G 40e6 n 0.5 nu 0.2 pt "
      "10 {}",
      void_ratio, M, gamma_1kPa, lambda, chi, N, more);
}

const NorSand& law_of(const Material& material) { return static_cast<const NorSand&>(material); }

/// Isotropic stress with the image pressure at a share of P.
VectorX state_at(const Material& material, double pressure, double share) {
  VectorX state = material.initial_state();
  state.segment<3>(field::stress).setConstant(-pressure);
  state[NorSand::image_pressure] = share * (pressure + 10);
  return state;
}

/// A step of triaxial compression at constant lateral stress. Returns the volumetric strain.
double drained_step(const Material& material, VectorX& state, double axial, double lateral) {
  return -mixed_step(material, state, strain_of(0.3 * axial, 0.3 * axial, -axial),
                     {true, true, false}, Vector3::Constant(-lateral), 1e-9 * lateral)
              .head<3>()
              .sum();
}

double ratio_of(const VectorX& state) {
  const Invariants stress = invariants(stress_of(state));
  return stress.q / (stress.p + 10);
}

struct Reference {
  std::vector<double> void_ratio, pressure, strain, p, q, volume;
};

/// Largest deviations of p and q from the reference, over the largest p of each path.
double deviation(double first_step) {
  const CsvTable table =
      CsvTable::read(FURROW_SOURCE_DIR "/tests/verification/material/norsand_reference.csv");
  const Reference r{table.numbers("void_ratio"),   table.numbers("pressure_Pa"),
                    table.numbers("axial_strain"), table.numbers("p_Pa"),
                    table.numbers("q_Pa"),         table.numbers("volumetric_strain")};
  double worst = 0.0;
  std::unique_ptr<Material> material;
  VectorX state;
  double strain = 0.0, volume = 0.0;
  for (std::size_t row = 0; row < r.strain.size(); ++row) {
    if (row == 0 || r.strain[row] < r.strain[row - 1]) {
      material = material_of(sand(r.void_ratio[row]));
      state = state_at(*material, r.pressure[row], 0.8);
      strain = volume = 0.0;
    }
    const bool drained = r.strain[row] > 0 && r.volume[row] != 0 && r.volume[row] != r.strain[row];
    const int steps = std::max(1, static_cast<int>((r.strain[row] - strain) / first_step + 0.5));
    const double axial = (r.strain[row] - strain) / steps;
    for (int step = 0; step < steps; ++step) {
      if (drained)
        volume += drained_step(*material, state, axial, r.pressure[row]);
      else if (r.volume[row] == 0)
        material->update_point(stretch(strain_of(axial / 2, axial / 2, -axial)), state);
      else
        material->update_point(stretch(strain_of(0, 0, -axial)), state);
    }
    strain = r.strain[row];
    const Invariants end = invariants(stress_of(state));
    worst =
        std::max({worst, std::abs(end.p / r.p[row] - 1), std::abs(end.q - r.q[row]) / r.p[row]});
    if (drained) {
      EXPECT_NEAR(volume, r.volume[row], 0.01 * r.strain[row]);
    }
  }
  return worst;
}

/// Drained, undrained and confined compression, dense and loose: the update converges to the
/// integrated rate equations, with the first order of its step.
TEST(NorSandReference, PathsConvergeToTheRateForm) {
  const double coarse = deviation(8e-5), fine = deviation(2e-5);
  EXPECT_LT(fine, 0.01);
  EXPECT_LT(fine, 0.4 * coarse);
}

/// Loose and dense sand end on the critical state line at the critical stress ratio.
TEST(NorSandClosedForm, LooseAndDenseSandEndInTheSameCriticalState) {
  const double lateral = 2e4;
  for (const double void_ratio : {0.6, 0.7, 0.85, -0.6, -0.85}) {  // negative: the curved line
    const auto material =
        material_of(sand(std::abs(void_ratio), 0.35, void_ratio < 0 ? "csl_exponent 0.6" : ""));
    VectorX state = state_at(*material, lateral, 0.8);
    for (int step = 0; step < 3000; ++step) drained_step(*material, state, 5e-4, lateral);
    const double P = invariants(stress_of(state)).p + 10;
    EXPECT_NEAR(ratio_of(state), M, 0.01 * M) << void_ratio;
    EXPECT_NEAR(P, (lateral + 10) / (1 - M / 3), 0.01 * P) << void_ratio;
    EXPECT_NEAR(state[NorSand::void_ratio], law_of(*material).critical_void_ratio(P), 0.004);
  }
}

/// At the peak of a drained test no hardening remains: the stress ratio is M - (1 - N) chi psi and
/// the dilatancy of plastic flow chi psi, with the state parameter of the peak.
TEST(NorSandClosedForm, PeakAndDilatancyFollowTheStateParameter) {
  for (const double N : {0.2, 0.5, 0.7}) {
    for (const double pressure : {3e3, 1e5}) {
      for (const double void_ratio : {0.58, 0.68}) {
        const auto material = material_of(sand(void_ratio, N, ""));
        VectorX state = state_at(*material, pressure, 0.8);
        double peak = 0, psi = 0, dilatancy = 0;
        for (int step = 0; step < 1200; ++step) {
          const VectorX before = state;
          const double volume = drained_step(*material, state, 1e-4, pressure);
          if (ratio_of(state) <= peak) break;
          peak = ratio_of(state);
          const Invariants stress = invariants(stress_of(state));
          psi = state[NorSand::void_ratio] - law_of(*material).critical_void_ratio(stress.p + 10);
          // Without the elastic part, which the small change of pressure leaves
          const double elastic =
              (stress.p - invariants(stress_of(before)).p) / material->moduli(before).bulk;
          dilatancy =
              (volume - elastic) / (state[NorSand::eps_dev_pl] - before[NorSand::eps_dev_pl]);
        }
        EXPECT_LT(psi, -0.03);
        EXPECT_NEAR(peak, M - (1 - N) * chi * psi, 0.015 * peak) << N << " " << void_ratio;
        EXPECT_NEAR(dilatancy, chi * psi, 0.05 * chi * std::abs(psi) + 0.005)
            << N << " " << void_ratio;
      }
    }
  }
}

/// The peak and the fall of the strength over the slip are the same in points of any width. The
/// state parameter falls to 1/e over a slip of shear_band/((1 + e) chi).
TEST(NorSandShearBand, StrengthFallsOverTheSameSlipInAllWidths) {
  const double lateral = 2e4, band = 0.005, void_ratio = 0.6;
  const auto fall = [&](double width) {
    const auto material = material_of(
        sand(void_ratio, 0.35, fmt::format("shear_band {} band_width {}", band, width)));
    VectorX state = state_at(*material, lateral, 0.8);
    std::vector<double> ratios;  // the peak, then one at each tenth of a millimetre of slip
    double peak = 0.0, at_peak = 0.0;
    for (int step = 0; step < 200000 && ratios.size() < 20; ++step) {
      drained_step(*material, state, 2e-5 * band / width, lateral);
      const double ratio = ratio_of(state), strain = state[NorSand::eps_dev_pl];
      if (ratio > peak) {
        peak = ratio;
        at_peak = strain;
      } else if ((strain - at_peak) * width > 1e-4 * static_cast<double>(ratios.size() + 1)) {
        ratios.push_back(ratio);
      }
    }
    ratios.insert(ratios.begin(), peak);
    return ratios;
  };
  const std::vector<double> narrow = fall(band), wide = fall(4 * band), widest = fall(16 * band);
  ASSERT_EQ(narrow.size(), 21U);
  const double above = narrow[0] - M;
  EXPECT_GT(above, 0.3);
  for (std::size_t i = 0; i < narrow.size(); ++i) {
    EXPECT_NEAR(wide[i], narrow[i], 0.05 * above) << i;
    EXPECT_NEAR(widest[i], narrow[i], 0.05 * above) << i;
  }
  const double psi = (narrow[10] - M) / above, slip = 1e-3;
  EXPECT_NEAR(psi, std::exp(-(1 + void_ratio) * chi * slip / band), 0.1);
}

/// Dense sand that was pressed harder than it now is yields on the cone of the least dilatancy.
TEST(NorSandClosedForm, DensePointOnTheConeLiesOnTheYieldSurface) {
  const auto material = material_of(sand(0.58));
  VectorX state = state_at(*material, 2e3, 20.0);
  int yielding = 0;
  for (int step = 0; step < 400; ++step) {
    const double before = state[NorSand::eps_dev_pl];
    drained_step(*material, state, 5e-5, 2e3);
    const Invariants stress = invariants(stress_of(state));
    if (state[NorSand::eps_dev_pl] <= before ||
        stress.p + 10 > 0.3 * state[NorSand::image_pressure])
      continue;
    ++yielding;
    EXPECT_NEAR(material->yield_function(state), 0.0, 0.01 * stress.q);
    double on_surface = 0.0;  // q of the drawn surface at this pressure
    const std::vector<Vector2> line = material->yield_surface(state, 2000);
    for (const Vector2& point : line)
      if (point[0] <= stress.p) on_surface = point[1];
    EXPECT_NEAR(stress.q, on_surface, 0.02 * stress.q);
  }
  EXPECT_GT(yielding, 20);
}

/// At constant volume sand ends at the pressure whose critical void ratio it has.
TEST(NorSandClosedForm, ConstantVolumeEndsOnTheCriticalStateLine) {
  for (const double void_ratio : {0.68, 0.74}) {
    const auto material = material_of(sand(void_ratio, 0.35, ""));
    VectorX state = state_at(*material, 5e4, 0.8);
    for (int step = 0; step < 60000; ++step)
      material->update_point(stretch(strain_of(5e-5, 5e-5, -1e-4)), state);
    const double P = 1e3 * std::exp((gamma_1kPa - void_ratio) / lambda);
    EXPECT_NEAR(ratio_of(state), M, 0.01 * M) << void_ratio;
    EXPECT_NEAR(invariants(stress_of(state)).p / P, 1.0, 0.03) << void_ratio;
  }
}

/// In extension the smooth section has K times the critical stress ratio.
TEST(NorSandClosedForm, ExtensionHasTheRatioOfItsSection) {
  const double K = 0.72, pressure = 5e4;
  const auto material = material_of(sand(0.75, 0.35, "K 0.72 section matsuoka_nakai"));
  VectorX state = state_at(*material, pressure, 0.8);
  for (int step = 0; step < 3000; ++step)
    mixed_step(*material, state, strain_of(-2.5e-4, -2.5e-4, 5e-4), {false, false, true},
               Vector3::Constant(-pressure), 1e-9 * pressure);
  EXPECT_NEAR(ratio_of(state), K * M, 0.01 * K * M);
}

/// Dense preloaded sand is elastic in confined compression until the limit of its density.
TEST(NorSandClosedForm, PreloadedSandHasTheElasticLateralStress) {
  const double nu = 0.2;
  const auto material = material_of(sand(0.55, 0.35, "image_pressure 1e6"));
  VectorX state = material->initial_state();
  for (int step = 0; step < 200; ++step)
    material->update_point(stretch(strain_of(0, 0, -2e-5)), state);
  EXPECT_NEAR(state[0] / state[2], nu / (1 - nu), 1e-9);
  EXPECT_EQ(state[field::dissipated_energy], 0.0);
  // ... and a smaller preload yields first
  const auto softer = material_of(sand(0.55, 0.35, "image_pressure 1e3"));
  VectorX other = softer->initial_state();
  for (int step = 0; step < 200; ++step)
    softer->update_point(stretch(strain_of(0, 0, -2e-5)), other);
  EXPECT_LT(-other[2], -0.95 * state[2]);
  EXPECT_GT(other[field::dissipated_energy], 0.0);
}

/// Grains that have separated bear nothing until they are as dense again as the loosest sand that
/// has a strength, D_l = M/(1 - N).
TEST(NorSandLowStress, SeparatedSandBearsNothingUntilItIsDenseAgain) {
  const double N = 0.35;
  const auto material = material_of(sand(0.7, N, ""));
  VectorX state = state_at(*material, 2e4, 0.8);
  const auto volume_steps = [&](double each, int steps) {
    for (int step = 0; step < steps; ++step)
      material->update_point(stretch(strain_of(each, each, each)), state);
  };
  volume_steps(1e-3, 100);
  EXPECT_NEAR(invariants(stress_of(state)).p, -10.0, 1e-9);  // opened, at the tensile strength
  volume_steps(1e-3, 70);
  EXPECT_GT(state[NorSand::void_ratio], 1.5);
  const double chi_i = law_of(*material).parameters().chi_i;
  int borne = 0;
  for (int step = 0; step < 2000; ++step) {
    volume_steps(-1e-4, 1);
    const Invariants stress = invariants(stress_of(state));
    const double psi_i = state[NorSand::void_ratio] -
                         law_of(*material).critical_void_ratio(state[NorSand::image_pressure]);
    if (chi_i * psi_i > M / (1 - N)) {
      EXPECT_LT(stress.p, 100) << "at void ratio " << state[NorSand::void_ratio];
    } else if (stress.p > 2e4) {
      ++borne;
    }
  }
  EXPECT_GT(borne, 10);
}

/// Sand that opened for a moment compacts little under the first kilopascal, unless H is constant.
TEST(NorSandLowStress, SandThatOpenedBearsTheFirstLoadNearItsVoidRatio) {
  const auto compaction = [&](const std::string& hardening) {
    const auto material = material_of(sand(0.7, 0.35, hardening));
    VectorX state = state_at(*material, 2e4, 0.8);
    while (invariants(stress_of(state)).p > -9.99)
      material->update_point(stretch(strain_of(1e-5, 1e-5, 1e-5)), state);
    const double opened = state[NorSand::void_ratio];
    while (invariants(stress_of(state)).p < 1e3)
      material->update_point(stretch(strain_of(-1e-5, -1e-5, -1e-5)), state);
    return (opened - state[NorSand::void_ratio]) / (1 + opened);
  };
  EXPECT_LT(compaction(""), 0.003);
  EXPECT_GT(compaction("H_exponent 0"), 0.02);
}

/// A plunge of pressure and strain jumps of one half leave a finite state on or inside the surface.
TEST(NorSandLowStress, LongStepsStayOnTheSurface) {
  for (const double void_ratio : {0.5, 0.7, 0.9, 1.6}) {
    const auto material = material_of(sand(void_ratio));
    for (const double jump : {0.01, 0.5}) {
      VectorX state = state_at(*material, 3e4, 0.8);
      for (const Vector6& strain :
           {strain_of(0, 0, 0, jump), strain_of(jump, jump, jump), strain_of(0, 0, 0, jump),
            strain_of(-jump, -jump, -jump), strain_of(-jump, jump, 0, jump)}) {
        const VectorX before = state;
        const double heat = state[field::dissipated_energy];
        material->update_point(stretch(strain), state);
        ASSERT_TRUE(state.allFinite());
        EXPECT_LE(material->yield_function(state) / material->stress_scale(state),
                  1e-8 + excess_of_cone(*material, before, state));
        EXPECT_GE(state[field::dissipated_energy], heat);
      }
    }
  }
}

}  // namespace
}  // namespace furrow::norsand_test
