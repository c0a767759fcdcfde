# SPDX-License-Identifier: GPL-2.0-or-later
"""Resistance of which one part is known.

    resistance_energy_test.py strip <furrow> <furrow-point>
    resistance_energy_test.py road <results of inputs/scenes/tyre_on_plane.lig>
    resistance_energy_test.py bed <results of inputs/scenes/wheel_on_sand.lig>

strip: ground that is only compacted, by a wheel without friction. Compaction takes per metre what
confined compression of a column of the same law takes to the depth of the rut and does not give
back, R = b h int_0^z/h sigma_1 d(z/h) - b h w (Bekker's compaction resistance; w the elastic energy
per volume before compression), with the z of the ground: sinkage less penetration of the contact.
Within 3 %, with cells of a quarter of the depth.
road: on a rigid plane all that resists a towed tyre is its own loss and motion.
bed: what grains and friction get, measured at the contacts, is what the wheel gives, within 1 %; a
towed wheel is not driven, so that friction turns it and takes less than pressing grains down. The
contacts among the grains, the walls, gravity and motion take (fix grain/work) what the grains get,
within 1 %, and it is lost below, ahead of and beside the track.
"""

import json
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from furrow_run import columns, output, script_output

HERE = Path(__file__).resolve().parent
WIDTH, DEPTH = 0.1, 0.1  # of the strip [m]
COMPACTION = 0.03  # relative error
CONTACT = 0.005  # of the whole: springs give back what they take
BULLDOZING = 0.08  # of the whole: the contact is long, not endless
UNEXPLAINED = 0.01  # of the whole
OF_THE_WORK = 0.01  # error of works on grains
OF_THE_ROAD = 0.05  # of the whole: friction, contact, damping of the rig


def parts_of(results):
    """(whole, parts by name) [N], and the sinkage [m]; what is not accounted for is checked."""
    summary = json.loads((results / "summary.json").read_text())
    found = summary["resistance_parts"]
    print(json.dumps(found, indent=1))
    assert abs(found["unexplained"]) <= UNEXPLAINED * found["whole"], "parts do not sum to the whole"
    return found["whole"], found["parts"], summary["quantities"]["hub_drop"]["mean"]


def compression_work(file, sinkage):
    """Per metre, what is not given back [N]."""
    point = columns(file, "point")
    shortened = 1.0 - np.exp(-point["axial_strain"])  # z/h
    stress = point["axial_stress"]
    work = np.concatenate([[0.0], np.cumsum(0.5 * (stress[1:] + stress[:-1]) * np.diff(shortened))])
    assert shortened[-1] > sinkage / DEPTH, "the oedometer does not reach the rut"
    return WIDTH * DEPTH * np.interp(sinkage / DEPTH, shortened, work - point["stored_energy"])


def strip(furrow, furrow_point):
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        script_output(furrow, HERE / "strip.lig", folder)
        output([furrow_point, "run", HERE / "oedometer.yaml", "-o", folder / "point", "--no-plot"], folder)
        whole, parts, sinkage = parts_of(folder / "results")
        penetration = np.loadtxt(folder / "penetration.txt")[-10:].mean()
        expected = compression_work(folder / "point" / "point.h5", sinkage - penetration)
    compaction = parts["compaction"]
    print(f"sinkage {sinkage:.5g} m, penetration {penetration:.3g} m: compaction {compaction:.4g} N, in closed form {expected:.4g} N")
    assert abs(compaction - expected) <= COMPACTION * expected, "compaction is not the closed form"
    assert 0.0 <= parts["bulldozing"] <= BULLDOZING * whole, "the strip is not only compacted"
    contact = parts["contact springs and damping"]
    assert abs(contact) <= CONTACT * whole, "contact springs do not give back what they take"
    assert "friction of wheel and ground" not in parts, "a wheel without friction has a part of it"


def road(results):
    whole, parts, _ = parts_of(Path(results))
    own = parts["wheel or tyre"] + parts["inertia of the wheel"]
    print(f"tyre and its motion {own:.4g} N of {whole:.4g} N")
    assert abs(own - whole) <= OF_THE_ROAD * whole, "a road takes more than friction"
    for part in ("compaction", "bulldozing", "grid", "grains, pressed down"):
        assert part not in parts, f"a road has a part '{part}'"


def bed(results):
    whole, parts, _ = parts_of(Path(results))
    given = json.loads((Path(results) / "summary.json").read_text())["resistance_parts"]["given_to_grains"]
    assert 0.0 < parts["friction of wheel and ground"] < given["grains, pressed down"]
    among = sum(force for part, force in parts.items() if part.startswith("grains, "))
    print(f"in the window grains are given {sum(given.values()):.4g} N, found among them {among:.4g} N")
    assert abs(among - sum(given.values())) <= UNEXPLAINED * whole, "places do not sum to what grains get"
    assert min(parts[f"grains, {place}"] for place in ("below the track", "ahead and aside")) > 0.05 * whole
    history = columns(Path(results) / "history.h5")
    error, *given = (history[name][-1] for name in ("contact_spring_loss", "drive_work", "load_work"))
    print(f"of {sum(given):.4g} J given, {error:.3g} J are not found again")
    assert abs(error) <= OF_THE_WORK * sum(given), "works at the contacts are not the wheel's"

    slide, roll, square, below, ahead, aside, walls, lifted = (
        history[f"grains_{name}_work"]
        for name in ("slide", "roll", "square", "below", "ahead", "aside", "walls", "lifted"))
    kinetic = history["grains_kinetic_energy"]
    got = history["grain_press_work"] + history["grain_push_work"]
    taken = slide + roll + square + walls + lifted + kinetic - kinetic[0]
    print(f"grains get {got[-1]:.4g} J, of which {taken[-1]:.4g} J are found among them")
    assert abs(taken[-1] - got[-1]) <= OF_THE_WORK * got[-1], "the work among grains does not sum up"
    assert np.allclose(below + ahead + aside, slide + roll + square, rtol=1e-4, atol=1e-6)
    assert min(slide[-1], roll[-1], below[-1], ahead[-1], aside[-1]) > 0.05 * got[-1]
    assert 0.0 < square[-1] < 0.2 * got[-1], "slow sand takes little by damping"


if __name__ == "__main__":
    {"strip": strip, "road": road, "bed": bed}[sys.argv[1]](*sys.argv[2:])
