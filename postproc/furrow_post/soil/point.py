# SPDX-License-Identifier: GPL-2.0-or-later
"""Virtual oedometer on a material point."""

import json
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from ..analyse.statistics import rms
from ..arrays import Floats
from ..csv_table import read_columns
from ..errors import ResultsError
from ..programs import find_program
from .make import Confined


def confined_strain(material: Path, stresses: tuple[float, ...]) -> Floats:
    """Strain (a ratio) at these axial stresses [Pa]. @raises ResultsError where furrow-point stops"""
    path = {
        "title": "oedometer",
        "material": str(material.resolve()),
        "path": {"type": "confined", "stress": list(stresses), "steps": 40},
    }
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "path.yaml"
        file.write_text(json.dumps(path), encoding="utf-8")  # JSON is YAML
        command = [find_program("furrow-point"), "run", file, "-o", f"{folder}/out", "--no-plot"]
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
        if done.returncode:
            raise ResultsError(f"{material}: {' '.join(done.stderr.split())}")
        columns = read_columns(Path(folder) / "out" / "point.csv")
    strain: Floats = np.interp(
        stresses, columns["axial_stress"], -np.expm1(-columns["axial_strain"])
    )
    return strain


def oedometer_misfit(material: Path, oedometer: Confined) -> float:
    """rms of virtual less measured strain over the greatest measured one."""
    difference = confined_strain(material, oedometer.stress) - np.array(oedometer.strain)
    return rms(difference) / oedometer.strain[-1]
