// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Is the box still the one that the bodies were put into?

#include "coupling/checks/scene_checks.h"

namespace furrow::coupling {

Box edges_of_box(const LAMMPS_NS::LAMMPS& lammps);

/// `change_box` may move and stretch grains; bodies and terrain stay. Boxes that follow their
/// grains, or that a fix deforms, change on purpose.
void warn_of_changed_box(const LAMMPS_NS::LAMMPS& lammps, const Box& before, const Warn& warn);

}  // namespace furrow::coupling
