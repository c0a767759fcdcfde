// SPDX-License-Identifier: GPL-2.0-or-later
// Cost of a body's mesh wall: time per step with mesh/body + wall/gran/body over that with
// LIGGGHTS's rigid moving mesh (mesh/surface + move/mesh + wall/gran), same bed, same wheel, same
// motion. Two instances run alternately, a few hundred steps each, so that a noisy machine meets
// both alike; the ratio of each pair is taken and its median printed.
//
//   build/tests/benchmarks/coupled/wall_cost [pairs] [steps]        or under mpirun -n 2
//
// The bed of about 30,000 grains is made once (command bed) and kept.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include <fmt/format.h>
#include <mpi.h>

#include "atom.h"
#include "furrow/geometry/meshes/wheel_mesh.h"
#include "tests/coupled/support/scene.h"

namespace {

using furrow::Surface;
using furrow::Vector3;
using furrow::test::PrescribedBody;
using furrow::test::Scene;

constexpr double radius = 0.15, speed = 0.3, sink_speed = 1.0, step = 4e-5;
constexpr int sink_steps = 700, warm_steps = 1000;

Surface wheel_at_start(double level) {
  furrow::WheelGeometry geometry;
  geometry.diameter = 2 * radius;
  geometry.width = 0.1;
  geometry.segments = 60;
  geometry.element_size = 0.013;
  Surface wheel = furrow::make_wheel_mesh(geometry);
  wheel.x.colwise() += Vector3(-0.2, 0.0, level + radius + 0.012);
  return wheel;
}

void write_stl(const std::string& path, const Surface& surface) {
  std::ofstream file(path);
  file << "solid wheel\n";
  for (const auto& triangle : surface.triangles) {
    file << "facet normal 0 0 1\nouter loop\n";
    for (int j = 0; j < 3; ++j) {
      const Vector3 x = surface.x.col(triangle[j]);
      file << fmt::format("vertex {:.17g} {:.17g} {:.17g}\n", x[0], x[1], x[2]);
    }
    file << "endloop\nendfacet\n";
  }
  file << "endsolid wheel\n";
}

double bed_level(Scene& scene) {
  double top = 0.0;
  const LAMMPS_NS::Atom& atom = *scene.lammps().atom;
  for (int i = 0; i < atom.nlocal; ++i) top = std::max(top, atom.x[i][2] + atom.radius[i]);
  return scene.max(top);
}

double load_bed(Scene& scene) {
  scene.command("processors 1 * 1");
  scene.command(
      "bed " FURROW_SOURCE_DIR
      "/inputs/beds/sand.lig length 0.8 width 0.32 depth 0.12 clearance_above 0.36 diameter 0.01 "
      "density 2600 young 2e7 poisson 0.25 restitution 0.3 friction 0.6 rolling 0.15 pour_friction "
      "0.3 step 4e-5 "
      "seed 86028121");
  scene.command("fix m4 all property/global coefficientFriction peratomtypepair 2 0.6 0.5 0.5 0.5");
  return bed_level(scene);
}

constexpr const char* contact = "model hertz tangential history rolling_friction epsd2";

void make_stock(Scene& scene) {
  const double level = load_bed(scene);
  const Surface wheel = wheel_at_start(level);
  const Vector3 axle = wheel.x.rowwise().mean();
  const std::string stl = fmt::format("wall_cost_{}.stl", scene.ranks());
  if (scene.rank() == 0) write_stl(stl, wheel);
  MPI_Barrier(MPI_COMM_WORLD);
  scene.command(fmt::format("fix wheel all mesh/surface file {} type 2", stl));
  scene.command(fmt::format("fix walls all wall/gran {} mesh n_meshes 1 meshes wheel", contact));
  scene.command("fix move all nve/sphere");
  scene.command(
      fmt::format("fix down all move/mesh mesh wheel linear {} 0 -{}", speed, sink_speed));
  scene.command(
      fmt::format("fix turn all move/mesh mesh wheel rotate origin {} 0 {} axis 0 1 0 period {}",
                  axle[0], axle[2], 2 * M_PI * radius / speed));
  scene.command(fmt::format("run {}", sink_steps));
  scene.commands("unfix turn\nunfix down");
  const double t = sink_steps * step;
  scene.command(fmt::format("fix roll all move/mesh mesh wheel linear {} 0 0", speed));
  scene.command(
      fmt::format("fix turn all move/mesh mesh wheel rotate origin {} 0 {} axis 0 1 0 period {}",
                  axle[0] + speed * t, axle[2] - sink_speed * t, 2 * M_PI * radius / speed));
  scene.command(fmt::format("run {}", warm_steps));
}

void make_body(Scene& scene) {
  const double level = load_bed(scene);
  const Surface start = wheel_at_start(level);
  const Vector3 axle = start.x.rowwise().mean();
  const double sink_time = sink_steps * step, spin = speed / radius;
  scene.add_body("wheel",
                 std::make_unique<PrescribedBody>(start, [=](double time, Surface& surface) {
                   const Vector3 centre =
                       axle + Vector3(speed * time, 0.0, -sink_speed * std::min(time, sink_time));
                   const Vector3 velocity(speed, 0.0, time < sink_time ? -sink_speed : 0.0);
                   const furrow::Matrix3 turn =
                       Eigen::AngleAxisd(spin * time, Vector3::UnitY()).toRotationMatrix();
                   for (Eigen::Index n = 0; n < surface.x.cols(); ++n) {
                     const Vector3 arm = turn * (start.x.col(n) - axle);
                     surface.x.col(n) = centre + arm;
                     surface.v.col(n) = velocity + spin * Vector3::UnitY().cross(arm);
                   }
                 }));
  scene.wall_of_body("wheel", contact, "walls");
  scene.command("fix move all nve/sphere");
  scene.command(fmt::format("run {}", sink_steps + warm_steps));
}

double time_of(Scene& scene, int steps) {
  MPI_Barrier(MPI_COMM_WORLD);
  const auto begin = std::chrono::steady_clock::now();
  scene.command(fmt::format("run {} pre no post no", steps));
  MPI_Barrier(MPI_COMM_WORLD);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  const int pairs = argc > 1 ? std::atoi(argv[1]) : 15, steps = argc > 2 ? std::atoi(argv[2]) : 200;
  {
    Scene stock, body;
    make_stock(stock);
    make_body(body);
    std::vector<double> ratios, milliseconds;
    for (int i = 0; i < pairs; ++i) {
      const double a = time_of(body, steps), b = time_of(stock, steps);
      ratios.push_back(a / b);
      milliseconds.push_back(1e3 * b / steps);
    }
    std::sort(ratios.begin(), ratios.end());
    std::sort(milliseconds.begin(), milliseconds.end());
    if (stock.rank() == 0)
      fmt::print(
          "{} rank(s), {} grains, {} triangles: body wall over stock rigid mesh wall, time per "
          "step: median {:.3f} "
          "(min {:.3f}, max {:.3f}, {} pairs of {} steps); stock {:.2f} ms a step\n",
          stock.ranks(), static_cast<long>(stock.lammps().atom->natoms),
          wheel_at_start(0.1).triangle_count(), ratios[ratios.size() / 2], ratios.front(),
          ratios.back(), pairs, steps, milliseconds[milliseconds.size() / 2]);
  }
  MPI_Finalize();
}
