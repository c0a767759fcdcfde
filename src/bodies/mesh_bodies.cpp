// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/bodies/mesh_bodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

constexpr double smallest_mesh = 1e-3, largest_mesh = 5.0;  // [m], of wheels and tools
// Nominal radius of a wheel over the largest distance of its mesh from the axle: grousers of a
// small rover wheel reach 0.2 of it.
constexpr double minimum_radius = 0.5, usual_radius = 0.75;
// Imbalance of a wheel: distance of the centre of mass from the axle over the radius, and
// difference of the moments of inertia across the axle over that about it.
constexpr double largest_offset = 0.02, largest_difference = 0.1;
const Range densities = Range::closed(10.0, 25000.0);  // [kg/m^3] from foam to tungsten
// Rounding of a proposed axis and origin, and noise of the origin, over the size of the mesh; angle
// within which the axis is one of the file's.
constexpr double axis_step = 1e-3, origin_step = 1e-3, origin_noise = 2e-3, straight = radians(0.5);

/// @param axis the key's meaning and default
void declare_mesh(Schema& schema, const std::string& origin, const std::string& axis,
                  const std::vector<double>& default_axis) {
  schema.text("file", "mesh of a solid, STL, OBJ or VTP, relative to the script").may_change();
  schema
      .number("scale", "m", Range::positive(),
              "length of a unit of the file: 0.001 for a mesh in millimetres")
      .by_default(1.0);
  schema.numbers("origin", 3, "", Range::any(), origin).by_default(std::vector<double>{0, 0, 0});
  schema.numbers("axis", 3, "", Range::any(), axis).by_default(default_axis);
}

Vector3 vector_from(const Options& options, const std::string& key) {
  return Eigen::Map<const Vector3>(options.numbers(key).data());
}

std::string numbers(const Vector3& vector) {
  return fmt::format("{:.6g} {:.6g} {:.6g}", vector.x(), vector.y(), vector.z());
}

/// Units of length in mesh files [m]; a proposal takes the first that gives a usual size.
constexpr std::array units{1.0, 0.001, 0.01, 0.0254};
constexpr double usual_least = 0.03, usual_most = 3.0;  // [m]

double rounded(double value, double step) {
  const double number = step * std::round(value / step);
  return number == 0.0 ? 0.0 : number;  // without the sign of -0
}

/// The principal axis whose two others have the most equal moments.
Vector3 axis_of_revolution(const MassProperties& of) {
  const Matrix3 about_centre =
      of.inertia - of.volume * (of.centre.squaredNorm() * Matrix3::Identity() -
                                of.centre * of.centre.transpose());
  const Eigen::SelfAdjointEigenSolver<Matrix3> principal(about_centre);
  const Vector3& moments = principal.eigenvalues();  // increasing
  Vector3 axis =
      principal.eigenvectors().col(moments[1] - moments[0] < moments[2] - moments[1] ? 2 : 0);
  int largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  return axis[largest] < 0.0 ? -axis : axis;
}

/// @returns the rotation from the axes of the file, with 'axis' along the unit vector `target`
Matrix3 attitude_of(const Options& options, const Vector3& target) {
  const Vector3 axis = direction_from(options, "axis");
  // Quaternion from half angles; Eigen's FromTwoVectors would compile a singular value
  // decomposition.
  Quaternion rotation;
  rotation.w() = 1.0 + axis.dot(target);
  rotation.vec() = axis.cross(target);
  if (rotation.norm() < 1e-8) {  // opposite: half a turn
    rotation.w() = 0.0;
    rotation.vec() = axis.unitOrthogonal();
  }
  return rotation.normalized().toRotationMatrix();
}

/// A mesh that is probably in another unit.
void check_size(const Options& options, const SolidMesh& mesh) {
  const auto [lower, upper] = mesh.surface.bounds();
  const double span = (upper - lower).maxCoeff(), size = options.number("scale") * span;
  if (size >= smallest_mesh && size <= largest_mesh) return;
  throw InputError(options.where("scale"),
                   fmt::format("is {:g} m, and {} spans {:.4g} m with it", options.number("scale"),
                               mesh.file, size),
                   fmt::format("a size of {:g} to {:g} m", smallest_mesh, largest_mesh),
                   fmt::format("write '{}'", keywords(propose_placement(mesh.surface))));
}

/// Checks the mesh, and brings it into metres about the origin of the body.
void place(const Options& options, const Vector3& target, SolidMesh& mesh) {
  check_size(options, mesh);
  check_solid(mesh);
  Matrix3X& x = mesh.surface.x;
  x = options.number("scale") *
      (attitude_of(options, target) * (x.colwise() - vector_from(options, "origin")));
}

