// SPDX-License-Identifier: GPL-2.0-or-later
// The same answer on every number of ranks, in every arrangement of their blocks. The first rank
// runs the scene alone too and compares; run under mpirun (tests/CMakeLists.txt).

#include <gtest/gtest.h>
#define OMPI_SKIP_MPICXX
#include <mpi.h>

#include <algorithm>
#include <memory>
#include <numeric>

#include "../../unit/mpm/terrain_scene.h"
#include "furrow/bodies/rigid_plate.h"
#include "furrow/core/error.h"
#include "tests/support/bar.h"
#include "tests/support/checkpoints.h"
#include "tests/support/max_error.h"

namespace furrow::ranks_test {
namespace {

using namespace testing_terrain;

Communicator world_ranks() {
  MPI_Comm all = MPI_COMM_WORLD;
  return Communicator(&all);
}

bool is_first() { return world_ranks().rank() == 0; }

/// The ground has 20 x 5 cells: some blocks are thin, and of 1 x 8 three are empty.
std::vector<BlockLayout> layouts() {
  switch (world_ranks().size()) {
    case 2:
      return {{2, 1}, {1, 2}};
    case 3:
      return {{3, 1}, {1, 3}};
    case 4:
      return {{2, 2}};
    case 8:
      return {{4, 2}, {1, 8}};
    default:
      return {{world_ranks().size(), 1}};
  }
}

/// Porous elasticity: the moduli depend on the stress, and the springs of contacts on the moduli.
constexpr char porous_snow[] =
    "crushable_foam density 200 pt 2000 sigma0 5000 K 1 pc0_reading pc0 elasticity porous "
    "elasticity.kappa 0.005 elasticity.e0 3.5 nu 0.3 pt_el 5000 hardening exponential pc0 5000 "
    "lambda 0.35 hardening.kappa 0.005 hardening.e0 3.5";

/// Choices that make one scene differ from another.
struct Variant {
  const char* name;
  bool window, slide, sheet;
  const char* ends;
  std::string material = snow();
  double sleep_tolerance = 0.0;
  double upper = 0.2;   // end of the bed along x [m]
  double speed = -2.0;  // of the plate [m/s]
  bool thin = false;    // a wall in the place of the plate, which divides the ground
  bool graded = false;  // fine cells follow the plate
};

/// A plate pressed into snow beside the middle of a bed with absorbing sides, then shaken:
/// particles change cells and ranks.
struct Scene {
  Scene(const Communicator& ranks, const Variant& variant, const BlockLayout& blocks = {})
      : ground(parameters(variant, blocks), ranks),
        plate(tool(variant.thin)),
        contact(plate, ground, ContactParameters{}, true, "foot"),
        speed(variant.speed) {
    system.add(plate, "plate");
    system.add(ground, "ground");
    system.add(contact, "foot");
  }
  static RigidPlate tool(bool thin) {
    const PlateGeometry square{PlateShape::square, 0.1, 0.05, 4};
    const Vector3 place(0.03, 0.0, 0.1 + 1e-4);
    return thin ? RigidPlate(square, test::bar({0.03, 0.1, 0.1}), place)
                : RigidPlate(square, place);
  }
  static TerrainParameters parameters(const Variant& variant, const BlockLayout& blocks) {
    const double cell = 0.02;
    TerrainParameters p =
        box(material_of(variant.material), {-0.2, 0.0, 0}, {variant.upper, 0.1, 0.1}, cell);
    p.z = even(0, 0.14, cell);
    p.gravity = {0, 0, -standard_gravity};
    p.initial_stress = true;
    p.window = variant.window;
    if (variant.window) {  // higher ground ahead: blocks follow
      ReliefParameters relief;
      relief.trapezoid = Eigen::Vector4d(0.4, 0.02, 0.399, 0.4);
      p.relief = GroundRelief(relief, "ground");
    }
    p.surface_mesh = variant.sheet;
    p.blocks = blocks;
    p.sleep_tolerance = variant.sleep_tolerance;
    p.thin_parts = variant.thin;
    if (variant.graded) {
      const FollowingAxis axis =
          following_axis({-0.5, 0.5, cell, -0.06, 0.06, 1.3}, "ground along x");
      p.x = axis.layout;
      p.halvings = axis.halvings;
      p.window = true;
    }
    if (variant.slide) p.slide = SlideSurface{SlideBox{0.03, 0.0, 0.1, 0.1}, 0.3};
    set_boundary(p, {variant.ends, variant.ends, "smooth", variant.graded ? "smooth" : "absorbing",
                     "rough", "free"});
    return p;
  }
  void run(int intervals) {
    for (int n = 0; n < intervals; ++n) {
      plate.prescribe(speed);
      if (ground.parameters().window) ground.follow(plate.centre().x() + 0.002 * ++steps);
      // as grains do that lie on the sheet [N]
      if (ground.parameters().surface_mesh) ground.surface().f.row(2).setConstant(-0.05);
      system.advance(2e-4);
    }
  }
  ContinuumTerrain ground;
  RigidPlate plate;
  TerrainContact contact;
  CoupledSystem system;
  double speed;  // [m/s]
  int steps = 0;
};

/// The scene on the first rank alone; none on the others.
std::unique_ptr<Scene> scene_of_one(const Variant& variant) {
  return is_first() ? std::make_unique<Scene>(Communicator(), variant) : nullptr;
}

/// Bytes or numbers of one rank, on all.
template <class Value>
void broadcast(std::vector<Value>& values, int from) {
  auto size = static_cast<int>(values.size());
  MPI_Bcast(&size, 1, MPI_INT, from, MPI_COMM_WORLD);
  values.resize(static_cast<std::size_t>(size));
  MPI_Bcast(values.data(), size * static_cast<int>(sizeof(Value)), MPI_BYTE, from, MPI_COMM_WORLD);
}

/// All that a checkpoint of a scene holds, as the program has it: the bytes of the first rank, and
/// the particles of each.
struct State {
  /// Collective for a scene of all ranks.
  explicit State(Scene& scene)
      : plate(test::state_of(scene.plate)),
        ground(test::state_of(scene.ground, scene.ground.ranks().rank())),
        contact(test::state_of(scene.contact)),
        steps(scene.steps) {
    if (scene.ground.ranks().size() > 1) share(scene.ground.ranks().size());
  }
  /// That of the first rank, on all of them.
  explicit State(Scene* of_first) {
    if (of_first) *this = State(*of_first);
    share(1);
  }
  void share(int writers) {
    for (test::SavedState* state : {&plate, &ground, &contact}) broadcast(state->bytes, 0);
    ground.numbers.of_rank.resize(static_cast<std::size_t>(writers));
    for (int r = 0; r < writers; ++r)
      broadcast(ground.numbers.of_rank[static_cast<std::size_t>(r)], r);
    MPI_Bcast(&steps, 1, MPI_INT, 0, MPI_COMM_WORLD);
  }
  void restore(Scene& scene) const {
    test::restore(scene.plate, plate);
    test::restore(scene.ground, ground);
    test::restore(scene.contact, contact);
    scene.steps = steps;
  }
  bool operator==(const State& other) const {
    return plate == other.plate && ground == other.ground && contact == other.contact;
  }
  test::SavedState plate, ground, contact;
  int steps = 0;
};

/// Results of a scene; on each of its ranks.
struct Answer {
  explicit Answer(Scene& scene)
      : energy(scene.ground.energy_budget()),
        force(scene.contact.force()),
        contacts(scene.contact.contacts()),
        friction_loss(scene.contact.friction_loss()),
        slide_loss(scene.ground.slide_loss()),
        sheet(sheet_of(scene.ground.surface())),
        rut(collected_rut(scene.ground)) {
    for (const Face face : all_faces) impulse[face] = scene.ground.boundary_impulse(face);
    std::vector<double> mine;
    for_particles(scene.ground, [&](Particles& p, std::size_t n) {
      const Vector3 x = p.position(n), v = p.velocity(n);
      mine.insert(mine.end(), {p.data(column::id)[n], x[0], x[1], x[2], v[0], v[1], v[2]});
      for (std::size_t s = 0; s < 7; ++s) mine.push_back(p.data(column::state + s)[n]);
    });
    const std::vector<double> all = scene.ground.ranks().gather(mine);
    std::vector<std::size_t> order(all.size() / record);
    for (std::size_t n = 0; n < order.size(); ++n) order[n] = n;
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return all[record * a] < all[record * b]; });
    for (const std::size_t n : order)
      particles.insert(particles.end(), all.begin() + static_cast<long>(record * n),
                       all.begin() + static_cast<long>(record * (n + 1)));
  }
  static std::vector<double> sheet_of(const Surface& surface) {
    std::vector<double> numbers(surface.x.data(), surface.x.data() + surface.x.size());
    numbers.insert(numbers.end(), surface.v.data(), surface.v.data() + surface.v.size());
    return numbers;
  }
  static std::vector<double> collected_rut(const ContinuumTerrain& ground) {
    std::vector<double> numbers;
    for (const RutPoint& point : ground.rut().gather(ground.ranks()))
      numbers.insert(numbers.end(), {point.x, point.y, point.z, 1e-3 * point.density});
    return numbers;
  }
  static constexpr std::size_t record = 14;
  std::vector<double> particles;  // number, place, velocity and stress of each, by number
  EnergyBudget energy;
  Vector3 force;
  double contacts, friction_loss, slide_loss;
  std::vector<double> sheet, rut;
  FaceArray<Vector3> impulse;
};

