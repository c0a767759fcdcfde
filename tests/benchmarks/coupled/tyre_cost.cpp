// SPDX-License-Identifier: GPL-2.0-or-later
// Cost of a tyre in a coupled step: the time in the bodies' advance (all of the tyre's sub-steps
// and the rig) and in the mesh that follows it, over the time of whole steps of the same run. The
// tyre is lowered onto 100,000 grains of 10 mm. They lie in a cubic lattice, six contacts a grain,
// as many as in a poured bed: it needs no settling.
//
//   build/tests/benchmarks/coupled/tyre_cost [step] [across] [around] [steps]        or under
//   mpirun -n 2

#include <chrono>
#include <cstdlib>
#include <string>
#include <tuple>

#include <fmt/format.h>
#include <mpi.h>

#include "atom.h"
#include "coupling/wheels/fix_tyre_darnell.h"
#include "modify.h"
#include "tests/coupled/support/scene.h"

namespace {

using furrow::test::Scene;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

constexpr double diameter = 0.01, spacing = 0.9995 * diameter;  // [m]
constexpr const char* contact = "model hertz tangential history rolling_friction epsd2";

/// 120 x 50 x 17 grains between walls; returns the height of the bed [m].
double make_bed(Scene& scene) {
  const double length = 120 * spacing, width = 50 * spacing, depth = 17 * spacing;
  scene.command("processors 1 * 1");
  scene.granular_box({-0.5 * length - 0.01, -0.5 * width - 0.01, -0.01},
                     {0.5 * length + 0.01, 0.5 * width + 0.01, depth + 0.8}, 0.4 * diameter);
  scene.contact_properties(2e7, 0.25, 0.3, 0.6);
  scene.command(
      "fix rolling all property/global coefficientRollingFriction peratomtypepair 2 0.15 0.15 0.15 "
      "0.15");
  scene.commands(fmt::format(
      "pair_style gran {}\npair_coeff * *\nfix weight all gravity 9.81 vector 0 0 -1", contact));
  // Walls overlap the outer grains as those overlap each other.
  const double inset = 0.5 * (diameter - spacing);
  for (const auto& [name, plane, at] : {std::tuple("x1", "xplane", -0.5 * length + inset),
                                        {"x2", "xplane", 0.5 * length - inset},
                                        {"y1", "yplane", -0.5 * width + inset},
                                        {"y2", "yplane", 0.5 * width - inset},
                                        {"floor", "zplane", inset}})
    scene.command(fmt::format("fix {} all wall/gran {} primitive type 1 {} {:.9f}", name, contact,
                              plane, at));
  scene.command(fmt::format("lattice sc {:.9f} origin 0.5 0.5 0.5", spacing));
  scene.command(fmt::format("region fill block {:.9f} {:.9f} {:.9f} {:.9f} 0 {:.9f} units box",
                            -0.5 * length, 0.5 * length, -0.5 * width, 0.5 * width, depth));
  scene.commands(
      fmt::format("create_atoms 1 region fill\nset group all diameter {} density 2600", diameter));
  return depth + 0.5 * (diameter - spacing);
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  const auto argument = [&](int i, double otherwise) {
    return argc > i ? std::atof(argv[i]) : otherwise;
  };
  const double step = argument(1, 1.5e-5);
  const int across = static_cast<int>(argument(2, 6)), around = static_cast<int>(argument(3, 72)),
            steps = static_cast<int>(argument(4, 400));
  {
    Scene scene;
    const double level = make_bed(scene);
    scene.command(fmt::format("timestep {}", step));
    // Hooks run in the order of the fixes: the first before the bodies advance, the next behind,
    // and so on.
    double advance = 0.0, follow = 0.0;
    Clock::time_point mark;
    scene.at_start_of_step([&] { mark = Clock::now(); });
    scene.command(fmt::format("fix tyre all tyre/darnell file " FURROW_SOURCE_DIR
                              "/inputs/tyres/p235_75r15.yaml pressure 1e5 mesh {} {} mass 30 "
                              "inertia 1 axle -0.2 0 {:.9f}",
                              across, around, level + 0.3488));
    scene.at_start_of_step([&] {
      advance += seconds_since(mark);
      mark = Clock::now();
    });
    scene.command(
        fmt::format("fix rig all wheel/rig wheel tyre load_force 3000 speed 1 mode towed "
                    "settle_time 0.02 accelerate_time 0.02 "
                    "ground_level {:.9f} damping 2000",
                    level));
    scene.command("fix skin all mesh/body body tyre type 2");
    scene.at_start_of_step([&] { follow += seconds_since(mark); });
    scene.command("fix tread all wall/gran/body " + std::string(contact) +
                  " mesh n_meshes 1 meshes skin");
    scene.command("fix move all nve/sphere");
    scene.command("thermo 100000");
    scene.command(fmt::format("run {}", static_cast<int>(0.03 / step)));  // lowered, in contact

    furrow::DarnellTyre& tyre =
        dynamic_cast<furrow::coupling::FixTyreDarnell*>(scene.lammps().modify->find_fix_id("tyre"))
            ->tyre();
    const double carried = tyre.surface().total_force().z();
    advance = follow = 0.0;
    MPI_Barrier(MPI_COMM_WORLD);
    const Clock::time_point start = Clock::now();
    scene.command(fmt::format("run {} pre no post no", steps));
    MPI_Barrier(MPI_COMM_WORLD);
    const double whole = seconds_since(start);
    if (scene.rank() == 0)
      fmt::print(
          "{} rank(s), {} grains, tyre {} x {} of {} triangles carrying {:.0f} N, step {:.3g} s of "
          "{:.3g} s stable: {:.2f} ms a "
          "step; the tyre's advance {:.3f} ms, {:.1f} % of it; its mesh {:.3f} ms, {:.1f} %\n",
          scene.ranks(), static_cast<long>(scene.lammps().atom->natoms), across, around,
          tyre.surface().triangle_count(), carried, step, tyre.stable_time_step(),
          1e3 * whole / steps, 1e3 * advance / steps, 100 * advance / whole, 1e3 * follow / steps,
          100 * follow / whole);
  }
  MPI_Finalize();
}