/// Mesh of a wheel with the axle along y through the origin.
class MeshWheel {
 public:
  /// @param proposal  keywords of a balanced wheel
  MeshWheel(const Options& options, const Surface& surface, std::string proposal)
      : options_(options),
        proposal_(std::move(proposal)),
        of_unit_density_(mass_properties(surface)) {
    double reach = 0.0;
    for (const auto& node : surface.x.colwise())
      reach = std::max(reach, std::hypot(node.x(), node.z()));
    const auto [lower, upper] = surface.bounds();
    const double radius = options.has("radius") ? options.number("radius") : reach;
    if (radius > reach * (1.0 + solid_mesh_tolerance))
      throw InputError(options.where("radius"), fmt::format("is {:g} m", radius),
                       fmt::format("at most {:.6g} m, the largest distance from the axle", reach),
                       "check scale, origin and axis");
    const std::string as_nominal =
        fmt::format("is {:g} m, and the mesh reaches {:.4g} m from the axle", radius, reach);
    if (radius < minimum_radius * reach)
      throw InputError(options.where("radius"), as_nominal,
                       fmt::format("{:.4g} to {:.4g} m", minimum_radius * reach, reach),
                       "give the radius of the rim between its grousers, in m");
    if (radius < usual_radius * reach)
      warnings_.push_back(
          fmt::format("{} {}: rim speed, slip and hub drop take the smaller radius; "
                      "give that of the rim between its grousers",
                      options.where("radius"), as_nominal));
    reach_ = reach;
    wheel_.geometry.diameter = 2.0 * radius;
    wheel_.geometry.grousers.height = std::max(0.0, reach - radius);
    wheel_.geometry.grousers.number = static_cast<int>(options.integer("grousers"));
    wheel_.geometry.width = upper.y() - lower.y();
    wheel_.hub.centre = read_axle(options);
    set_inertia();
  }

  const RigidWheelParameters& parameters() const { return wheel_; }
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  void set_inertia() {
    const double volume = of_unit_density_.volume;
    const bool has_mass = options_.has("mass");
    if (has_mass == options_.has("density"))
      throw InputError(options_.where("mass"), has_mass ? "is given with a density" : "is missing",
                       "either mass or density",
                       fmt::format("the volume of the mesh is {:.6g} m^3", volume));
    HubInertia& inertia = wheel_.hub.inertia;
    inertia.mass = has_mass ? options_.number("mass") : options_.number("density") * volume;
    const bool inertia_given = has_mass && options_.has("inertia");
    if (const std::optional<InputError> fault =
            imbalance(inertia_given ? ", unless the wheel shall run out of round"
                                    : ", or give mass and inertia")) {
      if (!inertia_given) throw *fault;
      warnings_.push_back(fault->what());
    }
    const double density = inertia.mass / volume;
    const Matrix3& of_mesh = of_unit_density_.inertia;
    inertia.axial = options_.has("inertia") ? options_.number("inertia") : density * of_mesh(1, 1);
    inertia.diametral = options_.has("inertia_diametral")
                            ? options_.number("inertia_diametral")
                            : 0.5 * inertia.axial * (of_mesh(0, 0) + of_mesh(2, 2)) / of_mesh(1, 1);
  }

  /// A hub is a body of revolution with its centre of mass on the axle. @return what is not so
  std::optional<InputError> imbalance(const std::string& otherwise) const {
    const std::string remedy = fmt::format("write '{}'{}", proposal_, otherwise);
    const Vector3& centre = of_unit_density_.centre;
    if (const double offset = std::hypot(centre.x(), centre.z()); offset > largest_offset * reach_)
      return InputError(options_.where("origin"),
                        fmt::format("puts the axle {:.4g} m from the centre of mass", offset),
                        fmt::format("at most {:.4g} m, {:g} of the largest radius",
                                    largest_offset * reach_, largest_offset),
                        remedy);
    const Matrix3& inertia = of_unit_density_.inertia;
    if (std::abs(inertia(0, 0) - inertia(2, 2)) <= largest_difference * inertia(1, 1)) return {};
    return InputError(
        options_.where("axis"), "is no axis of revolution of the mesh",
        fmt::format("moments of inertia across the axle that differ by at most {:g} of that about "
                    "it",
                    largest_difference),
        remedy);
  }

  const Options& options_;
  std::string proposal_;
  MassProperties of_unit_density_;
  double reach_ = 0.0;  // [m] largest distance from the axle
  RigidWheelParameters wheel_;
  std::vector<std::string> warnings_;
};

