# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post answer and the same function of Python."""

import tempfile
import unittest
from pathlib import Path
from unittest.mock import patch

import yaml

import furrow_post
from furrow_post.cli import answer_command, run_commands
from furrow_post.cli.parameters import Given


class AnswerTest(unittest.TestCase):
    def test_python_reads_the_table_in_the_default_folder_of_the_command(self) -> None:
        with (
            tempfile.TemporaryDirectory() as text,
            patch.object(answer_command, "default_folder", return_value=Path(text)),
            patch.object(run_commands, "post", return_value=0) as post,
        ):
            (Path(text) / answer_command.TABLE).write_text("quantity,value\nrut_depth,0.04\n", encoding="utf-8")
            table = furrow_post.answer("265/70R17", load=6000)
        self.assertEqual(post.call_args.args, ("answer", "265/70R17", "--load", 6000, "--output", Path(text)))
        self.assertEqual(table["value"]["rut_depth"], 0.04)

    def test_help_names_the_default_folder(self) -> None:
        (option,) = (one for one in answer_command.answer.params if one.name == "folder")
        self.assertTrue(getattr(option, "help").endswith(f"/{answer_command.default_folder().name}"))

    def test_firm_sand_has_the_contact_of_firm_sand(self) -> None:
        for index, name in ((80.0, "sand.yaml"), (90.0, "firm_sand.yaml")):
            text = answer_command._soil(Given(soil="sand", cone_index=index))
            self.assertEqual(Path(yaml.safe_load(text)["contact"]).name, name)


if __name__ == "__main__":
    unittest.main()
