// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Compares the LIGGGHTS library that is loaded with the one this executable was built for.

#include <string>

#include "lammps.h"

namespace furrow::coupling {

/// The only version whose class layouts and symbols the files of this folder know.
inline constexpr char liggghts_version[] = "3.8.0";

/// Symbols of the functions that overrides.cpp replaces; it calls the originals.
namespace symbol {
inline constexpr char create[] = "_ZN9LAMMPS_NS6LAMMPS6createEv";
inline constexpr char write_restart[] = "_ZN9LAMMPS_NS12WriteRestart5writeEPc";
inline constexpr char read_int[] = "_ZN9LAMMPS_NS11ReadRestart8read_intEv";
inline constexpr char nread_double[] = "_ZN9LAMMPS_NS11ReadRestart12nread_doubleEPdiP8_IO_FILE";
inline constexpr char restart_requested[] = "_ZN9LAMMPS_NS6Output17restart_requestedEl";
inline constexpr char write_output[] = "_ZN9LAMMPS_NS6Output5writeEl";
inline constexpr char open_dump[] = "_ZN9LAMMPS_NS4Dump8openfileEv";
inline constexpr char evaluate[] = "_ZN9LAMMPS_NS8Variable8evaluateEPcPPNS0_4TreeE";
inline constexpr char evaluate_boolean[] = "_ZN9LAMMPS_NS8Variable16evaluate_booleanEPc";
inline constexpr char execute_command[] = "_ZN9LAMMPS_NS5Input15execute_commandEv";
inline constexpr char include[] = "_ZN9LAMMPS_NS5Input7includeEv";
inline constexpr char begin_step[] = "_ZN9LAMMPS_NS9Integrate6ev_setEl";
inline constexpr char decide[] = "_ZN9LAMMPS_NS8Neighbor6decideEv";
}  // namespace symbol

/// The start-up self-test: version, symbols, and members that are reached by layout.
/// @throws Error that names what differs and the version that is needed
void check_library(const LAMMPS_NS::LAMMPS& lammps);

/// The next definition of a function behind this executable's own; null when there is none.
void* next_definition(const char* name);
template <class Function>
Function* next_function(const char* name) {
  return reinterpret_cast<Function*>(next_definition(name));
}

}  // namespace furrow::coupling
