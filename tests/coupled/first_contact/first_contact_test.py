# SPDX-License-Identifier: GPL-2.0-or-later
"""Settling of a wheel on the ground, and the friction there.

    first_contact_test.py lowering <furrow>  the height at which a wheel starts does not change its rest
    first_contact_test.py friction <furrow>  a contact line without values takes those of the material file
"""

import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from furrow_run import INPUTS, columns, script_output

HERE = Path(__file__).resolve().parent
MATERIALS = INPUTS / "materials"
GAPS = (0.001, 0.01, 0.05, 0.1)  # [m]
SAME = 0.02  # of the hub drop at rest
LOAD = 600.0  # [N]
LARGEST_FORCE = 1.05  # of the load while the wheel is lowered
DROPPED = 1.3  # times the hub drop of the lowered wheel, for a wheel that falls 0.1 m


def run(furrow: str, **variables: object) -> tuple[dict[str, list[float]], str]:
    """Columns of the history, and the output."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        script = (HERE / "wheel.lig").read_text().replace("MATERIALS", str(MATERIALS))
        (folder / "wheel.lig").write_text(script)
        said = script_output(furrow, "wheel.lig", folder, seconds=280, **variables)
        return {key: list(column) for key, column in columns(folder / "results" / "history.h5").items()}, said


def expect(what: str, holds: bool) -> None:
    print(what)
    if not holds:
        sys.exit(f"FAILED: {what}")


def lowering(furrow: str) -> None:
    for ground, continuum in (("continuum", 1), ("height field", 0)):
        rests = []
        for gap in GAPS:
            history, _ = run(furrow, continuum=continuum, gap=gap)
            rests.append(history["hub_drop"][-1])
            force = max(history["force_z"])
            expect(f"{ground}, {1e3 * gap:g} mm above: rests at {1e3 * rests[-1]:.2f} mm, largest force {force:.0f} N",
                   abs(rests[-1] / rests[0] - 1) <= SAME and force <= LARGEST_FORCE * LOAD)
        history, _ = run(furrow, continuum=continuum, gap=GAPS[-1], release="in_air")
        expect(f"{ground}, dropped by {1e3 * GAPS[-1]:g} mm: rests at {1e3 * history['hub_drop'][-1]:.2f} mm",
               history["hub_drop"][-1] > DROPPED * rests[0])


def friction(furrow: str) -> None:
    snow = {"material": MATERIALS / "fresh_snow_cam_clay.yaml", "motion": "mode slip slip 0.1", "steps": 7000}
    taken, words = run(furrow, **snow, contact="body_material steel")
    expect("the contact prints its values",
           "Contact of 'wheel' (steel) with 'Fresh snow, 200 kg/m3, cohesive Cam clay': friction 0.3 (0.2 to 0.5), "
           "slip_length 0.04 m (0.025 to 0.05); assumed" in words)
    given, words = run(furrow, **snow, contact="friction 0.3 slip_length 0.04")
    expect("both runs are equal", taken == given and "Contact of" not in words)
    pull = sum(taken["force_x"][-100:]) / sum(taken["force_z"][-100:])
    expect(f"a driven wheel is held back by snow: net traction coefficient {pull:.3f}", pull < -0.05)
    nothing = HERE / "no_contact.yaml"
    _, words = run(furrow, material=nothing, contact="body_material rubber", steps=1)
    expect("a material without contact gives a warning",
           "'Ground that says nothing' has no contact with rubber, so that friction and slip_length of 'wheel' are "
           "unknown: 0.3 and 0 m hold" in words)
    _, words = run(furrow, continuum=0, contact="body_material steel", steps=1)
    expect("a soil without contact gives a warning", "'soil' has no contact with steel" in words)
    card = f"card {HERE / 'limited.yaml'}"
    for contact in ("body_material steel", "friction 0.4 slip_length 0.01"):
        _, words = run(furrow, continuum=0, soil=card, contact=contact, steps=1)
        expect("a shear limit of a soil card gives a warning", words.count("shear_limit") == 1 and
               "fix contact/scm: the shear_limit of 18000 Pa that " in words and "has for steel has no effect on 'wheel'" in words)


if __name__ == "__main__":
    {"lowering": lowering, "friction": friction}[sys.argv[1]](sys.argv[2])