void expect_near(double a, double b, double scale, const std::string& what) {
  EXPECT_LE(std::abs(a - b), 1e-9 * scale) << what << ": " << a << " " << b;
}

void expect_alike(const Answer& many, const Answer& one) {
  ASSERT_EQ(many.particles.size(), one.particles.size());
  const double scales[14] = {1, 0.1, 0.1, 0.1, 1, 1, 1, 1e5, 1e5, 1e5, 1e5, 1e5, 1e5, 1};
  test::MaxError difference;
  for (std::size_t n = 0; n < one.particles.size(); ++n)
    difference.add((many.particles[n] - one.particles[n]) / scales[n % 14]);
  EXPECT_LE(difference.max(), 1e-9);
  ASSERT_EQ(many.sheet.size(), one.sheet.size());
  for (std::size_t n = 0; n < one.sheet.size(); ++n)
    expect_near(many.sheet[n], one.sheet[n], 1.0, "sheet");
  ASSERT_EQ(many.rut.size(), one.rut.size());
  for (std::size_t n = 0; n < one.rut.size(); ++n) expect_near(many.rut[n], one.rut[n], 1.0, "rut");
  EXPECT_EQ(many.contacts, one.contacts);
  for (int c = 0; c < 3; ++c)
    expect_near(many.force[c], one.force[c], one.force.norm(), "contact force");
  expect_near(many.friction_loss, one.friction_loss, 1.0, "friction loss");
  const EnergyBudget &m = many.energy, &o = one.energy;
  expect_near(m.kinetic_energy, o.kinetic_energy, o.contact_work, "kinetic energy");
  expect_near(m.stored_energy, o.stored_energy, o.contact_work, "stored energy");
  expect_near(m.dissipated_energy, o.dissipated_energy, o.contact_work, "dissipated energy");
  expect_near(m.contact_work, o.contact_work, o.contact_work, "contact work");
  expect_near(many.slide_loss, one.slide_loss, o.contact_work, "slide loss");
  expect_near(m.load_work, o.load_work, o.contact_work, "load work");
  expect_near(m.numerical_loss, o.numerical_loss, o.contact_work, "numerical loss");
  for (const Face face : all_faces)
    EXPECT_LE((many.impulse[face] - one.impulse[face]).norm(),
              1e-9 * one.impulse[Face::z_lower].norm())
        << "impulse of face " << static_cast<int>(face);
}

