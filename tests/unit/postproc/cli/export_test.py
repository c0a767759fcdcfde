# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post export: the table has the numbers of the history, with every digit."""

import contextlib
import csv
import io
import unittest

import h5py
import numpy as np

from furrow_post.cli.main import main
from support.folder import FolderTest
from support.runs import write_run


class ExportTest(FolderTest):
    def setUp(self) -> None:
        super().setUp()
        for name, sinkage in (("a", 0.05), ("b", 0.1 / 3)):
            write_run(self.folder / name, sinkage=sinkage)
            with h5py.File(self.folder / name / "history.h5", "r+") as content:
                for channel, unit in (("time", "s"), ("hub_drop", "m"), ("force_z", "N")):
                    content["history"][channel].attrs["unit"] = np.bytes_(unit)

    def export(self, *words: str) -> None:
        given = [str(self.folder / word) if word in ("a", "b", "out.csv") else word for word in words]
        with contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(main(["export", *given]), 0)

    def rows(self, file: str) -> list[dict[str, str]]:
        with open(self.folder / file, encoding="utf-8", newline="") as content:
            return list(csv.DictReader(content))

    def history(self, name: str) -> dict[str, list[float]]:
        with h5py.File(self.folder / name / "history.h5") as content:
            return {channel: data[()].tolist() for channel, data in content["history"].items()}

    def test_export_has_every_channel_with_unit_and_every_digit(self) -> None:
        self.export("b")
        rows, history = self.rows("b/history.csv"), self.history("b")
        names = {name.partition(" [")[0]: name for name in rows[0]}
        self.assertEqual(set(names), set(history))
        self.assertEqual(list(rows[0])[0], "time [s]")
        self.assertEqual((names["hub_drop"], names["slip"]), ("hub_drop [m]", "slip"))
        for channel, values in history.items():
            self.assertEqual([float(row[names[channel]]) for row in rows], values)

    def test_chosen_channels_of_several_runs_are_exported(self) -> None:
        self.export("a", "b", "--channels", "force_z, hub_drop", "-o", "out.csv")
        rows = self.rows("out.csv")
        self.assertEqual(list(rows[0]), ["run", "time [s]", "force_z [N]", "hub_drop [m]"])
        for name in ("a", "b"):
            found = [float(row["hub_drop [m]"]) for row in rows if row["run"] == name]
            self.assertEqual(found, self.history(name)["hub_drop"])

    def test_mistyped_channel_suggests_the_nearest(self) -> None:
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors):
            self.assertEqual(main(["export", str(self.folder / "a"), "--channels", "hub_dorp"]), 1)
        self.assertIn("no run has the channel 'hub_dorp'", errors.getvalue())
        self.assertIn("did you mean 'hub_drop'?", errors.getvalue())

    def test_channel_of_one_run_leaves_empty_cells(self) -> None:
        with h5py.File(self.folder / "b" / "history.h5", "r+") as content:
            del content["history/slip"]
        self.export("a", "b", "--channels", "slip", "-o", "out.csv")
        rows = self.rows("out.csv")
        self.assertEqual({row["slip"] for row in rows if row["run"] == "b"}, {""})
        self.assertNotIn("", {row["slip"] for row in rows if row["run"] == "a"})


if __name__ == "__main__":
    unittest.main()
