# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow_post.load(): the history as a data frame; the example script; the error without pandas."""

import os
import shutil
import subprocess
import sys
import unittest
from collections.abc import Mapping
from typing import Any
from unittest import mock

import furrow_post
from furrow_post.errors import ResultsError
from support.command import SOURCE
from support.folder import FolderTest
from support.runs import write_run


class LoadTest(FolderTest):
    def setUp(self) -> None:
        super().setUp()
        write_run(self.folder)

    def test_channels_are_the_columns_of_the_file(self) -> None:
        run = furrow_post.load(self.folder)
        channels = run.channels
        self.assertEqual(list(channels.columns), list(run.columns))
        for name, values in run.columns.items():
            self.assertTrue((channels[name].to_numpy() == values).all(), name)
        self.assertEqual(channels.attrs["units"], run.units)

    def test_unknown_channel_is_refused_with_the_existing_names(self) -> None:
        run = furrow_post.load(self.folder)
        tables: list[Mapping[str, Any]] = [run.columns, run.units, run.meanings]
        for values in tables:
            with self.assertRaisesRegex(ResultsError, "history.h5: has no 'hub_dorp'; it has .*hub_drop"):
                values["hub_dorp"]
            with self.assertRaisesRegex(ResultsError, r"did you mean hub_drop\?"):
                values["hub_dorp"]

    def test_loaded_arrays_cannot_be_changed(self) -> None:
        run = furrow_post.load(self.folder)
        with self.assertRaisesRegex(ValueError, "read-only"):
            run.columns["hub_drop"][:] = 0
        run.channels["hub_drop"] = 0.0  # a data frame is a copy
        self.assertGreater(run.columns["hub_drop"].max(), 0)

    def test_missing_pandas_is_reported_with_the_remedy(self) -> None:
        run = furrow_post.load(self.folder / "history.h5")
        with mock.patch.dict(sys.modules, {"pandas": None}):
            with self.assertRaisesRegex(ResultsError, "install Debian's python3-pandas, or use .col"):
                run.channels
        self.assertEqual(len(run.columns["time"]), 2000)

    def test_package_is_installed_by_pip_with_its_files(self) -> None:
        source, target = self.folder / "source", self.folder / "target"
        shutil.copytree(SOURCE / "postproc", source)  # setuptools builds in the source
        pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-index"]
        pip += ["--no-build-isolation", "--target", str(target), str(source)]
        done = subprocess.run(pip, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        for file in (SOURCE / "postproc" / "furrow_post").rglob("*"):
            if file.is_file() and file.suffix not in (".pyc", ".md"):
                place = target / "furrow_post" / file.relative_to(SOURCE / "postproc" / "furrow_post")
                self.assertTrue(place.is_file(), f"{place} is missing")
        done = subprocess.run(
            [target / "bin" / "furrow-post", "--version"],
            capture_output=True,
            text=True,
            env={**os.environ, "PYTHONPATH": str(target)},
        )
        self.assertEqual(done.stdout, f"furrow-post {furrow_post.__version__}\n", done.stderr)


if __name__ == "__main__":
    unittest.main()