/// Collective for the scene of all ranks.
void expect_alike(Scene& many, Scene* one) {
  const Answer answer(many);
  if (one) expect_alike(answer, Answer(*one));
}

class Variants : public ::testing::TestWithParam<Variant> {};
INSTANTIATE_TEST_SUITE_P(Ranks, Variants,
                         ::testing::Values(Variant{"at_rest", false, false, true, "absorbing"},
                                           Variant{"moving", true, false, false, "smooth"},
                                           Variant{"sliding", false, true, false, "smooth"},
                                           Variant{"divided", true, false, false, "absorbing",
                                                   snow(), 0.0, 0.2, -2.0, true},
                                           Variant{"all", true, true, false, "absorbing"}),
                         [](const auto& one) { return one.param.name; });

TEST_P(Variants, ResultsAreThoseOfOneRank) {
  const std::unique_ptr<Scene> one = scene_of_one(GetParam());
  if (one) {
    one->run(30);
    EXPECT_GT(one->contact.contacts(), 20.0);
    if (GetParam().slide) {
      EXPECT_GT(one->ground.slide_loss(), 0.0);
    }
    if (GetParam().thin) {
      double copies = 0.0;  // of the velocity of nodes: particles that use one
      for (const ParticleGroup& group : one->ground.groups())
        copies += group.field > 0 ? static_cast<double>(group.particles.size()) : 0.0;
      EXPECT_GT(copies, 20.0);
    }
    if (GetParam().window) {
      EXPECT_GT(one->ground.travelled(), 0.03);
      EXPECT_FALSE(one->ground.rut().points().empty());
    }
  }
  for (const BlockLayout& layout : layouts()) {
    SCOPED_TRACE(::testing::Message() << layout.x << " x " << layout.y << " blocks");
    Scene many(world_ranks(), GetParam(), layout);
    const Partition::Bounds before = many.ground.partition().bounds();
    many.run(30);
    expect_alike(many, one.get());
    if (GetParam().window && layout.x % 2 == 0) {  // else not by a whole cell
      EXPECT_NE(many.ground.partition().bounds(), before);
    }
    EXPECT_TRUE(many.ground.grid().stored() == many.ground.partition().local_nodes());
  }
}

