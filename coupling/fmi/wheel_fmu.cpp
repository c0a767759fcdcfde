// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/fmi/wheel_fmu.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "furrow/core/checksum.h"
#include "furrow/core/error.h"

namespace furrow::coupling::fmi {

namespace {

constexpr double same_time = 1e-9;  // relative

/// The path of "file:///folder%20name/resources".
std::string path_of(const std::string& location) {
  constexpr char scheme[] = "file:";
  if (location.rfind(scheme, 0) != 0) return location;
  std::string path;
  for (std::size_t i = sizeof scheme - 1; i < location.size(); ++i) {
    if (location[i] == '%' && i + 2 < location.size()) {
      path += static_cast<char>(std::stoi(location.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      path += location[i];
    }
  }
  if (path.rfind("//localhost/", 0) == 0) return path.substr(11);
  return path.rfind("//", 0) == 0 ? path.substr(2) : path;
}

const char* name_of(WheelFmu::Phase phase) {
  switch (phase) {
    case WheelFmu::Phase::instantiated:
      return "before initialization";
    case WheelFmu::Phase::initializing:
      return "in initialization mode";
    case WheelFmu::Phase::stepping:
      return "between steps";
    case WheelFmu::Phase::discarded:
      return "at the end of the script";
    case WheelFmu::Phase::terminated:
      return "after Terminate";
    default:
      return "after an error";
  }
}

std::uint64_t checksum_of(const void* bytes, std::size_t size) {
  Checksum sum;
  sum.add(bytes, size);
  return sum.value();
}

template <class Container>
auto& at(Container& container, fmi2ValueReference reference, const char* type) {
  if (reference >= container.size())
    throw InputError(fmt::format("value reference {}", reference),
                     fmt::format("is no {} of this FMU", type), "those of modelDescription.xml");
  return container[reference];
}

}  // namespace

WheelFmu::WheelFmu(std::string name, const std::string& guid, const std::string& resources,
                   const fmi2CallbackFunctions& callbacks)
    : name_(std::move(name)),
      resources_(path_of(resources)),
      callbacks_(callbacks),
      contents_(read_contents((std::filesystem::path(resources_) / "furrow.json").string())),
      values_(start_values()) {
  if (guid != contents_.guid)
    throw InputError("Instantiate: the GUID", "is '" + guid + "'", "'" + contents_.guid + "'",
                     "take modelDescription.xml and resources from the same FMU");
}

Values WheelFmu::start_values() const {
  Values values;
  values.strings = {contents_.script, ""};
  for (const Contents::ScriptVariable& each : contents_.variables)
    values.strings.push_back(each.value);
  return values;
}

void WheelFmu::log(fmi2Status status, const std::string& message) const {
  if (!callbacks_.logger) return;
  std::string text;
  for (const char c : message) text += c == '%' ? "%%" : std::string(1, c);
  callbacks_.logger(callbacks_.componentEnvironment, name_.c_str(), status,
                    status == fmi2Discard   ? "logStatusDiscard"
                    : status == fmi2Warning ? "logStatusWarning"
                                            : "logStatusError",
                    text.c_str());
}

void WheelFmu::log_once(const std::string& warning) {
  if (warned_.insert(warning).second) log(fmi2Warning, warning);
}

/// A script that is opened again for a state repeats its warnings.
void WheelFmu::log_warnings() {
  for (const std::string& text : wheel_->take_warnings()) log_once(text);
}

void WheelFmu::warn_of_unused_inputs() {
  const auto unused = [&](Real input, Boolean parameter, bool wanted) {
    if (values_.reals[input] == 0.0 || values_.booleans[parameter] == wanted) return;
    log_once(fmt::format("{} has no effect: it needs the parameter {} = {}", reals[input].name,
                         booleans[parameter].name, wanted));
  };
  unused(load, height_by_load, true);
  unused(spin_torque, spin_by_torque, true);
  unused(spin_rate, spin_by_torque, false);
}

void WheelFmu::need(std::initializer_list<Phase> allowed) const {
  if (std::find(allowed.begin(), allowed.end(), phase_) == allowed.end())
    throw Error(fmt::format("the call is not allowed {}", name_of(phase_)));
}

// ---- phases

void WheelFmu::set_up(double start) {
  need({Phase::instantiated});
  time_ = start;
}

void WheelFmu::enter_initialization() {
  need({Phase::instantiated});
  phase_ = Phase::initializing;
}

void WheelFmu::open(const OneWheel::State* state) {
  std::vector<Contents::ScriptVariable> given;
  for (std::size_t i = 0; i < contents_.variables.size(); ++i)
    given.push_back({contents_.variables[i].name, values_.strings[first_script_variable + i]});
  const std::string path = (std::filesystem::path(resources_) / values_.strings[script]).string();
  wheel_ = std::make_unique<OneWheel>(path, given, values_.strings[fmi::log], state);
  log_warnings();
}

void WheelFmu::exit_initialization() {
  need({Phase::initializing});
  if (!wheel_) open(nullptr);
  wheel_->read(values_);
  phase_ = Phase::stepping;
}

fmi2Status WheelFmu::step(double time, double length) {
  need({Phase::stepping});
  if (!(std::abs(time - time_) <= same_time * std::max(1.0, std::abs(time_))))
    throw InputError("DoStep: currentCommunicationPoint", fmt::format("is {} s", time),
                     fmt::format("{} s, the end of the step before", time_));
  warn_of_unused_inputs();
  const double done = wheel_->advance(length, values_);
  log_warnings();
  time_ = time + done;
  if (done == length) return fmi2OK;
  phase_ = Phase::discarded;
  log(fmi2Discard, fmt::format("the script ended at {} s; give its command run more steps", time_));
  return fmi2Discard;
}

void WheelFmu::terminate() {
  need({Phase::stepping, Phase::discarded});
  phase_ = Phase::terminated;
}

void WheelFmu::reset() {
  wheel_.reset();
  values_ = start_values();
  time_ = 0.0;
  phase_ = Phase::instantiated;
}

// ---- variables

double WheelFmu::real(fmi2ValueReference reference) {
  const double& value = at(values_.reals, reference, "Real");
  if (reference < first_output) return value;
  need({Phase::initializing, Phase::stepping, Phase::discarded, Phase::terminated, Phase::failed});
  if (phase_ == Phase::initializing) {
    if (!wheel_) open(nullptr);
    wheel_->read(values_);
  }
  return value;
}

bool WheelFmu::boolean(fmi2ValueReference reference) const {
  return at(values_.booleans, reference, "Boolean");
}

const std::string& WheelFmu::string(fmi2ValueReference reference) const {
  return at(values_.strings, reference, "String");
}

void WheelFmu::set_real(fmi2ValueReference reference, double value) {
  double& place = at(values_.reals, reference, "Real");
  if (reference >= first_output)
    throw InputError(fmt::format("SetReal: {}", reals[reference].name), "is an output", "inputs");
  need({Phase::instantiated, Phase::initializing, Phase::stepping});
  place = value;
  if (reference < velocity_x) values_.pose_given[reference] = true;
}

void WheelFmu::need_closed(const std::string& parameter) const {
  need({Phase::instantiated, Phase::initializing});
  if (wheel_)
    throw Error("parameter '" + parameter +
                "' is set after outputs were read; set parameters before that");
}

void WheelFmu::set_boolean(fmi2ValueReference reference, bool value) {
  bool& place = at(values_.booleans, reference, "Boolean");
  need_closed(booleans[reference].name);
  place = value;
}

void WheelFmu::set_string(fmi2ValueReference reference, const char* value) {
  std::string& place = at(values_.strings, reference, "String");
  need_closed(reference < first_script_variable
                  ? strings[reference].name
                  : contents_.variables[reference - first_script_variable].name);
  place = value ? value : "";
}

// ---- states

std::unique_ptr<WheelFmu::Snapshot> WheelFmu::snapshot() {
  if (!contents_.keeps_states)
    throw Error(
        "the script has no variable 'begin' or 'from' for checkpoints, so the FMU has no states to "
        "get; see "
        "fmi.md");
  auto snapshot = std::make_unique<Snapshot>(Snapshot{phase_, values_, time_, std::nullopt});
  const bool over = phase_ == Phase::discarded || phase_ == Phase::terminated;
  if (!wheel_ || over) return snapshot;  // a script that has ended has only its values
  snapshot->wheel = wheel_->state();
  if (!wheel_->begins_at_state()) restore(*snapshot);
  return snapshot;
}

void WheelFmu::restore(const Snapshot& snapshot) {
  wheel_.reset();
  values_ = snapshot.values;
  time_ = snapshot.time;
  phase_ = Phase::failed;  // should the script not open
  if (snapshot.wheel) open(&*snapshot.wheel);
  phase_ = snapshot.phase;
}

std::vector<std::uint8_t> pack(const WheelFmu::Snapshot& snapshot) {
  nlohmann::json json{{"phase", static_cast<int>(snapshot.phase)},
                      {"time", snapshot.time},
                      {"reals", snapshot.values.reals},
                      {"booleans", snapshot.values.booleans},
                      {"pose_given", snapshot.values.pose_given},
                      {"strings", snapshot.values.strings}};
  if (snapshot.wheel) {
    json["pose"] = snapshot.wheel->pose;
    json["files"] = nlohmann::json::object();
    for (const auto& [name, content] : snapshot.wheel->files)
      json["files"][name] =
          nlohmann::json::binary(std::vector<std::uint8_t>(content.begin(), content.end()));
  }
  std::vector<std::uint8_t> bytes = nlohmann::json::to_cbor(json);
  const std::uint64_t sum = checksum_of(bytes.data(), bytes.size());
  for (std::size_t i = 0; i < sizeof sum; ++i)
    bytes.push_back(static_cast<std::uint8_t>(sum >> (8 * i)));
  return bytes;
}

std::unique_ptr<WheelFmu::Snapshot> unpack(const fmi2Byte* bytes, std::size_t size) {
  constexpr char refused[] =
      "the bytes are no state of this FMU, or are damaged; give those that fmi2SerializeFMUstate "
      "wrote";
  std::uint64_t sum = 0;
  if (!bytes || size <= sizeof sum) throw Error(refused);
  size -= sizeof sum;
  for (std::size_t i = 0; i < sizeof sum; ++i)
    sum |= static_cast<std::uint64_t>(static_cast<std::uint8_t>(bytes[size + i])) << (8 * i);
  if (sum != checksum_of(bytes, size)) throw Error(refused);
  try {
    const nlohmann::json json = nlohmann::json::from_cbor(bytes, bytes + size);
    auto snapshot = std::make_unique<WheelFmu::Snapshot>();
    snapshot->phase = static_cast<WheelFmu::Phase>(json.at("phase").get<int>());
    snapshot->time = json.at("time");
    snapshot->values.reals = json.at("reals");
    snapshot->values.booleans = json.at("booleans");
    snapshot->values.pose_given = json.at("pose_given");
    json.at("strings").get_to(snapshot->values.strings);
    if (json.contains("pose")) {
      OneWheel::State state;
      state.pose = json.at("pose");
      for (const auto& [name, content] : json.at("files").items()) {
        const auto& binary = content.get_binary();
        state.files[name] = std::string(binary.begin(), binary.end());
      }
      snapshot->wheel = state;
    }
    return snapshot;
  } catch (const nlohmann::json::exception&) {
    throw Error(refused);
  }
}

}  // namespace furrow::coupling::fmi
