# SPDX-License-Identifier: GPL-2.0-or-later
"""Mistakes of users with the laboratory: its tests, their evaluation, calibrations."""

import functools
import importlib
import json
import operator
import os
import shutil
import sys
import tempfile
import unittest
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any
from unittest import mock

import jsonschema
import numpy as np

from furrow_post.arrays import Floats
from furrow_post.cli.main import main
from support.command import SOURCE
from support.faults import FaultsTest, outcome
from support.laboratory import cell_rows, triaxial_stress, write_test

LABORATORY = SOURCE / "inputs" / "laboratory"
MATERIAL = SOURCE / "inputs" / "materials" / "fresh_snow.yaml"
REFERENCE = SOURCE / "inputs" / "validation" / "snow_oedometer" / "reference.csv"
sys.path.insert(0, str(LABORATORY))

from task import SCHEMA

# (words of run.py, error); everything is refused before a run
TESTS = (
    ("odometer", "'odometer' is not one of"),
    ("oedometer --ground snoww", "there is no ground 'snoww'; there are sand_cmu"),
    ("repose --ground snow_bonded", "the test repose has no sintered clusters"),
    ("oedometer -v grians 100", "no line reads 'grians'; did you mean grains?"),
    ("oedometer -v steps 3", "computes 'steps' itself"),
    ("oedometer -v stiffness 3e6", "no line reads 'stiffness'"),  # of snow, not of sand
    ("plate -v travel 4", "no line reads 'travel'"),
    ("oedometer -v stress 10", "variable stress: 10 Pa is not above the confinement at the start"),
    ("oedometer -v start_fraction 0.9", "variable start_fraction: 0.9 is above 0.4"),
    ("oedometer -v grains 100 -v grains 200", "-v grains is given 2 times; give it once"),
    ("oedometer -v results x", "-v results: use -o for the results folder"),
    ("oedometer -v ground snow", "-v ground: use --ground"),
    ("oedometer -v grains 0", "variable grains: 0 is not above 0"),
    ("oedometer -v grains 1", "variable grains: 1 is not a whole number from 50 on"),
    ("oedometer -v grains 99.5", "variable grains: 99.5 is not a whole number"),
    ("oedometer -v grains 1000000000", "variable grains: 1000000000 is above 5000000"),
    ("oedometer -v grains many", "variable grains: 'many' is not a number"),
    ("oedometer -v rate -1", "variable rate: -1 is not above 0"),
    ("oedometer -v strain nan", "variable strain: 'nan' is not a number"),
    ("triaxial -v confinement -1e3", "variable confinement: -1e3 is not above 0"),
    ("oedometer -v seed 7", "variable seed: 7 is no prime above 10000"),
    ("oedometer -v friction -0.1", "variable friction: -0.1 is not 0 or more"),
    ("oedometer -v strain 50", "variable strain: 50 is outside of 0 to 3; a cell keeps"),
    ("oedometer -v rate 1e-6", "variable rate: 1e-6 is outside of 0.001 to 100 1/s"),
    ("plate -v speed 1e-9", "variable speed: 1e-9 is outside of 0.0001 to 10 m/s"),
    ("plate --series 99", "variable size: a plate of 99 m is no smaller than its bed, 0.26 m wide"),
    ("plate -v size 80", "variable size: a plate of 80 m is no smaller than its bed"),
    ("oedometer -v density 26500", "variable density: 26500 is outside of 10 to 8000 kg/m3"),
    ("oedometer -v friction 31", "variable friction: 31 is outside of 0 to 5; a coefficient"),
    ("oedometer --ground snow -v density 7000", "variable density: 7000 kg/m3 is denser than ice"),
    ("oedometer --ground snow_bonded -v bulk 2000", "variable bulk: 2000 kg/m3 is denser than ice"),
    (f"oedometer --continuum {SOURCE}/inputs/scenes/README.md", "README.md: "),
    (f"oedometer --continuum {SOURCE}/inputs/tyres/p235_75r15.yaml", "has neither 'law' nor 'base'"),
    ("oedometer --series 1,2", "variable seed: 1 is no prime"),
    ("oedometer --confinement 1e4", "the series of oedometer is seed; use --series"),
    ("triaxial --confinement 1e4,,2e4", "has an empty value of confinement"),
    ("triaxial --confinement 1e4,10000", "has a value of confinement twice"),
    ("triaxial --confinement 1e4 --series 1e4", "are the same here; give one of them"),
    ("triaxial --confinement 1e4 -v confinement 2e4", "is given by -v and by --series"),
    ("triaxial --confinement stiff", "variable confinement: 'stiff' is not a number"),
    ("triaxial --confinement=-1e4", "variable confinement: -1e4 is not above 0"),
    ("oedometer --continuum none.yaml", "none.yaml: no such file; name a material (YAML)"),
    (f"shear --continuum {MATERIAL}", "--continuum is for oedometer and triaxial"),
    ("oedometer --reference none.csv", "none.csv: no such file or directory"),
    ("oedometer --reference empty.csv", "empty.csv: cannot be used (no rows of such numbers)"),
    (f"triaxial --reference {REFERENCE}", "--reference is for oedometers; leave it out"),
    ("oedometer -o empty.csv", "empty.csv: "),
    ("oedometer --build none", "there is no program"),
)

