// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/run_script.h"

#include <exception>
#include <new>

#include "coupling/base/fix_coupled_system.h"
#include "coupling/liggghts/errors/error_policy.h"
#include "coupling/liggghts/styles/script.h"
#include "input.h"

namespace furrow::coupling {

void run_script(LAMMPS_NS::LAMMPS& lammps) {
  try {
    lammps.input->file();
  } catch (const std::bad_alloc&) {
    stop_alone(lammps, "there is not enough memory for this script", {"furrow", 0});
  } catch (const std::exception& problem) {
    stop_alone(lammps, problem.what(), {"furrow", 0});
  }
}

void warn_without_run(LAMMPS_NS::LAMMPS& lammps) {
  const FixCoupledSystem* system = FixCoupledSystem::find(lammps);
  if (system && !system->has_run())
    warn(lammps, "no 'run' follows the lines of the bodies: nothing was computed");
}

}  // namespace furrow::coupling
