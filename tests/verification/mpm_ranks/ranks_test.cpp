// SPDX-License-Identifier: GPL-2.0-or-later
// The same answer on every number of ranks. Each rank runs the scene alone too and compares; run
// under mpirun (tests/CMakeLists.txt).

#include <gtest/gtest.h>
#define OMPI_SKIP_MPICXX
#include <mpi.h>

#include <algorithm>

#include "../../unit/mpm/terrain_scene.h"
#include "bodies/rigid_plate.h"
#include "core/error.h"
#include "tests/support/checkpoints.h"
#include "tests/support/max_error.h"

namespace furrow {
namespace {

using namespace testing_terrain;

Communicator world_ranks() {
  MPI_Comm all = MPI_COMM_WORLD;
  return Communicator(&all);
}

/// What makes the scene another.
struct Variant {
  const char* name;
  bool window, slide;
  const char* ends;
};

/// A plate pressed into snow beside the middle of a bed with absorbing sides, then shaken:
/// particles change cells and ranks.
struct Scene {
  Scene(const Communicator& ranks, const Variant& variant)
      : ground(parameters(variant), ranks),
        plate({PlateShape::square, 0.1, 0.05, 4}, {0.03, 0.0, 0.1 + 1e-4}),
        contact(plate, ground, ContactParameters{}, true, "foot") {
    system.add(plate, "plate");
    system.add(ground, "ground");
    system.add(contact, "foot");
  }
  static TerrainParameters parameters(const Variant& variant) {
    const double cell = 0.02;
    TerrainParameters p = box(material_of(snow()), {-0.2, 0.0, 0}, {0.2, 0.1, 0.1}, cell);
    p.z = even(0, 0.14, cell);
    p.gravity = {0, 0, -standard_gravity};
    p.initial_stress = true;
    p.window = variant.window;
    if (variant.slide) p.slide = SlideSurface{SlideBox{0.03, 0.0, 0.1, 0.1}, 0.3};
    set_boundary(p, {variant.ends, variant.ends, "smooth", "absorbing", "rough", "free"});
    return p;
  }
  void run(int intervals) {
    for (int n = 0; n < intervals; ++n) {
      plate.prescribe(-2.0);
      if (ground.parameters().window) ground.follow(plate.centre().x() + 0.002 * ++steps);
      system.advance(2e-4);
    }
  }
  ContinuumTerrain ground;
  RigidPlate plate;
  TerrainContact contact;
  CoupledSystem system;
  int steps = 0;
};

/// Places and stresses of all particles by number.
std::vector<double> sorted_particles(ContinuumTerrain& ground) {
  std::vector<double> mine;
  for_particles(ground, [&](Particles& particles, std::size_t p) {
    const Vector3 x = particles.position(p), v = particles.velocity(p);
    mine.insert(mine.end(), {particles.data(column::id)[p], x[0], x[1], x[2], v[0], v[1], v[2]});
    for (std::size_t s = 0; s < 7; ++s) mine.push_back(particles.data(column::state + s)[p]);
  });
  const std::vector<double> all = ground.ranks().gather(mine);
  constexpr std::size_t record = 14;
  std::vector<std::size_t> order(all.size() / record);
  for (std::size_t n = 0; n < order.size(); ++n) order[n] = n;
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return all[record * a] < all[record * b]; });
  std::vector<double> sorted;
  for (const std::size_t n : order)
    sorted.insert(sorted.end(), all.begin() + static_cast<long>(record * n),
                  all.begin() + static_cast<long>(record * (n + 1)));
  return sorted;
}

void expect_near(double a, double b, double scale, const std::string& what) {
  EXPECT_LE(std::abs(a - b), 1e-9 * scale) << what << ": " << a << " " << b;
}

void expect_alike(Scene& many, Scene& one) {
  const std::vector<double> a = sorted_particles(many.ground), b = sorted_particles(one.ground);
  ASSERT_EQ(a.size(), b.size());
  const double scales[14] = {1, 0.1, 0.1, 0.1, 1, 1, 1, 1e5, 1e5, 1e5, 1e5, 1e5, 1e5, 1};
  test::MaxError difference;
  for (std::size_t n = 0; n < a.size(); ++n) difference.add((a[n] - b[n]) / scales[n % 14]);
  EXPECT_LE(difference.max(), 1e-9);
  EXPECT_EQ(many.contact.contacts(), one.contact.contacts());
  const double force = one.contact.force().norm();
  for (int c = 0; c < 3; ++c)
    expect_near(many.contact.force()[c], one.contact.force()[c], force, "contact force");
  expect_near(many.contact.friction_loss(), one.contact.friction_loss(), 1.0, "friction loss");
  const EnergyBudget m = many.ground.energy_budget(), o = one.ground.energy_budget();
  expect_near(m.kinetic_energy, o.kinetic_energy, o.contact_work, "kinetic energy");
  expect_near(m.stored_energy, o.stored_energy, o.contact_work, "stored energy");
  expect_near(m.dissipated_energy, o.dissipated_energy, o.contact_work, "dissipated energy");
  expect_near(m.contact_work, o.contact_work, o.contact_work, "contact work");
  expect_near(many.ground.slide_loss(), one.ground.slide_loss(), o.contact_work, "slide loss");
  expect_near(m.load_work, o.load_work, o.contact_work, "load work");
  expect_near(m.numerical_loss, o.numerical_loss, o.contact_work, "numerical loss");
  for (const Face face : all_faces) {
    const Vector3 i = many.ground.boundary_impulse(face), j = one.ground.boundary_impulse(face);
    EXPECT_LE((i - j).norm(), 1e-9 * one.ground.boundary_impulse(Face::z_lower).norm())
        << "impulse of face " << static_cast<int>(face);
  }
}

