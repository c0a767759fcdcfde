// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/ground/boundary_effect.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace furrow {

namespace {

constexpr double compaction = 0.1, steps = 500;  // logarithmic strain of snow, and steps to it
constexpr double slow = 0.1;                     // [s] of a step, for laws with a rate
constexpr double wheel_pressure = 2e4;           // [Pa]
constexpr double frictional = 0.1;               // q/p where the yield surface is highest
constexpr double small_response = 0.02, small_traction = 0.01;

struct Edges {
  BoundaryEffects sides, base;
};
/// Fitted by the study ground_size (effects.csv): {a, c} of the response and of the traction.
constexpr BoundaryEffect none = {0.0, 1.0};
constexpr std::array<std::array<Edges, 2>, 3> edges = {{
    {{{{{-0.468, 0.138}, {-0.059, 0.425}}, {{-1.974, 0.226}, none}},  // sand: a wheel,
      {{{1.045, 0.626}, none}, {{3.744, 0.603}, none}}}},             // a plate
    {{{{{-0.988, 0.05}, {-0.054, 0.38}}, {{-0.193, 0.75}, none}},     // clay
      {{{-0.233, 0.241}, none}, {{0.267, 0.636}, none}}}},
    {{{{none, {0.029, 1.0}}, {{-1.62, 0.612}, {0.561, 0.583}}},  // snow
      {{{-0.931, 0.562}, none}, {{77.041, 0.189}, none}}}},
}};

const Edges& edges_of(GroundKind kind, PressedBy body) {
  return edges[static_cast<std::size_t>(kind)][static_cast<std::size_t>(body)];
}

}  // namespace

GroundKind ground_kind(const Material& material) {
  VectorX state = material.initial_state();
  const auto carried = [&state] { return -state[field::stress + 2]; };
  Matrix3 gradient = Matrix3::Zero();
  gradient(2, 2) = std::expm1(-compaction / steps);
  for (int n = 0; n < steps && carried() < wheel_pressure; ++n)
    material.update_point(gradient, state, nullptr, slow);
  if (carried() < wheel_pressure) return GroundKind::snow;
  const std::vector<Vector2> surface = material.yield_surface(state);
  const auto top = std::max_element(surface.begin(), surface.end(),
                                    [](const Vector2& a, const Vector2& b) { return a[1] < b[1]; });
  return top != surface.end() && (*top)[1] > frictional * std::abs((*top)[0]) ? GroundKind::sand
                                                                              : GroundKind::clay;
}

const char* name_of(GroundKind kind) {
  constexpr std::array<const char*, 3> names = {"sand", "clay", "snow"};
  return names[static_cast<std::size_t>(kind)];
}

double BoundaryEffect::at(double x) const { return amplitude * std::exp(-x / decay); }

double BoundaryEffect::distance(double change) const {
  const double ratio = std::abs(amplitude) / change;
  return ratio > 1.0 ? decay * std::log(ratio) : 0.0;
}

double BoundaryEffects::enough() const {
  return std::max(response.distance(small_response), traction.distance(small_traction));
}

BoundaryEffects effects_of_sides(GroundKind kind, PressedBy body) {
  return edges_of(kind, body).sides;
}

BoundaryEffects effects_of_base(GroundKind kind, PressedBy body) {
  return edges_of(kind, body).base;
}

}  // namespace furrow
