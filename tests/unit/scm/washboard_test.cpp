// SPDX-License-Identifier: GPL-2.0-or-later
// A quarter car rolls over a washboard of firm soil: the motion of its masses against the transfer
// functions of two masses, two springs and a damper, and the speed at which the wheel leaves the
// ground.

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>

#include <gmock/gmock.h>

#include "furrow/bodies/coupled_system.h"
#include "furrow/bodies/rigid_wheel.h"
#include "furrow/rig/wheel_rig.h"
#include "furrow/scm/scm_contact.h"

namespace furrow::washboard_test {
namespace {

constexpr double radius = 0.25, width = 0.1, wavelength = 1.0;   // [m]
constexpr double unsprung = 10.0, sprung = 50.0;                 // [kg]
constexpr double spring = 8000.0, damper = 316.0;                // [N/m], [N s/m]
constexpr double subgrade = 2e7;                                 // [Pa/m]
const double load = (unsprung + sprung) * standard_gravity;      // [N]
const double natural = std::sqrt(spring / sprung) / (2.0 * pi);  // [Hz]

/// Penetration d of a rigid cylinder on an elastic bed under the load, F = 4/3 K b d sqrt(2 R d).
const double penetration =
    std::pow(0.75 * load / (subgrade * width * std::sqrt(2.0 * radius)), 2.0 / 3.0);
const double contact_stiffness = 1.5 * load / penetration;

GroundRelief washboard(double amplitude) {
  ReliefParameters relief;
  relief.washboard = Vector2(wavelength, amplitude);
  relief.flat_until = 1.0;
  return GroundRelief(relief, "ground");
}

struct QuarterCar {
  QuarterCar(double amplitude, double speed, double end)
      : field({end + 2.0, 0.14, Vector2(0.5 * end, 0.0), 0.0, 0.02, washboard(amplitude)}),
        wheel(parameters()),
        rig(WheelRig::schema().read({"load_mass", std::to_string(unsprung + sprung), "speed",
                                     std::to_string(speed), "mode", "slip", "slip", "0",
                                     "settle_time", "0.5", "accelerate_time", "0.2", "ground_level",
                                     "0", "suspension_stiffness", std::to_string(spring),
                                     "suspension_damping", std::to_string(damper)}),
            wheel),
        contact(wheel, field, soil, {width, true}) {
    system.add(wheel, "wheel");
    system.add(contact, "contact");
  }
  void step() {
    rig.apply(time, dt);
    system.advance(dt);
    time += dt;
  }
  double channel(const std::string& name) const {
    const std::vector<Channel> channels = WheelRig::channels();
    const auto found = std::find_if(channels.begin(), channels.end(),
                                    [&](const Channel& channel) { return channel.name == name; });
    return rig.measure(time).at(static_cast<std::size_t>(found - channels.begin()));
  }
  static RigidWheelParameters parameters() {
    RigidWheelParameters wheel;
    wheel.geometry.diameter = 2.0 * radius;
    wheel.geometry.width = width;
    wheel.geometry.segments = 120;
    wheel.geometry.element_size = 0.05;
    wheel.hub = {{unsprung, 0.4, 0.2}, {0.0, 0.0, radius + 1e-4}};
    return wheel;
  }
  static Soil firm() {
    Soil soil;  // elastic up to pressures that no wheel reaches
    soil.k_phi = 1e12;
    soil.n = 1.0;
    soil.stiffness = subgrade;
    soil.shear_length = 0.01;
    return soil;
  }

