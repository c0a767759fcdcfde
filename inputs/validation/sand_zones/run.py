#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Zones in sand under the rolling tyre of [Shoop2001] (principal stresses) and under rigid wheels
that are towed, driven or locked (flow). See README.md.

Makes the runs that are missing and writes stress.csv, flow.csv and the figures.
"""

import sys
from collections.abc import Sequence
from pathlib import Path

HERE = Path(__file__).resolve().parent
PROJECT = HERE.parents[2]
sys.path.insert(0, str(PROJECT / "postproc"))

import furrow_post  # first: says which of the next ones are missing

from furrow_post.figures.terrain_stress import draw_stress
from furrow_post.study.case import Case, Value
from furrow_post.study.furrow_cases import script_case
from furrow_post.study.output import Output
from furrow_post.study.runner import Runner
from furrow_post.study.study import Study, run_study

import zones

TYRE_FILE = PROJECT / "inputs/tyres/p235_75r15.yaml"
MATERIALS = PROJECT / "inputs/materials"
# The tyre on sand that is nearly rigid, as in tyre_on_sand_ground, but for more than one turn
TYRE: dict[str, Value] = {
    "body": f"tyre/darnell file {TYRE_FILE} pressure 241e3 mesh 6 72 half yes mass 30 inertia 1",
    "radius": 0.3483,
    "load": 6227,
    "speed": 2.2222,
    "mode": "towed",
    "settle": 0.2,
    "accelerate": 0.1,
    "distance": 2.2,
    "damping": 4000,
    "friction": 0.6,
    "terrain": "length 1.2 width 0.8 depth 0.4 cell 0.025 fine_width 0.3 fine_depth 0.15 "
    "growth 1.25 gravity 0 ends absorbing sides absorbing base absorbing",
}
# A rigid wheel on loose sand, small cells for its flow
WHEEL: dict[str, Value] = {
    "body": "wheel/rigid diameter 0.74 width 0.272 shoulder 0.051 mass 636 inertia 2.15 "
    "segments 72",
    "radius": 0.37,
    "load": 3000,
    "speed": 1.0,
    "settle": 0.4,
    "accelerate": 0.2,
    "distance": 0.8,
    "damping": 10000,
    "friction": 0.5,
    "terrain": "length 1.6 width 1.0 depth 0.3 cell 0.04 fine_width 0.4 growth 1.25 "
    "clearance_above 0.5",
    "material": MATERIALS / "dry_sand.yaml",
}


def tyre(name: str, what: str, material: str) -> Case:
    given: dict[str, Value] = {**TYRE, "material": MATERIALS / f"{material}.yaml"}
    return script_case(name, HERE / "roll.lig", given, what=what, stage="tyre")


def wheel(name: str, what: str, mode: str) -> Case:
    given: dict[str, Value] = {**WHEEL, "mode": mode}
    return script_case(name, HERE / "roll.lig", given, what=what, stage="wheel", may_fail=True)


CASES = (
    wheel("towed", "towed, spin free", "towed"),
    wheel("driven", "driven, slip 0.3", "slip slip 0.3"),
    wheel("locked", "locked, slip -1", "slip slip -1"),
    tyre("tyre_cap", "the tyre on McCormick sand, cap law", "mccormick_sand"),
)


def evaluate(runner: Runner, output: Output) -> Sequence[str]:
    stress, flow = [], []
    for case in CASES:
        record = runner.record(case)
        if record is None:
            continue
        folder = runner.folder(case)
        row: zones.Row = {
            "run": case.name,
            "what": case.what,
            "user_s": round(record.cpu_time, 1),
        }
        if case.stage == "tyre":
            stress += [{**row, **layer} for layer in zones.stresses(folder)]
            draw_stress(folder, case.what, output.path(f"{case.name}.png"), dpi=80)
        else:
            flow.append({**row, **zones.flow(folder, float(str(WHEEL["speed"])))})
    output.table("stress.csv", stress)
    output.table("flow.csv", flow)
    return []


if __name__ == "__main__":
    sys.exit(run_study(Study(Path(__file__), __doc__ or "", CASES, evaluate)))
