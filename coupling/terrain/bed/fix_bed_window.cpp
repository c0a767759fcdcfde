// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/terrain/bed/fix_bed_window.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <mpi.h>

#include "atom.h"
#include "furrow/core/communicator.h"
#include "furrow/core/error.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "coupling/base/checks/require_unique.h"
#include "coupling/base/fix_body.h"
#include "coupling/liggghts/data/exchange_buffer.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "domain.h"
#include "furrow/geometry/closest_feature.h"
#include "modify.h"
#include "update.h"

namespace furrow::coupling {

namespace {

// A grain of the rut that lies deeper than this share of the sum of radii in a renewed grain, or of
// its radius in the renewed ground, is taken out.
constexpr double seam_overlap = 0.05;
constexpr double same_place = 1e-6;  // of a slab: where terrain and bed begin

}  // namespace

const StyleRow bed_window_style =
    fix_style<FixBedWindow>("bed/window", "bed", "terrain/bed/fix_bed_window.md");

Schema FixBedWindow::schema() {
  Schema schema("fix bed/window");
  schema.text("body", "id of the fix of the wheel");
  schema.integer("slabs", Range::at_least(4), "number of slabs that divide the bed along x");
  schema.number("behind", "m", Range::positive(),
                "distance behind the middle of the wheel at which slabs are renewed; more than "
                "half the wheel");
  schema.text("terrain", "id of the fix of the terrain that carries the bed and moves with it")
      .optional();
  return schema;
}

const Outputs<FixBedWindow>& FixBedWindow::outputs() {
  using Fix = FixBedWindow;
  static const Outputs<Fix> list = {
      {"renewed", "", "slabs renewed since the start",
       [](Fix& fix) { return static_cast<double>(fix.renewed_); }},
      {"grains", "", "grains in the box",
       [](Fix& fix) { return static_cast<double>(fix.atom->natoms); }},
      {"inserted_minus_removed", "", "grains inserted minus grains removed since the start",
       [](Fix& fix) {
         return Communicator(&fix.world).sum(static_cast<double>(fix.inserted_minus_removed_));
       }},
  };
  return list;
}

FixBedWindow::FixBedWindow(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : FurrowFix(lammps, narg, arg, schema()),
      body_(use<FixBody>("body", {"wheel", "body"}).body()),
      behind_(options().number("behind")),
      slabs_(options().integer("slabs")),
      slab_length_(domain->prd[0] / static_cast<double>(slabs_)) {
  if (!domain->xperiodic)
    throw InputError("fix bed/window", "is used in a box that is not periodic along x",
                     "boundary p ? ?",
                     "use a bed that closes on itself: inputs/beds/sand_window.lig");
  const auto [lower, upper] = body_.surface().bounds();
  const double half = 0.5 * (upper[0] - lower[0]);
  const double longest = domain->prd[0] - half - 2.0 * slab_length_;
  if (behind_ < half || behind_ + half + 2.0 * slab_length_ > domain->prd[0])
    throw InputError(
        options().where("behind"), fmt::format("is {:.4g} m", behind_),
        fmt::format("{:.4g} (half the body) to {:.4g} m (box less half the body less two slabs)",
                    half, longest),
        "make the bed longer, or cut it into more slabs");
  check_slab();
  if (options().given("terrain")) terrain_ = &use<FixTerrainContinuum>("terrain", {"terrain"});
  check_terrain();
  require_unique<FixBedWindow>(*modify, options().subject(), "renews the bed of the box",
                               "one bed/window", [](FixBedWindow&) { return true; });
  force_reneighbor = 1;
  next_reneighbor = -1;
  provide(outputs());
  keep_state();
}

/// A thinner slab may hold no grain.
void FixBedWindow::check_slab() const {
  double largest = 0.0;
  for (int i = 0; i < atom->nlocal; ++i) largest = std::max(largest, 2.0 * atom->radius[i]);
  largest = Communicator(&world).max(largest);
  if (slab_length_ >= largest) return;
  throw InputError(
      options().where("slabs"),
      fmt::format("is {}: slabs of {:.3g} m for grains of {:.3g} m", slabs_, slab_length_, largest),
      fmt::format("slabs no shorter than a grain: at most {:.0f}",
                  std::floor(domain->prd[0] / largest)));
}

/// Terrain that carries the bed is renewed with it, slab by slab.
void FixBedWindow::check_terrain() const {
  const std::string where = options().where("terrain");
  if (!terrain_) {
    for (const auto* each : fixes_of<const FixTerrainContinuum>(*modify))
      if (each->options().flag("surface_mesh"))
        throw InputError(where, fmt::format("is missing, and {} carries grains", each->name()),
                         fmt::format("'terrain {}'", each->id),
                         "grains that are put in again would lie on a rut");
    return;
  }
  if (!terrain_->options().given("slabs"))
    throw InputError(
        where, fmt::format("is '{}', which does not move on", terrain_->id),
        "a fix terrain/continuum with 'surface_mesh yes', 'follow' and 'slabs'",
        fmt::format("write 'follow {} slabs {}' in its line", options().text("body"), slabs_));
  if (const long slabs = terrain_->options().integer("slabs"); slabs != slabs_)
    throw InputError(options().where("slabs"),
                     fmt::format("is {}, and {} has {}", slabs_, terrain_->name(), slabs),
                     "as many slabs as the terrain that carries the bed has",
                     "write the same number in both lines");
  if (!terrain_->follows(body_))
    throw InputError(options().where("body"),
                     fmt::format("is '{}', and {} follows '{}'", options().text("body"),
                                 terrain_->name(), terrain_->options().text("follow")),
                     "the body that the terrain follows", "name one body in both lines");
}

/// Its slabs must be those of the bed, and it must begin where the bed is renewed first.
void FixBedWindow::check_place_of_terrain() const {
  const double lower = terrain_->terrain().grid().axis(0).lower(), wanted = slab_end(next_ - 1);
  if (std::abs(lower - wanted) <= same_place * slab_length_) return;
  throw InputError(
      terrain_->options().where("centre"), fmt::format("lets the terrain begin at {:.6g} m", lower),
      fmt::format("{:.6g} m, from where on fix bed/window renews the bed: the end of a slab, "
                  "'behind' or less than a slab more behind the body",
                  wanted),
      fmt::format("write 'centre {:.6g} <y>', or let the body start elsewhere, or change 'behind'",
                  wanted + 0.5 * domain->prd[0]));
}

/// The undisturbed bed is in no grain of the checkpoint any more.
void FixBedWindow::checkpoint(Checkpoint& state) {
  bool remembered = bed_.has_value();
  state.value("remembered", remembered);
  if (!remembered) return;
  if (!bed_) bed_.emplace();
  bed_->checkpoint(state);
  state.value("next", next_);
  state.value("renewed", renewed_);
  const Communicator ranks(&world);
  std::int64_t difference = inserted_minus_removed_;
  if (state.saving())
    difference = static_cast<std::int64_t>(ranks.sum(static_cast<double>(difference)));
  state.value("inserted_minus_removed", difference);
  state.value("first_frozen_tag", first_frozen_tag_);
  state.value("last_frozen_tag", last_frozen_tag_);
  state.values("frozen", frozen_);
  if (state.saving()) return;
  inserted_minus_removed_ = ranks.rank() == 0 ? difference : 0;
}

int FixBedWindow::setmask() {
  using namespace LAMMPS_NS::FixConst;
  return INITIAL_INTEGRATE | PRE_EXCHANGE | PRE_NEIGHBOR | POST_FORCE;
}

void FixBedWindow::init() {
  collectively([&] {
    check_last_of_forces(*modify, *this, "its forces would move the slab that is held in place");
  });
}

/// Grains have just been exchanged and carry their histories; forces and lists come later.
void FixBedWindow::setup_pre_neighbor() {
  collectively([&] {
    if (bed_) {
      bed_->follow_riders(*lmp);
      return;
    }
    bed_.emplace();
    bed_->remember(*lmp);
    next_ = static_cast<std::int64_t>(
        std::floor((middle_of_body() - behind_ - domain->boxlo[0]) / slab_length_));
    if (terrain_) check_place_of_terrain();
  });
}

std::int64_t FixBedWindow::slab_of(double x) const {
  const auto slab =
      static_cast<std::int64_t>(std::floor((x - domain->boxlo[0]) / slab_length_)) % slabs_;
  return slab < 0 ? slab + slabs_ : slab;
}

bool FixBedWindow::is_frozen(int i) const {
  return atom->tag[i] >= first_frozen_tag_ && atom->tag[i] <= last_frozen_tag_;
}

double FixBedWindow::slab_end(std::int64_t slab) const {
  return domain->boxlo[0] + static_cast<double>(slab + 1) * slab_length_;
}

void FixBedWindow::initial_integrate(int) {
  due_ = terrain_ ? moved_on() : slab_end(next_) <= middle_of_body() - behind_;
  if (due_) next_reneighbor = update->ntimestep;
}

/// Terrain moves on when one of its remap intervals ends; the bed follows in the same step.
bool FixBedWindow::moved_on() {
  ContinuumTerrain& terrain = terrain_->terrain();
  terrain.follow(middle_of_body() - behind_ + 0.5 * domain->prd[0]);
  return static_cast<std::int64_t>(terrain.dropped_slabs()) > renewed_;
}

/// Lists are about to be made, on all ranks. LIGGGHTS has fix contacthistory gather its values into
/// the grains before any other fix has its turn (Modify::list_init_pre_exchange).
void FixBedWindow::pre_exchange() {
  if (!due_) return;
  due_ = false;
  collectively([&] { renew(next_++); });
}

void FixBedWindow::renew(std::int64_t slab) {
  const std::int64_t here = ((slab % slabs_) + slabs_) % slabs_;
  std::vector<std::size_t> fresh;
  for (std::size_t g = 0; g < bed_->size(); ++g)
    if (slab_of_grain(g) == here) fresh.push_back(g);

  // The slab behind has not moved since it was renewed; it is put in once more, because its grains
  // need partners in this slab.
  take_out(here, fresh);
  bed_->renumber(fresh);
  put_in(fresh, (here + 1) % slabs_);
  put_in(frozen_, std::nullopt);
  frozen_ = fresh;
  last_frozen_tag_ = bed_->largest_tag();
  first_frozen_tag_ = last_frozen_tag_ - static_cast<int>(fresh.size()) + 1;
  finish_exchange(*lmp);
  ++renewed_;
}

/// Removes the grains in the slab, the slab frozen until now, and grains of the rut that lie in the
/// grains to come or in the ground that has come.
void FixBedWindow::take_out(std::int64_t slab, const std::vector<std::size_t>& fresh) {
  const double middle = domain->boxlo[0] + (static_cast<double>(slab) + 0.5) * slab_length_;
  const auto from_middle = [&](double x) {
    return std::abs(std::remainder(x - middle, domain->prd[0]));
  };
  double largest = 0.0;
  for (const std::size_t g : fresh) largest = std::max(largest, bed_->radius(g));
  const double inner = 0.5 * slab_length_ - 2.0 * largest;
  const double outer = 0.5 * slab_length_ + 2.0 * largest;
  std::vector<std::size_t> at_seam;
  for (const std::size_t g : fresh)
    if (std::abs(bed_->position(g)[0] - middle) > inner) at_seam.push_back(g);

  for (int i = 0; i < atom->nlocal;) {
    const double x = atom->x[i][0];
    const bool at_seam_too = from_middle(x) < outer;
    if (slab_of(x) == slab || is_frozen(i) ||
        (at_seam_too && (overlaps(i, at_seam) || overlaps_new_surface(i)))) {
      remove_grain(*lmp, i);  // another grain takes this index
      --inserted_minus_removed_;
    } else {
      ++i;
    }
  }
}

bool FixBedWindow::overlaps(int i, const std::vector<std::size_t>& grains) const {
  const double* x = atom->x[i];
  return std::any_of(grains.begin(), grains.end(), [&](std::size_t g) {
    const double* other = bed_->position(g);
    const double dx = std::remainder(x[0] - other[0], domain->prd[0]);
    const double dy = x[1] - other[1];
    const double dz = x[2] - other[2];
    const double reach = (1.0 - seam_overlap) * (atom->radius[i] + bed_->radius(g));
    return dx * dx + dy * dy + dz * dz < reach * reach;
  });
}

/// The terrain's newest slab has the patch of the surface mesh of the one that it dropped.
bool FixBedWindow::overlaps_new_surface(int i) const {
  if (!terrain_) return false;
  const Surface& mesh = terrain_->terrain().surface();
  const std::size_t slabs = static_cast<std::size_t>(slabs_),
                    patch = (terrain_->terrain().dropped_slabs() - 1) % slabs,
                    triangles = mesh.triangle_count() / slabs;
  const Vector3 centre = Eigen::Map<const Vector3>(atom->x[i]);
  const double reach = (1.0 - seam_overlap) * atom->radius[i];
  for (std::size_t t = patch * triangles; t < (patch + 1) * triangles; ++t) {
    const Vector3i& nodes = mesh.triangles[t];
    Vector3 p = centre;
    p.x() = mesh.x(0, nodes[0]) + std::remainder(p.x() - mesh.x(0, nodes[0]), domain->prd[0]);
    if (closest_point_on_triangle(p, mesh.x.col(nodes[0]), mesh.x.col(nodes[1]),
                                  mesh.x.col(nodes[2]))
            .distance < reach)
      return true;
  }
  return false;
}

/// @param rut slab of the removed grains, which are no partners
void FixBedWindow::put_in(const std::vector<std::size_t>& grains, std::optional<std::int64_t> rut) {
  const auto is_gone = [&](std::size_t partner) { return rut && slab_of_grain(partner) == *rut; };
  for (const std::size_t g : grains) {
    const double* x = bed_->position(g);
    bool mine = true;
    for (int k = 0; k < 3; ++k) mine &= x[k] >= domain->sublo[k] && x[k] < domain->subhi[k];
    if (!mine) continue;
    bed_->put_in(*lmp, g, is_gone);
    ++inserted_minus_removed_;
  }
}

/// Holds the slab that was renewed last: its front face looks into the rut.
void FixBedWindow::post_force(int) {
  for (int i = 0; i < atom->nlocal; ++i)
    if (is_frozen(i))
      for (int k = 0; k < 3; ++k)
        atom->f[i][k] = atom->torque[i][k] = atom->v[i][k] = atom->omega[i][k] = 0.0;
}

}  // namespace furrow::coupling