GOOD: dict[str, Any] = {
    "test": "oedometer",
    "ground": "snow",
    "variables": {"grains": 600, "stress": 1.1e6},
    "parameters": {"strength": [6e3, 5e2, 5e4]},
    "seeds": [86028121, 67867967],
    "reference": "../validation/snow_oedometer/reference.csv",
    "lowest": 4.9e4,
    "highest": 1.01e6,
}
QUANTITIES: dict[str, Any] = {"reference": None, "lowest": None, "highest": None}
SEVERAL: dict[str, Any] = {"test": None, **QUANTITIES}
PULL = {"strength": [1e3, 100]}
INNER: dict[str, Any] = {"series": [1e4], "quantities": PULL}  # what has forms within forms
EXAMPLE: dict[str, Any] = {**GOOD, **INNER, "tests": [{"test": "tension", **INNER}]}

# Faults that span several keys, or the scripts of a test: (changed keys, None: left out; error)
CALIBRATIONS: tuple[tuple[dict[str, Any], str], ...] = (
    *(({key: None}, f"'{key}' is missing") for key in ("test", "ground", "parameters", "seeds")),
    ({"ground": "snoww"}, "there is no ground 'snoww'"),
    ({"grund": "snow"}, "there is no key 'grund'; did you mean 'ground'?"),
    ({"variables": {"grians": 1}}, "no line reads 'grians'"),
    ({"variables": {"rate": -1}}, "variable rate: -1 is not above 0"),
    ({"variables": {"seed": 86028121}}, "seeds stand in 'seeds'"),
    ({"parameters": {"strenth": [2, 1, 3]}}, "no line reads 'strenth'; did you mean strength or"),
    ({"parameters": {"k1": [2, 1, 3]}}, "computes 'k1' itself"),
    ({"parameters": {"seed": [2, 1, 3]}}, "give it once, seeds in 'seeds'"),
    ({"parameters": {"grains": [60, 50, 70]}}, "is a parameter and a variable"),
    ({"parameters": {"strength": [1, 3, 2]}}, "[start, lower, upper] with 0 < lower"),
    ({"parameters": {"strength": [5, 1, 2]}}, "starts at 5, and goes from 1 to 2; needed is [start, lower, upper]"),
    ({"parameters": {"strength": [float("nan"), 1, 2]}}, "[start, lower, upper]"),
    ({"seeds": [86028122]}, "variable seed: 86028122 is no prime"),
    ({"reference": None}, "one of 'reference', with 'lowest' and 'highest', and 'quantities' is needed"),
    ({"reference": "none.csv"}, "none.csv is no file; the path is relative to"),
    ({"lowest": None}, "one of 'reference', with 'lowest' and 'highest'"),
    ({"lowest": 2e6}, "'lowest' is 2e+06, not below 'highest', 1.01e+06 Pa"),
    ({"lowest": 1e9, "highest": 2e9}, "has no row with a stress of 1e+09 to 2e+09 Pa"),
    ({"quantities": {"K0": [0.4, 0.1]}}, "one of 'reference', with"),
    *(
        ({**QUANTITIES, "quantities": {"K0": value}}, 'or [value, "30%"]')
        for value in ([0.4, 0], [0.4, "30"], [0.4, "130%"], [0, "30%"])
    ),
    ({"series": [1e4]}, "'series' is of confinements; the test oedometer has none"),
    ({"tests": [{"test": "tension", "quantities": PULL}]}, "'test' stands beside 'tests'; write it for each of them"),
    ({**SEVERAL, "tests": [{"variables": {}}]}, "tests.0: 'test' is missing; give an object"),
    ({**SEVERAL, "tests": [{"test": "oedometer"}]}, "tests.0: one of 'reference', with"),
    ({**SEVERAL, "tests": [{"test": "tension", "seeds": [3]}]}, "there is no key 'seeds'"),
    ({**SEVERAL, "tests": [{"test": "tension", "quantities": PULL}]}, "no line reads 'stress'"),
)

