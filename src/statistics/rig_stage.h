// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Names of the channels of a rig's history that its evaluation reads, and the stages of a run.

namespace furrow {

/// Stages of a run, one after the other, and again in each pass; steady values are those of the
/// cruise.
enum class RigStage { settle = 0, accelerate = 1, cruise = 2, back = 3 };

/// Name of the channel that holds the stage of every row, as a number.
constexpr char stage_channel[] = "stage";

/// Name of the channel that counts the passes in one rut, from 1.
constexpr char pass_channel[] = "pass";

/// Travel of an axle along x. Speed and slip are answers of a free axle. Pull is an answer too
/// where the axle shares its travel with the other wheels of a vehicle.
enum class AxleTravel { held = 0, free = 1, shared = 2 };

/// Name of the channel that holds the travel of the axle, as a number.
constexpr char axle_free_channel[] = "axle_free";

/// Name of the channel that counts the pitches of grousers by which the wheel has turned.
constexpr char grouser_channel[] = "grouser_pitches";

/// Names of three depths [m]: of the hub, of the tyre's deflection, of the ground below the wheel.
constexpr char hub_drop_channel[] = "hub_drop";
constexpr char tyre_deflection_channel[] = "tyre_deflection";
constexpr char rut_depth_channel[] = "rut_depth";

}  // namespace furrow
