// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/fmi/one_wheel.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "furrow/core/error.h"
#include "furrow/core/gravity.h"
#include "coupling/base/roles/fix_rig.h"
#include "coupling/base/fix_wheel_hub.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "atom.h"
#include "update.h"

namespace furrow::coupling::fmi {

namespace {

namespace fs = std::filesystem;

constexpr std::array<Coordinate, 5> coordinates{Coordinate::x, Coordinate::y, Coordinate::z,
                                                Coordinate::yaw, Coordinate::camber};
constexpr std::size_t height = 2;     // in coordinates
constexpr double largest_turn = 0.5;  // in a step [rad]
constexpr double same_place = 0.1;    // of a radius, between the script and the first step
constexpr double same_step = 1e-6;    // error of a multiple of the time step
constexpr char checkpoint[] = "state";
constexpr double maximum_steps = 1e9;
// Limits as those of a rig: load over weight, torque over load x radius, and rim speed [m/s]
constexpr double largest_load = 1e5, largest_torque = 100.0, largest_rim_speed = 1000.0;

/// A folder that is removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_((fs::temp_directory_path() / "furrow-fmu-XXXXXX").string()) {
    if (!mkdtemp(path_.data())) throw Error("folder '" + path_ + "' for states cannot be made");
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  fs::path operator/(const std::string& name) const { return fs::path(path_) / name; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

std::map<std::string, std::string> read_files(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream stream(entry.path(), std::ios::binary);
    files[fs::relative(entry.path(), folder).string()] =
        std::string(std::istreambuf_iterator<char>(stream), {});
  }
  return files;
}

void write_files(const TemporaryFolder& folder, const std::map<std::string, std::string>& files) {
  for (const auto& [name, content] : files) {
    const fs::path path = folder / name;
    fs::create_directories(path.parent_path());
    std::ofstream stream(path, std::ios::binary);
    if (!stream.write(content.data(), static_cast<std::streamsize>(content.size())).flush())
      throw Error("state '" + path.string() + "' cannot be written");
  }
}

}  // namespace

OneWheel::OneWheel(const std::string& script,
                   const std::vector<Contents::ScriptVariable>& variables, const std::string& log,
                   const State* state) {
  std::vector<std::string> arguments = {"-in",  script, "-screen",
                                        "none", "-log", log.empty() ? "none" : log};
  const TemporaryFolder folder;
  if (state) {
    before_ = *state;
    write_files(folder, state->files);
  }
  const bool continues = !before_.files.empty();
  const bool on_bed = std::any_of(variables.begin(), variables.end(),
                                  [](const auto& each) { return each.name == "from"; });
  const std::string begin = on_bed ? "from" : "begin";
  for (const auto& [name, value] : variables)
    if (!continues || name != begin) arguments.insert(arguments.end(), {"-var", name, value});
  if (continues) {
    const std::string path = folder / checkpoint;
    arguments.insert(arguments.end(), {"-var", begin, on_bed ? path : "read_restart " + path});
  }
  session_ = std::make_unique<Session>(arguments, "", MPI_COMM_SELF, [] { return false; });

  const LAMMPS_NS::Modify& modify = *session_->liggghts()->modify;
  const std::vector<FixWheelHub*> wheels = fixes_of<FixWheelHub>(modify);
  if (wheels.size() != 1)
    throw InputError("script '" + script + "'", fmt::format("has {} wheels", wheels.size()),
                     "one wheel or tyre");
  if (!fixes_of<FixRig>(modify).empty())
    throw InputError("script '" + script + "'", "has a fix wheel/rig",
                     "a wheel without a rig: the importer of the FMU moves it");
  id_ = wheels[0]->id;
  for (std::size_t i = 0; i < pose_.size(); ++i) pose_[i] = hub().position(coordinates[i]);
  if (continues) pose_ = before_.pose;
}

WheelHub& OneWheel::hub() const {
  auto* fix = dynamic_cast<FixWheelHub*>(session_->liggghts()->modify->find_fix_id(id_.c_str()));
  if (!fix) throw Error("fix '" + id_ + "' is no longer part of the simulation");
  return fix->hub();
}

std::array<double, 5> OneWheel::rates(double seconds, const Values& values) const {
  std::array<double, 5> rates{};
  for (std::size_t i = 0; i < rates.size(); ++i) {
    if (i == height && values.booleans[height_by_load]) continue;
    const double radius = hub().nominal_radius();
    const double begin = values.pose_given[i] ? values.reals[position_x + i] : pose_[i];
    if (!moved_ && before_.files.empty() && i <= height &&
        std::abs(begin - pose_[i]) > same_place * radius)
      throw InputError(fmt::format("DoStep: {}", reals[position_x + i].name),
                       fmt::format("is {} in the first step, and the script has the wheel at {}",
                                   begin, pose_[i]),
                       fmt::format("at most {:.3g} m away", same_place * radius),
                       "give the place of the wheel in the script, or do not set this input");
    const double target = begin + seconds * values.reals[velocity_x + i];
    const double travel = target - pose_[i];
    const double limit = i <= height ? radius : largest_turn;
    if (!(std::abs(travel) <= limit))
      throw InputError(
          fmt::format("DoStep: {}", reals[position_x + i].name),
          fmt::format("is {} at the end of the step, and the wheel is at {}", target, pose_[i]),
          fmt::format("at most {} away", limit),
          "give the place of the wheel in the script, or a shorter step");
    rates[i] = travel / seconds;
  }
  return rates;
}

void OneWheel::check_inputs(const WheelHub& wheel, const Values& values) {
  const double weight = wheel.total_mass() * standard_gravity, radius = wheel.nominal_radius(),
               loads = std::max(
                   {weight, std::abs(values.reals[load]), wheel.ground_wrench().force.norm()});
  const auto refuse_above = [&](Real input, double most, const char* unit) {
    if (std::abs(values.reals[input]) > most)
      throw InputError(fmt::format("DoStep: {}", reals[input].name),
                       fmt::format("is {:g} {}", values.reals[input], unit),
                       fmt::format("{:.3g} to {:.3g} {} for a wheel of {:.4g} kg", -most, most,
                                   unit, wheel.total_mass()),
                       "check the unit of the input");
  };
  if (values.booleans[height_by_load]) refuse_above(load, largest_load * weight, "N");
  if (values.booleans[spin_by_torque])
    refuse_above(spin_torque, largest_torque * loads * radius, "N m");
  else
    refuse_above(spin_rate, largest_rim_speed / radius, "rad/s");
}

double OneWheel::advance(double step, Values& values) {
  const double own = session_->liggghts()->update->dt;
  const double count = std::round(step / own);
  if (!(count >= 1 && count <= maximum_steps) || std::abs(step - count * own) > same_step * step)
    throw InputError("DoStep: communicationStepSize", fmt::format("is {} s", step),
                     fmt::format("multiples of the script's time step of {} s", own));
  for (const Real each : {load, spin_torque, spin_rate})
    if (!std::isfinite(values.reals[each]))
      throw InputError(fmt::format("DoStep: {}", reals[each].name), "is not finite", "a number");
  WheelHub& wheel = hub();
  check_inputs(wheel, values);
  const std::array<double, 5> rate = rates(count * own, values);
  for (std::size_t i = 0; i < rate.size(); ++i) wheel.prescribe(coordinates[i], rate[i]);
  if (values.booleans[height_by_load]) {
    wheel.release(Coordinate::z);
    wheel.set_load({0.0, 0.0, -values.reals[load]});
  }
  if (values.booleans[spin_by_torque]) {
    wheel.release(Coordinate::spin);
    wheel.set_axle_torque(values.reals[spin_torque]);
  } else {
    wheel.prescribe(Coordinate::spin, values.reals[spin_rate]);
  }
  moved_ = true;
  const long done = session_->step(static_cast<long>(count));
  for (std::size_t i = 0; i < pose_.size(); ++i) pose_[i] = hub().position(coordinates[i]);
  read(values);
  return done == static_cast<long>(count) ? step : static_cast<double>(done) * own;
}

void OneWheel::read(Values& values) const {
  const WheelHub& wheel = hub();
  const Wrench wrench = wheel.ground_wrench();
  for (std::size_t i = 0; i < pose_.size(); ++i)
    if (!values.pose_given[i]) values.reals[position_x + i] = wheel.position(coordinates[i]);
  for (unsigned i = 0; i < 3; ++i) {
    values.reals[force_x + i] = wrench.force[i];
    values.reals[moment_x + i] = wrench.moment[i];
  }
  values.reals[hub_z] = wheel.position(Coordinate::z);
  values.reals[hub_velocity_z] = wheel.rate(Coordinate::z);
  values.reals[hub_spin] = wheel.position(Coordinate::spin);
  values.reals[hub_spin_rate] = wheel.rate(Coordinate::spin);
}

bool OneWheel::begins_at_state() const {
  return !moved_ || session_->liggghts()->atom->natoms == 0;
}

OneWheel::State OneWheel::state() const {
  if (!moved_) return {pose_, before_.files};
  const TemporaryFolder folder;
  session_->write_checkpoint((folder / checkpoint).string());
  return {pose_, read_files(folder.path())};
}

}  // namespace furrow::coupling::fmi
