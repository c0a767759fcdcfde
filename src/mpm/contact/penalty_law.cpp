// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/contact/penalty_law.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/material/material.h"

namespace furrow {

namespace {

constexpr double margin = 0.8;             // of a stiffness that is chosen
constexpr double maximum_stiffness = 1e3;  // above what a contact may have

/// An explicit step of dt needs 4 m - 2 dt c - dt^2 k > 0 in every mode, with dampers that act on
/// the velocity of the step before. A particle with the weights N_i adds to the masses m N_i, so
/// that its modes are the value u of a velocity field at the particle and the gradient times
/// sqrt(D), D = h^2/4, with unit mass (Jensen and Bessel). With dt = cfl h/c, c^2 = M/rho, and n
/// particles along a cell, dt^2 k and 2 dt c are
///   a = 12 cfl^2 K/M                       of the ground, for the gradient
///   b = n^2 cfl^2 s + 4 zeta n cfl sqrt(s)  of spring and damper, for the value at the point of
///                                          contact: u + (gradient times sqrt(D))/n
/// and the larger eigenvalue of [b, b/n; b/n, a + b/n^2] is below 4.
bool is_stable(double a, double b, double n) {
  return a < 4.0 && b < 4.0 && (4.0 - a) * (4.0 - b) > 4.0 * b / (n * n);
}

}  // namespace

/// Largest stiffness with which the law is stable on all layers.
double PenaltyLaw::largest_stiffness(const TerrainParameters& terrain,
                                     const std::string& where) const {
  const auto& per_cell = terrain.particles_per_cell;
  const double most = *std::max_element(per_cell.begin(), per_cell.end());
  const double least = *std::min_element(per_cell.begin(), per_cell.end());
  const auto stable = [&](double stiffness) {
    return std::all_of(
        terrain.layers.begin(), terrain.layers.end(), [&](const TerrainLayer& layer) {
          const ElasticModuli moduli = layer.material->moduli(layer.material->initial_state());
          const double eigenvalue = std::max(3.0 * moduli.bulk, 2.0 * moduli.shear) / moduli.wave();
          const double spring = most * terrain.cfl * std::sqrt(stiffness);
          return is_stable(4.0 * terrain.cfl * terrain.cfl * eigenvalue,
                           spring * (spring + 4.0 * damping_), least);
        });
  };
  if (!stable(0.0))
    throw InputError(where, fmt::format("presses on ground with steps of cfl {}", terrain.cfl),
                     "cfl below sqrt(M/3K), with the wave modulus M and the bulk modulus K",
                     "lower the ground's cfl");
  double allowed = 0.0, refused = maximum_stiffness;
  if (stable(refused)) return refused;
  while (refused - allowed > 1e-4 * refused) {
    const double middle = 0.5 * (allowed + refused);
    (stable(middle) ? allowed : refused) = middle;
  }
  return allowed;
}

void PenaltyLaw::fit(const TerrainParameters& terrain, const std::string& where) {
  for (const TerrainLayer& layer : terrain.layers)
    unstressed_moduli_.push_back(layer.material->moduli(layer.material->initial_state()).wave());
  const double largest = largest_stiffness(terrain, where);
  if (!stiffness_) stiffness_ = std::min(usual_stiffness, margin * largest);
  if (*stiffness_ < largest) return;
  throw InputError(where,
                   fmt::format("has a stiffness of {}, too stiff for steps of cfl {} with {} "
                               "particles along a cell and damping {}",
                               *stiffness_, terrain.cfl,
                               *std::max_element(terrain.particles_per_cell.begin(),
                                                 terrain.particles_per_cell.end()),
                               damping_),
                   fmt::format("stiffness below {:.3g}", largest),
                   "lower the stiffness, the damping, or the ground's cfl");
}

}  // namespace furrow
