// SPDX-License-Identifier: GPL-2.0-or-later
// The functions of FMI 2.0 for co-simulation. See inputs/guide/howto/fmi.md.

#include <cstring>
#include <exception>
#include <string>

#include "coupling/fmi/component.h"
#include "coupling/fmi/variables.h"

namespace {

using furrow::coupling::fmi::Component;

template <class... Parameters, class... Arguments>
fmi2Status call(fmi2Component component, fmi2Status (Component::*function)(Parameters...),
                Arguments... arguments) {
  if (!component) return fmi2Error;
  return (static_cast<Component*>(component)->*function)(arguments...);
}

fmi2Status unsupported(fmi2Component component, fmi2String function) {
  return call(component, &Component::unsupported, function);
}

}  // namespace

#define FMI_EXPORTED __attribute__((visibility("default")))

extern "C" {

FMI_EXPORTED const char* fmi2GetTypesPlatform() { return "default"; }
FMI_EXPORTED const char* fmi2GetVersion() { return "2.0"; }

FMI_EXPORTED fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid,
                                           fmi2String resources,
                                           const fmi2CallbackFunctions* callbacks, fmi2Boolean,
                                           fmi2Boolean) {
  if (!callbacks || !name || !guid || !resources) return nullptr;
  if (type == fmi2CoSimulation)
    return furrow::coupling::fmi::make_component(name, guid, resources, *callbacks);
  if (callbacks->logger)
    callbacks->logger(callbacks->componentEnvironment, name, fmi2Error, "logStatusError",
                      "fmi2Instantiate: the FMU is for co-simulation");
  return nullptr;
}

FMI_EXPORTED void fmi2FreeInstance(fmi2Component component) {
  if (!component) return;
  call(component, &Component::reset);  // its errors go to the logger
  delete static_cast<Component*>(component);
}

FMI_EXPORTED fmi2Status fmi2SetDebugLogging(fmi2Component, fmi2Boolean, std::size_t,
                                            const fmi2String[]) {
  return fmi2OK;  // errors and warnings are always logged, and nothing else is
}

FMI_EXPORTED fmi2Status fmi2SetupExperiment(fmi2Component component, fmi2Boolean, fmi2Real,
                                            fmi2Real start, fmi2Boolean, fmi2Real) {
  return call(component, &Component::set_up, start);
}

FMI_EXPORTED fmi2Status fmi2EnterInitializationMode(fmi2Component component) {
  return call(component, &Component::enter_initialization);
}

FMI_EXPORTED fmi2Status fmi2ExitInitializationMode(fmi2Component component) {
  return call(component, &Component::exit_initialization);
}

FMI_EXPORTED fmi2Status fmi2Terminate(fmi2Component component) {
  return call(component, &Component::terminate);
}

FMI_EXPORTED fmi2Status fmi2Reset(fmi2Component component) {
  return call(component, &Component::reset);
}

// ---- variables

FMI_EXPORTED fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference references[],
                                    std::size_t count, fmi2Real values[]) {
  return call(component, &Component::get_reals, references, count, values);
}

FMI_EXPORTED fmi2Status fmi2GetInteger(fmi2Component component, const fmi2ValueReference[],
                                       std::size_t count, fmi2Integer[]) {
  return count == 0 ? fmi2OK : unsupported(component, "fmi2GetInteger");
}

FMI_EXPORTED fmi2Status fmi2GetBoolean(fmi2Component component,
                                       const fmi2ValueReference references[], std::size_t count,
                                       fmi2Boolean values[]) {
  return call(component, &Component::get_booleans, references, count, values);
}

FMI_EXPORTED fmi2Status fmi2GetString(fmi2Component component,
                                      const fmi2ValueReference references[], std::size_t count,
                                      fmi2String values[]) {
  return call(component, &Component::get_strings, references, count, values);
}

FMI_EXPORTED fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference references[],
                                    std::size_t count, const fmi2Real values[]) {
  return call(component, &Component::set_reals, references, count, values);
}

FMI_EXPORTED fmi2Status fmi2SetInteger(fmi2Component component, const fmi2ValueReference[],
                                       std::size_t count, const fmi2Integer[]) {
  return count == 0 ? fmi2OK : unsupported(component, "fmi2SetInteger");
}

FMI_EXPORTED fmi2Status fmi2SetBoolean(fmi2Component component,
                                       const fmi2ValueReference references[], std::size_t count,
                                       const fmi2Boolean values[]) {
  return call(component, &Component::set_booleans, references, count, values);
}

