// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A bed of grains as it was at one instant, with all that its grains carry, to be put in again.

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "furrow/core/checkpoint.h"
#include "lammps.h"

namespace furrow::coupling {

/// The grains of all ranks, on every rank, in the order of their tags then. A grain is meant by its
/// index in that order; its latest copy in the run has another tag.
class RememberedBed {
 public:
  /// Remembers the bed in the box, its grains at rest. Collective; grains have just been exchanged
  /// and carry their contact histories.
  /// @throws StateError for an atom style whose grains are packed in another way
  void remember(LAMMPS_NS::LAMMPS& lammps);
  /// Notes the fixes that ride with the grains, before every run that puts grains in: they, and
  /// their order, may be others than when the bed was remembered.
  /// @throws StateError for one that the bed's grains have no numbers of
  void follow_riders(const LAMMPS_NS::LAMMPS& lammps);
  void checkpoint(Checkpoint& state);

  std::size_t size() const { return latest_tag_.size(); }
  const double* position(std::size_t grain) const;  ///< [m]
  double radius(std::size_t grain) const;           ///< [m]

  /// Gives the grains, which are about to be put in, the next unused tags, in their order.
  void renumber(const std::vector<std::size_t>& grains);
  /// Largest tag that a copy or an original has had.
  int largest_tag() const { return largest_tag_; }

  /// Puts a grain in on this rank, under its latest tag and with its contacts to the latest copies
  /// of its partners. @param is_gone partners whose contacts are left out
  void put_in(LAMMPS_NS::LAMMPS& lammps, std::size_t grain,
              const std::function<bool(std::size_t partner)>& is_gone) const;

 private:
  void gather(LAMMPS_NS::LAMMPS& lammps);
  void refer_partners_by_index();
  /// Place of a grain's first number in packed_; for the one behind the last, the end of all.
  std::size_t begin(std::size_t grain) const {
    return grain == 0 ? 0 : bounds_[grain * (riders_.size() + 1) - 1];
  }
  /// Place of a rider's first number; for the one behind the last, the end of the grain.
  std::size_t begin(std::size_t grain, std::size_t rider) const {
    return bounds_[grain * (riders_.size() + 1) + rider];
  }
  double* packed(std::size_t grain) { return &packed_[begin(grain)]; }
  const double* packed(std::size_t grain) const { return &packed_[begin(grain)]; }

  std::vector<std::string> riders_;      // exchange_buffer.h
  std::optional<std::size_t> contacts_;  // the rider with the contact histories, if there are
  std::size_t contact_values_ = 0;       // of each contact
  std::vector<double> packed_;           // exchange_buffer.h, one grain after the other
  std::vector<std::size_t> bounds_;      // in packed_: of the riders, and the end, each grain
  std::vector<int> latest_tag_;          // of each grain
  int largest_tag_ = 0;
};

}  // namespace furrow::coupling
