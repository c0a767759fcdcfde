// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A script that runs inside another program, which gets its turn between the steps.

#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <mpi.h>

#include "coupling/liggghts/driver.h"
#include "coupling/session/coroutine.h"
#include "lammps.h"

namespace furrow::coupling {

/// LIGGGHTS and MPI have one state per process: whoever calls a Session holds this lock. Threads
/// take turns, also with sessions of their own.
std::recursive_mutex& process_lock();

/// The script runs in a coroutine. It pauses between two steps of a run, where LIGGGHTS has
/// finished one and begins the next: runs are neither split nor set up twice, and results are those
/// of the executable. Runs that prepare a bed do not pause.
///
/// All functions are collective. @throws RunError, after which the session has ended
///
/// A process has one copy of this library: the functions of LIGGGHTS that another copy overrides
/// would lead into that one.
class Session : private Driver {
 public:
  using Interrupted = std::function<bool()>;

  /// Runs the script up to its first run.
  /// @param arguments as on the command line, without the name of the program
  /// @param temporary a script to remove at the end; may be empty
  /// @param interrupted is asked between steps, some times a second
  Session(std::vector<std::string> arguments, std::string temporary, MPI_Comm ranks,
          Interrupted interrupted);
  ~Session() override;
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Runs steps, and the commands between runs. @return how many: fewer at the end of the script,
  /// or when interrupted @throws Error after close()
  long step(long count);
  long run() { return step(std::numeric_limits<long>::max()); }
  bool ended() const { return script_.ended(); }
  /// Ends a run after its next step, with its results written, and skips the rest of the script.
  void end();

  /// Writes the state after the last complete step. The run may be paused. A run that continues
  /// from the file makes new neighbour lists, so it sums the forces of grains in another order.
  /// @param path of the file to write
  /// @throws Error outside of a run
  void write_checkpoint(const std::string& path);

  /// LIGGGHTS lives as long as any owner of this pointer. @throws Error after close()
  std::shared_ptr<LAMMPS_NS::LAMMPS> liggghts() const;
  void close();
  long step_number() const;  ///< of LIGGGHTS
  double time() const;       ///< of the scene [s]
  bool interrupted() const { return interrupted_now_; }
  /// Runs a change of the scene between steps; its warnings go to take_warnings().
  void change(const std::function<void()>& action);
  /// Warnings of Furrow since the last call, on the first rank.
  std::vector<std::string> take_warnings() { return std::exchange(warnings_, {}); }

 private:
  void run_whole_script();
  void resume();
  void pause();
  bool asks_to_stop();
  void remove_temporary();
  void before_step(LAMMPS_NS::LAMMPS& lammps) override;
  bool before_command(LAMMPS_NS::LAMMPS& lammps) override;
  void warned(const std::string& text) override { warnings_.push_back(text); }

  std::vector<std::string> arguments_;
  std::string temporary_;
  MPI_Comm ranks_;
  Interrupted interrupted_;
  std::shared_ptr<LAMMPS_NS::LAMMPS> liggghts_;
  Coroutine script_;
  long left_ = 0, done_ = 0;  // steps of this call
  bool ending_ = false, interrupted_now_ = false;
  std::vector<std::string> warnings_;
  double last_asked_ = 0.0;  // [s]
};

}  // namespace furrow::coupling
