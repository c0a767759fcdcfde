// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/session/session.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "atom.h"
#include "furrow/core/error.h"
#include "coupling/base/fix_coupled_system.h"
#include "coupling/command_line.h"
#include "coupling/liggghts/data/access.h"
#include "coupling/liggghts/errors/error_policy.h"
#include "coupling/liggghts/errors/first_rank.h"
#include "coupling/liggghts/styles/fixes_of.h"
#include "coupling/liggghts/errors/signals.h"
#include "coupling/output/histories/fix_history.h"
#include "coupling/run_script.h"
#include "coupling/session/host_process.h"
#include "domain.h"
#include "signal_handling.h"
#include "update.h"
#include "write_restart.h"

namespace furrow::coupling {

namespace {

constexpr double time_between_questions = 0.1;  // [s]

/// Each instance of LIGGGHTS adds its styles to tables of the process, and complains on std::cerr
/// of each that is there already.
class QuietErrors {
 public:
  QuietErrors() { std::cerr.setstate(std::ios::failbit); }
  ~QuietErrors() { std::cerr.clear(); }
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;
};

/// @throws Error where another copy of this library runs LIGGGHTS in this process
void claim_process() {
  constexpr char variable[] = "FURROW_LIBRARY_IN_PROCESS";
  const std::string own = std::to_string(reinterpret_cast<std::uintptr_t>(&claim_process));
  const std::string found = shared_text(variable);
  if (!found.empty() && found != own)
    throw Error("another copy of Furrow's library runs in this process; use a process for each");
  share_text(variable, own);
}

/// Grains are inside a periodic box, as in every restart file, while this exists. LIGGGHTS itself
/// moves them there only when it makes neighbour lists.
class GrainsInBox {
 public:
  explicit GrainsInBox(const LAMMPS_NS::LAMMPS& lammps)
      : atom_(*lammps.atom), images_(atom_.image, atom_.image + atom_.nlocal) {
    for (int i = 0; i < atom_.nlocal; ++i)
      places_.insert(places_.end(), atom_.x[i], atom_.x[i] + 3);
    lammps.domain->pbc();
  }
  ~GrainsInBox() {
    std::copy(images_.begin(), images_.end(), atom_.image);
    for (int i = 0; i < atom_.nlocal; ++i) std::copy_n(&places_[3 * std::size_t(i)], 3, atom_.x[i]);
  }
  GrainsInBox(const GrainsInBox&) = delete;
  GrainsInBox& operator=(const GrainsInBox&) = delete;

 private:
  LAMMPS_NS::Atom& atom_;
  std::vector<LAMMPS_NS::tagint> images_;
  std::vector<double> places_;
};

/// Without MPI nothing can be freed: the process is at its end.
void free_all(LAMMPS_NS::LAMMPS* lammps) {
  int finalized = 0;
  MPI_Finalized(&finalized);
  if (!finalized) delete lammps;
}

}  // namespace

std::recursive_mutex& process_lock() {
  static std::recursive_mutex lock;
  return lock;
}

Session::Session(std::vector<std::string> arguments, std::string temporary, MPI_Comm ranks,
                 Interrupted interrupted)
    : arguments_(std::move(arguments)),
      temporary_(std::move(temporary)),
      ranks_(ranks),
      interrupted_(std::move(interrupted)),
      script_([this] { run_whole_script(); }) {
  try {
    claim_process();
    const CommandLine line = read_command_line(arguments_);
    on_first_rank(ranks_, [&] { check_command_line(line); });
    arguments_.insert(arguments_.begin(), "furrow");
    arguments_ = words_for_liggghts(arguments_);
    resume();
  } catch (...) {
    remove_temporary();
    throw;
  }
}

Session::~Session() {
  int finalized = 0;
  MPI_Finalized(&finalized);
  if (finalized) return;
  try {
    close();
  } catch (const RunError&) {  // has been printed
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "ERROR: %s\n", problem.what());
  }
}

// ---- from outside

long Session::step(long count) {
  liggghts();  // must be there
  left_ = count;
  done_ = 0;
  interrupted_now_ = false;
  if (!ended() && count > 0) resume();
  return done_;
}

