// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/terrain/fix_bed_window.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <mpi.h>

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "core/communicator.h"
#include "core/error.h"
#include "coupling/bodies/fix_coupled_system.h"
#include "coupling/liggghts/errors.h"
#include "coupling/base/args.h"
#include "domain.h"
#include "fix_contact_history.h"
#include "modify.h"
#include "update.h"

namespace furrow::coupling {

namespace {

// Places in AtomVecSphere's exchange buffer; checked against the grain's own data when the bed is
// remembered.
constexpr std::size_t at_x = 1, at_v = 4, at_tag = 7, at_radius = 11, at_omega = 14;
// A grain of the rut that lies deeper than this share of the sum of radii in a renewed grain is
// taken out.
constexpr double seam_overlap = 0.05;

int place_of_fix(const LAMMPS_NS::Modify& modify, const LAMMPS_NS::Fix* fix) {
  return static_cast<int>(std::find(modify.fix, modify.fix + modify.nfix, fix) - modify.fix);
}

}  // namespace

Schema FixBedWindow::schema() {
  Schema schema("fix bed/window");
  schema.text("body", "id of the fix that makes the wheel");
  schema.integer("slabs", Range::at_least(4), "number of slabs that the bed is cut into along x");
  schema.number("behind", "m", Range::positive(),
                "distance behind the middle of the body at which slabs are renewed");
  return schema;
}

FixBedWindow::FixBedWindow(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg),
      options_(schema().read(args_after_style(narg, arg))),
      body_(FixCoupledSystem::find_body(*lammps, options_.where("body"), options_.text("body"))
                .body()),
      behind_(options_.number("behind")),
      slabs_(options_.integer("slabs")) {
  if (!domain->xperiodic)
    throw InputError("fix bed/window", "stands in a box that is not periodic along x",
                     "boundary p ? ?",
                     "use a bed that closes on itself: inputs/beds/sand_window.lig");
  slab_length_ = domain->prd[0] / static_cast<double>(slabs_);
  const auto [lower, upper] = body_.surface().bounds();
  const double half = 0.5 * (upper[0] - lower[0]);
  if (behind_ < half || behind_ + half + 2.0 * slab_length_ > domain->prd[0])
    throw InputError(
        options_.where("behind"), fmt::format("is {:.4g} m", behind_),
        fmt::format("{:.4g} (half the body) to {:.4g} m (box less half the body less two slabs)",
                    half, domain->prd[0] - half - 2.0 * slab_length_),
        "make the bed longer, or cut it into more slabs");
  force_reneighbor = 1;
  next_reneighbor = -1;
  vector_flag = 1;
  size_vector = 3;
  global_freq = 1;
  extvector = 0;
}

bool FixBedWindow::uses(LAMMPS_NS::Fix& other) const {
  auto* owner = dynamic_cast<BodyFix*>(&other);
  return owner && &owner->body() == &body_;
}

int FixBedWindow::setmask() {
  using namespace LAMMPS_NS::FixConst;
  return INITIAL_INTEGRATE | PRE_EXCHANGE | PRE_NEIGHBOR | POST_FORCE;
}

/// Contact histories are gathered into the grains by fix contacthistory; grains may be exchanged
/// only after that.
void FixBedWindow::init() {
  const LAMMPS_NS::Fix* history = modify->find_fix_style_strict("contacthistory", 0);
  with_collective_errors(*error, [&] {
    if (history && place_of_fix(*modify, history) > place_of_fix(*modify, this))
      throw InputError("fix bed/window", "comes before the pair style was set up",
                       "bed/window after a run", "write 'run 0' before this line");
  });
}

/// Grains have just been exchanged and carry their histories; forces and lists come later.
void FixBedWindow::setup_pre_neighbor() {
  if (remembered_) return;
  remembered_ = true;
  with_collective_errors(*error, [&] { remember_bed(); });
  next_ = static_cast<long>(
      std::floor((body_.surface().x.row(0).mean() - behind_ - domain->boxlo[0]) / slab_length_));
}

void FixBedWindow::remember_bed() {
  const auto* history = dynamic_cast<LAMMPS_NS::FixContactHistory*>(
      modify->find_fix_style_strict("contacthistory", 0));
  std::vector<double> own, buffer;
  for (int i = 0; i < atom->nlocal; ++i) {
    std::size_t room = 64;
    for (int f = 0; f < modify->nfix; ++f) room += 64;
    buffer.assign(room + static_cast<std::size_t>(comm->maxexchange_fix), 0.0);
    const auto size = static_cast<std::size_t>(atom->avec->pack_exchange(i, buffer.data()));
    if (buffer[at_radius] != atom->radius[i] ||
        static_cast<int>(ubuf(buffer[at_tag]).i) != atom->tag[i])
      throw StateError(
          "fix bed/window: LIGGGHTS packs a grain in an order that is not atom_style granular's; "
          "use that style");
    // The riders come last, in the order of extra_grow.
    std::size_t end = size, history_at = 0;
    for (int e = atom->nextra_grow - 1; e >= 0; --e) {
      LAMMPS_NS::Fix* rider = modify->fix[atom->extra_grow[e]];
      std::vector<double> part(buffer.size());
      end -= static_cast<std::size_t>(rider->pack_exchange(i, part.data()));
      if (rider == history) history_at = end;
    }
    own.push_back(static_cast<double>(size));
    own.push_back(static_cast<double>(history_at));
    own.insert(own.end(), buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(size));
  }

  int count = static_cast<int>(own.size());
  std::vector<int> counts(static_cast<std::size_t>(comm->nprocs)), starts(counts.size() + 1, 0);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  for (std::size_t r = 0; r < counts.size(); ++r) starts[r + 1] = starts[r] + counts[r];
  std::vector<double> all(static_cast<std::size_t>(starts.back()));
  MPI_Allgatherv(own.data(), count, MPI_DOUBLE, all.data(), counts.data(), starts.data(),
                 MPI_DOUBLE, world);

  std::vector<std::size_t> places;  // of every grain's two leading numbers
  for (std::size_t p = 0; p < all.size(); p += 2 + static_cast<std::size_t>(all[p]))
    places.push_back(p);
  const auto tag_at = [&](std::size_t p) { return static_cast<int>(ubuf(all[p + 2 + at_tag]).i); };
  std::sort(places.begin(), places.end(),
            [&](std::size_t a, std::size_t b) { return tag_at(a) < tag_at(b); });
  for (const std::size_t p : places) {
    offset_.push_back(reference_.size());
    history_offset_.push_back(static_cast<std::size_t>(all[p + 1]));
    current_tag_.push_back(tag_at(p));
    reference_.insert(
        reference_.end(), all.begin() + static_cast<std::ptrdiff_t>(p + 2),
        all.begin() + static_cast<std::ptrdiff_t>(p + 2 + static_cast<std::size_t>(all[p])));
  }
  largest_tag_ = current_tag_.empty() ? 0 : current_tag_.back();

  // Partners by their place in the reference from now on, not by tags, which change with every
  // copy.
  const std::vector<int> tags = current_tag_;
  const int values = history ? const_cast<LAMMPS_NS::FixContactHistory*>(history)->get_dnum() : 0;
  for (std::size_t g = 0; history && g < offset_.size(); ++g) {
    double* entry = &reference_[offset_[g] + history_offset_[g]];
    const long partners = static_cast<long>(ubuf(*entry++).i);
    for (long n = 0; n < partners; ++n, entry += 1 + values) {
      const auto found =
          std::lower_bound(tags.begin(), tags.end(), static_cast<int>(ubuf(*entry).i));
      *entry = ubuf(static_cast<int>(found - tags.begin())).d;
    }
    for (std::size_t k = 0; k < 3; ++k)
      reference_[offset_[g] + at_v + k] = reference_[offset_[g] + at_omega + k] = 0.0;
  }
}

long FixBedWindow::slab_of(double x) const {
  const long slab = static_cast<long>(std::floor((x - domain->boxlo[0]) / slab_length_)) % slabs_;
  return slab < 0 ? slab + slabs_ : slab;
}

void FixBedWindow::initial_integrate(int) {
  const double limit = body_.surface().x.row(0).mean() - behind_;
  due_ = domain->boxlo[0] + static_cast<double>(next_ + 1) * slab_length_ <= limit;
  if (due_) next_reneighbor = update->ntimestep;
}

/// Lists are about to be made, on all ranks.
void FixBedWindow::pre_exchange() {
  if (!due_) return;
  due_ = false;
  with_collective_errors(*error, [&] { renew(next_++); });
}

void FixBedWindow::renew(long slab) {
  const long here = ((slab % slabs_) + slabs_) % slabs_;
  std::vector<std::size_t> fresh;
  for (std::size_t g = 0; g < offset_.size(); ++g)
    if (slab_of_grain(g) == here) fresh.push_back(g);

  // The slab behind has not moved since it was renewed; it is put in once more, because its grains
  // need partners in this slab.
  take_out(here, fresh);
  for (const std::size_t g : fresh) current_tag_[g] = ++largest_tag_;
  put_in(fresh, static_cast<int>((here + 1) % slabs_));
  put_in(frozen_, -1);
  frozen_ = fresh;
  first_frozen_tag_ = largest_tag_ - static_cast<int>(fresh.size()) + 1;
  last_frozen_tag_ = largest_tag_;

  LAMMPS_NS::bigint local = atom->nlocal;
  MPI_Allreduce(&local, &atom->natoms, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  atom->nghost = 0;
  if (atom->map_style) {
    atom->map_init();
    atom->map_set();
  }
  ++renewed_;
}

/// What stands in the slab, the slab frozen until now, and grains of the rut that lie in the grains
/// to come.
void FixBedWindow::take_out(long slab, const std::vector<std::size_t>& fresh) {
  const double period = domain->prd[0],
               middle = domain->boxlo[0] + (static_cast<double>(slab) + 0.5) * slab_length_;
  double largest = 0.0;
  for (const std::size_t g : fresh) largest = std::max(largest, packed(g)[at_radius]);
  const double inner = 0.5 * slab_length_ - 2.0 * largest,
               outer = 0.5 * slab_length_ + 2.0 * largest;
  std::vector<const double*> at_seam;
  for (const std::size_t g : fresh)
    if (std::abs(packed(g)[at_x] - middle) > inner) at_seam.push_back(packed(g));
  // Frozen now: their tags are those of the slab renewed last.
  int i = 0;
  while (i < atom->nlocal) {
    const double* x = atom->x[i];
    bool out = slab_of(x[0]) == slab ||
               (atom->tag[i] >= first_frozen_tag_ && atom->tag[i] <= last_frozen_tag_);
    if (!out && std::abs(std::remainder(x[0] - middle, period)) < outer)
      for (const double* other : at_seam) {
        const double dx = std::remainder(x[0] - other[at_x], period), dy = x[1] - other[at_x + 1],
                     dz = x[2] - other[at_x + 2];
        const double reach = (1.0 - seam_overlap) * (atom->radius[i] + other[at_radius]);
        out |= dx * dx + dy * dy + dz * dz < reach * reach;
      }
    if (!out) {
      ++i;
      continue;
    }
    atom->avec->copy(atom->nlocal - 1, i, 1);
    --atom->nlocal;
    --inserted_minus_removed_;
  }
}

/// @param rut partners in this slab are gone; -1: none is
void FixBedWindow::put_in(const std::vector<std::size_t>& grains, int rut) {
  auto* history = dynamic_cast<LAMMPS_NS::FixContactHistory*>(
      modify->find_fix_style_strict("contacthistory", 0));
  const auto values = static_cast<std::size_t>(history ? history->get_dnum() : 0);
  std::vector<double> buffer;
  for (const std::size_t g : grains) {
    const double* x = packed(g) + at_x;
    bool mine = true;
    for (int k = 0; k < 3; ++k) mine &= x[k] >= domain->sublo[k] && x[k] < domain->subhi[k];
    if (!mine) continue;
    const std::size_t end = g + 1 < offset_.size() ? offset_[g + 1] : reference_.size();
    buffer.assign(packed(g), static_cast<const double*>(reference_.data()) + end);
    buffer[at_tag] = ubuf(current_tag_[g]).d;
    if (history) {
      // Shortened in place: partners that are gone are left out; what follows the history moves up.
      const std::size_t begin = history_offset_[g];
      const long partners = static_cast<long>(ubuf(buffer[begin]).i);
      std::vector<double> kept;
      long count = 0;
      for (std::size_t n = 0; n < static_cast<std::size_t>(partners); ++n) {
        const double* entry = &buffer[begin + 1 + n * (1 + values)];
        const auto partner = static_cast<std::size_t>(ubuf(*entry).i);
        if (partner >= offset_.size() || slab_of_grain(partner) == rut) continue;
        kept.push_back(ubuf(current_tag_[partner]).d);
        kept.insert(kept.end(), entry + 1, entry + 1 + values);
        ++count;
      }
      std::vector<double> rest(
          buffer.begin() + static_cast<std::ptrdiff_t>(
                               begin + 1 + static_cast<std::size_t>(partners) * (1 + values)),
          buffer.end());
      buffer.resize(begin);
      buffer.push_back(ubuf(static_cast<int>(count)).d);
      buffer.insert(buffer.end(), kept.begin(), kept.end());
      buffer.insert(buffer.end(), rest.begin(), rest.end());
    }
    atom->avec->unpack_exchange(buffer.data());
    ++inserted_minus_removed_;
  }
}

/// The slab renewed last stands still: its front face looks into the rut.
void FixBedWindow::post_force(int) {
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->tag[i] >= first_frozen_tag_ && atom->tag[i] <= last_frozen_tag_)
      for (int k = 0; k < 3; ++k)
        atom->f[i][k] = atom->torque[i][k] = atom->v[i][k] = atom->omega[i][k] = 0.0;
}

double FixBedWindow::compute_vector(int n) {
  if (n == 0) return static_cast<double>(renewed_);
  if (n == 1) return static_cast<double>(atom->natoms);
  return Communicator(&world).sum(static_cast<double>(inserted_minus_removed_));
}

}  // namespace furrow::coupling
