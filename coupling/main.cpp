// SPDX-License-Identifier: GPL-2.0-or-later
// furrow: LIGGGHTS with the fix styles of this folder. Same command line, same scripts: furrow -in
// script.

#include <algorithm>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include <mpi.h>

#include "coupling/command_line.h"
#include "coupling/liggghts/errors/first_rank.h"
#include "coupling/liggghts/initialize_mpi.h"
#include "coupling/liggghts/library_check.h"
#include "coupling/liggghts/errors/rescue.h"
#include "coupling/liggghts/errors/signals.h"
#include "coupling/liggghts/styles/style_registry.h"
#include "coupling/output/histories/fix_wheel_history.h"
#include "coupling/run_script.h"
#include "furrow/io/results/law_json.h"
#include "furrow/io/files/version.h"
#include "lammps.h"

namespace {

using namespace furrow::coupling;

constexpr int wrong_command_line = 2;

/// @return a status that ends the program, or nothing
std::optional<int> read_words(int argc, char** argv, bool prints) {
  try {
    const CommandLine line = read_command_line({argv + 1, argv + argc});
    if (prints && line.help) std::fputs(usage().c_str(), stdout);
    if (prints && line.version)
      std::printf("furrow %s with LIGGGHTS %s\n", furrow::version().c_str(), liggghts_version);
    if (line.help || line.version) return 0;
    on_first_rank(MPI_COMM_WORLD, [&] { check_command_line(line); });
  } catch (const std::exception& problem) {
    if (prints) std::fprintf(stderr, "ERROR: %s\n", problem.what());
    return wrong_command_line;
  }
  return std::nullopt;
}

std::string keys_of_styles() {
  std::vector<furrow::Schema> schemas;
  for (const Style& style : styles()) schemas.push_back(style.schema());
  return furrow::schemas_json(schemas);
}

/// Answers that need no MPI, which takes most of the time of a start.
/// @return the status that ends the program, or nothing
std::optional<int> answer(int argc, char** argv) {
  try {
    const CommandLine line = read_command_line({argv + 1, argv + argc});
    if (!line.lists_variables && !line.lists_keys) return std::nullopt;
    std::puts((line.lists_variables ? script_variables(line) : keys_of_styles()).c_str());
    return 0;
  } catch (const std::exception& problem) {
    const bool asked = std::count(argv + 1, argv + argc, std::string("--variables")) > 0;
    if (!asked) return std::nullopt;  // every rank stops at the same fault below
    std::fprintf(stderr, "ERROR: %s\n", problem.what());
    return wrong_command_line;
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (const std::optional<int> status = answer(argc, argv)) return *status;
  handle_signals();
  prepare_rescue();
  initialize_mpi(&argc, &argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  confirm_signals(rank == 0);
  std::optional<int> status = read_words(argc, argv, rank == 0);
  if (!status) {
    std::vector<std::string> words = words_for_liggghts({argv, argv + argc});
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    auto* lammps = new LAMMPS_NS::LAMMPS(argc, pointers.data(), MPI_COMM_WORLD);
    start_rescue(*lammps);
    run_script(*lammps);
    if (agreed_signal())
      report_stop(*lammps);
    else
      warn_without_run(*lammps);
    print_verdicts(*lammps);
    delete lammps;
    status = agreed_signal() ? failure_status() : 0;
  }
  MPI_Finalize();
  return *status;
}
