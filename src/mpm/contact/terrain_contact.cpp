// SPDX-License-Identifier: GPL-2.0-or-later
#include "mpm/contact/terrain_contact.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "geometry/closest_feature.h"
#include "core/error.h"

namespace furrow {

namespace {

// a search lasts until surface and ground have moved so many cells towards each other
constexpr double skin_cells = 0.5;
constexpr double max_penetration = 0.5;  // of the shortest cell
// of the penetration that an impulse takes away in one step (J. Baumgarte, 1972)
constexpr double correction = 0.2;
/// What a particle remembers of a contact: tangential spring [m], slip [m], stiffness [N/m] as of
/// the last search.
enum Memory : std::size_t { spring, slip = 3, stiffness, memory_size };
constexpr double mirror_tolerance = 1e-6;  // of the surface's size

std::vector<int> mirror_nodes(const Surface& surface, double plane, const std::string& where) {
  const auto [low, high] = surface.bounds();
  const double tolerance = mirror_tolerance * (high - low).norm();
  // Nodes in the order of x finds the image without comparing all with all.
  std::vector<int> order(surface.node_count());
  for (std::size_t n = 0; n < order.size(); ++n) order[n] = static_cast<int>(n);
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return surface.x(0, a) < surface.x(0, b); });
  std::vector<int> mirror(surface.node_count(), -1);
  for (std::size_t n = 0; n < mirror.size(); ++n) {
    Vector3 image = surface.x.col(static_cast<Eigen::Index>(n));
    image.y() = 2.0 * plane - image.y();
    auto at = std::lower_bound(order.begin(), order.end(), image.x() - tolerance,
                               [&](int a, double x) { return surface.x(0, a) < x; });
    for (; at != order.end() && surface.x(0, *at) <= image.x() + tolerance; ++at)
      if ((surface.x.col(*at) - image).norm() <= tolerance) mirror[n] = *at;
    if (mirror[n] < 0)
      throw InputError(where,
                       fmt::format("needs a surface that is its own mirror image in the plane y = "
                                   "{:.4g} m of the half model; the node at "
                                   "{:.4g} {:.4g} {:.4g} m has none",
                                   plane, image.x(), 2.0 * plane - image.y(), image.z()),
                       "a wheel in the middle, without slip angle or camber",
                       "or model the whole ground");
  }
  return mirror;
}

}  // namespace

Schema TerrainContact::schema(const std::string& subject) {
  Schema schema(subject);
  schema
      .choice("enforcement", {"penalty", "impulse"},
              "springs, or the impulse that stops the approach")
      .by_default("penalty");
  schema.choice("surface", {"frictional", "rough", "smooth"}, "rough: no slip; smooth: no friction")
      .by_default("frictional");
  schema.number("friction", "", Range::non_negative(), "coefficient mu of a frictional surface")
      .by_default(0.3);
  schema
      .number("slip_length", "m", Range::non_negative(),
              "k of tau = mu sigma (1 - exp(-j/k)) with the slip j; 0: tau = mu sigma")
      .by_default(0.0);
  schema
      .number("stiffness", "", Range::positive(),
              "spring of a particle over wave modulus x cube root of its volume")
      .by_default(0.4);
  schema.number("damping", "", Range::closed(0.0, 1.0), "of spring and particle, of critical")
      .by_default(0.1);
  return schema;
}

ContactParameters TerrainContact::parameters_from(const Options& options) {
  ContactParameters p;
  p.enforcement = options.text("enforcement") == "penalty"
                      ? ContactParameters::Enforcement::penalty
                      : ContactParameters::Enforcement::impulse;
  const std::string& surface = options.text("surface");
  if (surface != "frictional" && options.given("friction"))
    throw InputError(options.where("friction"), fmt::format("is given with a {} surface", surface),
                     "friction with surface frictional only");
  p.friction = surface == "rough"    ? std::numeric_limits<double>::infinity()
               : surface == "smooth" ? 0.0
                                     : options.number("friction");
  p.slip_length = options.number("slip_length");
  p.stiffness = options.number("stiffness");
  p.damping = options.number("damping");
  return p;
}

