// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/fix_contact_plane.h"

namespace furrow::coupling {

namespace {

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

Schema FixContactPlane::schema() {
  Schema schema("fix contact/plane");
  declare_body(schema);
  schema.number("level", "m", Range::any(), "z of the floor");
  schema.number("friction", "", Range::non_negative(), "Coulomb's mu");
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
       [](Fix& fix) { return fix.contact_.plane.total_force().x(); }},
      {"force_y", "N", "force on the body",
       [](Fix& fix) { return fix.contact_.plane.total_force().y(); }},
      {"force_z", "N", "force on the body",
       [](Fix& fix) { return fix.contact_.plane.total_force().z(); }},
      {"pressure", "Pa", "largest pressure at a node",
       [](Fix& fix) { return fix.contact_.plane.pressure().maxCoeff(); }},
      {"area", "m^2", "area of the touching nodes",
       [](Fix& fix) { return touching_area(fix.contact_.plane); }},
  };
  return list;
}

FixContactPlane::PlaneContact::PlaneContact(Body& touching, const Options& options)
    : body(touching), plane(plane_parameters(options), touching.surface()) {}

FixContactPlane::FixContactPlane(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixContact(lammps, narg, arg, schema()), contact_(body(), options()) {
  contribute(static_cast<Contact&>(contact_));
  provide(outputs());
}

}  // namespace furrow::coupling
