// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// bed: a settled bed of grains, made once and kept. See command_bed.md.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "furrow/core/options/options.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "coupling/terrain/bed/bed_script.h"
#include "coupling/terrain/bed/bed_surface.h"
#include "pointers.h"

namespace furrow::coupling {

class CommandBed : protected LAMMPS_NS::Pointers {
 public:
  explicit CommandBed(LAMMPS_NS::LAMMPS* lammps) : Pointers(lammps) {}
  /// The keywords that every bed has; the other parameters are those of its script.
  static Schema schema();
  static OutputTable outputs();

  void command(int narg, char** arg);

 private:
  /// Any other word of the line than script and from, with its value.
  struct Parameter {
    std::string name;
    std::string value;
    std::string written;  // the name in the line, which may be a former one
  };
  /// Values of the line.
  struct Request {
    BedScript script;
    BedSurface surface;
    std::string from;                   // a checkpoint of a run on this bed, or "none"
    std::vector<Parameter> parameters;  // depth among them
    std::string values;                 // of all parameters, equal for equal numbers

    /// Text that identifies the bed, equal for equal beds.
    std::string identity() const;
  };
  /// The files of a bed that was made: a folder, which is there whole or not at all.
  struct KeptBed {
    explicit KeptBed(std::filesystem::path where) : folder(std::move(where)) {}
    std::filesystem::path folder;
    std::filesystem::path restart() const { return folder / "bed.restart"; }
    /// A name and a value on each line, then how it was made.
    std::filesystem::path facts() const { return folder / "facts.txt"; }
    /// Damage of the files; empty when all is whole.
    std::string problem() const;
    /// @throws InputError for a folder or file that another user may have changed
    void require_trusted() const;
  };

  Request read_request(const std::vector<std::string>& words);
  void set_contact(const Options& options);
  void set_parameters(const Request& request);
  bool is_kept(const KeptBed& bed);
  void make(const Request& request, const KeptBed& bed);
  void keep(const Request& request, const KeptBed& bed);
  void read(const Request& request, const KeptBed& bed);
  void run_section(const Request& request, const std::string& name);
};

}  // namespace furrow::coupling
