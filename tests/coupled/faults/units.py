# SPDX-License-Identifier: GPL-2.0-or-later
"""Numbers in the units that people mistake: a value, a warning or an error, never a silent change.

    units.py <furrow>

Each number of the height field, its soil card, the contact, the wheel mesh, the rig and the chassis is written
in the other units of its kind. The run must be refused, or warn of something that the sound run does
not warn of, or give results within a tenth of the sound ones.
"""

import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

INPUTS = Path(__file__).resolve().parents[3] / "inputs"
SAME = 0.1  # of the largest value of a channel
CHANNELS = ("hub_drop", "force_x", "force_z", "drive_torque", "velocity_x")

# Factors on SI units. Units less than ten times apart, such as km/h and m/s, give values that are as likely.
LENGTH = {"mm": 1e3, "cm": 1e2, "inch": 1 / 0.0254, "km": 1e-3}
PRESSURE = {"kPa": 1e-3, "MPa": 1e-6, "psi": 1 / 6894.76}
ANGLE = {"rad": math.pi / 180}
SHARE = {"percent": 1e2}
MASS = {"g": 1e3, "t": 1e-3}
FORCE = {"kN": 1e-3, "MN": 1e-6}
SPEED = {"cm/s": 1e2, "mm/s": 1e3}
MODULUS = {"kN": 1e-3, "MN": 1e-6}
INERTIA = {"g cm2": 1e7, "kg cm2": 1e4}
STIFFNESS = {"N/mm": 1e-3, "kN/m": 1e-3}
TIME = {"ms": 1e3}

HEAD = """units si
atom_style granular
atom_modify sort 0 0
newton off
communicate single vel yes
region box block -2 6 -1 1 -1 1.5 units box
create_box 1 box
neighbor 0.05 bin
timestep 5e-4
"""
FIELD = HEAD + """fix wheel all wheel/rigid diameter {diameter} width {width} mass {mass} inertia {inertia} axle 0 0 {axle}
fix rig all wheel/rig wheel wheel load_force {load} speed {speed} mode slip slip {slip} settle_time {settle} &
  accelerate_time 0.1 ground_level 0 damping {damping}
fix soil all terrain/scm length 3 width 0.6 centre 1 0 cell {cell} k_c {k_c} k_phi {k_phi} n {n} c {c} phi {phi} K {K} &
  stiffness {stiffness}
fix touch all contact/scm body wheel terrain soil friction {friction} slip_length {slip_length} contact_width {contact_width}
fix out all wheel/history rig rig folder {results} every 10
run 1000
"""
RELIEF = FIELD.replace("cell {cell}", "cell {cell} washboard {wavelength} {amplitude} flat_until 0.1")
CARD = HEAD + """fix wheel all wheel/mesh file {mesh} scale {scale} axis 0 0 1 radius {radius} mass {mass} grousers 24 axle 0 0 0.165
fix rig all wheel/rig wheel wheel load_mass {load} speed {speed} mode torque torque {torque} settle_time 0.1 &
  accelerate_time 0.1 ground_level 0
fix soil all terrain/scm length 3 width 0.6 centre 1 0 cell 0.01 card {card}
fix touch all contact/scm body wheel terrain soil
fix out all wheel/history rig rig folder {results} every 10
run 1000
"""
CHASSIS = HEAD + """fix front all wheel/rigid diameter 0.5 width 0.16 mass 25 inertia 0.8 axle 0.8 0 0.2501
fix rear all wheel/rigid diameter 0.5 width 0.16 mass 25 inertia 0.8 axle 0 0 0.2501
fix front_rig all wheel/rig wheel front load_mass {load} speed 0.5 mode towed settle_time 0.1 accelerate_time 0.1 &
  ground_level 0 suspension_stiffness {stiffness} suspension_damping {damping}
fix rear_rig all wheel/rig wheel rear load_mass {load} speed 0.5 mode towed settle_time 0.1 accelerate_time 0.1 &
  ground_level 0 suspension_stiffness {stiffness} suspension_damping {damping}
fix body all wheel/chassis rigs front_rig,rear_rig pitch_inertia {pitch_inertia} height {height}
fix soil all terrain/scm length 4 width 0.6 centre 1 0 cell 0.02 k_c 15600 k_phi 2407400 n 1.1 c 250 phi 31.9 K 0.0114
fix front_touch all contact/scm body front terrain soil body_material soil
fix rear_touch all contact/scm body rear terrain soil body_material soil
fix out all wheel/history rig front_rig folder {results} every 10
run 1000
"""
MESH = INPUTS / "meshes" / "rover_wheel.stl"
FIELD_VALUES = {"diameter": 0.5, "width": 0.16, "mass": 25, "inertia": 0.8, "axle": 0.2501, "load": 600, "speed": 0.5, "slip": 0.2,
                "settle": 0.1, "damping": 2000, "cell": 0.02, "k_c": 15600, "k_phi": 2407400, "n": 1.1, "c": 2500, "phi": 31.9,
                "K": 0.0114, "stiffness": 1e8, "friction": 0.4, "slip_length": 0.009, "contact_width": 0.16}
