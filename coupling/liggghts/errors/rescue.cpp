// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/liggghts/errors/rescue.h"

#include <csignal>
#include <cstdio>
#include <exception>
#include <mutex>
#include <thread>

#include <mpi.h>
#include <unistd.h>

#include "coupling/liggghts/styles/fixes_of.h"
#include "coupling/liggghts/errors/result_buffer.h"

namespace furrow::coupling {

namespace {

constexpr int rescue_signal = SIGUSR2;
constexpr std::chrono::seconds until_rank_0_waits(1), until_results_are_saved(2);
constexpr std::chrono::milliseconds until_results_are_unused(500);

pid_t process_of_rank_0 = 0;  // 0: there is none here
// recursive: an error inside HDF5 ends the run on the same thread, which saves what it can
std::recursive_timed_mutex results;

sigset_t signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, rescue_signal);
  return set;
}

}  // namespace

ResultsInUse::ResultsInUse() { results.lock(); }

ResultsInUse::~ResultsInUse() { results.unlock(); }

void flush_results(const LAMMPS_NS::LAMMPS& lammps) {
  if (!lammps.modify) return;
  const ResultsInUse in_use;
  for (ResultBuffer* fix : fixes_of<ResultBuffer>(*lammps.modify)) try {
      fix->flush_results();
    } catch (const std::exception& loss) {
      std::fprintf(stderr, "Results of fix %s are lost: %s\n", as_fix(*fix).id, loss.what());
    }
}

bool flush_unused_results(const LAMMPS_NS::LAMMPS& lammps, std::chrono::milliseconds time_limit) {
  const std::unique_lock lock(results, time_limit);
  if (lock) flush_results(lammps);
  return lock.owns_lock();
}

void prepare_rescue() {
  const sigset_t set = signals();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
}

void start_rescue(const LAMMPS_NS::LAMMPS& lammps) {
  int rank = 0, size = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  if (size == 1) return;
  MPI_Comm computer;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, rank, MPI_INFO_NULL, &computer);
  int first[2] = {rank, static_cast<int>(getpid())};
  MPI_Bcast(first, 2, MPI_INT, 0, computer);
  MPI_Comm_free(&computer);
  if (first[0] == 0) process_of_rank_0 = first[1];
  if (rank != 0) return;
  std::thread([&lammps] {
    const sigset_t set = signals();
    int signal = 0;
    if (sigwait(&set, &signal) != 0) return;
    std::this_thread::sleep_for(until_rank_0_waits);
    if (!flush_unused_results(lammps, until_results_are_unused))
      std::fprintf(stderr, "Results since the last flush are lost: rank 0 was writing them.\n");
  }).detach();
}

void ask_for_rescue() {
  if (process_of_rank_0 == 0 || kill(process_of_rank_0, rescue_signal) != 0) return;
  std::this_thread::sleep_for(until_results_are_saved);
}

}  // namespace furrow::coupling
