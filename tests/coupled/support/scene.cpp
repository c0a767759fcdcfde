// SPDX-License-Identifier: GPL-2.0-or-later
#include "tests/coupled/support/scene.h"

#include <algorithm>
#include <cstdio>

#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>

#include "atom.h"
#include "coupling/base/fix_body.h"
#include "coupling/liggghts/data/access.h"
#include "input.h"
#include "modify.h"

namespace furrow::test {

namespace {

// LIGGGHTS makes fixes from the words of a line: a scene puts its own address there.

constexpr char scene_key[] = "scene";

Schema scene_schema(const std::string& style) {
  Schema schema("fix " + style);
  schema.text(scene_key, "address of the scene that the fix belongs to");
  return schema;
}

Scene& scene_of(const Options& options) {
  return *reinterpret_cast<Scene*>(std::stoull(options.text(scene_key), nullptr, 16));
}

class FixTestBody : public coupling::FixBody {
 public:
  FixTestBody(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
      : FixBody(lammps, narg, arg, scene_schema("test/body"), [arg](const Options& options) {
          return scene_of(options).hand_over_body(arg[0]);
        }) {}
};

template <int Mask>
class FixHook : public coupling::FurrowFix {
 public:
  FixHook(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
      : FurrowFix(lammps, narg, arg, scene_schema("test/hook")), scene_(scene_of(options())) {
    nevery = 1;
  }
  int setmask() override { return Mask; }
  void initial_integrate(int) override { scene_.run_action(id); }
  void end_of_step() override { scene_.run_action(id); }

 private:
  Scene& scene_;
};

/// Runs an action without terminal output: a second instance in one process registers every contact
/// model again, with some 230 messages.
template <class Action>
auto silently(Action&& action) {
  std::fflush(nullptr);
  const int nowhere = open("/dev/null", O_WRONLY), out = dup(STDOUT_FILENO),
            err = dup(STDERR_FILENO);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  auto result = action();
  std::fflush(nullptr);
  dup2(out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  for (int descriptor : {nowhere, out, err}) close(descriptor);
  return result;
}

template <class FixStyle>
LAMMPS_NS::Fix* create(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg) {
  return new FixStyle(lammps, narg, arg);
}

}  // namespace

Surface make_sheet(int n, double side, double z, bool alternate) {
  Surface sheet;
  sheet.resize(static_cast<std::size_t>((n + 1) * (n + 1)));
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      sheet.x.col(j * (n + 1) + i) = Vector3(-side / 2 + side * i / n, -side / 2 + side * j / n, z);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      if (alternate && (i + j) % 2) {
        sheet.triangles.insert(sheet.triangles.end(), {Vector3i(a, b, d), Vector3i(b, c, d)});
      } else {
        sheet.triangles.insert(sheet.triangles.end(), {Vector3i(a, b, c), Vector3i(a, c, d)});
      }
    }
  return sheet;
}

Scene::Scene() {
  const char* arguments[] = {"furrow", "-log", "none", "-screen", "/dev/null"};
  lammps_ = silently(
      [&] { return new LAMMPS_NS::LAMMPS(5, const_cast<char**>(arguments), MPI_COMM_WORLD); });
  coupling::add_fix_style(*lammps_, "test/body", create<FixTestBody>);
  coupling::add_fix_style(*lammps_, "test/start",
                          create<FixHook<LAMMPS_NS::FixConst::INITIAL_INTEGRATE>>);
  coupling::add_fix_style(*lammps_, "test/end", create<FixHook<LAMMPS_NS::FixConst::END_OF_STEP>>);
}

Scene::~Scene() { delete lammps_; }

void Scene::command(const std::string& text) { lammps_->input->one(text.c_str()); }

void Scene::commands(const std::string& lines) {
  std::size_t begin = 0;
  while (begin < lines.size()) {
    std::size_t end = lines.find('\n', begin);
    if (end == std::string::npos) end = lines.size();
    command(lines.substr(begin, end - begin));
    begin = end + 1;
  }
}

void Scene::add_body(const std::string& id, std::unique_ptr<Body> body) {
  waiting_[id] = std::move(body);
  command(fmt::format("fix {} all test/body {} {}", id, scene_key, fmt::ptr(this)));
}

std::unique_ptr<Body> Scene::hand_over_body(const std::string& id) {
  return std::move(waiting_.at(id));
}

Body& Scene::body(const std::string& id) {
  return dynamic_cast<coupling::FixBody&>(*lammps_->modify->find_fix_id(id.c_str())).body();
}

void Scene::add_action(const std::string& style, std::function<void()> action) {
  const std::string id = fmt::format("hook_{}", actions_.size());
  actions_[id] = std::move(action);
  command(fmt::format("fix {} all {} {} {}", id, style, scene_key, fmt::ptr(this)));
}

void Scene::at_end_of_step(std::function<void()> action) {
  add_action("test/end", std::move(action));
}

void Scene::at_start_of_step(std::function<void()> action) {
  add_action("test/start", std::move(action));
}

int Scene::rank() const {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}
int Scene::ranks() const {
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  return ranks;
}
double Scene::sum(double value) const {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return value;
}
double Scene::max(double value) const {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return value;
}

double Scene::grain_mass() const {
  double mass = 0.0;
  for (int i = 0; i < lammps_->atom->nlocal; ++i) mass += lammps_->atom->rmass[i];
  return sum(mass);
}

double Scene::grain_kinetic_energy() const {
  const LAMMPS_NS::Atom& atom = *lammps_->atom;
  double energy = 0.0;
  for (int i = 0; i < atom.nlocal; ++i) {
    const double inertia = 0.4 * atom.rmass[i] * atom.radius[i] * atom.radius[i];
    energy += 0.5 * atom.rmass[i] * Eigen::Map<const Vector3>(atom.v[i]).squaredNorm() +
              0.5 * inertia * Eigen::Map<const Vector3>(atom.omega[i]).squaredNorm();
  }
  return sum(energy);
}

double Scene::upward_momentum() const {
  const LAMMPS_NS::Atom& atom = *lammps_->atom;
  double momentum = 0.0;
  for (int i = 0; i < atom.nlocal; ++i) momentum += atom.rmass[i] * atom.v[i][2];
  return sum(momentum);
}

double Scene::top_of_grains() const {
  const LAMMPS_NS::Atom& atom = *lammps_->atom;
  double top = 0.0;
  for (int i = 0; i < atom.nlocal; ++i) top = std::max(top, atom.x[i][2] + atom.radius[i]);
  return max(top);
}

void Scene::granular_box(const Vector3& lower, const Vector3& upper, double skin,
                         const std::string& boundary) {
  commands("atom_style granular\natom_modify map array\nboundary " + boundary +
           "\nnewton off\ncommunicate single vel yes\nunits si");
  command(fmt::format("region box block {} {} {} {} {} {} units box", lower[0], upper[0], lower[1],
                      upper[1], lower[2], upper[2]));
  command("create_box 2 box");
  command(fmt::format("neighbor {} bin", skin));
  command("neigh_modify delay 0 check yes");
}

void Scene::contact_properties(double young, double poisson, double restitution, double friction) {
  command(fmt::format("fix m1 all property/global youngsModulus peratomtype {0} {0}", young));
  command(fmt::format("fix m2 all property/global poissonsRatio peratomtype {0} {0}", poisson));
  command(fmt::format(
      "fix m3 all property/global coefficientRestitution peratomtypepair 2 {0} {0} {0} {0}",
      restitution));
  command(fmt::format(
      "fix m4 all property/global coefficientFriction peratomtypepair 2 {0} {0} {0} {0}",
      friction));
}

void Scene::grains_fall(const std::string& contact, double step, double gravity) {
  commands(fmt::format(
      "pair_style gran {}\npair_coeff * *\ntimestep {}\nfix weight all gravity {} vector 0 0 -1",
      contact, step, gravity));
}

void Scene::flat_walls(const std::string& contact, const std::vector<std::string>& planes) {
  for (const std::string& plane : planes)
    command(fmt::format("fix {0:.1}{1} all wall/gran {2} primitive type 1 {0}", plane,
                        plane[7] == '-' ? 1 : 2, contact));
}

void Scene::wall_of_body(const std::string& body, const std::string& contact,
                         const std::string& wall) {
  command(fmt::format("fix skin all mesh/body body {} type 2", body));
  command(fmt::format("fix {} all wall/gran/body {} mesh n_meshes 1 meshes skin", wall, contact));
}

void Scene::pour(double radius, const std::string& region, const std::string& amount,
                 const std::string& all_in) {
  commands(fmt::format(
      "fix pts all particletemplate/sphere 15485863 atom_type 1 density constant 2500 radius "
      "constant {}\n"
      "fix pdd all particledistribution/discrete 32452843 1 pts 1.0\n"
      "region fill {} units box\n"
      "fix ins all insert/pack seed 32452867 distributiontemplate pdd insert_every once "
      "overlapcheck yes all_in {} {} region fill\n"
      "fix move all nve/sphere",
      radius, region, all_in, amount));
}

}  // namespace furrow::test
