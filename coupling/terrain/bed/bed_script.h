// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A script that makes a bed: its sections and the parameters that it declares. See command_bed.md.

#include <filesystem>
#include <string>
#include <vector>

#include "furrow/core/options/options.h"

namespace furrow::coupling {

/// Present name of a parameter that was renamed; of others their name.
std::string current_name(const std::string& parameter);

class BedScript {
 public:
  /// @throws InputError for a file that is none
  explicit BedScript(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  const std::string& text() const { return text_; }
  /// True if Furrow levels the bed, before the section "#: levelled", and not the script.
  bool leaves_levelling() const { return has("levelled"); }
  /// True if the script pours the bed up to the highest place of its surface.
  bool reads_highest() const;
  /// Commands of a section, continued lines joined.
  std::vector<std::string> commands(const std::string& section) const;

  /// Adds the keys of the section "#: parameters" that the schema does not have; of a script
  /// without it, those that its commands read, with any value. @throws InputError
  void declare_parameters(Schema& schema) const;

 private:
  std::vector<std::string> sections() const;
  std::vector<std::string> lines(const std::string& section) const;
  bool has(const std::string& section) const;
  std::vector<std::string> parameters_that_are_read() const;
  [[noreturn]] void refuse(const std::string& problem, const std::string& allowed) const;

  std::filesystem::path path_;
  std::string text_;
};

}  // namespace furrow::coupling