TerrainContact::TerrainContact(Body& body, ContinuumTerrain& ground,
                               const ContactParameters& parameters, bool half_model,
                               const std::string& where)
    : body_(body),
      ground_(ground),
      parameters_(parameters),
      where_(where),
      corners_(body.surface()) {
  // A particle of mass rho d^3 on its spring s M d, d the spacing: omega dt = sqrt(s) c dt/d, and a
  // leapfrog needs less than 2.
  const auto& per_cell = ground.parameters().particles_per_cell;
  const double group = std::sqrt(parameters.stiffness) * ground.parameters().cfl *
                       *std::max_element(per_cell.begin(), per_cell.end());
  if (parameters.enforcement == ContactParameters::Enforcement::penalty && group >= 2.0)
    throw InputError(
        where,
        fmt::format(
            "has a stiffness of {}, too stiff for steps of cfl {} with {} particles along a cell",
            parameters.stiffness, ground.parameters().cfl,
            *std::max_element(per_cell.begin(), per_cell.end())),
        "sqrt(stiffness) x cfl x particles below 2", "lower the stiffness, or the ground's cfl");
  if (half_model) mirror_ = mirror_nodes(body.surface(), ground.grid().axis(1).lower(), where);
  for (ParticleGroup& layer : ground_.unsynchronised_groups())
    memory_.push_back(layer.particles.add_column("contact " + where, memory_size));
}

/// Candidates are found again at the present places, but with the stiffnesses of the last search,
/// and the next search comes when it would have come: a run that is restarted continues bit for
/// bit.
void TerrainContact::checkpoint(Checkpoint& state) {
  const Matrix3X& x = body_.surface().x;
  state.match("surface_nodes", x.cols());
  const bool searched = searched_.cols() == x.cols();
  bool fresh = searched && generation_ == ground_.generation();
  Matrix3X nodes = searched ? searched_ : x;
  if (!state.saving()) find_candidates(false);
  state.value("deepest_penetration", deepest_);
  state.value("friction_loss", friction_loss_);
  state.value("damping_loss", damping_loss_);
  state.value("drift", drift_);
  state.value("searched_since_sorting", fresh);
  state.values("searched_nodes", nodes);
  if (state.saving()) return;
  generation_ = ground_.generation() - (fresh ? 0 : 1);
  searched_ = nodes;
  started_ = true;
}

bool TerrainContact::is_stale() {
  if (!started_ || generation_ != ground_.generation() ||
      searched_.cols() != body_.surface().x.cols())
    return true;
  moved_ = std::sqrt((body_.surface().x - searched_).colwise().squaredNorm().maxCoeff());
  return moved_ + drift_ > skin_;
}

void TerrainContact::search() {
  refuse_departure();
  find_candidates(true);
  searched_ = body_.surface().x;
  generation_ = ground_.generation();
  moved_ = drift_ = 0.0;
  if (!started_) refuse_overlap();
  started_ = true;
}

/// Particles that can touch before surface and ground have moved by the skin, each with its
/// triangles.
void TerrainContact::find_candidates(bool stiffness_anew) {
  const Surface& surface = body_.surface();
  const double cell = ground_.grid().shortest_cell();
  skin_ = skin_cells * cell;
  double half = 0.0;
  Vector3 lower = Vector3::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
  for (const ParticleGroup& group : ground_.unsynchronised_groups())
    for (std::size_t p = 0; p < group.particles.size(); ++p) {
      const Vector3 x = group.particles.position(p);
      lower = lower.cwiseMin(x);
      upper = upper.cwiseMax(x);
    }
  const auto [low, high] = surface.bounds();
  for (const ParticleGroup& group : ground_.unsynchronised_groups())
    for (std::size_t p = 0; p < group.particles.size(); ++p) {
      const Vector3 x = group.particles.position(p), h(group.particles.data(column::half_x)[p],
                                                       group.particles.data(column::half_y)[p],
                                                       group.particles.data(column::half_z)[p]);
      if ((x.array() > low.array() - 4.0 * h.array() - skin_).all() &&
          (x.array() < high.array() + 4.0 * h.array() + skin_).all())
        half = std::max(
            half,
            h.norm() * std::max(1.0, group.particles.data(column::state + field::volume_ratio)[p]));
    }
  staleness_ = ground_.staleness();
  reach_ = half + skin_ + max_penetration * cell + staleness_;
  candidates_.clear();
  near_.clear();
  const TriangleSearch triangles(surface, reach_, lower, upper);
  for (std::size_t k = 0; k < ground_.unsynchronised_groups().size(); ++k) {
    Particles& particles = ground_.unsynchronised_groups()[k].particles;
    const double *x = particles.data(column::x), *y = particles.data(column::y),
                 *z = particles.data(column::z);
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const Vector3 point(x[p], y[p], z[p]);
      const auto [first, last] = triangles.near(point);
      const std::size_t begin = near_.size();
      for (const int* t = first; t != last; ++t) {
        const Vector3i& n = surface.triangles[static_cast<std::size_t>(*t)];
        const double distance = closest_point_on_triangle(point, surface.x.col(n[0]),
                                                          surface.x.col(n[1]), surface.x.col(n[2]))
                                    .distance;
        if (distance <= reach_) near_.push_back({distance, *t});
      }
      if (near_.size() == begin) continue;
      std::sort(near_.begin() + static_cast<std::ptrdiff_t>(begin), near_.end(),
                [](const Near& a, const Near& b) { return a.distance < b.distance; });
      candidates_.push_back({{k, p}, point, begin, near_.size()});
      if (stiffness_anew)
        memory_of({k, p})[Memory::stiffness] =
            parameters_.stiffness *
            ground_.unsynchronised_groups()[k].material->moduli(particles.state(p)).wave() *
            std::cbrt(particles.data(column::volume)[p]);
    }
  }
}

