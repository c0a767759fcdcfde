// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// An instance of the FMU as the functions of the standard call it.

#include "coupling/fmi/fmi2.h"

namespace furrow::coupling::fmi {

/// Each function reports an exception through the logger of the importer and returns its status.
/// All are virtual and have types of C only: importers unpack an FMU for each of its instances, and
/// all copies of the library in a process call the instances of the first copy.
class Component {
 public:
  virtual ~Component() = default;

  virtual fmi2Status set_up(double start) = 0;
  virtual fmi2Status enter_initialization() = 0;
  virtual fmi2Status exit_initialization() = 0;
  virtual fmi2Status step(double time, double length) = 0;
  virtual fmi2Status terminate() = 0;
  virtual fmi2Status reset() = 0;

  using References = const fmi2ValueReference*;
  virtual fmi2Status get_reals(References references, std::size_t count, fmi2Real* values) = 0;
  virtual fmi2Status get_booleans(References references, std::size_t count,
                                  fmi2Boolean* values) = 0;
  virtual fmi2Status get_strings(References references, std::size_t count, fmi2String* values) = 0;
  virtual fmi2Status set_reals(References references, std::size_t count,
                               const fmi2Real* values) = 0;
  virtual fmi2Status set_booleans(References references, std::size_t count,
                                  const fmi2Boolean* values) = 0;
  virtual fmi2Status set_strings(References references, std::size_t count,
                                 const fmi2String* values) = 0;

  virtual fmi2Status get_state(fmi2FMUstate* state) = 0;
  virtual fmi2Status set_state(fmi2FMUstate state) = 0;
  virtual fmi2Status free_state(fmi2FMUstate* state) = 0;
  virtual fmi2Status size_of_state(fmi2FMUstate state, std::size_t* size) = 0;
  virtual fmi2Status pack_state(fmi2FMUstate state, fmi2Byte* bytes, std::size_t size) = 0;
  virtual fmi2Status unpack_state(const fmi2Byte* bytes, std::size_t size, fmi2FMUstate* state) = 0;

  virtual fmi2Status last_time(fmi2Real* value) = 0;
  virtual fmi2Status ended(fmi2Boolean* value) = 0;
  virtual fmi2Status unsupported(fmi2String function) = 0;
};

/// Makes a component by the first copy of the library in this process.
/// @return null where it is refused, with the reason in the logger
Component* make_component(fmi2String name, fmi2String guid, fmi2String resources,
                          const fmi2CallbackFunctions& callbacks);

}  // namespace furrow::coupling::fmi
