// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Compares the script that continues a run with the script of the run of the checkpoint.

#include <string>
#include <vector>

#include "furrow/core/checkpoint.h"
#include "lammps.h"

namespace furrow::coupling {

/// Fixes, properties of grains and keywords of controllers, as text in a checkpoint.
class ContinuedLines {
 public:
  explicit ContinuedLines(LAMMPS_NS::LAMMPS& lammps) : lammps_(lammps) {}

  /// @param controllers  ids of the fixes that control motions
  void checkpoint(Checkpoint& state, const std::vector<std::string>& controllers);

  /// Warns of differences that may be meant; once, before the first run. Nothing happens in a run
  /// that does not continue another.
  /// @throws StateError when the script lacks a fix whose state the checkpoint has
  void check(const std::vector<std::string>& controllers);

 private:
  std::string lines_of(const std::vector<std::string>& controllers) const;
  void check_fixes() const;
  void warn_of_properties() const;
  void warn_of_controllers(const std::vector<std::string>& controllers) const;

  LAMMPS_NS::LAMMPS& lammps_;
  bool unchecked_ = false;  // a checkpoint was read
  // Lines of the checkpoint's script.
  std::string fixes_;        // names, a line each
  std::string properties_;   // id and values, a line each
  std::string controllers_;  // name of the fix, keyword and value, a line each
};

}  // namespace furrow::coupling
