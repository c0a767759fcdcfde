// SPDX-License-Identifier: GPL-2.0-or-later
// The functions of FMI 2.0 for co-simulation. See inputs/guide/howto/fmi.md.

#include <cstdlib>
#include <cstring>

#include <mpi.h>

#include "core/error.h"
#include "coupling/fmi/wheel_fmu.h"
#include "coupling/liggghts/error_policy.h"

namespace {

using namespace furrow::coupling;
using furrow::coupling::fmi::WheelFmu;

void start_mpi() {
  int initialized = 0, finalized = 0;
  MPI_Finalized(&finalized);
  if (finalized) throw furrow::Error("MPI has ended in this process; start another one");
  MPI_Initialized(&initialized);
  if (initialized) return;
  MPI_Init(nullptr, nullptr);
  std::atexit([] {
    int ended = 0;
    MPI_Finalized(&ended);
    if (!ended) MPI_Finalize();
  });
}

/// Reports what an action throws as an error of the function.
template <class Action>
fmi2Status guarded(fmi2Component component, const char* function, Action action) {
  auto* fmu = static_cast<WheelFmu*>(component);
  if (!fmu) return fmi2Error;
  const auto report = [&](const std::string& text) {
    const bool named = text.rfind(function, 0) == 0;
    fmu->log(fmi2Error, named ? text : std::string(function) + ": " + text);
    return fmi2Error;
  };
  try {
    return action(*fmu);
  } catch (const RunError& problem) {
    fmu->fail();
    return report(problem.text);
  } catch (const std::exception& problem) {
    return report(problem.what());
  }
}

template <class Value, class Action>
fmi2Status each(fmi2Component component, const char* function, std::size_t count,
                const fmi2ValueReference references[], Value values[], Action action) {
  return guarded(component, function, [&](WheelFmu& fmu) {
    for (std::size_t i = 0; i < count; ++i) action(fmu, references[i], values[i]);
    return fmi2OK;
  });
}

fmi2Status unsupported(fmi2Component component, const char* function) {
  return guarded(component, function, [](WheelFmu&) -> fmi2Status {
    throw furrow::Error("this FMU does not have the function");
  });
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
  const auto refuse = [&](const std::string& text) -> fmi2Component {
    if (callbacks && callbacks->logger)
      callbacks->logger(callbacks->componentEnvironment, name ? name : "", fmi2Error,
                        "logStatusError", "%s", text.c_str());
    return nullptr;
  };
  if (!callbacks || !name || !guid || !resources) return refuse("fmi2Instantiate: a null pointer");
  if (type != fmi2CoSimulation) return refuse("fmi2Instantiate: the FMU is for co-simulation");
  try {
    start_mpi();
    throw_errors();
    return new WheelFmu(name, guid, resources, *callbacks);
  } catch (const std::exception& problem) {
    return refuse(problem.what());
  }
}

FMI_EXPORTED void fmi2FreeInstance(fmi2Component component) {
  guarded(component, "fmi2FreeInstance", [](WheelFmu& fmu) {
    fmu.reset();
    return fmi2OK;
  });
  delete static_cast<WheelFmu*>(component);
}

FMI_EXPORTED fmi2Status fmi2SetDebugLogging(fmi2Component, fmi2Boolean, std::size_t,
                                            const fmi2String[]) {
  return fmi2OK;  // errors are always logged, and nothing else is
}

FMI_EXPORTED fmi2Status fmi2SetupExperiment(fmi2Component component, fmi2Boolean, fmi2Real,
                                            fmi2Real start, fmi2Boolean, fmi2Real) {
  return guarded(component, "fmi2SetupExperiment", [&](WheelFmu& fmu) {
    fmu.set_up(start);
    return fmi2OK;
  });
}

FMI_EXPORTED fmi2Status fmi2EnterInitializationMode(fmi2Component component) {
  return guarded(component, "fmi2EnterInitializationMode", [](WheelFmu& fmu) {
    fmu.enter_initialization();
    return fmi2OK;
  });
}

FMI_EXPORTED fmi2Status fmi2ExitInitializationMode(fmi2Component component) {
  return guarded(component, "fmi2ExitInitializationMode", [](WheelFmu& fmu) {
    fmu.exit_initialization();
    return fmi2OK;
  });
}

FMI_EXPORTED fmi2Status fmi2Terminate(fmi2Component component) {
  return guarded(component, "fmi2Terminate", [](WheelFmu& fmu) {
    fmu.terminate();
    return fmi2OK;
  });
}

FMI_EXPORTED fmi2Status fmi2Reset(fmi2Component component) {
  return guarded(component, "fmi2Reset", [](WheelFmu& fmu) {
    fmu.reset();
    return fmi2OK;
  });
}

// ---- variables

FMI_EXPORTED fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference references[],
                                    std::size_t count, fmi2Real values[]) {
  return each(component, "fmi2GetReal", count, references, values,
              [](WheelFmu& fmu, fmi2ValueReference of, fmi2Real& value) { value = fmu.real(of); });
}