FMI_EXPORTED fmi2Status fmi2SetString(fmi2Component component,
                                      const fmi2ValueReference references[], std::size_t count,
                                      const fmi2String values[]) {
  return call(component, &Component::set_strings, references, count, values);
}

// ---- states

FMI_EXPORTED fmi2Status fmi2GetFMUstate(fmi2Component component, fmi2FMUstate* state) {
  return call(component, &Component::get_state, state);
}

FMI_EXPORTED fmi2Status fmi2SetFMUstate(fmi2Component component, fmi2FMUstate state) {
  return call(component, &Component::set_state, state);
}

FMI_EXPORTED fmi2Status fmi2FreeFMUstate(fmi2Component component, fmi2FMUstate* state) {
  return call(component, &Component::free_state, state);
}

FMI_EXPORTED fmi2Status fmi2SerializedFMUstateSize(fmi2Component component, fmi2FMUstate state,
                                                   std::size_t* size) {
  return call(component, &Component::size_of_state, state, size);
}

FMI_EXPORTED fmi2Status fmi2SerializeFMUstate(fmi2Component component, fmi2FMUstate state,
                                              fmi2Byte bytes[], std::size_t size) {
  return call(component, &Component::pack_state, state, bytes, size);
}

FMI_EXPORTED fmi2Status fmi2DeSerializeFMUstate(fmi2Component component, const fmi2Byte bytes[],
                                                std::size_t size, fmi2FMUstate* state) {
  return call(component, &Component::unpack_state, bytes, size, state);
}

FMI_EXPORTED fmi2Status fmi2GetDirectionalDerivative(fmi2Component component,
                                                     const fmi2ValueReference[], std::size_t,
                                                     const fmi2ValueReference[], std::size_t,
                                                     const fmi2Real[], fmi2Real[]) {
  return unsupported(component, "fmi2GetDirectionalDerivative");
}

// ---- co-simulation

FMI_EXPORTED fmi2Status fmi2SetRealInputDerivatives(fmi2Component component,
                                                    const fmi2ValueReference[], std::size_t,
                                                    const fmi2Integer[], const fmi2Real[]) {
  return unsupported(component, "fmi2SetRealInputDerivatives");
}

FMI_EXPORTED fmi2Status fmi2GetRealOutputDerivatives(fmi2Component component,
                                                     const fmi2ValueReference[], std::size_t,
                                                     const fmi2Integer[], fmi2Real[]) {
  return unsupported(component, "fmi2GetRealOutputDerivatives");
}

FMI_EXPORTED fmi2Status fmi2DoStep(fmi2Component component, fmi2Real time, fmi2Real length,
                                   fmi2Boolean) {
  return call(component, &Component::step, time, length);
}

FMI_EXPORTED fmi2Status fmi2CancelStep(fmi2Component component) {
  return unsupported(component, "fmi2CancelStep");
}

FMI_EXPORTED fmi2Status fmi2GetStatus(fmi2Component, const fmi2StatusKind, fmi2Status*) {
  return fmi2Discard;
}

FMI_EXPORTED fmi2Status fmi2GetRealStatus(fmi2Component component, const fmi2StatusKind kind,
                                          fmi2Real* value) {
  if (kind != fmi2LastSuccessfulTime) return fmi2Discard;
  return call(component, &Component::last_time, value);
}

FMI_EXPORTED fmi2Status fmi2GetIntegerStatus(fmi2Component, const fmi2StatusKind, fmi2Integer*) {
  return fmi2Discard;
}

FMI_EXPORTED fmi2Status fmi2GetBooleanStatus(fmi2Component component, const fmi2StatusKind kind,
                                             fmi2Boolean* value) {
  if (kind != fmi2Terminated) return fmi2Discard;
  return call(component, &Component::ended, value);
}

FMI_EXPORTED fmi2Status fmi2GetStringStatus(fmi2Component, const fmi2StatusKind, fmi2String*) {
  return fmi2Discard;
}

/// Gives modelDescription.xml of the contents in a file to furrow-post fmu. @param version of FMI:
/// 2, 3
/// @return its number of bytes; with a sufficient size the text is written. -1 for a wrong file
FMI_EXPORTED long furrow_describe_fmu(const char* contents, const char* name, int version,
                                      char* text, std::size_t size) {
  namespace fmi = furrow::coupling::fmi;
  try {
    const std::string made = fmi::describe(fmi::read_contents(contents), name, version);
    if (made.size() <= size) std::memcpy(text, made.data(), made.size());
    return static_cast<long>(made.size());
  } catch (const std::exception&) {
    return -1;
  }
}
}