void TerrainContact::refuse_departure() const {
  const auto [low, high] = body_.surface().bounds();
  const Vector3 middle = 0.5 * (low + high);
  for (int a = 0; a < 2; ++a) {
    const Axis& axis = ground_.grid().axis(a);
    // A half model ends under the middle of the wheel.
    const double tolerance = mirror_tolerance * (high - low).norm();
    if (middle[a] < axis.lower() - tolerance || middle[a] > axis.upper() + tolerance)
      throw StateError(
          fmt::format("the middle of the body is at {} = {:.4g} m, beyond the ground that reaches "
                      "from {:.4g} to {:.4g} m; "
                      "give the ground "
                      "more length, or let it move with the body",
                      a == 0 ? 'x' : 'y', middle[a], axis.lower(), axis.upper()));
  }
}

void TerrainContact::refuse_overlap() const {
  const Surface& surface = body_.surface();
  if (!surface.is_closed()) return;
  const auto [low, high] = surface.bounds();
  for (const ParticleGroup& group : ground_.unsynchronised_groups())
    for (std::size_t p = 0; p < group.particles.size(); ++p) {
      const Vector3 x = group.particles.position(p);
      if ((x.array() > low.array()).all() && (x.array() < high.array()).all() &&
          encloses(surface, x))
        throw StateError(
            fmt::format("the ground at {:.4g} {:.4g} {:.4g} m is inside of the body at the start; "
                        "start above the ground",
                        x[0], x[1], x[2]));
    }
}

double* TerrainContact::memory_of(const ParticleIndex& at) {
  return ground_.unsynchronised_groups()[at.group].particles.data(memory_[at.group]) +
         memory_size * at.particle;
}

/// Spring and slip end with the contact.
void TerrainContact::forget(const ParticleIndex& at) {
  std::fill_n(memory_of(at), Memory::stiffness, 0.0);
}

/// A particle farther from the surface than this does not touch it [m].
double TerrainContact::touch_distance(const ParticleIndex& at) const {
  const Particles& particles = ground_.unsynchronised_groups()[at.group].particles;
  const std::size_t p = at.particle;
  const Vector3 half(particles.data(column::half_x)[p], particles.data(column::half_y)[p],
                     particles.data(column::half_z)[p]);
  return particles.data(column::state + field::volume_ratio)[p] * half.norm();
}

/// Candidates whose nearest triangle was so far away that it cannot have come near enough since are
/// left out; they forget the contact.
void TerrainContact::choose_active() {
  active_.clear();
  points_.clear();
  for (std::size_t n = 0; n < candidates_.size(); ++n) {
    const Candidate& candidate = candidates_[n];
    if (near_[candidate.first].distance - moved_ - drift_ - staleness_ >
        touch_distance(candidate.at)) {
      forget(candidate.at);
      continue;
    }
    active_.push_back(n);
    points_.push_back(candidate.at);
  }
}

