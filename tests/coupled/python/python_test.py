# SPDX-License-Identifier: GPL-2.0-or-later
"""The Python module drives scripts as the executable runs them: python_test.py <furrow> <mpirun>..."""

import os
import signal
import sys
import tempfile
import threading
import unittest
import warnings
from collections.abc import Callable
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "support"))

import furrow
import numpy as np
from furrow_run import output, run, words_of
from same_results import compare_arrays

SCENE = HERE / "wheel.lig"
SCENES = HERE.parents[2] / "inputs" / "scenes"
PROGRAM = ""
LAUNCH: list[str] = []


def executable(script: Path, fails: bool = False, launch: tuple[str, ...] = (), **variables: object) -> str:
    """@return what it printed"""
    said = run([*launch, PROGRAM, "-in", script, "-log", "none", *words_of(variables)], None, 500)
    assert bool(said.status) == fails, f"status {said.status}:\n{said.text}"
    return said.text


def opened(script: Path = SCENE, **variables: object) -> furrow.Simulation:
    given = {"here": HERE, **variables} if script == SCENE else variables
    return furrow.Simulation(script, variables=given)


class Case(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        before = os.getcwd()
        self.addCleanup(os.chdir, before)
        os.chdir(self.folder)

    def assert_same(self, one: str, other: str) -> None:
        """Every number of the results files, bit for bit."""
        self.assertGreater(compare_arrays(self.folder / one, self.folder / other, 0.0), 20)


class Stepping(Case):
    def test_results_equal_those_of_the_executable(self) -> None:
        executable(SCENE, here=HERE, results="alone")
        with opened(results="driven") as run:
            self.assertEqual((run.step_number, run.time), (0, 0.0))
            self.assertEqual(run.step(), 1)
            self.assertEqual(run.step(99), 99)
            self.assertEqual(run.step_number, 100)
            self.assertAlmostEqual(run.time, 0.02)
            while run.step(7):
                run.rigs["rig"].measure()
                run.terrains["soil"].particles()
            self.assertTrue(run.ended)
            self.assertEqual((run.step_number, run.step(), run.run()), (500, 0, 0))
            self.assertGreater(run.summary()["quantities"]["hub_drop"]["mean"], 0.015)
            self.assertEqual(run.summary("out"), run.summary())
        self.assert_same("alone", "driven")

    @staticmethod
    def heights_of_grains(run: furrow.Simulation) -> np.ndarray:
        return run.grains["position"][np.argsort(run.grains["id"]), 2]

    def test_results_on_grains_equal_those_of_the_executable(self) -> None:
        os.environ["FURROW_CACHE"] = str(self.folder / "cache")
        scene = SCENES / "wheel_on_sand.lig"
        small = {"diameter": 0.035, "duration": 0.15, "vtk": 0}
        executable(scene, results=self.folder / "alone", **small)
        with opened(scene, results=self.folder / "driven", **small) as run:
            while run.step(100):
                self.assertEqual(run.grains["position"].shape, (len(run.grains["id"]), 3))
                if not run.ended:
                    run.write_checkpoint("own")  # between two makings of neighbour lists
                    last = run.step_number
                    run.step(10)
                    expected = self.heights_of_grains(run)
        self.assert_same("alone", "driven")
        with opened(scene, results=self.folder / "driven", **small, **{"from": "own"}) as run:
            run.step(10)
            self.assertEqual(run.step_number, last + 10)
            np.testing.assert_allclose(self.heights_of_grains(run), expected, rtol=0, atol=1e-12)

    def test_simulations_advance_alternately(self) -> None:
        executable(SCENE, here=HERE, results="alone", slip=0.3)
        one, other = opened(results="one", slip=0.1), opened(results="other", slip=0.3)
        while one.step(50) + other.step(30):
            pass
        one.close()
        other.close()
        self.assert_same("alone", "other")

    def test_lines_are_run_as_a_script(self) -> None:
        executable(SCENE, here=HERE, results="alone")
        lines = SCENE.read_text(encoding="utf-8").splitlines()
        with furrow.Simulation(lines, variables={"here": HERE, "results": "driven"}) as run:
            run.run()
        self.assert_same("alone", "driven")
        self.assertEqual(list(self.folder.glob("*.lig")), [])

    def test_ended_run_has_results(self) -> None:
        with opened(results="driven") as run:
            run.step(400)
            run.end()
            self.assertTrue(run.ended)
            self.assertLessEqual(run.step_number, 401)
            self.assertTrue(run.summary()["complete"])

    def test_interrupt_keeps_the_state_of_the_run(self) -> None:
        executable(SCENE, here=HERE, results="alone")

        def interrupt(*_: object) -> None:
            raise KeyboardInterrupt

        before = signal.signal(signal.SIGALRM, interrupt)
        self.addCleanup(signal.signal, signal.SIGALRM, before)
        with opened(results="driven") as run:
            run.step(1)
            signal.setitimer(signal.ITIMER_REAL, 0.05)
            self.assertRaises(KeyboardInterrupt, run.run)
            self.assertLess(run.step_number, 500)
            run.run()
        self.assert_same("alone", "driven")


class Targets(Case):
    def test_slip_set_in_a_run_equals_that_of_a_continued_script(self) -> None:
        executable(SCENE, here=HERE, results="alone", slip=0.1)
        executable(SCENE, here=HERE, results="alone", slip=0.4, begin="read_restart alone/checkpoint.300")
        with opened(results="driven") as run:
            run.step(300)
            self.assertEqual(run.rigs["rig"].targets["slip"], 0.1)
            run.rigs["rig"].set(slip=0.4)
            self.assertEqual(run.rigs["rig"].targets["slip"], 0.4)
            run.run()
        self.assert_same("alone", "driven")

    def test_targets_take_effect(self) -> None:
        with opened(results="driven") as run:
            rig = run.rigs["rig"]
            run.step(300)
            rig.set(speed=0.25, load_force=120)
            run.step(1)
            row = rig.measure()
            self.assertAlmostEqual(row["velocity_x"], 0.25)
            self.assertAlmostEqual(row["load"], 120.0)
            self.assertAlmostEqual(row["slip"], 0.1)

    def test_refused_targets_change_nothing(self) -> None:
        with opened(results="driven") as run:
            rig = run.rigs["rig"]
            for wrong, text in (({"slip": 3}, "keyword 'slip' is 3"), ({"torque": 1}, "keyword 'torque' is given in mode slip"),
                                ({"damping": 1}, "keyword 'damping' cannot change during a run; allowed: load_mass"),
                                ({"speed": -1, "slip": 0.2}, "keyword 'speed'")):
                self.assertRaisesRegex(furrow.Error, text, rig.set, **wrong)
                self.assertEqual(rig.targets, {"load_force": 100.0, "speed": 0.5, "slip": 0.1, "drawbar_load": 0.0})

    def test_summary_warns_of_targets_that_changed_in_the_cruise(self) -> None:
        with opened(results="mixed") as run:
            run.step(300)
            self.assertRaisesRegex(furrow.Error, "summary: the run has not ended", run.summary)
            run.rigs["rig"].set(slip=0.3)
            run.run()
            warnings = run.summary()["warnings"]
        self.assertEqual(sum("targets of the rig changed during the cruise" in text for text in warnings), 1, warnings)

    def test_targets_of_several_passes_cannot_change(self) -> None:
        text = SCENE.read_text(encoding="utf-8").replace(" follow wheel", "")
        text = text.replace("mode slip", "passes 2 pass_length 0.02 return_time 0.06 mode slip")
        with furrow.Simulation(text.splitlines(), variables={"here": HERE, "results": "driven"}) as run:
            with self.assertRaisesRegex(furrow.Error, "keyword 'passes' is 2, and targets change"):
                run.rigs["rig"].set(slip=0.2)

    def test_python_moves_a_wheel_without_a_rig(self) -> None:
        lines = [line for line in SCENE.read_text(encoding="utf-8").replace("&\n", "").splitlines()
                 if not line.startswith(("fix             rig", "fix             out", "variable        slip"))]
        with furrow.Simulation(lines, variables={"here": HERE, "results": "driven"}) as run:
            wheel = run.wheels["wheel"]
            wheel.prescribe("z", -0.5)
            wheel.prescribe("x", 0.2)
            run.step(200)
            np.testing.assert_allclose(wheel.position[:3], [0.008, 0.0, 0.28 - 0.02], rtol=1e-12, atol=1e-15)
            np.testing.assert_allclose(wheel.velocity[:3], [0.2, 0.0, -0.5])
            self.assertGreater(wheel.force[2], 10.0)
            self.assertAlmostEqual(wheel.constraint[2], -wheel.force[2], delta=0.2 * wheel.force[2])
            wheel.release("z")
            wheel.load = (0.0, 0.0, -80.0)
            self.assertEqual(wheel.load, [0.0, 0.0, -80.0])
            run.step(1)
            self.assertEqual(wheel.constraint[2], 0.0)
            self.assertRaisesRegex(furrow.Error, "coordinate is 'up'; allowed: x, y, z, spin", wheel.hold, "up")
        with opened(results="rigged") as run:
            with self.assertRaisesRegex(furrow.Error, "wheel 'wheel': fix rig sets z in every step"):
                run.wheels["wheel"].prescribe("z", 0.0)


class Threads(Case):
    def test_two_simulations_in_two_threads_count_their_steps(self) -> None:
        with opened(results="one") as one, opened(results="other") as other:
            self.in_threads([lambda: [one.step(30) for _ in range(5)], lambda: [other.step(20) for _ in range(5)]])
            self.assertEqual((one.step_number, other.step_number), (150, 100))

    def test_two_threads_of_one_simulation_run_alternately(self) -> None:
        with opened(results="driven") as run:
            places = []
            self.in_threads([lambda: run.step(60), lambda: run.step(40),
                             lambda: [places.append(run.wheels["wheel"].position[2]) for _ in range(50)]])
            self.assertEqual((run.step_number, len(places)), (100, 50))
        run = opened(results="closed")
        self.in_threads([lambda: run.run(), run.close])
        self.assertRaisesRegex(furrow.Error, "the simulation is closed", run.step, 1)

    def in_threads(self, actions: list[Callable[[], object]]) -> None:
        failures: list[BaseException] = []

        def guarded(action: Callable[[], object]) -> None:
            try:
                action()
            except BaseException as failure:
                if "the simulation is closed" not in str(failure):  # by another thread
                    failures.append(failure)

        threads = [threading.Thread(target=guarded, args=(action,), daemon=True) for action in actions]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join(60.0)
            self.assertFalse(thread.is_alive())
        self.assertEqual(failures, [])


class ScriptBoundary(Case):
    def test_quit_ends_the_script_alone(self) -> None:
        lines = [*SCENE.read_text(encoding="utf-8").splitlines(), "quit", "print never"]
        with furrow.Simulation(lines, variables={"here": HERE, "results": "quit", "last": 20}) as run:
            self.assertEqual(run.run(), 20)
            self.assertTrue(run.ended)

    def test_checkpoints_replace_files_only(self) -> None:
        with opened(results="driven") as run:
            run.step(5)
            os.mkfifo("pipe")
            for path, fault in (("pipe", "is a device or a pipe"), ("/dev/null", "is a device or a pipe"), (".", "is a folder"),
                                ("missing/file", "lies in a folder that does not exist"), ("a\0b", "has a zero byte in its name")):
                self.assertRaisesRegex(furrow.Error, fault, run.write_checkpoint, path)
            self.assertFalse(Path("missing").exists() or Path("a").exists())
            self.assertTrue(Path("pipe").is_fifo())
            run.write_checkpoint("file")

    def test_targets_set_by_python_give_the_warnings_of_a_script(self) -> None:
        with opened(results="driven") as run:
            run.step(5)
            with self.assertWarnsRegex(UserWarning, "speed' is 7 m/s, and 'wheel' usually has at most"):
                run.rigs["rig"].set(speed=7)
            self.assertRaisesRegex(furrow.Error, "speed' is 1000 m/s", run.rigs["rig"].set, speed=1000)
            self.assertEqual(run.rigs["rig"].targets["speed"], 7)

    def test_suspended_wheel_continues_with_the_targets_of_python(self) -> None:
        lines = SCENE.read_text(encoding="utf-8").replace(
            "ground_level 0.12", "ground_level 0.12 suspension_stiffness 2e4 suspension_damping 200").splitlines()
        variables = {"here": HERE, "results": "whole"}
        with furrow.Simulation(lines, variables=variables) as run:
            run.step(260)
            run.rigs["rig"].set(load_force=120, slip=0.25)
            run.step(50)
            run.write_checkpoint("state")
            run.step(100)
            expected = run.wheels["wheel"].position
        with furrow.Simulation(lines, variables={**variables, "begin": "read_restart state"}) as run:
            self.assertEqual((run.rigs["rig"].targets["load_force"], run.rigs["rig"].targets["slip"]), (120, 0.25))
            run.step(100)
            np.testing.assert_array_equal(run.wheels["wheel"].position, expected)
            run.run()
            self.assertTrue(any("targets of the rig changed" in text for text in run.summary()["warnings"]))

    def test_coordinate_that_a_rig_or_a_hold_takes_is_refused(self) -> None:
        rig = "mode slip slip ${slip}"
        whole = SCENE.read_text(encoding="utf-8").replace("symmetry yes ", "")
        for words, coordinate in (("lateral free", "y"), ("slip_angle_ramp 0 0 1 5", "yaw")):
            lines = whole.replace(rig, f"{rig} {words}").splitlines()
            with furrow.Simulation(lines, variables={"here": HERE, "results": coordinate}) as run:
                wheel = run.wheels["wheel"]
                for command in (lambda: wheel.prescribe(coordinate, 0.1), lambda: wheel.hold(coordinate), lambda: wheel.release(coordinate)):
                    self.assertRaisesRegex(furrow.Error, f"fix rig sets {coordinate} in every step", command)
        lines = [line for line in whole.replace("&\n", "").splitlines() if not line.startswith(("fix             rig", "fix             out"))]
        with furrow.Simulation(lines, variables={"here": HERE, "results": "free"}) as run:
            wheel = run.wheels["wheel"]
            with self.assertRaisesRegex(furrow.Error, "a load along z has no effect, because z is held; call release\\('z'\\)"):
                wheel.load = (0.0, 0.0, -50.0)
            wheel.prescribe("spin", 1.0)
            with self.assertRaisesRegex(furrow.Error, "an axle torque has no effect, because spin is prescribed"):
                wheel.set_axle_torque(3.0)


class Arrays(Case):
    def test_arrays_are_read_only_views(self) -> None:
        with opened(results="driven") as run:
            wheel, soil = run.wheels["wheel"], run.terrains["soil"]
            nodes, forces = wheel.nodes, wheel.forces
            self.assertEqual(nodes.__array_interface__["data"], wheel.nodes.__array_interface__["data"])
            self.assertEqual(run.bodies["wheel"].nodes.ctypes.data, nodes.ctypes.data)
            before = nodes.copy()
            run.step(300)
            self.assertGreater(np.abs(nodes - before).max(), 1e-3)  # the array of before the steps
            np.testing.assert_allclose(forces[:, 2].sum(), wheel.force[2], rtol=1e-9)
            self.assertLess(wheel.triangles.max(), len(nodes))
            with self.assertRaises(ValueError):
                nodes[0, 0] = 1.0
            (snow,) = soil.particles()
            self.assertEqual(snow["velocity"].base is None, False)
            self.assertEqual(snow["z"].ctypes.data, soil.particles()[0]["z"].ctypes.data)
            self.assertEqual(snow["velocity"].shape, (len(snow["x"]), 3))
            self.assertLess(snow["z"].max(), 0.13)
            self.assertLess(snow["stress_zz"].min(), 0.0)
            kept = nodes
        with opened(results="driven") as again:  # the folder of a closed simulation is free
            again.step(1)
        self.assertTrue(np.isfinite(kept).all())  # as long as an array lives, its memory does
        for use in (lambda: wheel.position, run.step, run.run, lambda: run.time, lambda: run.step_number,
                    lambda: run.bodies, lambda: run.grains, lambda: run.folders, run.summary, lambda: run.outputs("soil"),
                    lambda: run.variable("slip"), lambda: run.write_checkpoint("late")):
            self.assertRaisesRegex(furrow.Error, "the simulation is closed; open it again", use)
        self.assertTrue(run.ended)
        run.end()
        run.close()

    def test_hub_equals_that_of_the_history(self) -> None:
        with opened(results="driven") as run:
            run.step(300)
            wheel, row = run.wheels["wheel"], run.rigs["rig"].measure()
            channels = ("x", "y", "z", "spin_angle")
            self.assertEqual(wheel.position[:4], [row[name] for name in channels])
            channels = tuple(f"{kind}_{axis}" for kind in ("force", "moment") for axis in "xyz")
            self.assertEqual(wheel.force, [row[name] for name in channels])
            self.assertEqual((wheel.radius, wheel.mass), (0.15, 5.0))
            self.assertEqual(run.variable("slip"), "0.1")
            self.assertIsNone(run.variable("absent"))
            self.assertEqual(run.folders, {"out": "driven"})
            soil = run.outputs("soil")
            self.assertEqual(soil["particles"], len(run.terrains["soil"].particles()[0]["x"]))
            self.assertGreater(soil["kinetic_energy"], 0.0)


    def test_height_field_is_a_terrain(self) -> None:
        with opened(SCENES / "wheel_on_scm.lig", results="field", distance=0.1) as run:
            soil = run.terrains["soil"]
            before = soil.nodes.copy()
            self.assertEqual((soil.level, soil.particles(), before[:, 2].max()), (0.0, [], 0.0))
            run.step(1000)
            self.assertEqual(soil.nodes[:, 2].min(), -run.outputs("soil")["deepest"])
            self.assertEqual(len(soil.forces), len(before))
            self.assertLess(soil.triangles.max(), len(before))


class Checkpoints(Case):
    def test_run_continues_from_checkpoints_of_script_and_python(self) -> None:
        executable(SCENE, here=HERE, results="alone")
        with opened(results="driven") as run:
            run.step(350)
        with opened(results="driven", begin="read_restart driven/checkpoint.300") as run:
            run.step(1)
            self.assertEqual(run.step_number, 301)
            run.run()
        self.assert_same("alone", "driven")
        with opened(results="driven") as run:
            self.assertRaisesRegex(furrow.Error, "needs a run that has begun", run.write_checkpoint, "own")
            run.step(350)
            run.write_checkpoint("own")
        with opened(results="driven", begin="read_restart own") as run:
            run.run()
        self.assert_same("alone", "driven")


class Errors(Case):
    def test_error_equals_that_of_the_executable_and_python_continues(self) -> None:
        for old, new in (("load_force 100", "lode_force 100"), ("fix             touch", "fixx            touch"),
                         ("${last} upto", "20\nunfix absent")):
            script = self.folder / "wrong.lig"
            script.write_text(SCENE.read_text(encoding="utf-8").replace(old, new), encoding="utf-8")
            variables = {"here": HERE, "results": "alone"}
            printed = executable(script, fails=True, **variables)
            with self.assertRaises(furrow.Error) as caught:
                with furrow.Simulation(script, variables={**variables, "results": "driven"}) as run:
                    run.run()
            text = str(caught.exception).replace("driven", "alone")
            self.assertIn(f"ERROR: {text}", printed)
            self.assertIn("wrong.lig, line", text)
        executable(SCENE, here=HERE, results="whole")
        with opened(results="driven") as run:  # also in the folder of runs that failed
            run.run()
        self.assert_same("whole", "driven")

    def test_warnings_are_python_warnings(self) -> None:
        """The run ends before the wheel has its speed, and the cells are coarse."""
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            with opened(results="short", last=4) as run:
                run.run()
        texts = [str(each.message) for each in caught]
        self.assertTrue(any("'wheel' has its speed from 0.05 s on" in text for text in texts), texts)
        self.assertEqual({each.category for each in caught}, {UserWarning})
        self.assertEqual(caught[0].filename, __file__)

    def test_wrong_arguments_are_refused(self) -> None:
        self.assertRaisesRegex(furrow.Error, "script 'absent.lig' cannot be read", furrow.Simulation, "absent.lig")
        self.assertRaisesRegex(furrow.Error, "has a variable 'slipp' that no line", opened, slipp=0.1)
        with opened(results="driven") as run:
            self.assertRaisesRegex(furrow.Error, "no fix of Furrow has the id 'absent'", run.outputs, "absent")
            self.assertRaisesRegex(furrow.Error, "steps is negative", run.step, -1)

    def test_error_in_a_step_ends_the_simulation(self) -> None:
        with opened(results="driven") as run:
            run.step(300)
            run.rigs["rig"].set(load_force=1e6)
            self.assertRaises(furrow.Error, run.run)
            self.assertTrue(run.ended)
            self.assertEqual(run.step(), 0)
        self.assertTrue((self.folder / "driven" / "history.h5").exists())


RANKS = """
from mpi4py import MPI
import furrow, sys
with furrow.Simulation(sys.argv[1], variables={"here": sys.argv[2], "results": "driven"}) as run:
    assert MPI.COMM_WORLD.size == 2
    run.step(300)
    run.rigs["rig"].set(slip=0.1)
    mine = sum(len(material["x"]) for material in run.terrains["soil"].particles())
    both = MPI.COMM_WORLD.allgather(mine)
    assert min(both) > 0, both
    forces = MPI.COMM_WORLD.allgather(run.wheels["wheel"].force)
    assert forces[0] == forces[1], forces
    run.run()
try:
    furrow.Simulation(["nonsense line"])
except furrow.Error as error:
    assert "Unknown command" in str(error) and "line 1: nonsense line" in str(error), str(error)
else:
    raise SystemExit("no error")
sys.stdout.write(f"rank {MPI.COMM_WORLD.rank} of {MPI.COMM_WORLD.size}\\n")  # print mixes ranks
"""


class Ranks(Case):
    def test_results_on_two_ranks_equal_those_of_one(self) -> None:
        two = (*LAUNCH, "2")
        executable(SCENE, launch=two, here=HERE, results="alone")
        (self.folder / "driver.py").write_text(RANKS, encoding="utf-8")
        printed = output([*two, sys.executable, "driver.py", SCENE, HERE], self.folder)
        self.assertIn("rank 1 of 2", printed)
        self.assert_same("alone", "driven")


if __name__ == "__main__":
    PROGRAM, LAUNCH = sys.argv[1], sys.argv[2:4]
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]], verbosity=2)
