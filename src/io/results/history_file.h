// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The results file of a run, history.h5 of a wheel or terrain.h5 of continuum terrain:
///
///   /run                 attributes title, version, script, started, ranks
///   /run/effective_input text: every style with all its values, and the script
///   /run/styles          text: the same styles in JSON (style_record.h)
///   /history/<channel>   one dataset for each channel, with attributes unit and meaning; all of
///                        one length
///   /grains/reference    id, x, radius, period of the settled bed before the wheel touches it;
///                        attribute bed_level
///   /grains/final        the same and v, at the end
///   /surface             triangles, x of the wheel or tyre at the end
///   /terrain/<field>     particles of continuum terrain at the end (terrain_fields.h), with
///                        attributes unit and meaning
///   /rut                 x, density: what moving terrain has left behind
///   /audit, /cost        numbers as attributes; /audit/energies [J] with its attribute terms, a
///                        name on each line
///   /warnings            text, a sentence on each line
///
/// The file on disk is complete at every instant: rows are gathered in memory, and a flush appends
/// them to a copy beside it ("history.part.h5") which then takes the file's name in one step. A run
/// that is killed leaves the state of its last flush, and others may read while it runs. A flush
/// comes by itself when five seconds have passed and at least a hundred times the duration of the
/// last one, so that files cost less than one per cent of a run.

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "furrow/geometry/surface.h"
#include "furrow/io/formats/grains.h"
#include "furrow/io/results/run_report.h"
#include "furrow/statistics/history.h"

namespace furrow {

struct TerrainSnapshot;
struct RutPoint;

/// Writes history.h5 while the run goes on. One rank of a run has it.
class HistoryFile {
 public:
  /// Starts a file; one that is there is replaced. @throws Error when it cannot be written
  static HistoryFile create(const std::string& path, const std::vector<Channel>& channels,
                            const RunInfo& info);

  /// Continues the file of a run that was stopped. Time semantic of a restart: the checkpoint at
  /// time t holds the state after the step that ended at t, and the row of that instant belongs to
  /// the part before. So every row with a time up to t is kept (up to 1e-9 of the row spacing
  /// later, for rounding), later rows are dropped, and the next row appended must be later than the
  /// last one kept. Call flush() with every checkpoint, or rows are missing at the seam.
  /// @throws Error when the channels differ from the file's, or when rows are missing between the
  /// last one kept and t
  static HistoryFile resume(const std::string& path, const std::vector<Channel>& channels,
                            double time);

  HistoryFile(HistoryFile&&) = default;
  HistoryFile& operator=(HistoryFile&&) = default;
  ~HistoryFile();  ///< flushes what is left; call flush() to see errors

  /// Adds a row (channels' order, time first) and flushes when it is time to.
  /// @throws Error for a wrong length; StateError when a value is not finite, or time does not grow
  void append(const std::vector<double>& row);
  /// Brings the file up to date. @throws Error
  void flush();

  void write_reference(const Grains& grains);
  /// Either may be empty. Grains without a virial, in the state that the file had at its end, keep
  /// that of the file: a run that is continued by no step cannot compute it.
  void write_final(Grains grains, const Surface& surface);
  /// The particles and, where the terrain moved, the rut it left: /terrain/<field>,
  /// /rut/{x,density}
  void write_terrain(const TerrainSnapshot& terrain, const std::vector<RutPoint>& rut);
  void write_closing(const RunClosing& closing);

  /// number of rows, flushed or not, of this run and the parts before
  std::size_t size() const { return flushed_rows_ + rows_.size(); }
  const std::string& path() const { return path_; }

 private:
  HistoryFile(std::string path, const std::vector<Channel>& channels);
  template <class Change>
  void replace_with(Change change);  // change(Hdf5File&) on a copy that then takes the file's name

  std::string path_;
  History rows_;  // since the last flush: memory does not grow with the run
  Grains final_;  // of the end before, with a virial; or none
  std::size_t flushed_rows_ = 0;
  std::optional<double> last_time_;  // [s] of the last row
  double flush_duration_ = 0.0;      // [s] of the last one
  std::chrono::steady_clock::time_point last_flush_;
};

// Reading back. @throws Error when the file or the part is missing, naming both
/// A former name of a channel is read as its present one.
History read_history(const std::string& path);
RunInfo read_run_info(const std::string& path);
Grains read_reference_grains(const std::string& path);
Grains read_final_grains(const std::string& path);
/// The run came to its end (write_closing was called).
bool has_closing(const std::string& path);
RunClosing read_closing(const std::string& path);

}  // namespace furrow