/// @param x where the particle is
bool TerrainContact::touch(const Candidate& candidate, const Vector3& x, Touch& touch) const {
  const Surface& surface = body_.surface();
  const Particles& particles = ground_.unsynchronised_groups()[candidate.at.group].particles;
  const std::size_t p = candidate.at.particle;
  ClosestPoint closest{};
  closest.distance = std::numeric_limits<double>::infinity();
  touch.triangle = 0;
  // What was farther by more than both have moved since is farther still. Of equally near triangles
  // the first counts, in whatever order they come.
  const double approach = moved_ + (x - candidate.found).norm();
  for (std::size_t n = candidate.first;
       n < candidate.last && near_[n].distance - approach <= closest.distance; ++n) {
    const auto t = static_cast<std::size_t>(near_[n].triangle);
    const Vector3i& node = surface.triangles[t];
    const ClosestPoint point = closest_point_on_triangle(
        x, surface.x.col(node[0]), surface.x.col(node[1]), surface.x.col(node[2]));
    if (point.distance < closest.distance ||
        (point.distance == closest.distance && t < touch.triangle)) {
      closest = point;
      touch.triangle = t;
    }
  }
  const Vector3 half(particles.data(column::half_x)[p], particles.data(column::half_y)[p],
                     particles.data(column::half_z)[p]);
  const double ratio = particles.data(column::state + field::volume_ratio)[p];
  const Vector3 outward = corners_.outward(surface, touch.triangle, closest.barycentric);
  const double side = closest.separation.dot(outward) >= 0.0 ? 1.0 : -1.0;
  if (side > 0.0 && closest.distance > touch_distance(candidate.at)) return false;
  // Closer than rounding, the separation has no direction.
  touch.normal = closest.distance > 1e-9 * half.norm()
                     ? Vector3(side / closest.distance * closest.separation)
                     : outward.normalized();
  touch.gap = side * closest.distance - ratio * touch.normal.cwiseAbs().dot(half);
  // Beside an edge, the direction of the nearest point is not the one that separates: of it and of
  // the faces' normals, the one with the largest gap does (separating axes). Without, ground level
  // with a plate is pushed away from the plate's edge.
  if (side > 0.0 && closest.feature_nodes() < 3)
    corners_.for_normals(surface, touch.triangle, closest.barycentric, [&](const Vector3& normal) {
      const double gap = closest.separation.dot(normal) - ratio * normal.cwiseAbs().dot(half);
      if (gap <= touch.gap) return;
      touch.gap = gap;
      touch.normal = normal;
    });
  touch.point = x - closest.separation;
  touch.barycentric = closest.barycentric;
  return touch.gap < 0.0;
}

double TerrainContact::friction_limit(double normal_force, double slip) const {
  if (normal_force <= 0.0 || parameters_.friction == 0.0) return 0.0;
  const double mobilised =
      parameters_.slip_length > 0.0 ? -std::expm1(-slip / parameters_.slip_length) : 1.0;
  return parameters_.friction * normal_force * mobilised;
}

/// @param velocity of the ground relative to the surface; @param memory tangential spring and slip
/// of the particle
Vector3 TerrainContact::penalty_force(const Touch& touch, const Vector3& velocity, double mass,
                                      double stiffness, double dt, double* memory) {
  const Vector3& n = touch.normal;
  const double damping = 2.0 * parameters_.damping * std::sqrt(stiffness * mass),
               approach = -velocity.dot(n);
  const double spring = -stiffness * touch.gap,
               normal_force = std::max(0.0, spring + damping * approach);
  step_damping_ += (normal_force - spring) * approach * dt;
  const Vector3 along = velocity + approach * n;
  Eigen::Map<Vector3> stretch(memory + Memory::spring);
  double& slip = memory[Memory::slip];
  stretch += dt * along;
  stretch -= stretch.dot(n) * n;
  Vector3 pull = -stiffness * stretch - damping * along;
  // Under TR eq 26 the strength grows with the slip, which grows with every relative motion along
  // the surface.
  if (parameters_.slip_length > 0.0) slip += dt * along.norm();
  const double limit = friction_limit(normal_force, slip), size = pull.norm();
  if (size > limit) {
    pull *= limit / size;
    const Vector3 held = -pull / stiffness;
    if (parameters_.slip_length == 0.0) slip += (stretch - held).norm();
    step_friction_ += limit * (stretch - held).norm();
    stretch = held;
  } else {
    step_damping_ += damping * along.squaredNorm() * dt;
  }
  return normal_force * n + pull;
}

