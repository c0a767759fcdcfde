// SPDX-License-Identifier: GPL-2.0-or-later
// The Python module furrow. See inputs/guide/howto/python.md.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <mpi.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <unistd.h>

#include "coupling/base/furrow_fix.h"
#include "coupling/liggghts/errors/error_policy.h"
#include "coupling/liggghts/errors/first_rank.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "coupling/liggghts/library_check.h"
#include "coupling/liggghts/styles/script.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "coupling/output/histories/fix_wheel_history.h"
#include "coupling/python/parts.h"
#include "coupling/session/host_process.h"
#include "coupling/session/session.h"
#include "furrow/io/files/version.h"

namespace {

namespace py = pybind11;
using namespace furrow::coupling;
using SessionPointer = std::shared_ptr<Session>;

// ---- MPI ----------------------------------------------------------------------------------------

/// Closes all sessions at the end of Python. If mpi4py has started MPI, it finalizes MPI itself,
/// later.
void close_all(const std::vector<std::weak_ptr<Session>>& sessions, bool started_here) {
  for (const std::weak_ptr<Session>& each : sessions)
    if (const SessionPointer session = each.lock()) session->close();
  int initialized = 0, finalized = 0;
  MPI_Initialized(&initialized);
  MPI_Finalized(&finalized);
  if (started_here && initialized && !finalized) MPI_Finalize();
}

/// @param communicator of mpi4py, or None for all ranks
MPI_Comm ranks_of(const py::object& communicator) {
  if (communicator.is_none()) return MPI_COMM_WORLD;
  const py::object address = py::module_::import("mpi4py.MPI").attr("_addressof")(communicator);
  return *reinterpret_cast<MPI_Comm*>(address.cast<std::uintptr_t>());
}

// ---- threads ------------------------------------------------------------------------------------

/// One thread of Python at a time calls LIGGGHTS. A thread that waits for its turn lets the others
/// run: the one whose turn it is may need Python, for Ctrl-C or a warning.
class Turn {
 public:
  Turn() {
    const py::gil_scoped_release others;
    process_lock().lock();
  }
  ~Turn() { process_lock().unlock(); }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;
};

/// A property of an object.
template <class Function>
py::cpp_function in_turn(Function&& function) {
  return py::cpp_function(std::forward<Function>(function), py::call_guard<Turn>());
}

/// Python may free a simulation in any thread.
void free_in_turn(Session* session) {
  if (PyGILState_Check()) {
    const Turn turn;
    delete session;
  } else {
    delete session;
  }
}

// ---- a simulation -------------------------------------------------------------------------------

/// Ctrl-C, or another signal whose handler raises an exception.
bool python_is_interrupted() {
  const py::gil_scoped_acquire python;
  return PyErr_CheckSignals() != 0;
}

/// Writes a script into the current folder, where files are found that the lines name. @return its
/// name
std::string write_script(const py::iterable& lines, MPI_Comm ranks) {
  std::string text;
  for (const py::handle& line : lines) text += std::string(py::str(line)) + "\n";
  std::string name = "furrow-XXXXXX.lig";
  on_first_rank(ranks, [&] {
    const int file = mkstemps(name.data(), 4);
    if (file < 0 || write(file, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
      throw furrow::Error(
          "the lines of the script cannot be written to a file in the current folder");
    close(file);
  });
  return broadcast(name, ranks);
}

void add_stream(std::vector<std::string>& arguments, const char* option, const py::object& target,
                bool by_default) {
  if (py::isinstance<py::bool_>(target) && target.cast<bool>() == by_default) return;
  arguments.push_back(option);
  const bool none = target.is_none() || py::isinstance<py::bool_>(target);
  arguments.push_back(none ? "none" : std::string(py::str(target)));
}

SessionPointer open(const py::object& script, const py::dict& variables, const py::object& log,
                    const py::object& screen, const py::object& communicator) {
  start_mpi();
  const MPI_Comm ranks = ranks_of(communicator);
  const bool is_path = py::isinstance<py::str>(script) || py::hasattr(script, "__fspath__");
  const std::string temporary = is_path ? "" : write_script(script, ranks);
  std::vector<std::string> arguments = {"-in", is_path ? std::string(py::str(script)) : temporary};
  add_stream(arguments, "-log", log, true);
  add_stream(arguments, "-screen", screen, true);
  for (const auto& [name, value] : variables) {
    arguments.insert(arguments.end(), {"-var", py::str(name)});
    if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value))
      for (const py::handle& each : value) arguments.push_back(py::str(each));
    else
      arguments.push_back(py::str(value));
  }
  const auto make = [&] {
    const py::gil_scoped_release others;
    return SessionPointer(new Session(arguments, temporary, ranks, python_is_interrupted),
                          free_in_turn);
  };
  SessionPointer session = make();
  show_warnings(*session);
  return session;
}

long advance(Session& session, long count) {
  if (count < 0) throw furrow::Error("step: the number of steps is negative; give 0 or more");
  long done = 0;
  {
    const py::gil_scoped_release others;
    done = session.step(count);
  }
  if (PyErr_Occurred()) throw py::error_already_set();
  show_warnings(session);
  return done;
}

/// Runs what ends a session.
template <void (Session::*action)()>
void finish(Session& session) {
  {
    const py::gil_scoped_release others;
    (session.*action)();
  }
  show_warnings(session);
}

template <class FixClass, class PartClass>
py::dict parts_of(const SessionPointer& session) {
  py::dict parts;
  for (FixClass* fix : fixes_of<FixClass>(*session->liggghts()->modify)) {
    const char* id = as_fix(*fix).id;
    parts[id] = PartClass(session, id);
  }
  return parts;
}

/// The values f_ID[1], f_ID[2], ... of a fix of Furrow, by name. Collective.
py::dict outputs_of(const Session& session, const std::string& id) {
  const std::shared_ptr<LAMMPS_NS::LAMMPS> lammps = session.liggghts();
  auto* fix = dynamic_cast<FurrowFix*>(lammps->modify->find_fix_id(id.c_str()));
  if (!fix) throw furrow::Error("no fix of Furrow has the id '" + id + "'");
  const OutputTable table = find_style(style_of(*fix))->outputs();
  py::dict values;
  if (table.what == "entry")
    for (std::size_t i = 0; i < table.rows.size(); ++i)
      values[py::str(table.rows[i].name)] = fix->compute_vector(static_cast<int>(i));
  return values;
}

py::dict folders_of(const Session& session) {
  py::dict folders;
  for (FixWheelHistory* fix : fixes_of<FixWheelHistory>(*session.liggghts()->modify))
    folders[fix->id] = fix->folder();
  return folders;
}

/// summary.json of a run that has ended.
py::object summary_of(const Session& session, const std::optional<std::string>& id) {
  const py::dict folders = folders_of(session);
  const std::string wanted = id                    ? *id
                             : folders.size() == 1 ? std::string(py::str((*folders.begin()).first))
                                                   : "";
  if (!folders.contains(wanted.c_str()))
    throw furrow::Error("summary: give the id of one wheel/history of the script");
  const py::object path = py::module_::import("pathlib").attr("Path")(folders[wanted.c_str()]);
  const py::object file = path / py::str("summary.json");
  if (!py::cast<bool>(file.attr("is_file")()))
    throw furrow::Error(
        "summary: the run has not ended, and has no averages yet; call run() or end() before, or "
        "read rig.measure()");
  const py::object text = file.attr("read_text")();
  return py::module_::import("json").attr("loads")(text);
}

// ---- documentation

constexpr char simulation_text[] =
    R"(A script of LIGGGHTS and Furrow, open up to its first run.

script: a path, or the lines of a script. Files that lines name are found from the current folder.
variables: as -var of the command line; numbers, texts or lists.
log, screen: a path, None, or True for what the command line does without the option.
communicator: of mpi4py; by default all ranks. All ranks make the same calls.

Positions are in m, angles in rad, forces in N. Arrays are read-only views without a copy.)";

}  // namespace

