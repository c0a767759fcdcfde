// SPDX-License-Identifier: GPL-2.0-or-later
// The functions of FMI 3.0 for co-simulation: those of 2.0 by other names. After the headers of the
// standard, see fmi2.h.

#include <cstdarg>
#include <cstdio>
#include <memory>
#include <vector>

#include "coupling/fmi/component.h"
#include "coupling/fmi/variables.h"

namespace {

using furrow::coupling::fmi::Component;
using furrow::coupling::fmi::first_boolean_of_3;
using furrow::coupling::fmi::first_string_of_3;

using LogMessage = void (*)(void* environment, fmi2Status, fmi2String category, fmi2String message);

struct Instance {
  void* environment;
  LogMessage log;
  Component* component;
};

void log_message(void* instance, fmi2String, fmi2Status status, fmi2String category,
                 fmi2String format, ...) {
  const auto* self = static_cast<Instance*>(instance);
  if (!self->log) return;
  std::va_list arguments, again;
  va_start(arguments, format);
  va_copy(again, arguments);
  std::vector<char> text(static_cast<std::size_t>(std::vsnprintf(nullptr, 0, format, arguments)) +
                         1);
  std::vsnprintf(text.data(), text.size(), format, again);
  va_end(again);
  va_end(arguments);
  self->log(self->environment, status, category, text.data());
}

template <class... Parameters, class... Arguments>
fmi2Status forward(void* instance, fmi2Status (Component::*function)(Parameters...),
                   Arguments... arguments) {
  if (!instance) return fmi2Error;
  return (static_cast<Instance*>(instance)->component->*function)(arguments...);
}

/// Value references of one type of FMI 2.0: those of 3.0 differ between types.
std::vector<fmi2ValueReference> within(const fmi2ValueReference references[], std::size_t count,
                                       unsigned first) {
  std::vector<fmi2ValueReference> own(references, references + count);
  for (fmi2ValueReference& each : own) each -= first;  // of another type: too large a number
  return own;
}

}  // namespace

