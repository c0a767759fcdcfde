// SPDX-License-Identifier: GPL-2.0-or-later
// Functions of libliggghts that this executable, or the Python module, replaces: the dynamic linker
// finds ours first. They need default visibility, everything else in coupling/ is hidden.

#include <algorithm>
#include <cstdio>
#include <string>

#include <fmt/format.h>
#include <mpi.h>

#include "furrow/core/error.h"

#include "coupling/liggghts/errors/checked_stream.h"
#include "coupling/liggghts/checkpoint_file.h"
#include "coupling/liggghts/driver.h"
#include "coupling/liggghts/errors/error_policy.h"
#include "coupling/liggghts/errors/errors.h"
#include "coupling/liggghts/library_check.h"
#include "coupling/liggghts/styles/script.h"
#include "coupling/liggghts/errors/signals.h"
#include "coupling/liggghts/errors/stream_check.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "dump.h"
#include "error.h"
#include "fix.h"
#include "input.h"
#include "integrate.h"
#include "lammps.h"
#include "neighbor.h"
#include "output.h"
#include "read_restart.h"
#include "update.h"
#include "variable.h"
#include "write_restart.h"

namespace {

using furrow::coupling::next_function;
using furrow::coupling::stop_alone;
using furrow::coupling::stop_together;
using furrow::coupling::with_collective_errors;
namespace symbol = furrow::coupling::symbol;

std::string fix_text(const LAMMPS_NS::Fix& fix, const char* style, const char* text) {
  const std::string name = std::string("fix ") + style + " (id " + fix.id + "): ";
  return name + (std::string(text).size() > 2 ? text : "illegal command");
}

constexpr char cut_short[] = "The restart file ends too early: it is cut short";

constexpr int deepest = 200;  // brackets and variables within a formula
int formulas = 0;             // formulas in evaluation

int depth_of_brackets(const char* text) {
  int depth = 0, largest = 0;
  for (; *text; ++text) {
    depth += *text == '(' ? 1 : *text == ')' ? -1 : 0;
    largest = std::max(largest, depth);
  }
  return largest;
}

/// A formula, while LIGGGHTS evaluates it: it calls itself for each bracket and each variable, and
/// would exhaust the stack.
class Formula {
 public:
  Formula(LAMMPS_NS::Error& error, const char* text) {
    if (++formulas <= deepest && depth_of_brackets(text) <= deepest) return;
    const std::string start = std::string(text).substr(0, 60);
    with_collective_errors(error, [&] {
      throw furrow::InputError(fmt::format("formula '{}'", start),
                               fmt::format("is more than {} brackets or variables deep", deepest),
                               "variables that are not made of themselves",
                               "look at the variables (v_name) of the formulas that it is made of");
    });
  }
  ~Formula() { --formulas; }
  Formula(const Formula&) = delete;
  Formula& operator=(const Formula&) = delete;
};

}  // namespace