/// A run of one rank goes on with all of them, and the other way round.
TEST_P(Variants, StateOfOneRankIsRestored) {
  const std::unique_ptr<Scene> one = scene_of_one(GetParam());
  if (one) one->run(12);
  Scene many(world_ranks(), GetParam(), layouts().front());
  State(one.get()).restore(many);
  if (one) one->run(12);
  many.run(12);
  expect_alike(many, one.get());
  const State state(many);
  if (!one) return;
  Scene back(Communicator(), GetParam());
  state.restore(back);
  back.run(6);
  one->run(6);
  expect_alike(back, one.get());
}

const Variant all = {"all", true, true, false, "absorbing"};

TEST(Blocks, RestartFromTheFirstRankIsBitwise) {
  for (const std::string& material : {snow(), std::string(porous_snow)}) {
    Variant variant = all;
    variant.material = material;
    Scene first(world_ranks(), variant, layouts().front()),
        second(world_ranks(), variant, layouts().front());
    // to a moment at which the plate touches: at the start the ground bounces off
    for (int n = 0; n < 7 || (first.contact.contacts() < 10.0 && n < 60); ++n) first.run(1);
    EXPECT_GE(first.contact.contacts(), 10.0);
    State(first).restore(second);
    first.run(20);
    second.run(20);
    EXPECT_TRUE(State(first) == State(second)) << material;
  }
}

TEST(Blocks, RestartInAnotherLayoutContinues) {
  const BlockLayout layout = layouts().front();
  if (layout.x == layout.y) GTEST_SKIP() << "as many blocks along x as along y";
  Scene first(world_ranks(), all, layout), turned(world_ranks(), all, {layout.y, layout.x});
  first.run(7);
  State(first).restore(turned);
  first.run(7);
  turned.run(7);
  expect_alike(Answer(turned), Answer(first));
}

/// Halves of a particle on two ranks are not united. The border of two blocks along x lies in the
/// fine cells: all halves behind the plate are on one rank.
TEST(GradedWindow, ResultsAreThoseOfOneRank) {
  Variant variant = {"graded", false, false, false, "smooth"};
  variant.graded = true;
  const std::unique_ptr<Scene> one = scene_of_one(variant);
  if (one) {
    one->run(60);
    EXPECT_GT(one->contact.contacts(), 20.0);
    EXPECT_GT(one->ground.travelled(), 0.07);
  }
  for (const BlockLayout& layout : layouts()) {
    SCOPED_TRACE(::testing::Message() << layout.x << " x " << layout.y << " blocks");
    Scene many(world_ranks(), variant, layout);
    many.run(60);
    if (layout.x <= 2) {
      expect_alike(many, one.get());
      continue;
    }
    const Vector3 force = many.contact.force();
    if (one) {
      EXPECT_LT((force - one->contact.force()).norm(), 0.01 * force.norm());
    }
  }
}

const Variant sleeping = {"sleeping", false, false, false, "absorbing", snow(), 0.1, 1.0, -0.2};