# script, sound values, units of the numbers
FEATURES = {
    "height field": (FIELD, FIELD_VALUES, {
        "diameter": LENGTH, "width": LENGTH, "mass": MASS, "inertia": INERTIA, "axle": LENGTH, "load": FORCE, "speed": SPEED,
        "slip": SHARE, "settle": TIME, "cell": LENGTH, "k_c": MODULUS, "k_phi": MODULUS, "n": SHARE, "c": PRESSURE, "phi": ANGLE,
        "K": LENGTH, "stiffness": PRESSURE, "friction": {**SHARE, "degrees": 55}, "slip_length": LENGTH, "contact_width": LENGTH}),
    "relief": (RELIEF, {**FIELD_VALUES, "wavelength": 0.5, "amplitude": 0.02}, {"wavelength": LENGTH, "amplitude": LENGTH}),
    "mesh and card": (CARD, {"mesh": MESH, "scale": 0.001, "radius": 0.15, "mass": 5, "load": 15, "speed": 0.2, "torque": 8,
                             "card": "card.yaml"},
                      {"scale": {"cm": 10, "inch": 25.4, "m": 1e3}, "radius": LENGTH, "mass": MASS, "load": {**MASS, "N": 9.80665},
                       "torque": {"kN m": 1e-3, "N mm": 1e3}}),
    "card": (CARD, {"mesh": MESH, "scale": 0.001, "radius": 0.15, "mass": 5, "load": 15, "speed": 0.2, "torque": 8,
                    "card": "card.yaml"}, {}),
    "chassis": (CHASSIS, {"load": 60, "stiffness": 8000, "damping": 316, "pitch_inertia": 5, "height": 0.2},
                {"load": {**MASS, "N": 9.80665}, "stiffness": STIFFNESS, "damping": STIFFNESS, "pitch_inertia": INERTIA,
                 "height": LENGTH}),
}
# values of the card, by lines "key: {value: ..."
CARD_UNITS = {"k_c": MODULUS, "k_phi": MODULUS, "c": PRESSURE, "phi": ANGLE, "K": LENGTH, "stiffness": PRESSURE}
CARD_TEXT = """title: A sand
stiffness: 1e8
gravity: 9.80665
pressure_sinkage:
  k_c: {value: 15600, error: 100, unit: N/m^(n+1)}
  k_phi: {value: 2407400, error: 100, unit: N/m^(n+2)}
  n: {value: 1.1, error: 0.01}
  sinkage: [0.001, 0.06]
  pressure: [1000, 90000]
shear:
  c: {value: 2500, error: 10, unit: Pa}
  phi: {value: 31.9, error: 0.1, unit: degree}
  K: {value: 0.0114, error: 0.001, unit: m}
contact:
  steel: {friction: 0.4, friction_range: [0.3, 0.5], slip_length: 0.009, slip_length_range: [0.006, 0.012], label: assumed, source: made}
"""


def run(furrow: str, folder: Path, script: str) -> tuple[int, set[str], dict[str, np.ndarray]]:
    """Status, warnings without their numbers, and columns."""
    (folder / "run.lig").write_text(script)
    done = subprocess.run([furrow, "-in", "run.lig", "-log", "none"], cwd=folder, text=True, stdin=subprocess.DEVNULL,
                          timeout=60, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    said = {re.sub(r"[\d.e+-]+", "#", line) for line in done.stdout.splitlines() if "WARNING" in line}
    columns = {}
    file = folder / "results" / "history.h5"
    if done.returncode == 0 and file.is_file():
        with h5py.File(file) as history:
            columns = {name: history["history"][name][()] for name in CHANNELS}
    return done.returncode, said, columns


def change(columns: dict[str, np.ndarray], sound: dict[str, np.ndarray]) -> float:
    """Change of the end of the run, over the largest value of each channel; infinite for another length."""
    worst = 0.0
    for name, column in sound.items():
        if columns[name].size != column.size:
            return math.inf
        tail = slice(-20, None)
        scale = np.max(np.abs(column))
        worst = max(worst, abs(np.mean(columns[name][tail]) - np.mean(column[tail])) / scale)
    return worst


def main(furrow: str) -> None:
    failures, count = [], 0
    for feature, (script, values, units) in FEATURES.items():
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "card.yaml").write_text(CARD_TEXT)
            def check_message(what: str, text: str) -> None:
                nonlocal count
                count += 1
                status, said, columns = run(furrow, folder, text)
                if status < 0 or status >= 128:
                    failures.append(f"{feature}, {what}: ended by a signal")
                elif status == 0 and not said - usual and change(columns, sound) > SAME:
                    failures.append(f"{feature}, {what}: a silent change of {change(columns, sound):.2f}")
            text = script.format(**values, results="results")
            status, usual, sound = run(furrow, folder, text)
            if status:
                sys.exit(f"{feature}: the sound script has the status {status}:\n{text}")
            for key, factors in units.items():
                for unit, factor in factors.items():
                    changed = {**values, key: f"{float(values[key]) * factor:.10g}"}
                    check_message(f"{key} in {unit}", script.format(**changed, results="results"))
            if feature == "card":
                for key, factors in CARD_UNITS.items():
                    for unit, factor in factors.items():
                        (folder / "card.yaml").write_text(re.sub(
                            rf"\b{key}: (\{{value: )?([\d.e+]+)", lambda m, f=factor: f"{key}: {m[1] or ''}{float(m[2]) * f:.10g}", CARD_TEXT))
                        check_message(f"{key} in {unit}", text)
    print(f"{count} numbers in other units, {len(failures)} silent")
    if failures:
        sys.exit("\n".join(failures))


if __name__ == "__main__":
    main(sys.argv[1])
