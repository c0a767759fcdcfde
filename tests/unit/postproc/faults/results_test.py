# SPDX-License-Identifier: GPL-2.0-or-later
"""Results folders that are damaged or foreign: every subcommand says file, fault and remedy."""

import json
import random
import shutil
import tempfile
import time
import unittest
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from furrow_post.cli.main import main
from furrow_post.errors import ResultsError
from furrow_post.read.hdf5 import opened
from support.faults import FaultsTest, outcome
from support.folder import SharedFolderTest
from support.runs import write_noisy_history, write_run
from support.rut import write_rut

Change = Callable[[Any], None]  # of an open history.h5

SUBCOMMANDS = ("plot", "picture", "terrain", "report", "compare", "cost")


def column(name: str, values: Callable[[Any], Any]) -> Change:
    """Replaces a channel, or all of them."""

    def change(content: Any) -> None:
        for channel in [name] if name else list(content["history"]):
            data = content["history"][channel]
            attributes, changed = dict(data.attrs), values(data[()])
            del content["history"][channel]
            content["history"][channel] = changed
            content["history"][channel].attrs.update(attributes)

    return change


def styles(change_entries: Callable[[Any], object]) -> Change:
    def change(content: Any) -> None:
        entries = json.loads(content["run/styles"][()])
        text = change_entries(entries)
        del content["run/styles"]
        content["run/styles"] = np.bytes_((text if isinstance(text, str) else json.dumps(entries)).encode())

    return change


def without(path: str) -> Change:
    def change(content: Any) -> None:
        del content[path]

    return change


def without_attribute(path: str, name: str) -> Change:
    def change(content: Any) -> None:
        del content[path].attrs[name]

    return change


def backwards(time_column: Any) -> Any:
    return np.concatenate((time_column[:1000], time_column[:1000]))


def not_a_number(values: Any) -> Any:
    values[500] = np.nan
    return values


def nodes_beyond(content: Any) -> None:
    content["surface/triangles"][...] = 10**6


def renamed_history(content: Any) -> None:
    content.move("history", "former")
    content.create_group("history")


# (fault, change of history.h5, subcommand, error)
HISTORIES: tuple[tuple[str, Change, str, str], ...] = (
    ("time runs backwards", column("time", backwards), "plot", "row 1001 of the history is at 0 s"),
    ("time stands", column("time", np.zeros_like), "compare", "time does not run forwards"),
    ("time not a number", column("time", not_a_number), "plot", "row 501 of the history is at nan"),
    ("force not a number", column("force_z", not_a_number), "report", "'force_z' has a value that"),
    ("no time", without("history/time"), "plot", "history.h5: has no 'time'"),
    ("no hub drop", without("history/hub_drop"), "compare", "history.h5: has no 'hub_drop'"),
    ("no stage", without("history/stage"), "report", "history.h5: has no 'stage'"),
    ("no channels", renamed_history, "plot", "fewer than two rows"),
    ("no history", without("history"), "plot", "history.h5: has no 'history'"),
    ("no run", without("run"), "compare", "history.h5: has no 'run'"),
    ("no unit", without_attribute("history/x", "unit"), "plot", "history.h5: /history/x has no unit"),
    ("short channel", column("force_x", lambda v: v[:10]), "plot", "have 10 to 2000 rows"),
    ("a text", column("x", lambda v: np.full(len(v), b"a")), "cost", "'x' is no row of numbers"),
    ("two axes", column("x", lambda v: np.zeros((len(v), 2))), "plot", "'x' is no row of numbers"),
    ("no rows", column("", lambda v: v[:0]), "plot", "fewer than two rows; run longer"),
    ("one row", column("", lambda v: v[:1]), "compare", "fewer than two rows; run longer"),
    ("styles cut", styles(lambda e: "[{"), "compare", "/run/styles cannot be read"),
    ("a style of numbers", styles(lambda e: e[0].update(style=3)), "cost", "are no texts"),
    ("no values", styles(lambda e: e[1]["options"].update(load_force=[])), "report", "no values"),
    ("a word", styles(lambda e: e[0]["options"].update(diameter=["x"])), "compare", "'diameter' is 'x', not a number"),
)

