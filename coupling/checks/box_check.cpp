// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/checks/box_check.h"

#include <algorithm>

#include <fmt/format.h>

#include "coupling/liggghts/fixes_of.h"
#include "coupling/bodies/fix_body.h"
#include "coupling/terrain/fix_bed_window.h"
#include "domain.h"

namespace furrow::coupling {

namespace {

constexpr int shrink_wrapped = 2;  // of Domain::nonperiodic

bool changes_on_purpose(const LAMMPS_NS::LAMMPS& lammps) {
  const auto fixes = fixes_of<const LAMMPS_NS::Fix>(*lammps.modify);
  return lammps.domain->nonperiodic == shrink_wrapped ||
         !fixes_of<const FixBedWindow>(*lammps.modify).empty() ||
         std::any_of(fixes.begin(), fixes.end(), [](const LAMMPS_NS::Fix* fix) {
           return fix->box_change_size || fix->box_change_shape || fix->box_change_domain;
         });
}

std::string text(const Box& box) {
  return fmt::format("({:g} {:g} {:g}) to ({:g} {:g} {:g})", box[0], box[1], box[2], box[3], box[4],
                     box[5]);
}

}  // namespace

Box edges_of_box(const LAMMPS_NS::LAMMPS& lammps) {
  const double *lower = lammps.domain->boxlo, *upper = lammps.domain->boxhi;
  return {lower[0], lower[1], lower[2], upper[0], upper[1], upper[2]};
}

void warn_of_changed_box(const LAMMPS_NS::LAMMPS& lammps, const Box& before, const Warn& warn) {
  const Box now = edges_of_box(lammps);
  if (now == before || fixes_of<const FixBody>(*lammps.modify).empty() ||
      changes_on_purpose(lammps))
    return;
  warn(
      fmt::format("the box was {} when the first body was made, and is {}: bodies and terrain have "
                  "stayed where they were; change the box before their lines",
                  text(before), text(now)));
}

}  // namespace furrow::coupling