/// Horizontal projection of the facets that face down [m^2].
double area_from_below(const Surface& surface) {
  double area = 0.0;
  for (std::size_t t = 0; t < surface.triangle_count(); ++t)
    area -= std::min(0.0, surface.area_vector(t).z());
  return area;
}

}  // namespace

MeshPlacement propose_placement(const Surface& surface) {
  const auto [lower, upper] = surface.bounds();
  const double span = (upper - lower).maxCoeff();
  MeshPlacement found;
  const auto is_usual = [&](double unit) {
    return unit * span >= usual_least && unit * span <= usual_most;
  };
  const auto unit = std::find_if(units.begin(), units.end(), is_usual);
  if (unit != units.end()) found.scale = *unit;
  const MassProperties of = mass_properties(surface);
  if (!(of.volume > 0.0)) return found;
  found.axis = axis_of_revolution(of);
  int along = 0;
  if (found.axis.maxCoeff(&along) > std::cos(straight)) found.axis = Vector3::Unit(along);
  // a step of a decimal digit
  const double step = std::pow(10.0, std::floor(std::log10(origin_step * span)));
  for (int k = 0; k < 3; ++k) {
    found.axis[k] = rounded(found.axis[k], axis_step);
    if (std::abs(of.centre[k]) > origin_noise * span) found.origin[k] = rounded(of.centre[k], step);
  }
  return found;
}

std::string keywords(const MeshPlacement& placement) {
  return fmt::format("scale {:g} origin {} axis {}", placement.scale, numbers(placement.origin),
                     numbers(placement.axis));
}

Vector3 direction_from(const Options& options, const std::string& key) {
  const Vector3 direction = vector_from(options, key);
  if (!(direction.norm() > 0.0)) throw InputError(options.where(key), "is 0 0 0", "a direction");
  return direction.normalized();
}

Schema mesh_wheel_schema(const std::string& subject) {
  Schema schema(subject);
  declare_mesh(schema, "axle centre, in the coordinates of the file",
               "direction of the axle in the file; it becomes y", {0, 1, 0});
  schema
      .number("radius", "m", Range::positive(),
              "nominal radius, for rim speed, slip and hub drop; by default the largest distance "
              "from the axle")
      .optional();
  schema
      .integer("grousers", Range::closed(0, 1000),
               "number of equal sectors, such as grousers; averages cover whole sectors")
      .by_default("0");
  schema.number("density", "kg/m^3", densities, "gives the mass of the solid, without `mass`")
      .optional();
  schema.number("mass", "kg", Range::positive(), "mass of the wheel, without `density`").optional();
  schema
      .number("inertia", "kg m^2", Range::positive(),
              "moment of inertia about the axle; by default that of a uniform solid")
      .optional();
  schema
      .number("inertia_diametral", "kg m^2", Range::positive(),
              "moment of inertia across the axle; by default in proportion to `inertia`")
      .optional();
  declare_axle(schema);
  return schema;
}

Schema mesh_plate_schema(const std::string& subject) {
  Schema schema(subject);
  declare_mesh(schema, "reference point of the plate, in the coordinates of the file",
               "direction in the file that points up", {0, 0, 1});
  schema.numbers("centre", 3, "m", Range::any(), "x y z of the reference point at the start");
  schema
      .number("area", "m^2", Range::positive(),
              "area of `pressure`; by default the horizontal projection of all facets that face "
              "down")
      .optional();
  return schema;
}

std::unique_ptr<RigidWheel> make_mesh_wheel(const Options& options, SolidMesh mesh,
                                            std::vector<std::string>& warnings) {
  MeshPlacement proposal = propose_placement(mesh.surface);
  proposal.scale = options.number("scale");
  place(options, Vector3::UnitY(), mesh);
  const MeshWheel wheel(options, mesh.surface, keywords(proposal));
  warnings = wheel.warnings();
  return std::make_unique<RigidWheel>(wheel.parameters(), std::move(mesh.surface),
                                      options.subject());
}

std::unique_ptr<RigidPlate> make_mesh_plate(const Options& options, SolidMesh mesh) {
  place(options, Vector3::UnitZ(), mesh);
  PlateGeometry geometry;
  geometry.shape = PlateShape::square;
  geometry.size =
      std::sqrt(options.has("area") ? options.number("area") : area_from_below(mesh.surface));
  return std::make_unique<RigidPlate>(geometry, std::move(mesh.surface),
                                      vector_from(options, "centre"));
}

}  // namespace furrow
