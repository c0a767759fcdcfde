// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Interface of a contact between two bodies of a coupled system.

namespace furrow {

class Contact {
 public:
  virtual ~Contact() = default;
  /// Computes the forces at the present positions and adds them to both bodies, before they advance
  /// by dt [s].
  /// @throws StateError
  virtual void apply(double dt) = 0;
};

}  // namespace furrow
