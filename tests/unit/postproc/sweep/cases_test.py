# SPDX-License-Identifier: GPL-2.0-or-later
"""From a command line to the runs of a sweep, by a fake program: checked, kept, continued."""

import unittest
from dataclasses import replace
from pathlib import Path

from furrow_post.errors import ResultsError
from furrow_post.run.executor import Executor, State
from furrow_post.sweep.cases import SweepRequest, case_of, plan_of
from furrow_post.sweep.sweep_plan import SweepPlan, read_plan
from support.fake import FakeTree
from support.folder import FolderTest

SCRIPT = """variable results index x
variable value index 1
variable seed index 10007
variable material index sand.yaml
variable motion index "mode towed"
variable fail index none
print "${value} ${seed} ${material} ${motion} ${fail}"
variable steps equal 3
run ${steps}
"""
# request and error
REFUSED: tuple[tuple[dict[str, object], str], ...] = (
    ({"sweep": ["valeu=1,2"]}, "no line reads 'valeu'; did you mean value?"),
    ({"sweep": ["steps=1,2"]}, "computes 'steps' itself, so that --sweep cannot set it"),
    ({"sweep": ["results=a,b"]}, "--sweep results: use -o"),
    ({"sweep": ["value=1,2"], "given": [("value", "3")]}, "given both by -v and by --sweep"),
    ({"sweep": ["slip=0,1"], "given": [("motion", "x")]}, "motion is given both by -v and by"),
    ({"sweep": ["slip=0,1", "torque=1,2"]}, "slip and torque set the same variable"),
    ({"sweep": ["value=1,2"], "given": [("valeu", "3")]}, "did you mean value?"),
    ({"sweep": ["seed=10007,10009"], "packings": 2}, "--packings chooses 'seed', which is swept"),
    ({"sweep": ["value=1"], "packings": 2, "given": [("seed", "x")]}, "'seed' is 'x', no whole"),
)


