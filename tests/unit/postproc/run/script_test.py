# SPDX-License-Identifier: GPL-2.0-or-later
"""Variables of LIGGGHTS scripts: what -v may set, through included files and beds."""

import os
import unittest

from furrow_post.errors import ResultsError
from furrow_post.run.script import check_variables, script_variables
from support.command import SOURCE
from support.folder import FolderTest

MAIN = """# variable commented index 1
variable   here index .      # the folder
variable   size index "0.1 0.2"  # not # a comment
variable   empty index ""
variable   steps equal ceil(${time}/${dt})   # time and dt have no default
variable   kind string soft
include    ${here}/parts/${kind}.part
bed        beds/bed.lig length ${size} step 1e-5 &
           depth 0.1
if         "${size} > 0" then "variable inner index 3" &
           else "print '${onlyhere}'"
fix        f all ave/time 1 1 v_seen f_x
print      "$q ${bed_level}"
"""


class ScriptTest(FolderTest):
    def setUp(self) -> None:
        super().setUp()
        self.script = self.folder / "main.lig"
        self.script.write_text(MAIN)
        for name, text in (
            ("parts/soft.part", "variable stiffness index 1e5\ninclude ${here}/parts/soft.part\n"),
            ("parts/hard.part", "variable strength index 1e5\n"),
            ("beds/bed.lig", "variable contact string hertz\nvariable pouring index 1\n"),
        ):
            (self.folder / name).parent.mkdir(exist_ok=True)
            (self.folder / name).write_text(text)
        self.here = {"here": str(self.folder)}

    def test_declared_and_read_variables_are_found(self) -> None:
        found = script_variables(self.script, self.here)
        self.assertEqual(found.not_found, ())
        expected = "dt empty here inner onlyhere pouring q seen size stiffness time"
        self.assertEqual(found.settable, expected.split())
        self.assertEqual(found.defaults["size"], '"0.1 0.2"')
        self.assertTrue({"steps", "kind", "contact"} <= found.computed)

    def test_unconditional_default_has_priority(self) -> None:
        self.script.write_text(
            """if "1 > 0" then "variable cell index 0.075" 'variable bed index a.lig'\n"""
            'variable cell index 0.05\nprint "${cell} ${bed}"\n'
        )
        found = script_variables(self.script, self.here)
        self.assertEqual(found.defaults, {"cell": "0.05", "bed": "a.lig"})

    def test_command_line_value_selects_the_file(self) -> None:
        self.script.write_text("variable kind index soft\ninclude ${here}/parts/${kind}.part\n")
        found = script_variables(self.script, {**self.here, "kind": "hard"})
        self.assertIn("strength", found.settable)
        self.assertNotIn("stiffness", found.settable)

    def test_faults_are_refused(self) -> None:
        for given, message in (
            ([("sise", "1")], "no line reads 'sise'; did you mean size"),
            ([("commented", "1")], "no line reads 'commented'"),
            ([("steps", "1")], "computes 'steps' itself"),
            ([("contact", "hooke")], "computes 'contact' itself"),
            ([("bed_level", "1")], "no line reads 'bed_level'"),
            ([("size", "1"), ("size", "2")], "-v size is given 2 times"),
            ([("size", " ")], "-v size has an empty value"),
            ([("", "1")], "-v has an empty name"),
            ([("results", "x")], "-v results: use -o"),
        ):
            with self.subTest(given=given), self.assertRaisesRegex(ResultsError, message):
                check_variables(self.script, given, {"results": "-o"}, self.here)

    def test_variables_that_are_read_pass(self) -> None:
        given = [("size", "1"), ("stiffness", "2"), ("dt", "1e-3"), ("q", "x"), ("empty", "")]
        self.assertEqual(check_variables(self.script, given, {}, self.here), [])

    def test_every_layer_of_a_ground_adds_a_file(self) -> None:
        (self.folder / "snow.yaml").write_text("")
        (self.folder / "sand.yaml").write_text("")
        self.script.write_text('variable material index snow.yaml\nprint "${material}"\n')
        check_variables(self.script, [("material", "snow.yaml:0.1,sand.yaml")], {})
        for value in ("ice.yaml", "snow.yaml:0.1,ice.yaml", "ice.yaml:0.1,sand.yaml"):
            with self.subTest(value), self.assertRaisesRegex(ResultsError, "there is no file ice.yaml; a path"):
                check_variables(self.script, [("material", value)], {})

    def test_missing_file_gives_a_warning(self) -> None:
        (self.folder / "parts" / "soft.part").unlink()
        warnings = check_variables(self.script, [("unknown", "1")], {}, self.here)
        self.assertRegex(warnings[0], "soft.part, which was not found")

    def test_every_script_of_the_project_is_read_completely(self) -> None:
        inputs = SOURCE / "inputs"
        for script in sorted(inputs.rglob("*.lig")):
            # a user's own script names files from where it is run, and no results folder; nor does a
            # script that Python steps
            if script.parent.name in ("beds", "parts", "grounds", "surrogate", "vehicle", "wheel_in_my_script"):
                continue
            here = script_variables(script, {}).defaults.get("here", ".")
            given = {"here": str(script.parent / here), "ground": "sand_dry"}
            if script.parent.name == "instruments":  # furrow-post card gives these their files
                ground = inputs / "laboratory/grounds/sand_dry.lig"
                given.update(ground=str(ground), laboratory=str(ground.parents[1]))
            with self.subTest(script=script.name):
                found = script_variables(script, given)
                self.assertEqual(found.not_found, ())
                self.assertIn("results", found.settable)
        self.assertNotEqual(os.listdir(inputs), [])


if __name__ == "__main__":
    unittest.main()