TEST(SleepingGround, ResultsAreThoseOfOneRank) {
  const std::unique_ptr<Scene> one = scene_of_one(sleeping);
  if (one) one->run(60);
  for (const BlockLayout& layout : layouts()) {
    SCOPED_TRACE(::testing::Message() << layout.x << " x " << layout.y << " blocks");
    Scene many(world_ranks(), sleeping, layout);
    many.run(60);
    EXPECT_LT(many.ground.active()->awake_share(), 0.9);
    expect_alike(many, one.get());
    if (!one) continue;
    const ActiveGround::Neglect &a = many.ground.active()->neglect(),
                                &b = one->ground.active()->neglect();
    EXPECT_GT(b.energy, 0.0);
    expect_near(a.force, b.force, b.largest_force, "neglected force");
    expect_near(a.energy, b.energy, b.energy, "neglected energy");
  }
}

TEST(SleepingGround, RestartContinuesOnSeveralRanks) {
  const BlockLayout layout = layouts().front();
  Scene first(world_ranks(), sleeping, layout), second(world_ranks(), sleeping, layout),
      turned(world_ranks(), sleeping, {layout.y, layout.x});
  first.run(53);
  EXPECT_LT(first.ground.active()->awake_share(), 0.9);
  const State state(first);
  state.restore(second);
  state.restore(turned);
  std::unique_ptr<Scene> one = scene_of_one(sleeping);
  if (one) state.restore(*one);
  for (Scene* scene : {&first, &second, &turned, one.get()})
    if (scene) scene->run(17);
  EXPECT_TRUE(State(first) == State(second));
  const Answer answer(first);
  expect_alike(Answer(turned), answer);
  if (one) expect_alike(Answer(*one), answer);
}

/// Every column of nodes in use has one owner, and blocks are as equal as cells allow.
TEST(Blocks, BlocksCoverAllCellsAndOwnEveryNodeOnce) {
  const Communicator ranks = world_ranks();
  for (const BlockLayout& layout : layouts()) {
    const Grid grid(Axis(even(0, 20, 1), "x"), Axis(even(0, 12, 1), "y"), Axis(even(0, 3, 1), "z"));
    Partition partition(ranks, layout, grid);
    Partition::Counts count = {std::vector<double>(20, 0.0), std::vector<double>(12, 0.0)};
    for (std::size_t c = 3; c < 9; ++c) count[0][c] = 100.0;  // all ground in some cells
    for (std::size_t c = 2; c < 8; ++c) count[1][c] = 100.0;
    partition.set_bounds(partition.balanced(count));
    std::vector<double> owners(22 * 14, 0.0);
    const NodeBlock owned = partition.owned_nodes();
    for (int i = owned.x.from; i < owned.x.to; ++i)
      for (int j = owned.y.from; j < owned.y.to; ++j)
        owners[static_cast<std::size_t>(14 * i + j)] += 1.0;
    ranks.sum(owners.data(), owners.size());
    for (int i = 3; i < 11; ++i)
      for (int j = 2; j < 10; ++j)
        EXPECT_EQ(owners[static_cast<std::size_t>(14 * i + j)], 1.0) << "column " << i << " " << j;
    double mine = 0.0;
    for (int x = 3; x < 9; ++x)
      for (int y = 2; y < 8; ++y)
        if (partition.owner(x, y) == ranks.rank()) mine += 1.0;
    EXPECT_EQ(ranks.sum(mine), 36.0);
    const double even_x = 6.0 / layout.x, even_y = 6.0 / layout.y;
    EXPECT_LE(mine, std::ceil(even_x) * std::ceil(even_y) + 1e-9);
  }
}