Vector3 TerrainContact::impulse_force(const Touch& touch, const Vector3& velocity, double mass,
                                      double dt, double* memory) {
  const Vector3& n = touch.normal;
  const double approach = -velocity.dot(n),
               normal_force = std::max(0.0, mass * (approach - correction * touch.gap / dt) / dt);
  const Vector3 along = velocity + approach * n;
  memory[Memory::slip] += dt * along.norm();
  const double limit = friction_limit(normal_force, memory[Memory::slip]),
               stopping = mass * along.norm() / dt;
  const double size = std::min(limit, stopping);
  step_damping_ += normal_force * approach * dt;
  step_friction_ += size * along.norm() * dt;
  return normal_force * n - (stopping > 0.0 ? mass / dt * size / stopping : 0.0) * along;
}

void TerrainContact::apply(double dt) {
  if (is_stale()) search();
  drift_ += ground_.largest_speed() * dt;
  const Surface& surface = body_.surface();
  nodal_.setZero(3, surface.x.cols());
  contacts_ = penetration_ = area_ = step_friction_ = step_damping_ = 0.0;
  choose_active();
  ground_.probe(points_, motions_);
  for (std::size_t n = 0; n < active_.size(); ++n) {
    const ParticleIndex& at = points_[n];
    Touch found;
    if (!touch(candidates_[active_[n]], motions_[n].position, found)) {
      forget(at);
      continue;
    }
    const ParticleGroup& group = ground_.unsynchronised_groups()[at.group];
    double* memory = memory_of(at);
    const double volume = group.particles.data(column::volume)[at.particle],
                 mass = group.material->density() * volume, length = std::cbrt(volume);
    Vector3 velocity = motions_[n].velocity_at(found.point);
    const Vector3i& nodes = surface.triangles[found.triangle];
    for (int c = 0; c < 3; ++c) velocity -= found.barycentric[c] * surface.v.col(nodes[c]);
    const Vector3 force =
        parameters_.enforcement == ContactParameters::Enforcement::penalty
            ? penalty_force(found, velocity, mass, memory[Memory::stiffness], dt, memory)
            : impulse_force(found, velocity, mass, dt, memory);
    ground_.add_point_force(at, force, found.point);
    for (int c = 0; c < 3; ++c) nodal_.col(nodes[c]) -= found.barycentric[c] * force;
    contacts_ += 1.0;
    area_ += length * length;
    penetration_ = std::max(penetration_, -found.gap);
  }
  collect();
}

/// Sums over ranks, adds the other half of a half model and gives the forces to the body.
void TerrainContact::collect() {
  const Communicator& ranks = ground_.ranks();
  if (ranks.size() > 1) {
    buffer_.assign(nodal_.data(), nodal_.data() + nodal_.size());
    buffer_.insert(buffer_.end(), {contacts_, area_, step_friction_, step_damping_});
    ranks.sum(buffer_.data(), buffer_.size());
    std::copy_n(buffer_.data(), nodal_.size(), nodal_.data());
    const double* rest = buffer_.data() + nodal_.size();
    contacts_ = rest[0];
    area_ = rest[1];
    step_friction_ = rest[2];
    step_damping_ = rest[3];
    penetration_ = ranks.max(penetration_);
  }
  if (!mirror_.empty()) {
    const Matrix3X half = nodal_;
    for (Eigen::Index n = 0; n < half.cols(); ++n) {
      Vector3 image = half.col(mirror_[static_cast<std::size_t>(n)]);
      image.y() = -image.y();
      nodal_.col(n) += image;
    }
    contacts_ *= 2.0;
    area_ *= 2.0;
    step_friction_ *= 2.0;
    step_damping_ *= 2.0;
  }
  friction_loss_ += step_friction_;
  damping_loss_ += step_damping_;
  deepest_ = std::max(deepest_, penetration_);
  if (penetration_ > max_penetration * ground_.grid().shortest_cell())
    throw StateError(
        fmt::format("the surface is {:.3g} m inside the ground, more than half a cell: the "
                    "contact's springs are too soft "
                    "for this load, or "
                    "the step is unstable; raise 'stiffness'",
                    penetration_));
  force_ = nodal_.rowwise().sum();
  body_.surface().f += nodal_;
}

}  // namespace furrow