namespace LAMMPS_NS {

#define FURROW_EXPORTED __attribute__((visibility("default")))

/// Called at the start and by the command clear, both of which make a new table of fix styles.
FURROW_EXPORTED void LAMMPS::create() {
  const auto original = next_function<void(LAMMPS*)>(symbol::create);
  if (!original) {  // without it there is no instance that check_library() could look at
    std::fprintf(stderr,
                 "ERROR: the LIGGGHTS library has no %s; install liggghts %s of Debian 12 or 13\n",
                 symbol::create, furrow::coupling::liggghts_version);
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  original(this);
  furrow::coupling::add_styles(*this);
}

/// Every restart file comes from here: of write_restart, restart and signals.
FURROW_EXPORTED void WriteRestart::write(char* file) {
  const auto original = next_function<void(WriteRestart*, char*)>(symbol::write_restart);
  with_collective_errors(*error, [&] {
    furrow::coupling::write_checkpoint(*lmp, file, [&](char* name) { original(this, name); });
  });
}

// LIGGGHTS does not look whether a restart file goes on, and would read its last number for ever.

FURROW_EXPORTED int ReadRestart::read_int() {
  const int value = next_function<int(ReadRestart*)>(symbol::read_int)(this);
  if (me == 0 && std::feof(fp)) error->one(FLERR, cut_short);
  return value;
}

FURROW_EXPORTED void ReadRestart::nread_double(double* numbers, int count, FILE* file) {
  next_function<void(ReadRestart*, double*, int, FILE*)>(symbol::nread_double)(this, numbers, count,
                                                                               file);
  if (std::feof(file)) error->one(FLERR, cut_short);
}

FURROW_EXPORTED double Variable::evaluate(char* text, Tree** tree) {
  static const auto original = next_function<double(Variable*, char*, Tree**)>(symbol::evaluate);
  const Formula formula(*error, text);
  return original(this, text, tree);
}

FURROW_EXPORTED double Variable::evaluate_boolean(char* text) {
  static const auto original = next_function<double(Variable*, char*)>(symbol::evaluate_boolean);
  const Formula formula(*error, text);
  return original(this, text);
}

/// @return 0, or 1 for a command that LIGGGHTS does not have
FURROW_EXPORTED int Input::execute_command() {
  if (furrow::coupling::stop_between_commands(*lmp)) return 0;
  if (furrow::coupling::Driver* driver = furrow::coupling::driver())
    if (driver->before_command(*lmp)) return 0;
  return next_function<int(Input*)>(symbol::execute_command)(this);
}

FURROW_EXPORTED void Input::include() {
  with_collective_errors(*error, [&] { furrow::coupling::check_include(*lmp); });
  next_function<void(Input*)>(symbol::include)(this);
}

/// The first function that a step calls.
FURROW_EXPORTED void Integrate::ev_set(bigint step) {
  static const auto original = next_function<void(Integrate*, bigint)>(symbol::begin_step);
  furrow::coupling::Driver* driver = furrow::coupling::driver();
  furrow::coupling::note_step();
  if (driver && !update->setupflag) driver->before_step(*lmp);
  original(this, step);
}

/// True if neighbour lists are made in this step.
FURROW_EXPORTED int Neighbor::decide() {
  static const auto original =
      next_function<int(Neighbor*)>(symbol::decide);  // LIGGGHTS calls it in every step
  const bool due = original(this) != 0;
  return furrow::coupling::follow_signals(*lmp, due) || due;
}

FURROW_EXPORTED bool Output::restart_requested(const bigint step) {
  // Without this LIGGGHTS, after a checkpoint that a signal asked for, has no further output.
  if (!restart_flag) next_restart_single = next_restart_double = update->laststep + 1;
  static const auto original = next_function<bool(Output*, bigint)>(symbol::restart_requested);
  return original(this, step);
}

/// Dumps, checkpoints and curves of a step.
FURROW_EXPORTED void Output::write(bigint step) {
  next_function<void(Output*, bigint)>(symbol::write_output)(this, step);
  with_collective_errors(*error, [&] { furrow::coupling::check_streams(*lmp); });
}

FURROW_EXPORTED void Dump::openfile() {
  const bool is_open = singlefile_opened;
  next_function<void(Dump*)>(symbol::open_dump)(this);
  if (!is_open && fp && !compressed)
    fp = furrow::coupling::checked_stream(fp, std::string("dump '") + id + "', file " + filename);
}

FURROW_EXPORTED void Error::all(const char* file, int line, const char* text) {
  stop_together(*lmp, text, {file, line});
}

FURROW_EXPORTED void Error::fix_error(const char* file, int line, Fix* fix, const char* text) {
  stop_together(*lmp, fix_text(*fix, fix->style, text), {file, line});
}

FURROW_EXPORTED void Error::fix_error(const char* file, int line, Fix* fix, const char* style,
                                      const char* text) {
  stop_together(*lmp, fix_text(*fix, style, text), {file, line});
}

FURROW_EXPORTED void Error::one(const char* file, int line, const char* text) {
  stop_alone(*lmp, text, {file, line});
}

}  // namespace LAMMPS_NS
