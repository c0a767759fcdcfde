// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/output/histories/fix_wheel_arc.h"

#include <filesystem>

#include <fmt/format.h>

#include "atom.h"
#include "comm.h"
#include "furrow/core/error.h"
#include "coupling/base/fix_coupled_system.h"
#include "coupling/base/checks/require_unique.h"
#include "coupling/base/fix_wheel_hub.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "coupling/liggghts/data/vector.h"
#include "coupling/output/results_folder.h"
#include "furrow/io/formats/csv_file.h"
#include "furrow/io/files/replace_file.h"
#include "update.h"

namespace furrow::coupling {

namespace {

constexpr double degree = pi / 180.0;

const std::vector<Channel>& arc_channels() {
  static const std::vector<Channel> list = {
      {"time", "s", "end of the interval"},
      {"angle", "degrees", "angle about the axle; 0 at the lowest point, positive ahead"},
      {"normal_stress", "Pa", "mean over the interval and the wheel's width; positive presses"},
      {"shear_stress", "Pa", "mean along the rim; positive drives the wheel forward"},
      {"slip_velocity", "m/s",
       "of the rim over the ground, mean by the normal force, > 0 backwards; 0 where nothing "
       "presses"}};
  return list;
}

}  // namespace

const StyleRow wheel_arc_style =
    fix_style<FixWheelArc>("wheel/arc", "history", "output/histories/fix_wheel_arc.md");

Schema FixWheelArc::schema() {
  Schema schema("fix wheel/arc");
  schema.text("wheel", "id of the fix of the wheel or tyre");
  schema.text("folder", "folder of arc.csv; created if missing; an earlier file is replaced");
  schema.integer("every", Range::at_least(1), "steps in the interval of a profile");
  schema.integer("sectors", Range::closed(6, 3600), "number of sectors in 180 degrees")
      .by_default(60);
  return schema;
}

OutputTable FixWheelArc::outputs() { return {"column", arc_channels()}; }

FixWheelArc::FixWheelArc(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FurrowFix(lammps, narg, arg, schema()),
      wheel_fix_(use<FixWheelHub>("wheel", {"wheel"})),
      arc_(wheel_fix_.hub(), static_cast<std::size_t>(options().integer("sectors"))),
      every_(options().integer("every")),
      columns_(arc_channels().size()) {
  require_unique<FixWheelArc>(*modify, options().subject(),
                              fmt::format("records the arc of '{}'", wheel_fix_.id),
                              "one wheel/arc for each wheel",
                              [&](FixWheelArc& other) { return &other.wheel_fix_ == &wheel_fix_; });
  nevery = 1;
  keep_state();
  wheel_fix_.hub().set_contact_record(&arc_);
}

FixWheelArc::~FixWheelArc() { wheel_fix_.hub().set_contact_record(nullptr); }

void FixWheelArc::init() {
  collectively([&] {
    if (const auto* plane = find_user(*modify, "contact/plane", wheel_fix_))
      throw InputError(options().where("wheel"),
                       fmt::format("is '{}', on the plane of '{}'", wheel_fix_.id, plane->id),
                       "a wheel on grains or continuum terrain");
  });
  on_this_rank([&] {
    if (comm->me == 0) make_results_folder(options());
  });
}

void FixWheelArc::end_of_step() {
  add_grains();
  duration_ += update->dt;
  if (update->ntimestep % every_ == 0) write_profile();
}

/// A body on grains is whole: mesh/body refuses half models.
void FixWheelArc::add_grains() {
  for (const GrainContact& contact : FixCoupledSystem::of(*lmp).contacts(wheel_fix_.hub())) {
    const Vector3 ground =
        vector(atom->v[contact.grain]) + vector(atom->omega[contact.grain]).cross(contact.arm);
    arc_.add(contact.point, -contact.force, contact.surface_velocity - ground, update->dt);
  }
}

void FixWheelArc::write_profile() {
  FixCoupledSystem& system = FixCoupledSystem::of(*lmp);
  std::vector<double>& sums = arc_.sums();
  system.communicator().sum(sums.data(), sums.size());
  const ContactArc::Profile profile = arc_.profile(sums, duration_);
  std::fill(sums.begin(), sums.end(), 0.0);
  duration_ = 0.0;
  on_this_rank([&] {
    if (comm->me != 0) return;
    for (std::size_t s = 0; s < profile.angle.size(); ++s) {
      const double row[] = {system.time(), profile.angle[s] / degree, profile.normal[s],
                            profile.shear[s], profile.slip[s]};
      for (std::size_t c = 0; c < columns_.size(); ++c) columns_[c].push_back(row[c]);
    }
    std::vector<std::string> names, units;
    for (const Channel& channel : arc_channels()) {
      names.push_back(channel.name);
      units.push_back(fmt::format("{} [{}]: {}", channel.name, channel.unit, channel.meaning));
    }
    write_text_file(options().text("folder") + "/arc.csv", csv_text(units, names, columns_));
  });
}

/// Saves the rows so far too: a continued run replaces the file of one that went further.
void FixWheelArc::checkpoint(Checkpoint& state) {
  const Communicator& ranks = FixCoupledSystem::of(*lmp).communicator();
  std::vector<double> sums = arc_.sums();
  if (state.saving()) ranks.sum(sums.data(), sums.size());
  state.match("sectors", options().integer("sectors"));
  state.values("sums", sums);
  state.value("duration", duration_);
  for (std::size_t c = 0; c < columns_.size(); ++c)
    state.values(arc_channels()[c].name, columns_[c]);
  if (!state.saving() && ranks.rank() == 0) arc_.sums() = sums;
}

}  // namespace furrow::coupling
