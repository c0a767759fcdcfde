// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Surfaces, grains and continuum terrain for ParaView: .vtp frames and the .pvd collection that
/// orders them in time.

#include <string>
#include <vector>

#include "furrow/geometry/surface.h"
#include "furrow/io/formats/grains.h"

namespace furrow {

struct MeshFacets;
struct TerrainSnapshot;

/// Polygons of a file. @throws InputError
MeshFacets read_vtp(const std::string& path);

/// Triangles with point data velocity [m/s] and force [N]. Written under another name and renamed:
/// never half a file. @throws Error
void write_vtp(const std::string& path, const Surface& surface);
/// A vector at every node.
struct NodeField {
  std::string name;
  Matrix3X values;
};
/// Triangles with fields of their nodes as point data. @throws Error
void write_vtp(const std::string& path, const Surface& surface,
               const std::vector<NodeField>& fields);
/// One vertex for each grain, with point data id, radius [m], velocity [m/s] and, with a reference,
/// displacement [m]. @throws Error
void write_vtp(const std::string& path, const Grains& grains, const Grains* reference = nullptr);
/// One vertex for each particle, with the fields of terrain_fields.h and its displacement [m] since
/// the start. @throws Error
void write_vtp(const std::string& path, const TerrainSnapshot& terrain);

/// A series of frames: <folder>/<name>_000000.vtp, ... and <folder>/<name>.pvd. The latter lists
/// complete frames only and is replaced in one step, so that a killed run leaves a valid series.
class VtkSeries {
 public:
  /// Starts a series; the folder is made if it is missing, an older series of that name is
  /// replaced.
  /// @throws Error
  static VtkSeries create(const std::string& folder, const std::string& name);
  /// Continues after a restart: frames later than time are dropped from the list and written again.
  /// @throws Error
  static VtkSeries resume(const std::string& folder, const std::string& name, double time);

  /// @throws Error when time is not later than the last frame's, or a file cannot be written
  void add(double time, const Surface& surface);
  void add(double time, const Grains& grains, const Grains* reference = nullptr);
  void add(double time, const TerrainSnapshot& terrain);

  std::size_t size() const { return frames_.size(); }
  std::string pvd() const;            ///< path of the collection
  std::vector<double> times() const;  ///< [s] of the frames so far

 private:
  struct Frame {
    double time;
    std::string file;  // relative to the folder
  };

  VtkSeries(std::string folder, std::string name)
      : folder_(std::move(folder)), name_(std::move(name)) {}
  std::string next_file(double time) const;
  void list(double time, const std::string& file);
  void write_pvd() const;

  std::string folder_, name_;
  std::vector<Frame> frames_;
};

}  // namespace furrow