SUMMARY = '{"window": {"start": %s, "end": %s}, "quantities": {"hub_drop": %s}}'
# (fault, text of summary.json, subcommand, error)
SUMMARIES = (
    ("cut", "{", "plot", "summary.json: cannot be read"),
    ("empty", "", "report", "summary.json: cannot be read"),
    ("a list", "[]", "compare", "summary.json: is not a summary of Furrow"),
    ("no mean", SUMMARY % (1, 2, "{}"), "plot", "summary.json: has no 'mean'"),
    ("a number", SUMMARY % (1, 2, "3"), "compare", "summary.json: cannot be used"),
    ("window of words", SUMMARY % ('"a"', 2, "null"), "plot", "summary.json: cannot be used"),
    ("a mean that is no number", SUMMARY % (1, 2, '{"mean": NaN}'), "report", "NaN is no number of JSON"),
    ("endless brackets", 100000 * "[", "compare", "brackets are nested too deeply"),
    ("no steady values", SUMMARY % (1, 2, "null"), "cost", "or run longer"),
)

# (fault, change of a run on grains, what picture says)
GRAINS: tuple[tuple[str, Change, str], ...] = (
    ("no identities", without("grains/final/id"), "history.h5: has no 'id'"),
    ("no reference", without("grains/reference"), "has no /grains/reference"),
    ("no level", without_attribute("grains/final", "bed_level"), "has no 'bed_level'"),
    ("nodes that are not there", nodes_beyond, "triangles without nodes"),
)


# (quantity, mean in summary.json, error): numbers that a hand wrote
CHANGED = (
    ("hub_drop", -5.0, "has a hub drop of -5 m, its history 0.05"),
    ("hub_drop", 9.9, "has a hub drop of 9.9 m, its history 0.05"),
    ("hub_drop", 0.0525, "has a hub drop of 0.0525 m"),
    ("force_z", 100.0, "has a force z of 100 N, its history 1000"),
    ("drawbar_pull", 200.0, "has a drawbar pull of 200 N, its history -200"),
    ("drive_torque", 50.0, "has a drive torque of 50 N m, its history 0"),
)
FRAMES = """<VTKFile type="Collection"><Collection>
<DataSet timestep="0" file="%s"/></Collection></VTKFile>"""