#define FMI_EXPORTED __attribute__((visibility("default")))
/// A function that this FMU does not have; further arguments are not looked at.
#define FMI_UNSUPPORTED(name)                                 \
  FMI_EXPORTED fmi2Status name(void* instance) {              \
    return forward(instance, &Component::unsupported, #name); \
  }

extern "C" {

FMI_EXPORTED const char* fmi3GetVersion() { return "3.0"; }

FMI_EXPORTED fmi2Status fmi3SetDebugLogging(void*, bool, std::size_t, const fmi2String[]) {
  return fmi2OK;  // errors and warnings are always logged, and nothing else is
}

FMI_EXPORTED void* fmi3InstantiateCoSimulation(fmi2String name, fmi2String token,
                                               fmi2String resources, bool, bool, bool, bool,
                                               const fmi2ValueReference[], std::size_t,
                                               void* environment, LogMessage log, void*) {
  if (!name || !token || !resources) return nullptr;
  auto instance = std::make_unique<Instance>(Instance{environment, log, nullptr});
  const fmi2CallbackFunctions callbacks{log_message, nullptr, nullptr, nullptr, instance.get()};
  instance->component = furrow::coupling::fmi::make_component(name, token, resources, callbacks);
  return instance->component ? instance.release() : nullptr;
}

FMI_EXPORTED void* fmi3InstantiateModelExchange(fmi2String, fmi2String, fmi2String, bool, bool,
                                                void* environment, LogMessage log) {
  if (log)
    log(environment, fmi2Error, "logStatusError",
        "fmi3InstantiateModelExchange: the FMU is for co-simulation");
  return nullptr;
}

FMI_EXPORTED void* fmi3InstantiateScheduledExecution(fmi2String, fmi2String, fmi2String, bool, bool,
                                                     void* environment, LogMessage log, void*,
                                                     void*, void*) {
  if (log)
    log(environment, fmi2Error, "logStatusError",
        "fmi3InstantiateScheduledExecution: the FMU is for co-simulation");
  return nullptr;
}

FMI_EXPORTED void fmi3FreeInstance(void* instance) {
  if (!instance) return;
  forward(instance, &Component::reset);  // its errors go to the logger
  delete static_cast<Instance*>(instance)->component;
  delete static_cast<Instance*>(instance);
}

FMI_EXPORTED fmi2Status fmi3EnterInitializationMode(void* instance, bool, double, double start,
                                                    bool, double) {
  const fmi2Status status = forward(instance, &Component::set_up, start);
  return status == fmi2OK ? forward(instance, &Component::enter_initialization) : status;
}

FMI_EXPORTED fmi2Status fmi3ExitInitializationMode(void* instance) {
  return forward(instance, &Component::exit_initialization);
}

FMI_EXPORTED fmi2Status fmi3Terminate(void* instance) {
  return forward(instance, &Component::terminate);
}

FMI_EXPORTED fmi2Status fmi3Reset(void* instance) { return forward(instance, &Component::reset); }

FMI_EXPORTED fmi2Status fmi3DoStep(void* instance, double time, double length, bool,
                                   bool* event_needed, bool* ended, bool* early, double* last) {
  const fmi2Status status = forward(instance, &Component::step, time, length);
  int terminated = 0;
  forward(instance, &Component::ended, &terminated);
  if (event_needed) *event_needed = false;
  if (ended) *ended = terminated != 0;
  if (early) *early = false;
  if (last) forward(instance, &Component::last_time, last);
  return status;
}

// ---- variables

FMI_EXPORTED fmi2Status fmi3GetFloat64(void* instance, const fmi2ValueReference references[],
                                       std::size_t count, double values[], std::size_t) {
  return forward(instance, &Component::get_reals, references, count, values);
}

FMI_EXPORTED fmi2Status fmi3SetFloat64(void* instance, const fmi2ValueReference references[],
                                       std::size_t count, const double values[], std::size_t) {
  return forward(instance, &Component::set_reals, references, count, values);
}

FMI_EXPORTED fmi2Status fmi3GetBoolean(void* instance, const fmi2ValueReference references[],
                                       std::size_t count, bool values[], std::size_t) {
  std::vector<fmi2Boolean> found(count);
  const auto own = within(references, count, first_boolean_of_3);
  const fmi2Status status =
      forward(instance, &Component::get_booleans, own.data(), count, found.data());
  if (status == fmi2OK)
    for (std::size_t i = 0; i < count; ++i) values[i] = found[i] != 0;
  return status;
}

FMI_EXPORTED fmi2Status fmi3SetBoolean(void* instance, const fmi2ValueReference references[],
                                       std::size_t count, const bool values[], std::size_t) {
  const std::vector<fmi2Boolean> given(values, values + count);
  const auto own = within(references, count, first_boolean_of_3);
  return forward(instance, &Component::set_booleans, own.data(), count, given.data());
}

FMI_EXPORTED fmi2Status fmi3GetString(void* instance, const fmi2ValueReference references[],
                                      std::size_t count, fmi2String values[], std::size_t) {
  const auto own = within(references, count, first_string_of_3);
  return forward(instance, &Component::get_strings, own.data(), count, values);
}

FMI_EXPORTED fmi2Status fmi3SetString(void* instance, const fmi2ValueReference references[],
                                      std::size_t count, const fmi2String values[], std::size_t) {
  const auto own = within(references, count, first_string_of_3);
  return forward(instance, &Component::set_strings, own.data(), count, values);
}

// ---- states

FMI_EXPORTED fmi2Status fmi3GetFMUState(void* instance, fmi2FMUstate* state) {
  return forward(instance, &Component::get_state, state);
}

FMI_EXPORTED fmi2Status fmi3SetFMUState(void* instance, fmi2FMUstate state) {
  return forward(instance, &Component::set_state, state);
}

FMI_EXPORTED fmi2Status fmi3FreeFMUState(void* instance, fmi2FMUstate* state) {
  return forward(instance, &Component::free_state, state);
}

FMI_EXPORTED fmi2Status fmi3SerializedFMUStateSize(void* instance, fmi2FMUstate state,
                                                   std::size_t* size) {
  return forward(instance, &Component::size_of_state, state, size);
}

FMI_EXPORTED fmi2Status fmi3SerializeFMUState(void* instance, fmi2FMUstate state, fmi2Byte bytes[],
                                              std::size_t size) {
  return forward(instance, &Component::pack_state, state, bytes, size);
}

FMI_EXPORTED fmi2Status fmi3DeserializeFMUState(void* instance, const fmi2Byte bytes[],
                                                std::size_t size, fmi2FMUstate* state) {
  return forward(instance, &Component::unpack_state, bytes, size, state);
}

// ---- types of variables and abilities that this FMU does not have

FMI_UNSUPPORTED(fmi3GetFloat32)
FMI_UNSUPPORTED(fmi3SetFloat32)
FMI_UNSUPPORTED(fmi3GetInt8)
FMI_UNSUPPORTED(fmi3SetInt8)
FMI_UNSUPPORTED(fmi3GetUInt8)
FMI_UNSUPPORTED(fmi3SetUInt8)
FMI_UNSUPPORTED(fmi3GetInt16)
FMI_UNSUPPORTED(fmi3SetInt16)
FMI_UNSUPPORTED(fmi3GetUInt16)
FMI_UNSUPPORTED(fmi3SetUInt16)
FMI_UNSUPPORTED(fmi3GetInt32)
FMI_UNSUPPORTED(fmi3SetInt32)
FMI_UNSUPPORTED(fmi3GetUInt32)
FMI_UNSUPPORTED(fmi3SetUInt32)
FMI_UNSUPPORTED(fmi3GetInt64)
FMI_UNSUPPORTED(fmi3SetInt64)
FMI_UNSUPPORTED(fmi3GetUInt64)
FMI_UNSUPPORTED(fmi3SetUInt64)
FMI_UNSUPPORTED(fmi3GetBinary)
FMI_UNSUPPORTED(fmi3SetBinary)
FMI_UNSUPPORTED(fmi3GetClock)
FMI_UNSUPPORTED(fmi3SetClock)
FMI_UNSUPPORTED(fmi3GetNumberOfVariableDependencies)
FMI_UNSUPPORTED(fmi3GetVariableDependencies)
FMI_UNSUPPORTED(fmi3GetDirectionalDerivative)
FMI_UNSUPPORTED(fmi3GetAdjointDerivative)
FMI_UNSUPPORTED(fmi3EnterConfigurationMode)
FMI_UNSUPPORTED(fmi3ExitConfigurationMode)
FMI_UNSUPPORTED(fmi3EnterEventMode)
FMI_UNSUPPORTED(fmi3EnterStepMode)
FMI_UNSUPPORTED(fmi3GetIntervalDecimal)
FMI_UNSUPPORTED(fmi3GetIntervalFraction)
FMI_UNSUPPORTED(fmi3GetShiftDecimal)
FMI_UNSUPPORTED(fmi3GetShiftFraction)
FMI_UNSUPPORTED(fmi3SetIntervalDecimal)
FMI_UNSUPPORTED(fmi3SetIntervalFraction)
FMI_UNSUPPORTED(fmi3SetShiftDecimal)
FMI_UNSUPPORTED(fmi3SetShiftFraction)
FMI_UNSUPPORTED(fmi3EvaluateDiscreteStates)
FMI_UNSUPPORTED(fmi3UpdateDiscreteStates)
FMI_UNSUPPORTED(fmi3GetOutputDerivatives)
}
