// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/fix_contact_plane.h"

#include <algorithm>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "coupling/base/checks/require_unique.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "furrow/tyre/tyre.h"
#include "update.h"

namespace furrow::coupling {

namespace {

// Largest penetration, as a fraction of the body's height: a deeper one means that the floor is too
// soft, or that the body starts inside it.
constexpr double max_depth = 0.05, max_depth_at_start = 0.01;

RigidPlaneParameters plane_parameters(const Options& options) {
  RigidPlaneParameters plane;
  plane.height = options.number("level");
  plane.friction = options.number("friction");
  plane.stiffness = options.number("stiffness");
  plane.tangential_stiffness = options.number("tangential_stiffness");
  plane.damping = options.number("damping");
  return plane;
}

double touching_area(const RigidPlane& plane) {
  double area = 0.0;
  for (Eigen::Index i = 0; i < plane.area().size(); ++i)
    if (plane.pressure()[i] > 0.0) area += plane.area()[i];
  return area;
}

}  // namespace

const StyleRow contact_plane_style =
    fix_style<FixContactPlane>("contact/plane", "contact", "contact/fix_contact_plane.md");

Schema FixContactPlane::schema() {
  Schema schema("fix contact/plane");
  declare_body(schema);
  schema.number("level", "m", Range::any(), "z of the plane");
  schema.number("friction", "", Range::non_negative(), "friction coefficient mu");
  schema.number("stiffness", "Pa/m", Range::positive(), "pressure per penetration").by_default(2e9);
  schema
      .number("tangential_stiffness", "Pa/m", Range::positive(),
              "shear stress per displacement while a node sticks")
      .by_default(1e9);
  schema.number("damping", "Pa s/m", Range::non_negative(), "pressure per approach velocity")
      .by_default(0.0);
  return schema;
}

const Outputs<FixContactPlane>& FixContactPlane::outputs() {
  using Fix = FixContactPlane;
  static const Outputs<Fix> list = {
      {"force_x", "N", "force on the body",
       [](Fix& fix) { return fix.to_whole(fix.contact_.plane.total_force()).x(); }},
      {"force_y", "N", "force on the body",
       [](Fix& fix) { return fix.to_whole(fix.contact_.plane.total_force()).y(); }},
      {"force_z", "N", "force on the body",
       [](Fix& fix) { return fix.to_whole(fix.contact_.plane.total_force()).z(); }},
      {"pressure", "Pa", "largest pressure at a node",
       [](Fix& fix) { return fix.contact_.plane.pressure().maxCoeff(); }},
      {"area", "m^2", "area of the touching nodes",
       [](Fix& fix) { return fix.symmetry_factor() * touching_area(fix.contact_.plane); }},
  };
  return list;
}

FixContactPlane::PlaneContact::PlaneContact(Body& touching, const Options& options)
    : body(touching), plane(plane_parameters(options), touching.surface()) {}

void FixContactPlane::PlaneContact::apply(double) {
  const Surface& surface = body.surface();
  const double depth = plane.parameters().height - surface.x.row(2).minCoeff();
  if (depth > 0.0) {
    const auto [lower, upper] = surface.bounds();
    if (depth > (begun ? max_depth : max_depth_at_start) * (upper[2] - lower[2]))
      throw StateError(
          begun
              ? fmt::format("the body is {:.3g} m inside the floor, more than {:g} of its height: "
                            "raise 'stiffness', {:g} Pa/m, or lower load or speed",
                            depth, max_depth, plane.parameters().stiffness)
              : fmt::format("the body starts {:.3g} m inside the floor at z = {:.4g} m: start it "
                            "above",
                            depth, plane.parameters().height));
  }
  begun = true;
  plane.press_on(body.surface());
}

/// The tread of a tyre on a floor of stiffness k and damping c is, node by node, a mass on a spring
/// and dashpot: omega^2 = k/m', 2 zeta omega = c/m' with its mass m' of an area. An explicit step
/// of dt is stable up to omega dt = 2, and with damping that lags by half a step up to c dt = m'.
void FixContactPlane::check_tyre_stability() {
  const auto* tyre = dynamic_cast<const Tyre*>(&body());
  if (!tyre) return;
  const double step = std::min(update->dt, tyre->stable_time_step());
  const RigidPlaneParameters& floor = contact_.plane.parameters();
  const double mass = tyre->tread_mass(), stiffest = 4.0 * mass / (step * step),
               softest = tyre->pressure() / (max_depth * tyre->nominal_radius());
  const auto refuse = [&](const char* key, double value, const std::string& unit,
                          const std::string& allowed) {
    throw InputError(
        options().where(key), fmt::format("is {:g} {}", value, unit), allowed,
        fmt::format("the tyre has {:.3g} kg/m^2 of tread and steps of {:.2g} s", mass, step));
  };
  if (floor.stiffness > stiffest || floor.stiffness < softest)
    refuse("stiffness", floor.stiffness, "Pa/m",
           fmt::format("{:.2g} to {:.2g} Pa/m under '{}' at {:g} Pa", softest, stiffest,
                       body_fix().id, tyre->pressure()));
  if (floor.tangential_stiffness > stiffest)
    refuse("tangential_stiffness", floor.tangential_stiffness, "Pa/m",
           fmt::format("at most {:.2g} Pa/m under '{}'", stiffest, body_fix().id));
  if (floor.damping > mass / step)
    refuse("damping", floor.damping, "Pa s/m",
           fmt::format("at most {:.2g} Pa s/m under '{}'", mass / step, body_fix().id));
}

FixContactPlane::FixContactPlane(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixContact(lammps, narg, arg, schema()), contact_(body(), options()) {
  require_unique<FixContactPlane>(
      *modify, options().subject(), fmt::format("puts a floor under '{}'", body_fix().id),
      "one level floor for each body",
      [&](FixContactPlane& other) { return &other.body_fix() == &body_fix(); });
  contribute(static_cast<Contact&>(contact_));
  provide(outputs());
}

}  // namespace furrow::coupling