def damaged(intact: bytes) -> Iterator[tuple[str, bytes]]:
    """(fault, content): truncated, foreign and with flipped bits; none may end this process."""
    yield "empty", b""
    yield "text", b"hello"
    for length in (8, 100, 1000, len(intact) // 2, len(intact) - 1):
        yield f"{length} bytes", intact[:length]
    for step, first in ((3001, 0), (3001, 17), (997, 5), (211, 3), (5003, 100), (20011, 7)):
        content = bytearray(intact)
        for place in range(first, len(content), step):
            content[place] ^= 1 << (place % 8)
        yield f"a bit in {step} bytes", bytes(content)
    for seed in range(8):
        content, dice = bytearray(intact), random.Random(seed)
        for _ in range(60):
            content[dice.randrange(6000)] ^= 1 << dice.randrange(8)
        yield f"60 bits of the head, {seed}", bytes(content)


class ResultsFaultsTest(FaultsTest, SharedFolderTest):
    @classmethod
    def setUpClass(cls) -> None:
        super().setUpClass()
        write_run(cls.folder / "good")
        write_run(cls.folder / "other", sinkage=0.051)
        (cls.folder / "grains").mkdir()
        write_noisy_history(cls.folder / "grains" / "history.h5")
        write_rut(cls.folder / "grains" / "history.h5", diameter=0.03)

    def copy(self, of: str = "good") -> Path:
        target = Path(tempfile.mkdtemp(dir=self.folder)) / "run"
        shutil.copytree(self.folder / of, target)
        return target

    def post(self, fault: str, subcommand: str, folder: Path, message: str) -> None:
        other = [str(self.folder / "other")] if subcommand == "compare" else []
        output = folder.parent / ("o.html" if subcommand == "report" else "o.png")
        words = [subcommand, str(folder), *other, "-o", str(output)]
        self.expect(f"{subcommand}: {fault}", outcome(lambda: main(words)), message)

    def test_damaged_files_give_an_error(self) -> None:
        intact = (self.folder / "good" / "history.h5").read_bytes()
        for fault, content in damaged(intact):
            folder = self.copy()
            (folder / "history.h5").write_bytes(content)
            self.post(fault, "plot", folder, "history.h5: ")

    def test_every_subcommand_refuses_a_damaged_file(self) -> None:
        folder = self.copy()
        (folder / "history.h5").write_bytes((folder / "history.h5").read_bytes()[:-1])
        (folder / "terrain.h5").write_bytes(b"\x89HDF\r\n\x1a\n" + 2000 * b"\x07")
        for subcommand in SUBCOMMANDS:
            self.post("truncated", subcommand, folder, "not a results file of Furrow, or damaged")
            self.post("no folder", subcommand, folder / "none", "none: no such file; name the")

    def test_faulty_histories_are_refused(self) -> None:
        for fault, change, subcommand, message in HISTORIES:
            folder = self.copy()
            with h5py.File(folder / "history.h5", "r+") as content:
                change(content)
            self.post(fault, subcommand, folder, message)

    def test_faulty_summaries_are_refused(self) -> None:
        for fault, text, subcommand, message in SUMMARIES:
            folder = self.copy()
            (folder / "summary.json").write_text(text)
            self.post(fault, subcommand, folder, message)
        folder = self.copy()
        content = json.loads((folder / "summary.json").read_text())
        content["window"] = {"start": 50.0, "end": 60.0}
        (folder / "summary.json").write_text(json.dumps(content))
        self.post("window of another run", "compare", folder, "lies outside of the history")
        (folder / "summary.json").write_bytes(b'{"title": "\xe9"}')
        self.post("no UTF-8", "plot", folder, "summary.json: ")

    def test_summary_that_contradicts_the_history_is_refused(self) -> None:
        for name, mean, message in CHANGED:
            folder = self.copy()
            content = json.loads((folder / "summary.json").read_text())
            content["quantities"][name]["mean"] = mean
            (folder / "summary.json").write_text(json.dumps(content))
            for subcommand in ("compare", "report", "cost"):
                self.post(f"{name} {mean}", subcommand, folder, message)

    def test_terrain_of_another_run_is_refused(self) -> None:
        folder = self.copy()
        with h5py.File(folder / "terrain.h5", "w") as content:
            content.create_group("run")["styles"] = np.bytes_(b"[]")
            content["run/effective_input"] = np.bytes_(b"fix soil all terrain/continuum")
            content.create_group("terrain")
        self.post("another input", "terrain", folder, "terrain.h5: is of another run than history.h5")

    def test_frames_outside_the_results_are_refused(self) -> None:
        folder = self.copy()
        (folder / "vtk").mkdir()
        for name in ("../../secret.vtp", "/etc/passwd", "x/../../../a.vtp"):
            (folder / "vtk" / "wheel.pvd").write_text(FRAMES % name)
            words = ["view", str(folder), "-o", str(folder.parent / "o.html")]
            said = outcome(lambda: main(words))
            self.expect(name, said, "outside of its folder")

    def test_faulty_grains_are_refused(self) -> None:
        for fault, change, message in GRAINS:
            folder = self.copy("grains")
            with h5py.File(folder / "history.h5", "r+") as content:
                change(content)
            self.post(fault, "picture", folder, message)

    def test_faulty_terrain_is_refused(self) -> None:
        vectors, numbers = ("x", "initial_position"), ("density", "volume")
        shapes: dict[str, tuple[int, ...]] = dict.fromkeys(vectors, (50, 3))
        shapes |= dict.fromkeys(numbers, (50,))
        cases: tuple[tuple[str, dict[str, tuple[int, ...]], str], ...] = (
            ("no particles", {n: (0, *s[1:]) for n, s in shapes.items()}, "has no particles"),
            ("fewer volumes", {**shapes, "volume": (7,)}, "arrays have 7 to 50 rows"),
            ("no volumes", {n: s for n, s in shapes.items() if n != "volume"}, "has no 'volume'"),
        )
        for fault, changed, message in cases:
            folder = self.copy()
            with h5py.File(folder / "terrain.h5", "w") as content:
                group = content.create_group("terrain")
                for name, shape in changed.items():
                    group[name] = np.random.default_rng(0).random(shape)
            self.post(fault, "terrain", folder, message)

    def test_check_of_the_file_takes_little_time(self) -> None:
        path = self.folder / "large.h5"
        with h5py.File(path, "w") as content:
            content["x"] = np.zeros((1_000_000, 4))  # 32 MB
        began = time.monotonic()
        with opened(path) as content:
            self.assertEqual(content["x"].shape, (1_000_000, 4))
        self.assertLess(time.monotonic() - began, 5.0)

    def test_missing_parts_of_a_valid_file_are_named(self) -> None:
        with self.assertRaisesRegex(ResultsError, "history.h5: has no 'nothing'"):
            with opened(self.folder / "good" / "history.h5") as content:
                content["nothing"]


if __name__ == "__main__":
    unittest.main()
