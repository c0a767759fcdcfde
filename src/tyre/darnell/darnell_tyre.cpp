// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/tyre/darnell/darnell_tyre.h"

#include <algorithm>

#include <fmt/format.h>

#include "furrow/core/options/check_number.h"
#include "furrow/core/error.h"
#include "furrow/tyre/sidewall/sidewall_direct.h"

namespace furrow {

namespace {

// Number of profiles of a ring for section_width(): profiles by the chain take time
constexpr std::size_t max_profiles = 72;

std::unique_ptr<Sidewall> make_sidewall(const TyreParameters& tyre, bool direct,
                                        const SidewallTableMaker& make_table) {
  if (direct) return std::make_unique<SidewallDirect>(tyre.sidewall, tyre.pressure);
  SidewallTableGrid grid;  // wrinkles rotate the tread's edge further than a smooth shape does
  grid.rotation_min = radians(-105);
  grid.rotation_max = radians(105);
  grid.rotation_nodes = 21;
  if (make_table) return make_table(tyre.sidewall, tyre.pressure, grid);
  return std::make_unique<SidewallTable>(tyre.sidewall, tyre.pressure, grid);
}

ShellSection tread_section(const TreadParameters& tread) {
  return ShellSection(
      {tread.E1, tread.E2, tread.nu12, tread.G12, tread.G12, tread.G12, tread.thickness},
      tread.areal_mass);
}

TreadMesh checked_mesh(const TyreParameters& tyre, const DarnellTyreSettings& settings,
                       const HubParameters& hub, const std::string& where) {
  check(tyre, where);
  check(settings, where);
  check(hub, where);
  return make_tread_mesh(tyre.tread, settings.across, settings.around, settings.half);
}

}  // namespace

void check(const DarnellTyreSettings& settings, const std::string& where) {
  check_integer(settings.across, Range::closed(2, 200), where + ", elements across");
  check_integer(settings.around, Range::closed(12, 2000), where + ", elements around");
  if (settings.half && settings.across % 2 != 0)
    throw InputError(where + ", elements across", fmt::format("is {}", settings.across),
                     "an even number for a half model");
  check_integer(settings.sidewall_rows, Range::closed(0, 50), where + ", sidewall rows");
  check_number(settings.damping_rate, Range::non_negative(), where + ", damping rate", "1/s");
}

DarnellTyre::DarnellTyre(const TyreParameters& tyre, const DarnellTyreSettings& settings,
                         const HubParameters& hub, const std::string& where,
                         const SidewallTableMaker& make_table)
    : DarnellTyre(tyre, settings, hub, make_table, checked_mesh(tyre, settings, hub, where)) {}

DarnellTyre::DarnellTyre(const TyreParameters& tyre, const DarnellTyreSettings& settings,
                         const HubParameters& hub, const SidewallTableMaker& make_table,
                         TreadMesh mesh)
    : NodalTyre(hub, {mesh.x, tyre.pressure, settings.damping_rate}),
      tyre_(tyre),
      settings_(settings),
      grid_(mesh.grid),
      shell_(mesh.x, mesh.quads, tread_section(tyre.tread), circumferential),
      rings_(make_rings(make_table)),
      surface_(mesh, rings_, settings.sidewall_rows) {
  nodes_.mass = shell_.mass();
  nodes_.inertia = shell_.rotary_inertia();
  for (int i = 0; settings.half && i < grid_.around; ++i) hold_in_symmetry_plane(grid_.node(i, 0));
  start();
}

std::vector<SidewallRing> DarnellTyre::make_rings(const SidewallTableMaker& make_table) const {
  const double edge_radius = tyre_.tread.radius - tyre_.tread.crown;
  const double width = 2.0 * pi * edge_radius / grid_.around;
  std::vector<SidewallRing> rings;
  for (const int side : {+1, -1}) {
    if (settings_.half && side < 0) continue;
    std::vector<int> edge;
    for (int i = 0; i < grid_.around; ++i) edge.push_back(grid_.node(i, side > 0 ? grid_.rows : 0));
    rings.emplace_back(make_sidewall(tyre_, settings_.direct, make_table), tyre_, side,
                       std::move(edge), width);
  }
  return rings;
}

NodalTyre::Internal DarnellTyre::add_internal_forces() {
  shell_.add_forces(nodes_, pressure());
  Internal internal{shell_.energy(), shell_.volume()};
  const RimPose pose = rim();
  for (SidewallRing& ring : rings_) {
    ring.add_forces(nodes_, pose);
    internal.energy += ring.potential();
    internal.volume += ring.volume();
  }
  return internal;
}

void DarnellTyre::follow_pressure() {
  for (SidewallRing& ring : rings_) ring.set_pressure(pressure());
}

Wrench DarnellTyre::hand_over(Matrix3X& on_nodes) {
  return surface_.hand_over(nodes_, rings_, *this, on_nodes);
}

double DarnellTyre::section_width() {
  double widest = 0.0;
  const RimPose pose = rim();
  for (SidewallRing& ring : rings_) {
    const std::size_t every = std::max<std::size_t>(1, ring.stations() / max_profiles);
    for (std::size_t i = 0; i < ring.stations(); i += every) {
      const Matrix3X points = ring.profile(i, nodes_, pose);
      for (Eigen::Index k = 0; k < points.cols(); ++k)
        widest =
            std::max(widest, ring.side() * (points.col(k) - centre()).dot(pose.attitude.col(1)));
    }
  }
  return 2.0 * widest;
}

double DarnellTyre::largest_sidewall_chord() const {
  double largest = 0.0;
  for (const SidewallRing& ring : rings_) largest = std::max(largest, ring.largest_chord());
  return largest;
}

void DarnellTyre::checkpoint(Checkpoint& state) {
  const TreadParameters& tread = tyre_.tread;
  state.match("across", settings_.across);
  state.match("around", settings_.around);
  state.match("half", settings_.half);
  state.match("sidewall_rows", settings_.sidewall_rows);
  state.match("tread_radius", tread.radius);
  state.match("tread_half_width", tread.half_width);
  state.match("tread_thickness", tread.thickness);
  state.match("E1", tread.E1);
  state.match("E2", tread.E2);
  state.match("sidewall_length", tyre_.sidewall.length);
  checkpoint_nodes(state);
}

}  // namespace furrow
