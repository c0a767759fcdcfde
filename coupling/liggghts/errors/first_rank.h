// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Actions of rank 0 alone, for instance with a file, whose outcome all ranks must know.

#include <exception>
#include <string>

#include <mpi.h>

#include "furrow/core/error.h"

namespace furrow::coupling {

/// A text of one rank, on every rank. Collective.
inline std::string broadcast(std::string text, MPI_Comm ranks, int from = 0) {
  int size = static_cast<int>(text.size());
  MPI_Bcast(&size, 1, MPI_INT, from, ranks);
  text.resize(static_cast<std::size_t>(size));
  MPI_Bcast(text.data(), size, MPI_CHAR, from, ranks);
  return text;
}

/// Runs an action on rank 0. Collective. @throws Error on all ranks when it throws on rank 0
template <class Action>
void on_first_rank(MPI_Comm ranks, Action&& action) {
  int rank = 0;
  MPI_Comm_rank(ranks, &rank);
  std::string problem;
  if (rank == 0) try {
      action();
    } catch (const std::exception& exception) {
      problem = exception.what();
      if (problem.empty()) problem = "an error without a message";
    }
  problem = broadcast(problem, ranks);
  if (!problem.empty()) throw Error(problem);
}

}  // namespace furrow::coupling
