// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/fix_contact_scm.h"

#include <algorithm>

#include <fmt/format.h>

#include "comm.h"
#include "furrow/core/options/check_number.h"
#include "furrow/core/error.h"
#include "coupling/contact/body_material.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "furrow/tyre/tyre.h"
#include "update.h"

namespace furrow::coupling {

namespace {

// Contact width over the shorter and the longer side of a body
constexpr double minimum_width = 0.05, largest_width = 1.5;
constexpr char soil[] = "soil";  // soil between grousers shears on soil

bool has_grousers(const FixBody& body) {
  const auto* wheel = dynamic_cast<const WheelHub*>(&body.body());
  return wheel && wheel->tip_radius() > wheel->nominal_radius();
}

}  // namespace

const StyleRow contact_scm_style =
    fix_style<FixContactScm>("contact/scm", "contact", "contact/fix_contact_scm.md");

Schema FixContactScm::schema() {
  Schema schema("fix contact/scm");
  declare_body(schema);
  declare_body_material(schema, {soil});
  declare_field(schema);
  schema
      .number("friction", "", Range::non_negative(),
              "friction coefficient of body and soil, up to the soil's strength; by default from "
              "the soil card")
      .optional();
  schema
      .number("slip_length", "m", Range::closed(0.0, 1.0),
              "slip distance that mobilises this friction, in the place of K; by default from the "
              "soil card")
      .optional();
  schema
      .number("contact_width", "m", Range::positive(),
              "width b in k_c/b; by default that of the present contact patch")
      .optional();
  return schema;
}

const Outputs<FixContactScm>& FixContactScm::outputs() {
  using Fix = FixContactScm;
  static const Outputs<Fix> list = {
      {"force_x", "N", "force on the body in the last sub-step",
       [](Fix& fix) { return fix.to_whole(fix.contact_.step().force).x(); }},
      {"force_y", "N", "force on the body in the last sub-step",
       [](Fix& fix) { return fix.to_whole(fix.contact_.step().force).y(); }},
      {"force_z", "N", "force on the body in the last sub-step",
       [](Fix& fix) { return fix.to_whole(fix.contact_.step().force).z(); }},
      {"area", "m^2", "contact area, seen from above",
       [](Fix& fix) { return fix.symmetry_factor() * fix.contact_.step().area; }},
      {"width", "m", "width b in k_c/b; 0 without contact or k_c",
       [](Fix& fix) { return fix.contact_.step().width; }},
      {"pressure", "Pa", "largest pressure", [](Fix& fix) { return fix.contact_.step().pressure; }},
      {"sinkage", "m", "largest sinkage of a cell",
       [](Fix& fix) { return fix.contact_.step().sinkage; }},
      {"stored_energy", "J", "elastic energy of the soil below the body",
       [](Fix& fix) { return fix.symmetry_factor() * fix.contact_.step().stored; }},
      {"compaction_loss", "J", "plastic work of the pressure since the start",
       [](Fix& fix) { return fix.symmetry_factor() * fix.contact_.losses().compaction; }},
      {"shear_loss", "J", "work of the shear stress since the start",
       [](Fix& fix) { return fix.symmetry_factor() * fix.contact_.losses().shear; }},
      {"damping_loss", "J", "work of the damping since the start",
       [](Fix& fix) { return fix.symmetry_factor() * fix.contact_.losses().damping; }},
  };
  return list;
}

/// @throws InputError for a height field without Bekker's parameters
const SoilPatches& FixContactScm::soils() const {
  need(terrain_fix().soils().has_value(), options().where("terrain"),
       fmt::format("is '{}', which has no soil", terrain_fix().id),
       "a terrain/scm with k_phi, n, c, phi and K, or with a card",
       "add them; only contact/rft does without");
  return *terrain_fix().soils();
}

/// @throws InputError for a width that has nothing to do with the body
double FixContactScm::contact_width() const {
  const double width = options().number("contact_width");
  const auto [lower, upper] = body().surface().bounds();
  const double across = (body().half_model() ? 2.0 : 1.0) * (upper.y() - lower.y()),
               along = upper.x() - lower.x(), largest = largest_width * std::max(across, along),
               least = minimum_width * std::min(across, along);
  if (width < least || width > largest)
    throw InputError(options().where("contact_width"),
                     fmt::format("is {:g} m, and '{}' is {:.4g} m wide and {:.4g} m long", width,
                                 body_fix().id, across, along),
                     fmt::format("{:.3g} to {:.3g} m", least, largest),
                     "give the width of the contact in m, or leave it out");
  return width;
}

/// Soil that fills the grousers of a wheel shears on soil. Any other surface slides on it.
ScmContact::Settings FixContactScm::settings_of_contact() {
  ScmContact::Settings settings;
  if (options().given("contact_width")) settings.width = contact_width();
  settings.records = comm->me == 0;
  warn_of_slip_length(*lmp, options());
  const bool line_has_friction = options().given("friction") || options().given("slip_length");
  if (options().given("body_material") && options().text("body_material") == soil &&
      line_has_friction)
    throw InputError(options().where("body_material"), "is soil, next to friction or slip_length",
                     "soil alone: it has the strength and the K of the terrain",
                     "remove 'friction' and 'slip_length', or write steel or rubber");
  const std::string material =
      !options().given("body_material") && has_grousers(body_fix()) && !line_has_friction
          ? soil
          : body_material(options(), body_fix());
  if (material == soil) return settings;
  BodyContact as_soil;
  as_soil.friction = settings.friction;
  as_soil.slip_length = soils().all().front().shear_length;
  const BodyContact contact =
      contact_with(*lmp, options(), body_fix(), material, ground(), as_soil,
                   "the soil's own c, phi and K hold, and a surface without grousers pulls less");
  settings.friction = options().given("friction") ? options().number("friction") : contact.friction;
  settings.slip_length =
      options().given("slip_length") ? options().number("slip_length") : contact.slip_length;
  return settings;
}

/// Settings with the friction in effect, from the line or from the ground.
std::vector<std::pair<std::string, std::string>> FixContactScm::settings() const {
  auto list = FixContact::settings();
  put_effective(list, settings_.friction,
                settings_.slip_length.value_or(soils().all().front().shear_length));
  return list;
}

FixContactScm::FixContactScm(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FixFieldContact(lammps, narg, arg, schema()),
      settings_(settings_of_contact()),
      contact_(body(), field(), soils(), settings_) {
  contribute(static_cast<Contact&>(contact_));
  provide(outputs());
}

/// Adds the losses of a wheel on this ground: plastic work is compaction, the work of shear
/// friction.
void FixContactScm::add_losses(const Body& wheel, GroundLosses& losses) const {
  if (&wheel != &body()) return;
  const ScmContact::Losses& own = contact_.losses();
  losses.compaction += symmetry_factor() * own.compaction;
  losses.continuum += symmetry_factor() * own.compaction;
  losses.friction += symmetry_factor() * own.shear;
  losses.contact_damping += symmetry_factor() * own.damping;
}

/// A mass m on a spring k with a dashpot c is stable for steps of dt up to k = 4 m/dt^2 and, with
/// damping that lags by half a step, c = m/dt. For a tyre m, k and c are those of an area of its
/// tread, for a wheel those of its largest contact, half its outline.
void FixContactScm::check_stability() {
  double mass, step = update->dt;
  if (const auto* tyre = dynamic_cast<const Tyre*>(&body())) {
    step = std::min(step, tyre->stable_time_step());
    mass = tyre->tread_mass();
  } else if (const auto* wheel = dynamic_cast<const WheelHub*>(&body())) {
    mass = wheel->total_mass() / (wheel->nominal_radius() * wheel->nominal_width());
  } else {
    return;  // the motion of a plate is prescribed
  }
  const auto refuse_above = [&](const char* key, double value, double limit, const char* unit) {
    if (value > limit)
      throw InputError(
          terrain_fix().options().where(key), fmt::format("is {:g} {}", value, unit),
          fmt::format("at most {:.2g} {} under '{}'", limit, unit, body_fix().id),
          fmt::format("the body has {:.3g} kg/m^2 of contact and steps of {:.2g} s", mass, step));
  };
  for (const Soil& soil : soils().all()) {
    refuse_above("stiffness", soil.stiffness, 4.0 * mass / (step * step), "Pa/m");
    refuse_above("damping", soil.damping, mass / step, "Pa s/m");
  }
}

}  // namespace furrow::coupling