class Variants : public ::testing::TestWithParam<Variant> {};
INSTANTIATE_TEST_SUITE_P(Ranks, Variants,
                         ::testing::Values(Variant{"at_rest", false, false, "absorbing"},
                                           Variant{"moving", true, false, "smooth"},
                                           Variant{"sliding", false, true, "smooth"},
                                           Variant{"all", true, true, "absorbing"}),
                         [](const auto& one) { return one.param.name; });

TEST_P(Variants, GiveTheAnswerOfOne) {
  Scene many(world_ranks(), GetParam()), one(Communicator(), GetParam());
  many.run(30);
  one.run(30);
  EXPECT_GT(one.contact.contacts(), 20.0);
  expect_alike(many, one);
  if (GetParam().slide) {
    EXPECT_GT(one.ground.slide_loss(), 0.0);
  }
  if (GetParam().window) {
    EXPECT_GT(one.ground.travelled(), 0.03);
    const double mine = static_cast<double>(many.ground.rut().points().size());
    EXPECT_EQ(many.ground.ranks().sum(mine), static_cast<double>(one.ground.rut().points().size()));
  }
}

/// A run of one rank goes on with all of them, and the other way round.
TEST_P(Variants, TakeOverTheStateOfOne) {
  Scene many(world_ranks(), GetParam()), one(Communicator(), GetParam()),
      back(Communicator(), GetParam());
  one.run(12);
  test::hand_over(one.plate, many.plate);
  test::hand_over(one.ground, many.ground);
  test::hand_over(one.contact, many.contact);
  many.steps = one.steps;
  one.run(12);
  many.run(12);
  expect_alike(many, one);
  test::hand_over(many.plate, back.plate);
  test::hand_over(many.ground, back.ground);  // collective
  test::hand_over(many.contact, back.contact);
  back.steps = many.steps;
  back.run(6);
  one.run(6);
  expect_alike(back, one);
}

TEST(Slabs, CoverAllCellsAndOwnEveryPlaneOnce) {
  const Communicator ranks = world_ranks();
  Partition partition(ranks, 20);
  std::vector<double> count(20, 0.0);
  for (std::size_t c = 3; c < 9; ++c) count[c] = 100.0;  // all ground in some cells
  partition.rebalance(count);
  std::vector<double> planes(22, 0.0), cells(20, 0.0);
  for (int p = partition.owned_planes().from; p < partition.owned_planes().to; ++p)
    planes[static_cast<std::size_t>(p)] += 1.0;
  double mine = 0.0;
  for (int c = 0; c < 20; ++c)
    if (partition.owner(c) == ranks.rank()) mine += count[static_cast<std::size_t>(c)];
  ranks.sum(planes.data(), planes.size());
  for (int p = 2; p < 11; ++p) EXPECT_EQ(planes[static_cast<std::size_t>(p)], 1.0) << "plane " << p;
  EXPECT_NEAR(mine, 600.0 / ranks.size(), 100.0);
}

TEST(Communicator, ExchangesAndGathersNumbersOfAnyCount) {
  const Communicator ranks = world_ranks();
  const std::vector<double> mine(static_cast<std::size_t>(ranks.rank()) + 1, ranks.rank() + 0.5);
  for (int other = 0; other < ranks.size(); ++other) {
    if (other == ranks.rank()) continue;
    const std::vector<double> theirs = ranks.exchange(other, mine);
    EXPECT_EQ(theirs, std::vector<double>(static_cast<std::size_t>(other) + 1, other + 0.5));
  }
  std::vector<double> expected;
  for (int r = 0; r < ranks.size(); ++r)
    expected.insert(expected.end(), static_cast<std::size_t>(r) + 1, r + 0.5);
  EXPECT_EQ(ranks.gather(mine), expected);
}

}  // namespace
}  // namespace furrow
