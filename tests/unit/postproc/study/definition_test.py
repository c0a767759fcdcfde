# SPDX-License-Identifier: GPL-2.0-or-later
"""study.yaml: defaults, texts and placeholders of runs; what is refused."""

import tempfile
import unittest
from pathlib import Path

from furrow_post.errors import ResultsError
from furrow_post.cli.study_command import study_folders
from furrow_post.run.case import Case
from furrow_post.study.definition import cases_of
from furrow_post.tables.engine import load_study
from support.command import SOURCE

TEXT = """
title: A wheel
checked: [soft]
texts:
  snow: |
    title: {what}
    law: {d: {d}}
defaults:
  script: wheel.lig
  variables: {depth: 0.2, material: '{folder}/material.yaml'}
  files: {material.yaml: snow}
  time_limit: 60
runs:
  all:
    soft: {what: soft snow, with: {d: 5000}}
    fine: {what: the same, with: {d: 5000}, variables: {cell: 0.02}, ranks: 2}
  law:
    defaults: {variables: {depth: 0.4}}
    hard: {variables: {material: '{materials}/ice.yaml'}, files: {material.yaml: null}, may_fail: true}
    path: {script: null}
"""


class DefinitionTest(unittest.TestCase):
    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.root = Path(temporary.name).resolve()
        self.folder = self.root / "inputs" / "wheel"
        self.folder.mkdir(parents=True)
        (self.root / "CMakeLists.txt").touch()

    def cases(self, text: str) -> dict[str, Case]:
        (self.folder / "study.yaml").write_text(text, encoding="utf-8")
        return {case.name: case for case in cases_of(self.folder)}

    def test_runs_have_the_defaults_of_the_study_and_of_their_stage(self) -> None:
        made = self.cases(TEXT.replace("    path: {script: null}\n", ""))
        soft, fine, hard = made["soft"], made["fine"], made["hard"]
        self.assertEqual(soft.arguments[1], self.folder / "wheel.lig")
        self.assertEqual(soft.variables["depth"], 0.2)
        self.assertEqual(soft.files["material.yaml"], "title: soft snow\nlaw: {d: 5000}\n")
        self.assertEqual((soft.time_limit, soft.stage, soft.may_fail), (60, "", False))
        self.assertEqual((fine.variables["cell"], fine.ranks), (0.02, 2))
        self.assertEqual((hard.variables["depth"], hard.stage, hard.may_fail), (0.4, "law", True))
        self.assertEqual(hard.variables["material"], self.root / "inputs" / "materials" / "ice.yaml")
        self.assertEqual(hard.files, {})

    def test_programs_and_paths_are_resolved(self) -> None:
        made = self.cases(
            "runs:\n  all:\n"
            "    snow: {point: {title: '{run}', material: '{materials}/{run}.yaml', path: '{type: a}'}}\n"
            "    tyre: {program: furrow-tyre, arguments: ['{tyres}/t.yaml', --load, 6227]}\n"
        )
        self.assertIn(f'material: "{self.root}/inputs/materials/snow.yaml"', made["snow"].files["path.yaml"])
        self.assertEqual(made["tyre"].arguments[1:], ("--load", 6227))
        self.assertEqual(made["tyre"].arguments[0], self.root / "inputs" / "tyres" / "t.yaml")

    def test_entry_expands_to_all_combinations_of_values(self) -> None:
        (self.folder / "evaluate.py").write_text("def column(height: float) -> str:\n    return f'{height:.1f}'\n")
        made = self.cases(
            "texts: {soil: 'e: {e}'}\n"
            "runs:\n  all:\n    plate_{size}/{law}:\n"
            "      for: {size: [0.1, 0.2], law: {cap: {e: 1}, norsand: {e: 2}}}\n"
            "      script: plate.lig\n"
            "      variables: {size: '{size}'}\n"
            "      files: {material.yaml: soil, column.txt: '= column(2 * {e})'}\n"
        )
        names = ["plate_0.1/cap", "plate_0.1/norsand", "plate_0.2/cap", "plate_0.2/norsand"]
        self.assertEqual(list(made), names)
        self.assertEqual(made["plate_0.2/cap"].variables["size"], "0.2")
        self.assertEqual(made["plate_0.2/cap"].files, {"material.yaml": "e: 1", "column.txt": "2.0"})

    def test_function_gives_the_keys_of_each_run(self) -> None:
        text = "def rows() -> list:\n    return [{'load': load, 'cell': load / 100} for load in (10, 20)]\n"
        (self.folder / "evaluate.py").write_text(text)
        made = self.cases("runs: {all: {'load_{load}': {for: = rows(), script: a.lig, variables: {cell: '{cell}'}}}}")
        self.assertEqual({name: case.variables["cell"] for name, case in made.items()}, {"load_10": "0.1", "load_20": "0.2"})

    def test_mistakes_are_refused(self) -> None:
        for text, message in (
            ("runs: {all: {a: {skript: x}}}", "run 'a' has unknown keys \\['skript'\\]; allowed are"),
            ("runs: {all: {a: {what: x}}}", "run 'a': give one of script, point, program"),
            ("runs: {all: {a: {script: x, program: y}}}", "give one of script, point, program"),
            ("- a\n", "is no mapping"),
        ):
            with self.subTest(text), self.assertRaisesRegex(ResultsError, message):
                self.cases(text)


class StoredTest(unittest.TestCase):
    def test_files_of_all_runs_exist(self) -> None:
        for folder in study_folders(SOURCE):
            study = load_study(folder)
            with self.subTest(study=folder.name):
                names = {case.name for case in study.cases}
                checked = names if study.checked is None else set(study.checked)
                self.assertTrue(checked <= names and (checked or folder.name == "validation"))  # tables alone
                for case in study.cases:
                    named = [v for v in (*case.arguments, *case.variables.values()) if isinstance(v, Path)]
                    self.assertTrue(all(path.exists() for path in named), case.name)
                    self.assertNotIn("{", "".join(str(word) for word in case.variables.values()).replace("{folder}", ""))


if __name__ == "__main__":
    unittest.main()