  static constexpr double dt = 1e-3;
  Soil soil = firm();
  HeightField field;
  RigidWheel wheel;
  WheelRig rig;
  ScmContact contact;
  CoupledSystem system;
  double time = 0.0;
};

/// Over the height of the ground: axle, sprung mass, and contact force [N/m].
struct Transfer {
  std::complex<double> axle, mass, force;
};

Transfer closed_form(double speed) {
  const double w = 2.0 * pi * speed / wavelength, k = contact_stiffness;
  const double half_patch = 2.0 * pi / wavelength * std::sqrt(2.0 * radius * penetration);
  const double ground = std::sin(half_patch) / half_patch;  // mean over the contact
  const std::complex<double> strut(spring, w * damper);
  const std::complex<double> carried = strut / (strut - sprung * w * w);
  const std::complex<double> axle = ground * k / (k - unsprung * w * w + strut * (1.0 - carried));
  return {axle, axle * carried, k * (ground - axle)};
}

/// Amplitude at the frequency of the washboard, over whole waves.
double amplitude_of(const std::vector<double>& values, double speed) {
  const double mean =
      std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  std::complex<double> sum = 0.0;
  for (std::size_t n = 0; n < values.size(); ++n)
    sum += (values[n] - mean) * std::polar(1.0, -2.0 * pi * speed / wavelength * QuarterCar::dt *
                                                    static_cast<double>(n));
  return 2.0 * std::abs(sum) / static_cast<double>(values.size());
}

TEST(Washboard, SprungMassMovesByTheTransferFunctionOfAQuarterCar) {
  constexpr double amplitude = 0.005;
  for (const double ratio : {0.6, 1.0, 2.0}) {
    const double speed = ratio * natural * wavelength;
    QuarterCar car(amplitude, speed, 3.5 * speed);
    const double steady = 2.3, period = wavelength / speed;
    std::vector<double> mass, axle;
    while (car.time < steady + 2.0 * period - 0.5 * QuarterCar::dt) {
      car.step();
      if (car.time < steady) continue;
      axle.push_back(car.wheel.centre().z());
      mass.push_back(car.channel("sprung_drop"));
    }
    const Transfer expected = closed_form(speed);
    EXPECT_NEAR(amplitude_of(axle, speed) / (amplitude * std::abs(expected.axle)), 1.0, 0.005)
        << ratio;
    EXPECT_NEAR(amplitude_of(mass, speed) / (amplitude * std::abs(expected.mass)), 1.0, 0.005)
        << ratio;
  }
}

/// The contact force swings by more than the load once the amplitude exceeds load over transfer
/// function, far below and just below the resonance of the wheel on the soil. The contact softens
/// as its force falls, which lowers that resonance; so the amplitudes are on either side of the
/// threshold.
TEST(Washboard, WheelLeavesTheGroundAboveThePredictedAmplitude) {
  const double resonance = std::sqrt((contact_stiffness + spring) / unsprung) / (2.0 * pi);  // [Hz]
  for (const double frequency : {0.45 * resonance, 0.93 * resonance})
    for (const double share : {0.8, 1.4}) {
      const double speed = frequency * wavelength;
      const double threshold = load / std::abs(closed_form(speed).force);
      QuarterCar car(share * threshold, speed, 1.5 * speed);
      int lost = 0, steps = 0;
      while (car.time < 1.4) {
        car.step();
        if (car.time < 1.1) continue;
        lost += car.contact.step().area == 0.0;
        ++steps;
      }
      if (share < 1.0)
        EXPECT_EQ(lost, 0) << frequency;
      else
        EXPECT_GT(lost, steps / 10) << frequency;
    }
}

TEST(Washboard, UndisturbedReliefHasNoRutAndNoHeap) {
  const HeightField field({4.0, 0.2, Vector2(2.0, 0.0), 0.3, 0.02, washboard(0.03)});
  EXPECT_EQ(field.volume_below(), 0.0);
  EXPECT_EQ(field.volume_above(), 0.0);
  EXPECT_EQ(field.deepest(), 0.0);
  EXPECT_NEAR(field.highest(), 0.33, 1e-4);
  EXPECT_NEAR(field.surface(field.index(62, 3)), 0.3 + 0.03 * std::sin(2.0 * pi * 0.25), 1e-12);
}

}  // namespace
}  // namespace furrow::washboard_test