PYBIND11_MODULE(furrow, module) {
  module.doc() = "Tyres and wheels on soft ground: the program furrow inside Python.";
  module.attr("__version__") = furrow::version();
  throw_errors();

  static py::exception<furrow::Error> error(module, "Error", PyExc_RuntimeError);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(thrown);
    } catch (const RunError& problem) {
      PyErr_SetString(error.ptr(), problem.text.c_str());
    } catch (const furrow::Error& problem) {
      PyErr_SetString(error.ptr(), problem.what());
    }
  });

  int initialized = 0;
  MPI_Initialized(&initialized);
  const auto sessions = std::make_shared<std::vector<std::weak_ptr<Session>>>();
  py::module_::import("atexit").attr("register")(
      py::cpp_function([sessions, initialized] { close_all(*sessions, !initialized); }));

  const py::call_guard<Turn> turn;
  py::class_<BodyPart>(module, "Body", "A body of the scene and its surface.")
      .def_property_readonly("id", &BodyPart::id)
      .def_property_readonly("nodes", in_turn(&BodyPart::nodes),
                             "Positions of the nodes [m], a view.")
      .def_property_readonly("velocities", in_turn(&BodyPart::velocities),
                             "Of the nodes [m/s], a view.")
      .def_property_readonly("forces", in_turn(&BodyPart::forces),
                             "Forces of the ground on the nodes [N], a view.")
      .def_property_readonly("triangles", in_turn(&BodyPart::triangles),
                             "Indices of nodes, a view.");
  py::class_<WheelPart, BodyPart>(module, "Wheel", "A wheel or tyre and its axle.")
      .def_property_readonly("position", in_turn(&WheelPart::position),
                             "x, y, z [m], spin, yaw, camber [rad].")
      .def_property_readonly("velocity", in_turn(&WheelPart::velocity),
                             "Rates of the position, half a step ago [m/s, rad/s].")
      .def_property_readonly("force", in_turn(&WheelPart::force),
                             "Of the ground: force [N] and moment about the axle centre [N m].")
      .def_property_readonly("constraint", in_turn(&WheelPart::constraint),
                             "Force or torque that holds or moves each coordinate [N, N m].")
      .def_property("load", in_turn(&WheelPart::load), in_turn(&WheelPart::set_load),
                    "Force at the axle, the weight included [N].")
      .def("set_axle_torque", &WheelPart::set_axle_torque, py::arg("torque"), turn,
           "Torque of a motor or brake [N m], where the spin is free.")
      .def("prescribe", &WheelPart::prescribe, py::arg("coordinate"), py::arg("rate"), turn,
           "Moves x, y, z, spin, yaw or camber at a rate [m/s, rad/s].")
      .def("hold", &WheelPart::hold, py::arg("coordinate"), turn, "Stops a coordinate.")
      .def("release", &WheelPart::release, py::arg("coordinate"), turn, "Lets forces move it.")
      .def_property_readonly("radius", in_turn(&WheelPart::radius), "Without grousers [m].")
      .def_property_readonly("mass", in_turn(&WheelPart::mass),
                             "Of all that moves with the wheel [kg].");
  py::class_<TerrainPart, BodyPart>(module, "Terrain", "Ground of a line terrain/...")
      .def_property_readonly("level", in_turn(&TerrainPart::level),
                             "Of the undisturbed surface [m].")
      .def("particles", &TerrainPart::particles, turn,
           "Particles of this rank, a dictionary of views for each material; none of a height "
           "field.");
  py::class_<RigPart>(module, "Rig", "A wheel/rig, which drives a wheel.")
      .def_property_readonly("id", &RigPart::id)
      .def("set", &RigPart::set, turn,
           "Changes load_mass, load_force, speed, slip, torque, spin_rate or drawbar_load.")
      .def_property_readonly("targets", in_turn(&RigPart::targets), "Their present values.")
      .def("measure", &RigPart::measure, turn,
           "The channels of history.h5 now, without the losses of the ground.");

  py::class_<Session, SessionPointer>(module, "Simulation", simulation_text)
      .def(py::init([sessions](const py::object& script, const py::dict& variables,
                               const py::object& log, const py::object& screen,
                               const py::object& communicator) {
             SessionPointer session = open(script, variables, log, screen, communicator);
             sessions->push_back(session);
             return session;
           }),
           py::arg("script"), py::kw_only(), py::arg("variables") = py::dict(),
           py::arg("log") = py::none(), py::arg("screen") = py::none(),
           py::arg("communicator") = py::none(), turn)
      .def("step", &advance, py::arg("count") = 1, turn,
           "Runs steps, and the commands between runs. Returns how many: fewer at the end.")
      .def(
          "run",
          [](Session& session) { return advance(session, std::numeric_limits<long>::max()); }, turn,
          "Runs to the end of the script. Returns the number of steps.")
      .def("end", &finish<&Session::end>, turn,
           "Ends the run after its next step, writes its results, and skips the rest.")
      .def("write_checkpoint", &Session::write_checkpoint, py::arg("path"), turn,
           "Of the present step, for read_restart.")
      .def("close", &finish<&Session::close>, turn,
           "Ends the run and frees the simulation, with the last of its arrays.")
      .def("__enter__", [](const SessionPointer& session) { return session; })
      .def(
          "__exit__", [](Session& session, const py::args&) { finish<&Session::close>(session); },
          turn)
      .def_property_readonly("ended", in_turn(&Session::ended), "Whether the script is at its end.")
      .def_property_readonly("time", in_turn(&Session::time), "Of the scene [s].")
      .def_property_readonly("step_number", in_turn(&Session::step_number), "Of LIGGGHTS.")
      .def_property_readonly("bodies", in_turn(&parts_of<FixBody, BodyPart>), "All bodies, by id.")
      .def_property_readonly("wheels", in_turn(&parts_of<FixWheelHub, WheelPart>))
      .def_property_readonly("terrains", in_turn(&parts_of<Terrain, TerrainPart>))
      .def_property_readonly("rigs", in_turn(&parts_of<FixWheelRig, RigPart>))
      .def_property_readonly("grains", in_turn(&grains),
                             "Grains of this rank, a dictionary of views.")
      .def("outputs", &outputs_of, py::arg("id"), turn, "The values f_ID[n] of a fix, by name.")
      .def(
          "variable",
          [](const Session& session, const std::string& name) {
            return variable(*session.liggghts(), name);
          },
          py::arg("name"), turn, "The text of a variable of the script, or None.")
      .def_property_readonly("folders", in_turn(&folders_of),
                             "Results folder of each wheel/history, by id.")
      .def("summary", &summary_of, py::arg("id") = py::none(), turn,
           "Averages of a run that has ended: summary.json as a dictionary.");
}