FMI_EXPORTED fmi2Status fmi2GetInteger(fmi2Component component, const fmi2ValueReference[],
                                       std::size_t count, fmi2Integer[]) {
  return count == 0 ? fmi2OK : unsupported(component, "fmi2GetInteger");
}

FMI_EXPORTED fmi2Status fmi2GetBoolean(fmi2Component component,
                                       const fmi2ValueReference references[], std::size_t count,
                                       fmi2Boolean values[]) {
  return each(
      component, "fmi2GetBoolean", count, references, values,
      [](WheelFmu& fmu, fmi2ValueReference of, fmi2Boolean& value) { value = fmu.boolean(of); });
}

FMI_EXPORTED fmi2Status fmi2GetString(fmi2Component component,
                                      const fmi2ValueReference references[], std::size_t count,
                                      fmi2String values[]) {
  return each(component, "fmi2GetString", count, references, values,
              [](WheelFmu& fmu, fmi2ValueReference of, fmi2String& value) {
                value = fmu.string(of).c_str();
              });
}

FMI_EXPORTED fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference references[],
                                    std::size_t count, const fmi2Real values[]) {
  return each(
      component, "fmi2SetReal", count, references, values,
      [](WheelFmu& fmu, fmi2ValueReference of, fmi2Real value) { fmu.set_real(of, value); });
}

FMI_EXPORTED fmi2Status fmi2SetInteger(fmi2Component component, const fmi2ValueReference[],
                                       std::size_t count, const fmi2Integer[]) {
  return count == 0 ? fmi2OK : unsupported(component, "fmi2SetInteger");
}

FMI_EXPORTED fmi2Status fmi2SetBoolean(fmi2Component component,
                                       const fmi2ValueReference references[], std::size_t count,
                                       const fmi2Boolean values[]) {
  return each(component, "fmi2SetBoolean", count, references, values,
              [](WheelFmu& fmu, fmi2ValueReference of, fmi2Boolean value) {
                fmu.set_boolean(of, value != 0);
              });
}

FMI_EXPORTED fmi2Status fmi2SetString(fmi2Component component,
                                      const fmi2ValueReference references[], std::size_t count,
                                      const fmi2String values[]) {
  return each(
      component, "fmi2SetString", count, references, values,
      [](WheelFmu& fmu, fmi2ValueReference of, fmi2String value) { fmu.set_string(of, value); });
}

// ---- states

FMI_EXPORTED fmi2Status fmi2GetFMUstate(fmi2Component component, fmi2FMUstate* state) {
  return guarded(component, "fmi2GetFMUstate", [&](WheelFmu& fmu) {
    std::unique_ptr<WheelFmu::Snapshot> made = fmu.snapshot();
    delete static_cast<WheelFmu::Snapshot*>(*state);  // one that is to be overwritten
    *state = made.release();
    return fmi2OK;
  });
}

