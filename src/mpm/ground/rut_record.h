// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The rut: the surface that a moving window leaves behind.

#include <vector>

#include "furrow/core/checkpoint.h"
#include "furrow/core/communicator.h"

namespace furrow {

/// A point of the surface as it was when the window removed the ground below it.
struct RutPoint {
  double x;        ///< [m]
  double y;        ///< [m]
  double z;        ///< of the surface [m]
  double density;  ///< mean over the depth [kg/m^3]
};

/// Rank 0 keeps what the window of all ranks removed.
class RutRecord {
 public:
  void add(const RutPoint& point) { points_.push_back(point); }
  const std::vector<RutPoint>& points() const {
    return points_;
  }  ///< points of the rut; empty on other ranks than 0
  std::vector<RutPoint> gather(const Communicator& ranks) const;  ///< on every rank; collective
  void checkpoint(Checkpoint& state, const Communicator& ranks);  ///< collective

 private:
  std::vector<double> gather_numbers(const Communicator& ranks) const;

  std::vector<RutPoint> points_;
};

}  // namespace furrow
