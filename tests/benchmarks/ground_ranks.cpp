// SPDX-License-Identifier: GPL-2.0-or-later
// Cost of several ranks: the rigid wheel of [Shoop2001] settles on 0.20 m of snow (half model).
// Prints what a rank computes and sends in a sub-step.
//   mpirun -n <ranks> build/tests/benchmarks/ground_ranks [cell in m] [seconds] [blocks along x, y]
// MPI's profiling interface counts calls and processor time here: that of the whole program, as MPI
// sees it.

#define OMPI_SKIP_MPICXX
#include <mpi.h>

#include <ctime>
#include <cstdlib>

#include <fmt/format.h>

#include "../support/wheel_on_ground.h"

namespace {

struct Traffic {
  double messages = 0.0, sent = 0.0;          // between two ranks; [byte]
  double collectives = 0.0, collected = 0.0;  // calls of all ranks; [byte]
  double seconds = 0.0;                       // of the processor, in MPI
};
Traffic traffic;

double seconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <class Call>
int timed(Call call) {
  const double start = seconds();
  const int status = call();
  traffic.seconds += seconds() - start;
  return status;
}

template <class Call>
int collective(int count, Call call) {
  traffic.collectives += 1.0;
  traffic.collected += 8.0 * count;
  return timed(call);
}

}  // namespace

extern "C" {
int MPI_Isend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm ranks,
              MPI_Request* request) {
  traffic.messages += 1.0;
  traffic.sent += 8.0 * count;
  return timed([&] { return PMPI_Isend(data, count, type, to, tag, ranks, request); });
}
int MPI_Waitall(int count, MPI_Request* requests, MPI_Status* statuses) {
  return timed([&] { return PMPI_Waitall(count, requests, statuses); });
}
int MPI_Allreduce(const void* in, void* out, int count, MPI_Datatype type, MPI_Op op,
                  MPI_Comm ranks) {
  return collective(count, [&] { return PMPI_Allreduce(in, out, count, type, op, ranks); });
}
int MPI_Reduce(const void* in, void* out, int count, MPI_Datatype type, MPI_Op op, int root,
               MPI_Comm ranks) {
  return collective(count, [&] { return PMPI_Reduce(in, out, count, type, op, root, ranks); });
}
int MPI_Bcast(void* data, int count, MPI_Datatype type, int root, MPI_Comm ranks) {
  return collective(count, [&] { return PMPI_Bcast(data, count, type, root, ranks); });
}
}

namespace furrow {
namespace {

int run(int argc, char** argv) {
  MPI_Comm all = MPI_COMM_WORLD;
  const Communicator ranks(&all);
  WheelOnGround::Ground ground;
  ground.cell = argc > 1 ? std::atof(argv[1]) : 0.04;
  const double end = argc > 2 ? std::atof(argv[2]) : 0.01;
  if (argc > 4) ground.blocks = BlockLayout{std::atoi(argv[3]), std::atoi(argv[4])};
  WheelOnGround scene(ground, ranks);
  const ContinuumTerrain& soil = scene.soil();

  scene.step();  // the first step has costs of its set-up
  traffic = {};
  const HaloTraffic before = soil.halo_traffic();
  const Traffic asking = traffic;
  const double start = seconds();
  double steps = 0.0;
  while (scene.time() < end) steps += scene.step();
  const double processor = seconds() - start;
  const Traffic now = traffic;
  const HaloTraffic halo = soil.halo_traffic();

  const double in_mpi = now.seconds - asking.seconds;
  const double outside = ranks.max((processor - in_mpi) / steps);
  const double messages = now.messages - asking.messages, sent = now.sent - asking.sent;
  const double most = ranks.max(sent / steps), all_messages = ranks.sum(messages),
               all_sent = ranks.sum(sent), particles = soil.particle_count();
  if (ranks.rank() != 0) return 0;
  const Grid& grid = soil.grid();
  fmt::print(
      "{} rank(s), {} x {} blocks of {} x {} x {} cells, {:.0f} particles, {:.0f} sub-steps\n",
      ranks.size(), soil.partition().blocks(0), soil.partition().blocks(1), grid.axis(0).cells(),
      grid.axis(1).cells(), grid.axis(2).cells(), particles, steps);
  fmt::print(
      "busiest rank, of a sub-step: {:.3f} ms of the processor outside MPI, {:.1f} ns a particle "
      "of its share\n",
      1e3 * outside, 1e9 * outside / particles * ranks.size());
  const double rank_steps = steps * ranks.size();
  fmt::print(
      "a rank, in a sub-step: halo {:.3f} messages, {:.0f} bytes as the ground counts them; all "
      "messages {:.3f}, {:.0f} bytes, of the rank with most {:.0f}; {:.2f} collective calls with "
      "{:.0f} bytes\n",
      (halo.messages - before.messages) / steps, (halo.bytes - before.bytes) / steps,
      all_messages / rank_steps, all_sent / rank_steps, most,
      (now.collectives - asking.collectives) / steps, (now.collected - asking.collected) / steps);
  return 0;
}

}  // namespace
}  // namespace furrow

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  const int status = furrow::run(argc, argv);
  MPI_Finalize();
  return status;
}
