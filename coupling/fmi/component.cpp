// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/fmi/component.h"

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include <mpi.h>

#include "furrow/core/error.h"
#include "coupling/fmi/wheel_fmu.h"
#include "coupling/liggghts/errors/error_policy.h"
#include "coupling/session/host_process.h"
#include "coupling/session/session.h"

namespace furrow::coupling::fmi {

namespace {

/// MPI ends with the process if it begins here.
void keep_mpi() {
  if (!start_mpi()) return;
  std::atexit([] {
    int ended = 0;
    MPI_Finalized(&ended);
    if (!ended) MPI_Finalize();
  });
}

WheelFmu::Snapshot& snapshot_of(fmi2FMUstate state) {
  if (!state) throw Error("the state is a null pointer");
  return *static_cast<WheelFmu::Snapshot*>(state);
}

class WheelComponent : public Component {
 public:
  WheelComponent(fmi2String name, fmi2String guid, fmi2String resources,
                 const fmi2CallbackFunctions& callbacks)
      : fmu_(std::in_place, name, guid, resources, callbacks) {}
  ~WheelComponent() override {
    const std::lock_guard turn(process_lock());
    fmu_.reset();
  }

  fmi2Status set_up(double start) override {
    return guarded("SetupExperiment", [&] { fmu_->set_up(start); });
  }
  fmi2Status enter_initialization() override {
    return guarded("EnterInitializationMode", [&] { fmu_->enter_initialization(); });
  }
  fmi2Status exit_initialization() override {
    return guarded("ExitInitializationMode", [&] { fmu_->exit_initialization(); });
  }
  fmi2Status step(double time, double length) override {
    fmi2Status status = fmi2OK;
    const fmi2Status thrown = guarded("DoStep", [&] { status = fmu_->step(time, length); });
    return thrown == fmi2OK ? status : thrown;
  }
  fmi2Status terminate() override {
    return guarded("Terminate", [&] { fmu_->terminate(); });
  }
  fmi2Status reset() override {
    return guarded("Reset", [&] { fmu_->reset(); });
  }

  fmi2Status get_reals(References references, std::size_t count, fmi2Real* values) override {
    return guarded("GetReal", [&] {
      for (std::size_t i = 0; i < count; ++i) values[i] = fmu_->real(references[i]);
    });
  }
  fmi2Status get_booleans(References references, std::size_t count, fmi2Boolean* values) override {
    return guarded("GetBoolean", [&] {
      for (std::size_t i = 0; i < count; ++i) values[i] = fmu_->boolean(references[i]);
    });
  }
  fmi2Status get_strings(References references, std::size_t count, fmi2String* values) override {
    return guarded("GetString", [&] {
      for (std::size_t i = 0; i < count; ++i) values[i] = fmu_->string(references[i]).c_str();
    });
  }
  fmi2Status set_reals(References references, std::size_t count, const fmi2Real* values) override {
    return guarded("SetReal", [&] {
      for (std::size_t i = 0; i < count; ++i) fmu_->set_real(references[i], values[i]);
    });
  }
  fmi2Status set_booleans(References references, std::size_t count,
                          const fmi2Boolean* values) override {
    return guarded("SetBoolean", [&] {
      for (std::size_t i = 0; i < count; ++i) fmu_->set_boolean(references[i], values[i] != 0);
    });
  }
  fmi2Status set_strings(References references, std::size_t count,
                         const fmi2String* values) override {
    return guarded("SetString", [&] {
      for (std::size_t i = 0; i < count; ++i) fmu_->set_string(references[i], values[i]);
    });
  }

  fmi2Status get_state(fmi2FMUstate* state) override {
    return guarded("GetFMUstate", [&] {
      std::unique_ptr<WheelFmu::Snapshot> made = fmu_->snapshot();
      delete static_cast<WheelFmu::Snapshot*>(*state);  // snapshot to be overwritten
      *state = made.release();
    });
  }
  fmi2Status set_state(fmi2FMUstate state) override {
    return guarded("SetFMUstate", [&] { fmu_->restore(snapshot_of(state)); });
  }
  fmi2Status free_state(fmi2FMUstate* state) override {
    if (!state) return fmi2OK;
    delete static_cast<WheelFmu::Snapshot*>(*state);
    *state = nullptr;
    return fmi2OK;
  }
  fmi2Status size_of_state(fmi2FMUstate state, std::size_t* size) override {
    return guarded("SerializedFMUstateSize", [&] { *size = pack(snapshot_of(state)).size(); });
  }
  fmi2Status pack_state(fmi2FMUstate state, fmi2Byte* bytes, std::size_t size) override {
    return guarded("SerializeFMUstate", [&] {
      const std::vector<std::uint8_t> packed = pack(snapshot_of(state));
      if (size < packed.size()) throw Error("the array is shorter than the state");
      std::memcpy(bytes, packed.data(), packed.size());
    });
  }
  fmi2Status unpack_state(const fmi2Byte* bytes, std::size_t size, fmi2FMUstate* state) override {
    return guarded("DeSerializeFMUstate", [&] { *state = unpack(bytes, size).release(); });
  }

  fmi2Status last_time(fmi2Real* value) override {
    *value = fmu_->time();
    return fmi2OK;
  }
  fmi2Status ended(fmi2Boolean* value) override {
    *value = fmu_->ended();
    return fmi2OK;
  }
  fmi2Status unsupported(fmi2String function) override {
    return guarded(function, [] { throw Error("this FMU does not have the function"); });
  }

 private:
  /// Reports what an action throws as an error of the function.
  template <class Action>
  fmi2Status guarded(const char* function, Action action) {
    const auto report = [&](const std::string& text) {
      const bool named = text.rfind(function, 0) == 0;
      fmu_->log(fmi2Error, named ? text : std::string(function) + ": " + text);
      return fmi2Error;
    };
    const std::lock_guard turn(process_lock());  // instances may be called in several threads
    try {
      action();
      return fmi2OK;
    } catch (const RunError& problem) {
      fmu_->fail();
      return report(problem.text);
    } catch (const std::exception& problem) {
      return report(problem.what());
    }
  }

  std::optional<WheelFmu> fmu_;
};

using Maker = Component* (*)(fmi2String, fmi2String, fmi2String, const fmi2CallbackFunctions*);

/// Makes a component by this copy of the library.
Component* make(fmi2String name, fmi2String guid, fmi2String resources,
                const fmi2CallbackFunctions* callbacks) {
  const std::lock_guard turn(process_lock());
  try {
    keep_mpi();
    throw_errors();
    return new WheelComponent(name, guid, resources, *callbacks);
  } catch (const std::exception& problem) {
    if (callbacks->logger)
      callbacks->logger(callbacks->componentEnvironment, name, fmi2Error, "logStatusError", "%s",
                        problem.what());
    return nullptr;
  }
}

/// Maker of the copy that was loaded first: LIGGGHTS calls the functions of that one.
Maker first_maker() {
  constexpr char variable[] = "FURROW_FMU_IN_PROCESS_1";  // a changed interface gets another number
  const std::string found = shared_text(variable);
  if (!found.empty())
    return reinterpret_cast<Maker>(static_cast<std::uintptr_t>(std::stoull(found)));
  share_text(variable, std::to_string(reinterpret_cast<std::uintptr_t>(make)));
  return make;
}

__attribute__((constructor)) void when_loaded() { first_maker(); }

}  // namespace

Component* make_component(fmi2String name, fmi2String guid, fmi2String resources,
                          const fmi2CallbackFunctions& callbacks) {
  return first_maker()(name, guid, resources, &callbacks);
}

}  // namespace furrow::coupling::fmi