Place = tuple[str | int, ...]  # keys and indices of a value within values


CANDIDATES: tuple[Any, ...] = (None, "nonsense", [1], {}, [], 0, -1, 1.5, [7, 7])  # of values that a form may refuse


def faults_of(form: Mapping[str, Any], place: Place = (), needed: str = "") -> Iterator[tuple[Place, str, str]]:
    """(place of a value, text of a wrong one, form that is needed) of a form of the schema and all within it."""
    needed = form.get("description", needed)
    for value in CANDIDATES:
        errors = jsonschema.Draft202012Validator(form).iter_errors(value)
        if any(not error.path and error.validator not in ("required", "oneOf") for error in errors):
            yield place, json.dumps(value), needed
    inner: dict[str | int, Any] = {0: form.get("items"), "strength": form.get("additionalProperties")}
    inner |= form.get("properties", {})
    for key, one in inner.items():
        if one:
            yield from faults_of(one, (*place, key), needed)


# (text of the file, error)
NO_CALIBRATIONS = (
    ("", "is no JSON"),
    ('{"test": ', "is no JSON"),
    ('{"test": "a", "test": "b"}', "the key 'test' stands there 2 times"),
)

STRAIN = np.linspace(0, 0.2, 400)
SIDE = -0.2 * STRAIN
Z = np.linspace(-0.001, 0.02, 400)
CELL_STRAIN = np.column_stack((SIDE, SIDE, STRAIN))
CELL = cell_rows(CELL_STRAIN, triaxial_stress(1e4, 1e4 + 2e5 * STRAIN))
CURVES: Mapping[str, Floats] = {
    "triaxial": CELL,
    "extension": cell_rows(-CELL_STRAIN, np.roll(triaxial_stress(1e4, 1e4 + 2e5 * STRAIN), 1, 1)),
    "plane_strain": CELL,
    "oedometer": CELL,
    "unconfined": CELL,
    "tension": cell_rows(-CELL_STRAIN, triaxial_stress(0.0, -2e5 * STRAIN)),
    "shear": np.column_stack((CELL[:, :8], np.linspace(0, 0.05, 401), np.full(401, 5e3))),
    "plate": np.column_stack((np.arange(400), Z, 1e4 * np.maximum(Z, 0), 1e6 * np.maximum(Z, 0))),
}
FACTS = "ground made confinement 1e4 size 0.1 depth 0.05 speed 0.5 diameter 0.01 density 2650"

# (fault, change of a curve's rows, error)
BAD_CURVES: tuple[tuple[str, Callable[[Floats], Floats], str], ...] = (
    ("not a number", lambda rows: rows * np.nan, "columns of finite numbers"),
    ("few rows", lambda rows: rows[:5], "has fewer than ten rows; was the run stopped?"),
    ("few columns", lambda rows: rows[:, :3], "columns of finite numbers"),
    ("zeros", lambda rows: 0 * rows, "cannot be used"),
)
BAD_TEXTS = (
    ("words", b"hello world\n", "curve.txt: cannot be used"),
    ("empty", b"", "curve.txt: has no rows of 1 numbers"),
    ("bytes", b"\xff\xfe\0" * 50, "curve.txt: is not text in UTF-8"),
    ("ragged", b"1 2 3 4 5 6 7 8 9 10\n1 2 3\n" * 9, "curve.txt: cannot be used"),
)
BAD_FACTS = (
    ("empty", "", "facts.txt: test '' is not one of"),
    ("another test", "test swelling", "facts.txt: test 'swelling' is not one of"),
    ("cut", "test plate size", "facts.txt: 'size' has no value"),
    ("no size", "test plate depth 0.1", "facts.txt: has no 'size'"),
    ("a word", "test plate size large", "facts.txt: cannot be used"),
)
DUMP_HEAD = 9 * "x\n"
BAD_DUMPS = (
    ("empty", "", "has no rows of 5 numbers"),
    ("no grains", DUMP_HEAD, "has no rows of 5 numbers"),
    ("few columns", DUMP_HEAD + "1 0\n" * 50, "has no rows of 5 numbers"),
    ("one place", DUMP_HEAD + "1 0 0 0 0.005\n" * 50, "was the run stopped, or too short?"),
    ("not a number", DUMP_HEAD + "1 nan nan nan 1\n" * 50, "was the run stopped, or too short?"),
)


