# SPDX-License-Identifier: GPL-2.0-or-later
"""Two soils side by side: each of two wheels rolls as on its soil alone, and a wheel that comes from one soil
rolls on the next as on this one alone.

    soil_patches_test.py field <furrow>       height field, soils across and along the travel
    soil_patches_test.py continuum <furrow>   continuum, soils across the travel
"""

import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from furrow_run import INPUTS, columns, script_output

HERE = Path(__file__).resolve().parent
MATERIALS = INPUTS / "materials"
CARD = """gravity: 9.80665
pressure_sinkage: {{k_c: 0, k_phi: {k_phi}, n: 1.1}}
shear: {{c: {c}, phi: {phi}, K: 0.01}}
"""
ALLOWED = 0.01  # of the value on the soil alone
# on a continuum, where forces of a wheel that has just started still swing, the hub drop alone
CHANNELS = {"field": ("hub_drop", "force_x", "force_z", "drive_torque"), "continuum": ("hub_drop",)}


def roll(furrow, folder, name, ground, soil, steps):
    """Wheel -> channel -> its values."""
    script_output(furrow, HERE / "wheels.lig", folder, continuum=int(ground == "continuum"), soil=soil, results=folder / name, steps=steps)
    return {wheel: columns(folder / name / wheel / "history.h5") for wheel in ("left", "right")}


def compare(ground, what, found, alone, last):
    """Means over so many last rows."""
    for channel in CHANNELS[ground]:
        mean, wanted = (float(np.mean(values[channel][-last:])) for values in (found, alone))
        scale = max(abs(wanted), 0.02 * abs(float(np.mean(alone["force_z"][-last:]))) if "force" in channel else 0)
        error = (mean - wanted) / scale
        print(f"{what:28} {channel:13} {mean:12.6g}, alone {wanted:12.6g}: {100 * error:+.3f} %")
        if not abs(error) <= ALLOWED:
            sys.exit(f"{what}: {channel} differs by {100 * error:.2f} % from that on its soil alone")


def main(ground, furrow):
    with tempfile.TemporaryDirectory() as text:
        folder = Path(text)
        if ground == "field":
            firm, soft = folder / "firm.yaml", folder / "soft.yaml"
            firm.write_text(CARD.format(k_phi=2.4e6, c=250, phi=32))
            soft.write_text(CARD.format(k_phi=4e5, c=1000, phi=25))
            line, steps, last = "card {}", 2800, 20
        else:
            firm, soft = MATERIALS / "dry_sand_smooth.yaml", MATERIALS / "fresh_snow_cam_clay.yaml"
            line, steps, last = "material {}", 1000, 30
        # sand alone with about the step that it has beside the stiffer snow
        of_step = {firm: " cfl 0.075"} if ground == "continuum" else {}
        alone = {soil: roll(furrow, folder, soil.stem, ground, line.format(soil) + of_step.get(soil, ""), steps)
                 for soil in (firm, soft)}
        drops = [float(np.mean(alone[soil]["left"]["hub_drop"][-last:])) for soil in (firm, soft)]
        if not abs(drops[1] / drops[0] - 1) > 0.2:
            sys.exit(f"the soils are too alike for a test: hub drops {drops}")
        both = roll(furrow, folder, "across", ground, f"{line.format(firm)} patches across:0:{soft}", steps)
        compare(ground, "right wheel, firm soil", both["right"], alone[firm]["right"], last)
        compare(ground, "left wheel, soft soil", both["left"], alone[soft]["left"], last)
        if ground == "field":
            on = roll(furrow, folder, "along", ground, f"{line.format(firm)} patches along:0.2:{soft}", steps)
            compare(ground, "from firm to soft soil", on["left"], alone[soft]["left"], last)


main(sys.argv[1], sys.argv[2])