/// Closed form of what a rank stores and sends. It has the nodes of its cells, of one cell more
/// towards each neighbour, and two nodes more, as many as splines reach beyond a cell. Blocks with
/// 4 or more cells share nodes with the next block only: 4 layers of them. A node has 4 numbers of
/// 8 bytes; a step sends it once, for forces, and the first step of a remap interval once more, for
/// momentum.
TEST(Blocks, StoredAndSentSizesAreTheClosedForm) {
  const Communicator ranks = world_ranks();
  constexpr int cells = 6, levels = 5 + 2, interval = 4, steps = 10, remaps = 3;
  for (const BlockLayout& layout : layouts()) {
    TerrainParameters p = box(material_of(elastic(1e6, 0.3, 200.0)), {0, 0, 0},
                              {1.0 * layout.x * cells, 1.0 * layout.y * cells, 5.0}, 1.0);
    p.blocks = layout;
    p.remap_interval = interval;
    ContinuumTerrain ground(p, ranks);
    for (int n = 0; n < steps; ++n) ground.advance(1e-3);

    double messages = 0.0, bytes = 0.0;  // of all ranks, in one exchange
    for (int x = 0; x < layout.x; ++x)
      for (int y = 0; y < layout.y; ++y) {
        const int along_x = (x > 0 ? 1 : 0) + (x + 1 < layout.x ? 1 : 0);
        const int along_y = (y > 0 ? 1 : 0) + (y + 1 < layout.y ? 1 : 0);
        const int x_nodes = cells + along_x + 2, y_nodes = cells + along_y + 2;
        messages += along_x + along_y;
        bytes += 32.0 * levels * 4 * (along_x * y_nodes + along_y * x_nodes);
      }
    double stored = 0.0;  // nodes of all ranks
    for (int x = 0; x < layout.x; ++x)
      for (int y = 0; y < layout.y; ++y) {
        const int x_nodes = cells + (x > 0 ? 1 : 0) + (x + 1 < layout.x ? 1 : 0) + 2,
                  y_nodes = cells + (y > 0 ? 1 : 0) + (y + 1 < layout.y ? 1 : 0) + 2;
        const double nodes = levels * x_nodes * y_nodes;
        stored += nodes;
        if (ground.partition().rank_of(x, y) == ranks.rank()) {
          EXPECT_EQ(static_cast<double>(ground.grid().node_count()), nodes);
        }
      }
    EXPECT_EQ(ranks.sum(static_cast<double>(ground.grid().node_count())), stored);
    const HaloTraffic traffic = ground.halo_traffic();
    EXPECT_EQ(traffic.steps, steps);
    EXPECT_NEAR(traffic.messages * ranks.size(), (steps + remaps) * messages, 1e-6);
    EXPECT_NEAR(traffic.bytes * ranks.size(), (steps + remaps) * bytes, 1e-6);
  }
}

/// Messages of at most this many numbers: none, some and all arrays are sent in parts.
class Messages : public ::testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(OfLength, Messages, ::testing::Values(1, 2, 3, 1000));

/// Rank r has 3 r numbers.
TEST_P(Messages, ExchangeGatherSumAndMaximumWorkForAnyCount) {
  const MPI_Comm world = MPI_COMM_WORLD;
  const Communicator ranks(&world, GetParam());
  const auto numbers_of = [](int rank) {
    std::vector<double> numbers(3 * static_cast<std::size_t>(rank));
    std::iota(numbers.begin(), numbers.end(), 100.0 * rank);
    return numbers;
  };
  const std::vector<double> mine = numbers_of(ranks.rank());
  std::vector<Communicator::Message> messages;
  for (int other = 0; other < ranks.size(); ++other)
    if (other != ranks.rank()) messages.push_back({other, mine});
  ranks.exchange_lengths(messages);
  ranks.exchange(messages);
  for (const Communicator::Message& message : messages)
    EXPECT_EQ(message.received, numbers_of(message.other));
  std::vector<double> expected;
  for (int r = 0; r < ranks.size(); ++r)
    for (const double number : numbers_of(r)) expected.push_back(number);
  EXPECT_EQ(ranks.gather(mine), expected);
  EXPECT_EQ(ranks.gather_to_first(mine), is_first() ? expected : std::vector<double>());

  std::vector<double> most(7), total(7), all_most(7), all_total(7);
  for (std::size_t n = 0; n < 7; ++n) {
    most[n] = ranks.rank() * (n % 2 ? 1.0 : -1.0);
    total[n] = ranks.rank() + 10.0 * static_cast<double>(n);
    all_most[n] = n % 2 ? ranks.size() - 1.0 : 0.0;
    all_total[n] = ranks.size() * (0.5 * (ranks.size() - 1) + 10.0 * static_cast<double>(n));
  }
  ranks.max(most.data(), most.size());
  ranks.sum(total.data(), total.size());
  EXPECT_EQ(most, all_most);
  EXPECT_EQ(total, all_total);
}

}  // namespace
}  // namespace furrow::ranks_test