void Session::end() {
  ending_ = true;
  if (ended()) return;
  LAMMPS_NS::SignalHandler::request_quit = true;
  struct Reset {
    ~Reset() { LAMMPS_NS::SignalHandler::request_quit = false; }
  } reset;
  resume();
}

void Session::write_checkpoint(const std::string& path) {
  const std::shared_ptr<LAMMPS_NS::LAMMPS> lammps = liggghts();
  if (ended() || lammps->update->whichflag != 1)
    throw Error("a checkpoint between steps needs a run that has begun and has not ended");
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::error_code absent;
  if (path.empty() || path.find('\0') != std::string::npos)
    throw InputError("checkpoint", path.empty() ? "has no name" : "has a zero byte in its name",
                     "the path of a file");
  if (!folder.empty() && !std::filesystem::is_directory(folder, absent))
    throw InputError(fmt::format("checkpoint '{}'", path), "lies in a folder that does not exist",
                     "a file in a folder that exists",
                     fmt::format("make the folder '{}', or correct the path", folder.string()));
  const GrainsInBox grains(*lammps);
  std::string name = path;
  LAMMPS_NS::WriteRestart(lammps.get()).write(name.data());
}

void Session::close() {
  end();
  remove_temporary();
  if (liggghts_ && liggghts_.use_count() > 1)  // arrays of Python keep LIGGGHTS
    for (FixHistory* history : fixes_of<FixHistory>(*liggghts_->modify)) history->release_folder();
  liggghts_.reset();
}

std::shared_ptr<LAMMPS_NS::LAMMPS> Session::liggghts() const {
  if (!liggghts_) throw Error("the simulation is closed; open it again with furrow.Simulation");
  return liggghts_;
}

long Session::step_number() const { return liggghts()->update->ntimestep; }

double Session::time() const {
  const std::shared_ptr<LAMMPS_NS::LAMMPS> lammps = liggghts();
  if (const FixCoupledSystem* system = FixCoupledSystem::find(*lammps)) return system->time();
  return static_cast<double>(lammps->update->ntimestep) * lammps->update->dt;
}

void Session::change(const std::function<void()>& action) {
  set_driver(this);
  struct Reset {
    ~Reset() { set_driver(nullptr); }
  } reset;
  action();
}

void Session::resume() {
  change([this] { script_.resume(); });
  if (ended()) remove_temporary();
}

void Session::remove_temporary() {
  if (!temporary_.empty()) unlink(temporary_.c_str());
  temporary_.clear();
}

// ---- from inside

void Session::run_whole_script() {
  std::vector<char*> pointers;
  for (std::string& argument : arguments_) pointers.push_back(argument.data());
  const auto make = [&] {
    const QuietErrors quiet;
    return new LAMMPS_NS::LAMMPS(static_cast<int>(pointers.size()), pointers.data(), ranks_);
  };
  liggghts_.reset(make(), free_all);
  run_script(*liggghts_);
  if (!ending_) warn_without_run(*liggghts_);
}

void Session::pause() { script_.pause(); }

bool Session::asks_to_stop() {
  const double now = MPI_Wtime();
  if (now - last_asked_ < time_between_questions) return false;
  last_asked_ = now;
  return interrupted_();
}

/// Ranks would stop at different steps: several are not interrupted.
void Session::before_step(LAMMPS_NS::LAMMPS& lammps) {
  if (ending_ || !run_can_be_continued()) return;
  int size = 1;
  MPI_Comm_size(ranks_, &size);
  interrupted_now_ = size == 1 && asks_to_stop();
  if (left_ == 0 || interrupted_now_) {
    --lammps.update->ntimestep;  // the step has not begun for the callers
    pause();
    ++lammps.update->ntimestep;
    if (ending_) return;
  }
  --left_;
  ++done_;
}

bool Session::before_command(LAMMPS_NS::LAMMPS& lammps) {
  if (!run_can_be_continued()) return false;
  const std::vector<std::string> words = current_command(lammps);
  if (!words.empty() && words[0] == "quit") ending_ = true;  // of the script, not of the process
  const bool runs = !words.empty() && (words[0] == "run" || words[0] == "run_until_steady");
  if (runs && left_ == 0 && !ending_) pause();
  return ending_;
}

}  // namespace furrow::coupling
