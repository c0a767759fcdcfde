// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/liggghts/library_check.h"

#include <malloc.h>

#include <dlfcn.h>
#include <fmt/format.h>

#include "furrow/core/error.h"
#include "coupling/liggghts/data/access.h"
#include "domain.h"
#include "input.h"
#include "modify.h"
#include "universe.h"

namespace furrow::coupling {

namespace {

[[noreturn]] void refuse(const std::string& difference) {
  throw Error(fmt::format(
      "the installed LIGGGHTS library is not the one that furrow was built for: {}; furrow uses "
      "the class layout of {}: install liggghts {} of Debian 12 or 13",
      difference, liggghts_version, liggghts_version));
}

/// The library has allocated the object: it must have room for the class that the headers declare.
template <class Class>
void check_room(Class* object, const char* name) {
  if (malloc_usable_size(object) < sizeof(Class))
    refuse(fmt::format("its class {} has less than {} bytes", name, sizeof(Class)));
}

}  // namespace

void* next_definition(const char* name) { return dlsym(RTLD_NEXT, name); }

void check_library(const LAMMPS_NS::LAMMPS& lammps) {
  const std::string version = lammps.universe->version;
  if (version.find(liggghts_version) == std::string::npos)
    refuse(fmt::format("it calls itself '{}'", version));
  for (const char* name :
       {symbol::create, symbol::write_restart, symbol::read_int, symbol::nread_double,
        symbol::restart_requested, symbol::decide, symbol::write_output, symbol::open_dump,
        symbol::evaluate, symbol::evaluate_boolean, symbol::execute_command, symbol::include,
        symbol::begin_step})
    if (!next_definition(name)) refuse(fmt::format("it has no symbol {}", name));
  check_room(lammps.modify, "Modify");
  check_room(lammps.input, "Input");
  check_room(lammps.domain, "Domain");
  // Tables of styles: entries that every LIGGGHTS has must be found there.
  if (!has_fix_style(lammps, "wall/gran") || !has_fix_style(lammps, "mesh/surface"))
    refuse("its table of fix styles is elsewhere");
  if (!has_command(lammps, "delete_atoms")) refuse("its table of commands is elsewhere");
}

}  // namespace furrow::coupling
