// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The base of every fix that records results: one file of rows, frames for ParaView, a closing at
/// the end of the run, and runs that are continued from a checkpoint.

#include <chrono>
#include <memory>
#include <optional>

#include "coupling/base/roles/fix_order.h"
#include "coupling/base/furrow_fix.h"
#include "coupling/liggghts/errors/result_buffer.h"
#include "furrow/io/files/folder_lock.h"
#include "furrow/io/results/history_file.h"
#include "furrow/io/formats/vtk_file.h"

namespace furrow::coupling {

class FixHistory : public FurrowFix, public SystemFollower, public ResultBuffer {
 public:
  std::string reason_to_follow() const override {
    return "it records what furrow/system has checked";
  }
  int setmask() override;
  /// Files are made when the first run starts: by then every style of the scene is known.
  void setup(int vflag) override;
  void end_of_step() override;
  /// Ends a run, also when the user interrupts it: all rows so far are written and evaluated.
  void post_run() override;
  /// An error ends the run: the rows since the last flush are still useful.
  void flush_results() override;
  /// Closes the file and frees the folder for another run. For a run that has ended.
  void release_folder();

  bool is_open() const { return opened_; }  ///< since the first run

 protected:
  /// @param schema with the keys of add_keys()
  FixHistory(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg, const Schema& schema);
  /// The keys that all have: folder, every and vtk. @param frames what a frame shows
  static void add_keys(Schema& schema, const char* frames);
  /// Names the file of rows; for the constructor of the derived class. @throws InputError for a
  /// file of another fix
  void take_file(const std::string& name);

  // ---- the recorder's part: called on all ranks -------------------------------------------------
  /// @param resume_time of the checkpoint that this run continues; none for a run from the start
  virtual void open(std::optional<double> resume_time) = 0;
  virtual void record() = 0;
  virtual void write_frame() = 0;
  virtual void close() = 0;

  bool draws() const { return options().integer("vtk") > 0; }
  double time() const;       ///< of the scene [s]
  double wall_time() const;  ///< since the first run began [s]
  RunInfo run_info(const std::string& title) const;
  /// Path of a file in the folder of the results.
  std::string in_folder(const std::string& name) const {
    return options().text("folder") + "/" + name;
  }

  /// Opens file_ for rows of these channels. Rank 0 only.
  void open_rows(const std::vector<Channel>& channels, const std::string& title,
                 std::optional<double> resume_time);
  /// Opens a series of frames; none where the line asks for none. Rank 0 only.
  std::optional<VtkSeries> open_frames(const std::string& series,
                                       std::optional<double> resume_time) const;

  std::optional<HistoryFile> file_;  ///< rank 0 only

 private:
  void warn_of_long_intervals();
  void take_folder();
  /// A checkpoint: the rows up to it must be in the file, or a continued run would find a gap.
  void checkpoint(Checkpoint& state) override;
  bool state_needs_options() const override { return false; }

  std::string file_name_;
  std::shared_ptr<FolderLock> lock_;  // of the folder; rank 0 only
  std::optional<double> resume_time_;
  bool opened_ = false;
  bool warned_ = false;  // of long intervals
  std::chrono::steady_clock::time_point started_;
};

}  // namespace furrow::coupling
