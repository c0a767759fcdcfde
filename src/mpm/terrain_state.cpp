// SPDX-License-Identifier: GPL-2.0-or-later
// Continuum ground as numbers, for restarts.
#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"
#include "mpm/continuum_terrain.h"

namespace furrow {

std::vector<double> MpmGround::fingerprint() const {
  std::vector<double> numbers = {static_cast<double>(phases_.size())};
  for (int a = 0; a < 3; ++a)
    numbers.insert(numbers.end(),
                   {static_cast<double>(grid_.axis(a).cells()), grid_.axis(a).shortest()});
  for (const GroundPhase& phase : phases_)
    numbers.insert(numbers.end(),
                   {static_cast<double>(phase.particles.record_length()), phase.law->density()});
  numbers.insert(numbers.end(), {static_cast<double>(faces_.state_length()),
                                 static_cast<double>(sheet_.surface().node_count())});
  return numbers;
}

std::vector<double> MpmGround::state() const {
  std::vector<double> state = fingerprint();
  double sums[] = {totals_.kinetic_energy,
                   totals_.momentum[0],
                   totals_.momentum[1],
                   totals_.momentum[2],
                   initial_,
                   stress_work_,
                   contact_work_,
                   gravity_work_,
                   dropped_kinetic_,
                   dropped_internal_,
                   dropped_dissipated_};
  ranks().sum(sums, std::size(sums));
  state.insert(state.end(), std::begin(sums), std::end(sums));
  state.insert(state.end(), {static_cast<double>(shifts_), focus_, next_id_, drift_, travel_,
                             ranks().max(largest_speed_), static_cast<double>(steps_left_),
                             lagging_ ? 1.0 : 0.0});
  std::vector<double> nodes = grid_.moving_state(partition_.owned());
  ranks().sum(nodes.data(), nodes.size());
  state.insert(state.end(), nodes.begin(), nodes.end());
  std::vector<double> rut;
  for (const RutPoint& point : rut_)
    rut.insert(rut.end(), {point.x, point.y, point.z, point.density});
  rut = ranks().gather(rut);
  state.push_back(static_cast<double>(rut.size()));
  state.insert(state.end(), rut.begin(), rut.end());
  const Matrix3X& f = sheet_.surface().f;
  state.insert(state.end(), f.data(), f.data() + f.size());
  Faces faces = faces_;
  faces.synchronise(ranks(), partition_.owned());
  faces.collect(ranks());
  faces.save(state);
  for (const GroundPhase& phase : phases_) {
    std::vector<double> records;
    for (std::size_t p = 0; p < phase.particles.size(); ++p) phase.particles.pack(p, records);
    records = ranks().gather(records);
    state.push_back(static_cast<double>(records.size()));
    state.insert(state.end(), records.begin(), records.end());
  }
  return state;
}

void MpmGround::restore(const std::vector<double>& state) {
  const std::vector<double> mine = fingerprint();
  if (state.size() < mine.size() || !std::equal(mine.begin(), mine.end(), state.begin()))
    throw Error(
        fmt::format("{}: the saved state belongs to other ground; restart with the materials, size "
                    "and cells of the first run",
                    where_));
  const double* next = state.data() + mine.size();
  for (double* sum : {&totals_.kinetic_energy, &totals_.momentum[0], &totals_.momentum[1],
                      &totals_.momentum[2], &initial_, &stress_work_, &contact_work_,
                      &gravity_work_, &dropped_kinetic_, &dropped_internal_, &dropped_dissipated_})
    *sum = ranks().rank() == 0 ? *next++ : (++next, 0.0);
  const int shifts = static_cast<int>(*next++);
  grid_.shift_x(shifts - shifts_);
  shifts_ = shifts;
  focus_ = *next++;
  next_id_ = *next++;
  drift_ = *next++;
  travel_ = *next++;
  largest_speed_ = *next++;
  steps_left_ = static_cast<int>(*next++);
  lagging_ = *next++ != 0.0;
  next = grid_.restore_moving_state(next);
  const auto rut_end = static_cast<std::size_t>(*next++);
  rut_.clear();
  for (std::size_t n = 0; n < rut_end; n += 4, next += 4)
    if (ranks().rank() == 0) rut_.push_back({next[0], next[1], next[2], next[3]});
  Matrix3X& f = sheet_.surface().f;
  std::copy_n(next, f.size(), f.data());
  next += f.size();
  next = faces_.restore(next, ranks().rank() == 0);
  for (GroundPhase& phase : phases_) {
    phase.particles.reorder({});
    const auto length = static_cast<std::size_t>(*next++);
    for (const double* end = next + length; next != end; next += phase.particles.record_length())
      if (partition_.owner(grid_.axis(0).cell_of(next[0])) == ranks().rank())
        phase.particles.unpack(next);
  }
  const double drift = drift_;
  if (ranks().size() > 1) sort();
  drift_ = drift;
  ++generation_;
  if (in_cycle()) {
    grid_.clear_sums(partition_.touched());
    give_forces();
  }
  if (!sheet_.exists()) return;
  sheet_.find(phases_);
  move_sheet();
}

}  // namespace furrow