class CasesTest(FolderTest):
    def setUp(self) -> None:
        super().setUp()
        self.tree = FakeTree(self.folder)
        self.tree.script.write_text(SCRIPT)
        self.sand = self.tree.script.with_name("sand.yaml")
        self.sand.write_text("loose")
        self.results = self.folder / "results"

    def plan(self, *sweep: str, **more: object) -> SweepPlan:
        return plan_of(replace(SweepRequest(self.tree.script, sweep), **more))[0]

    def executor(self) -> Executor:
        return Executor(self.results, self.tree.tools)

    def test_link_at_the_temporary_name_of_a_plan_is_not_followed(self) -> None:
        notes = self.results / "notes"
        self.results.mkdir()
        notes.write_text("of the user")
        (self.results / "sweep.json.part").symlink_to(notes)
        plan = self.plan("value=1,2")
        plan.write(self.results)
        self.assertEqual(notes.read_text(), "of the user")
        self.assertEqual(read_plan(self.results), plan)

    def test_faults_are_refused(self) -> None:
        for words, message in REFUSED:
            with self.subTest(words), self.assertRaises(ResultsError) as refused:
                plan_of(replace(SweepRequest(self.tree.script, ()), **words))
            self.assertIn(message, str(refused.exception))

    def test_script_without_seed_or_results_is_refused(self) -> None:
        self.tree.script.write_text(SCRIPT.replace("seed", "other"))
        with self.assertRaisesRegex(ResultsError, "--packings 3: no line of .* reads 'seed'"):
            self.plan("value=1,2", packings=3)
        self.tree.script.write_text(SCRIPT.replace("results", "folder"))
        with self.assertRaisesRegex(ResultsError, "all points would write to one folder"):
            self.plan("value=1,2")

    def test_list_shows_the_runs(self) -> None:
        plan = self.plan(
            "slip=-0.1,0.2",
            packings=2,
            given=[("value", "5")],
            preset=[("value", "7"), ("material", "other.yaml"), ("motion", "mode towed")],
        )
        folders = [point.folder for point in plan.points]
        self.assertEqual(
            folders, ["slip_-0.1", "slip_-0.1_seed_10009", "slip_0.2", "slip_0.2_seed_10009"]
        )
        variables = case_of(plan, plan.points[1]).variables
        self.assertEqual(variables["motion"], "mode slip slip -0.1")
        self.assertEqual((variables["value"], variables["seed"]), ("5", "10009"))
        self.assertEqual(variables["material"], "other.yaml")
        self.assertNotIn("seed", case_of(plan, plan.points[0]).variables)

    def test_failures_are_kept_until_retry(self) -> None:
        plan = self.plan("value=1,2", "fail=none", given=[("seed", "10009")])
        cases = [case_of(plan, point) for point in plan.points]
        self.executor().run(cases[:1])
        self.assertEqual(self.executor().missing(cases), cases[1:])
        # The fake program fails where it has a variable of this name
        self.assertEqual(self.executor().state(cases[0]), State.FAILED)
        self.executor().forget(cases)
        self.assertEqual(self.executor().missing(cases), cases)

    def test_point_of_another_script_material_or_program_is_repeated(self) -> None:
        plan = self.plan("value=1,2")
        cases = [case_of(plan, point) for point in plan.points]
        self.executor().run(cases)
        self.assertEqual(self.executor().missing(cases), [])
        self.tree.install("another build")
        self.assertEqual(self.executor().missing(cases), cases)
        self.tree.install()
        self.assertEqual(self.executor().missing(cases), [])
        self.sand.write_text("dense")
        again = [case_of(plan, point) for point in plan.points]
        self.assertEqual(len(self.executor().missing(again)), 2)
        self.sand.write_text("loose")
        self.tree.script.write_text(SCRIPT + "run 1\n")
        self.assertEqual(len(self.executor().missing(again)), 2)

    def test_point_is_repeated_when_the_base_of_its_material_changes(self) -> None:
        """Also a base of a base, and one with the name of the material."""
        (self.sand.parent / "variants").mkdir()
        first, second = self.sand.parent / "variants" / "sand.yaml", self.sand.with_name("dry.yaml")
        self.sand.write_text("base: variants/sand.yaml\nlaw: {d: 1}\n")
        first.write_text("base: ../dry.yaml\n")
        second.write_text("law: {d: 2}\n")
        case = case_of(self.plan("value=1"), self.plan("value=1").points[0])
        for file in (self.sand, first, second):
            self.executor().run([case])
            self.assertEqual(self.executor().missing([case]), [])
            file.write_text(file.read_text() + "# changed\n")
            self.assertEqual(self.executor().missing([case]), [case], file)

    def test_later_command_adds_points_of_the_same_scene(self) -> None:
        first = self.plan("value=1,2")
        first.write(self.results)
        former = read_plan(self.results)
        assert former
        self.assertEqual(former, first)
        both = self.plan("value=2,3").joined(former)
        self.assertEqual([p.folder for p in both.points], ["value_1", "value_2", "value_3"])
        other = self.plan("value=3", given=[("seed", "10009")]).joined(former)
        self.assertEqual([p.folder for p in other.points], ["value_3"])

    def test_until_steady_runs_a_separate_script(self) -> None:
        plan = self.plan("value=1", until_steady=0.03, time_limit=60.0)
        case = case_of(plan, plan.points[0])
        (text,) = case.files.values()
        self.assertEqual(
            text,
            f"include {self.tree.script.resolve()}\nrun_until_steady error 0.03 wall_time 60\n",
        )
        self.assertIn(self.tree.script.resolve(), case.input_files())

    def test_ranks_are_passed_to_the_runs(self) -> None:
        plan = self.plan("value=1", ranks=2)
        command = case_of(plan, plan.points[0]).command(Path("/x/furrow"), Path("/y"), {})
        self.assertEqual(command[:4], ["mpirun", "-n", "2", "/x/furrow"])


if __name__ == "__main__":
    unittest.main()