class LaboratoryFaultsTest(FaultsTest):
    def setUp(self) -> None:
        self.home = os.getcwd()
        self.temporary = tempfile.TemporaryDirectory()
        os.chdir(self.temporary.name)
        Path("empty.csv").write_text("rho_kgm3,sigma1_Pa\n")

    def tearDown(self) -> None:
        os.chdir(self.home)
        self.temporary.cleanup()

    def start(self, driver: str, words: list[str], message: str) -> None:
        module = importlib.import_module(driver)
        with mock.patch.object(sys, "argv", [driver, *words]):
            found = outcome(module.main)
        self.expect(" ".join(words), found, message)

    def test_faulty_tests_are_refused(self) -> None:
        for words, message in TESTS:
            self.start("run", words.split(), message)
        for name, value in (("grains", ""), ("", "3"), (" ", "3")):
            self.start("run", ["oedometer", "-v", name, value], "has an empty")

    def calibrate(self, text: str, message: str) -> None:
        Path("task.json").write_text(text)
        self.start("calibrate", ["task.json", "-o", "out", "--build", "none"], message)

    def test_faulty_calibrations_are_refused(self) -> None:
        self.calibrate(json.dumps(GOOD), "there is no program")  # nothing else is wrong
        for changes, message in CALIBRATIONS:
            kept = {key: value for key, value in {**GOOD, **changes}.items() if value is not None}
            self.calibrate(json.dumps(kept), message)
        for text, message in NO_CALIBRATIONS:
            self.calibrate(text, message)
        self.start("calibrate", ["none.json"], "none.json: no such file or directory")

    def test_faulty_values_of_a_calibration_are_refused(self) -> None:
        """Key, value and needed form are in the message, by the schema of the file."""
        faults = list(faults_of(SCHEMA))
        for place, value, needed in faults:
            task: Any = [json.loads(json.dumps(EXAMPLE))]
            *way, last = (0, *place)
            functools.reduce(operator.getitem, way, task)[last] = json.loads(value)
            name = f"'{'.'.join(map(str, place))}'" if place else "the file"
            self.calibrate(json.dumps(task[0]), f"{name} is {value}; needed is {needed}")
        self.assertEqual(len(faults), 263)  # another number: the schema accepts or refuses other values

    def test_faulty_results_of_tests_are_refused(self) -> None:
        for kind, rows in CURVES.items():
            folder = write_test(Path(kind), f"test {kind} {FACTS}", rows)
            self.assertEqual(outcome(lambda: main(["laboratory", str(folder)])).status, 0)
            for fault, change, message in BAD_CURVES:
                write_test(folder, f"test {kind} {FACTS}", change(rows))
                self.evaluate(f"{kind}: {fault}", folder, message)
            for fault, content, message in BAD_TEXTS:
                (folder / "curve.txt").write_bytes(content)
                self.evaluate(f"{kind}: {fault}", folder, message)
            (folder / "curve.txt").unlink()
            self.evaluate(f"{kind}: no curve", folder, "curve.txt: no such file")
        for fault, facts, message in BAD_FACTS:
            self.evaluate(fault, write_test(Path("plate"), facts, CURVES["plate"]), message)

    def test_faulty_deposits_are_refused(self) -> None:
        for kind in ("collapse", "repose"):
            folder = Path(kind)
            folder.mkdir()
            facts = f"test {kind} ground made diameter 0.01 radius 0.05 length 0.2"
            (folder / "facts.txt").write_text(facts)
            self.evaluate(f"{kind}: no dump", folder, ".dump: no such file")
            for fault, text, message in BAD_DUMPS:
                for name in ("column", "deposit"):
                    (folder / f"{name}.dump").write_text(text)
                self.evaluate(f"{kind}: {fault}", folder, message)

    def evaluate(self, fault: str, folder: Path, message: str) -> None:
        self.expect(fault, outcome(lambda: main(["laboratory", str(folder)])), message)

    def test_faulty_laws_from_tests_are_refused(self) -> None:
        triaxial, oedometer = (
            str(write_test(Path(kind), f"test {kind} {FACTS}", CURVES[kind])) for kind in ("triaxial", "oedometer")
        )
        for tests, confined, message in (
            ("none", oedometer, "none: has no facts.txt"),
            (oedometer, oedometer, "is a test 'oedometer'; name the results of test 'triaxial'"),
            (triaxial, triaxial, "is a test 'triaxial'; name the results of test 'oedometer'"),
        ):
            self.start("identify", [tests, "--oedometer", confined, "-o", "law.yaml"], message)
        self.assertFalse(Path("law.yaml").exists())
        shutil.rmtree(triaxial)


if __name__ == "__main__":
    unittest.main()