FMI_EXPORTED fmi2Status fmi2SetFMUstate(fmi2Component component, fmi2FMUstate state) {
  return guarded(component, "fmi2SetFMUstate", [&](WheelFmu& fmu) {
    if (!state) throw furrow::Error("the state is a null pointer");
    fmu.restore(*static_cast<WheelFmu::Snapshot*>(state));
    return fmi2OK;
  });
}

FMI_EXPORTED fmi2Status fmi2FreeFMUstate(fmi2Component, fmi2FMUstate* state) {
  if (!state) return fmi2OK;
  delete static_cast<WheelFmu::Snapshot*>(*state);
  *state = nullptr;
  return fmi2OK;
}

FMI_EXPORTED fmi2Status fmi2SerializedFMUstateSize(fmi2Component component, fmi2FMUstate state,
                                                   std::size_t* size) {
  return guarded(component, "fmi2SerializedFMUstateSize", [&](WheelFmu&) {
    if (!state) throw furrow::Error("the state is a null pointer");
    *size = pack(*static_cast<WheelFmu::Snapshot*>(state)).size();
    return fmi2OK;
  });
}

FMI_EXPORTED fmi2Status fmi2SerializeFMUstate(fmi2Component component, fmi2FMUstate state,
                                              fmi2Byte bytes[], std::size_t size) {
  return guarded(component, "fmi2SerializeFMUstate", [&](WheelFmu&) {
    if (!state) throw furrow::Error("the state is a null pointer");
    const std::vector<std::uint8_t> packed = pack(*static_cast<WheelFmu::Snapshot*>(state));
    if (size < packed.size()) throw furrow::Error("the array is shorter than the state");
    std::memcpy(bytes, packed.data(), packed.size());
    return fmi2OK;
  });
}

FMI_EXPORTED fmi2Status fmi2DeSerializeFMUstate(fmi2Component component, const fmi2Byte bytes[],
                                                std::size_t size, fmi2FMUstate* state) {
  return guarded(component, "fmi2DeSerializeFMUstate", [&](WheelFmu&) {
    *state = fmi::unpack(bytes, size).release();
    return fmi2OK;
  });
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
  return guarded(component, "fmi2DoStep", [&](WheelFmu& fmu) { return fmu.step(time, length); });
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
  return guarded(component, "fmi2GetRealStatus", [&](WheelFmu& fmu) {
    *value = fmu.time();
    return fmi2OK;
  });
}

FMI_EXPORTED fmi2Status fmi2GetIntegerStatus(fmi2Component, const fmi2StatusKind, fmi2Integer*) {
  return fmi2Discard;
}

FMI_EXPORTED fmi2Status fmi2GetBooleanStatus(fmi2Component component, const fmi2StatusKind kind,
                                             fmi2Boolean* value) {
  if (kind != fmi2Terminated) return fmi2Discard;
  return guarded(component, "fmi2GetBooleanStatus", [&](WheelFmu& fmu) {
    *value = fmu.ended();
    return fmi2OK;
  });
}

FMI_EXPORTED fmi2Status fmi2GetStringStatus(fmi2Component, const fmi2StatusKind, fmi2String*) {
  return fmi2Discard;
}

/// For furrow-post fmu: modelDescription.xml of the contents in a file. @return its number of
/// bytes; with a sufficient size the text is written. -1 for a wrong file
FMI_EXPORTED long furrow_describe_fmu(const char* contents, const char* name, char* text,
                                      std::size_t size) {
  try {
    const std::string made = fmi::describe(fmi::read_contents(contents), name);
    if (made.size() <= size) std::memcpy(text, made.data(), made.size());
    return static_cast<long>(made.size());
  } catch (const std::exception&) {
    return -1;
  }
}
}
