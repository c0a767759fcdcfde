# SPDX-License-Identifier: GPL-2.0-or-later
"""An FMU of one wheel, through an importer: fmi_test.py <furrow-post>"""

import ctypes
import os
import shutil
import subprocess
import sys
import tempfile
import threading
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
GUIDE = ROOT / "inputs" / "guide" / "howto"
sys.path.insert(0, str(GUIDE / "fmi"))

from importer import OK, Fmu, FmuError, Instance
from importer3 import Fmu3, Instance3

SCRIPT = GUIDE / "vehicle" / "wheel.lig"
SAND = Path(__file__).resolve().with_name("wheel_on_sand.lig")
POST = ""
STEP, BEGIN, SPEED = 4e-3, (0.0, 0.0, 0.351), (0.5, 0.1, -0.1)
OUTPUTS = ("force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z", "hub_z", "hub_spin_rate")

# The same motion with the Python module, in another process
REFERENCE = f"""
import sys, furrow
with furrow.Simulation(sys.argv[1], variables={{"cell": 0.04, "z": 0.351}}) as run:
    hub = run.wheels["wheel"]
    for k in range(100):
        for i, name in enumerate(("x", "y", "z")):
            target = {BEGIN}[i] + {SPEED}[i] * (k * {STEP}) + 4 * 1e-3 * {SPEED}[i]
            hub.prescribe(name, (target - hub.position[i]) / (4 * 1e-3))
        for name in ("yaw", "camber"):
            hub.prescribe(name, 0.0)
        hub.release("spin")
        hub.set_axle_torque(20.0)
        run.step(4)
        print(*(value.hex() for value in (*hub.force, hub.position[2], hub.velocity[3])))
"""


def exported(folder: Path, script: Path = SCRIPT, fmi: int = 2) -> Path:
    target = folder / f"{script.stem}.fmu"
    command = [sys.executable, POST, "fmu", str(script), "-o", str(target), "--fmi", str(fmi)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return target


def made(folder: Path, script: Path = SCRIPT) -> Fmu:
    return Fmu(exported(folder, script))


def advance(wheel: Instance, begin: int, end: int) -> list[list[str]]:
    """Steps with the motion of the reference. @return the outputs of each"""
    rows = []
    for k in range(begin, end):
        for name, start, speed in zip("xyz", BEGIN, SPEED):
            wheel.set({f"position_{name}": start + speed * (k * STEP), f"velocity_{name}": speed})
        wheel.set({"spin_torque": 20.0})
        wheel.step(k * STEP, STEP)
        rows.append([wheel.get(name).hex() for name in OUTPUTS])
    return rows


class Case(unittest.TestCase):
    folder: Path
    fmu: Fmu

    @classmethod
    def setUpClass(cls) -> None:
        if cls.__base__ is Case and not hasattr(Case, "fmu"):
            Case.folder = Path(tempfile.mkdtemp())
            unittest.addModuleCleanup(shutil.rmtree, Case.folder)
            Case.fmu = made(Case.folder)

    def instance(self, fmu: Fmu | None = None) -> Instance:
        wheel = Instance(fmu or self.fmu)
        self.addCleanup(wheel.free)
        return wheel

    def opened(self, script: str = "wheel.lig", **parameters: str) -> Instance:
        wheel = self.instance()
        given = {"cell": "0.04", "z": "0.351", **parameters}
        wheel.initialize({"script": script, **{f"variables.{name}": value for name, value in given.items()}})
        return wheel

    def changed(self, old: str, new: str) -> str:
        """Path of another script."""
        text = SCRIPT.read_text(encoding="utf-8")
        self.assertIn(old, text)
        script = self.folder / "changed.lig"
        script.write_text(text.replace(old, new), encoding="utf-8")
        return str(script)


class Results(Case):
    def test_results_equal_those_of_the_python_module(self) -> None:
        command = [sys.executable, "-c", REFERENCE, str(SCRIPT)]
        done = subprocess.run(command, check=True, text=True, capture_output=True)
        expected = [line.split() for line in done.stdout.splitlines()]
        self.assertEqual(advance(self.opened(), 0, 100), expected)
        self.assertGreater(float.fromhex(expected[-1][2]), 1000.0)

    def test_instances_advance_alternately(self) -> None:
        alone = advance(self.opened(), 0, 60)
        one, other = self.opened(), self.opened(cell="0.03")
        rows = []
        for k in range(60):
            rows += advance(one, k, k + 1)
            advance(other, k, k + 1)
        self.assertEqual(rows, alone)

    def test_copies_of_the_library_advance_alternately(self) -> None:
        alone = advance(self.opened(), 0, 30)
        copy = made(self.folder)
        self.assertNotEqual(copy.folder.name, self.fmu.folder.name)
        other, one = self.instance(copy), self.opened()
        other.initialize({"variables.cell": "0.04", "variables.z": "0.351"})
        for k in range(30):
            for wheel in (one, other):
                self.assertEqual(advance(wheel, k, k + 1), [alone[k]])
        self.assertRaisesRegex(FmuError, "time step of 0.001 s", other.step, 30 * STEP, 1e-5)

    def test_reset_restores_parameters(self) -> None:
        wheel = self.opened()
        first = advance(wheel, 0, 30)
        wheel.call("fmi2Reset")
        wheel.initialize({"variables.cell": "0.04", "variables.z": "0.351"})
        self.assertEqual(advance(wheel, 0, 30), first)
        by_load = self.instance()
        by_load.initialize({"height_by_load": True, "spin_by_torque": False, "variables.z": "0.351"})
        by_load.set({"load": 800.0, "spin_rate": 0.5})
        forces = []
        for k in range(1000):
            by_load.step(k * 1e-3, 1e-3)
            forces.append(by_load.get("force_z"))
        gained = 35.0 * by_load.get("hub_velocity_z")  # momentum
        self.assertAlmostEqual(sum(forces) * 1e-3, 800.0 + gained, delta=2.0)
        self.assertEqual(by_load.get("hub_spin_rate"), 0.5)

    def test_warnings_go_to_the_logger_once(self) -> None:
        wheel = self.opened(cell="0.07")
        advance(wheel, 0, 1)
        state = wheel.get_state()
        wheel.set_state(state)
        advance(wheel, 1, 2)
        wheel.free_state(state)
        found = [text for text in wheel.messages if "3.6 cells across 'wheel'" in text]
        self.assertEqual(len(found), 1, wheel.messages)

    def test_unset_inputs_follow_script_and_rates(self) -> None:
        wheel = self.opened()
        self.assertEqual(wheel.get("position_z"), 0.351)
        wheel.set({"velocity_x": 0.5, "load": 800.0})
        for k in range(10):
            wheel.step(k * STEP, STEP)
        self.assertAlmostEqual(wheel.get("position_x"), 0.5 * 10 * STEP, 12)
        self.assertEqual(wheel.get("hub_z"), 0.351)
        self.assertEqual(sum("load has no effect: it needs the parameter height_by_load" in text for text in wheel.messages), 1)

    def test_variables_have_units_and_references(self) -> None:
        units = {unit.attrib["name"] for unit in self.fmu.description.iter("Unit")}
        seen = set()
        for name, variable in self.fmu.variables.items():
            (value,) = list(variable)
            key = (value.tag, variable.attrib["valueReference"])
            self.assertNotIn(key, seen)
            seen.add(key)
            if value.tag == "Real":
                self.assertIn(value.attrib["unit"], units, name)
        index = list(self.fmu.variables)
        outputs = [index[int(u.attrib["index"]) - 1] for u in self.fmu.description.find("ModelStructure/Outputs")]
        self.assertEqual(outputs, [n for n, v in self.fmu.variables.items() if v.attrib["causality"] == "output"])


class Version3(Case):
    def test_results_states_and_refusals_equal_those_of_fmi_2(self) -> None:
        expected = advance(self.opened(), 0, 40)
        fmu = Fmu3(exported(self.folder, fmi=3))
        references = [variable.attrib["valueReference"] for variable in fmu.variables.values()]
        self.assertEqual(len(set(references)), len(references))
        self.assertEqual(set(fmu.variables), set(self.fmu.variables))
        self.assertRaisesRegex(FmuError, "the GUID is 'other'; allowed", Instance3, fmu, token="other")
        wheel = Instance3(fmu)
        self.addCleanup(wheel.free)
        self.assertIs(wheel.get("spin_by_torque"), True)
        wheel.initialize({"spin_by_torque": True, "variables.cell": "0.04", "variables.z": "0.351"})
        self.assertEqual(advance(wheel, 0, 20), expected[:20])
        state = wheel.deserialize(wheel.serialize(wheel.get_state()))
        self.assertEqual(advance(wheel, 20, 40), expected[20:])
        wheel.set_state(state)
        self.assertEqual(advance(wheel, 20, 40), expected[20:])
        wheel.free_state(state)
        self.assertEqual(([flag.value for flag in wheel.flags], round(wheel.last.value, 9)), ([False] * 3, 40 * STEP))
        self.assertRaisesRegex(FmuError, "communicationStepSize is 1e-05 s", wheel.step, 40 * STEP, 1e-5)
        with self.assertRaisesRegex(FmuError, "fmi3GetClock: this FMU does not have the function"):
            wheel.call("fmi3GetClock")


class States(Case):
    def test_steps_repeat_from_a_state(self) -> None:
        wheel = self.opened()
        fresh = wheel.get_state()
        first = advance(wheel, 0, 50)
        middle = wheel.get_state()
        rest = advance(wheel, 50, 80)
        wheel.set_state(middle)
        self.assertEqual([wheel.get(name).hex() for name in OUTPUTS], first[-1])
        self.assertEqual(advance(wheel, 50, 80), rest)
        wheel.set_state(fresh)
        self.assertEqual(advance(wheel, 0, 50), first)
        data = wheel.serialize(middle)
        other = self.opened()
        loaded = other.deserialize(data)
        other.set_state(loaded)
        again = other.get_state()  # before a further step
        self.assertEqual(advance(other, 50, 80), rest)
        other.set_state(again)
        self.assertEqual(advance(other, 50, 80), rest)
        for state in (fresh, middle, loaded, again):
            wheel.free_state(state)
            self.assertIsNone(state.value)
        for damaged in (data[:100], data[:200] + b"x" + data[201:], b""):
            with self.assertRaisesRegex(FmuError, "DeSerializeFMUstate: the bytes are no state of this FMU, or are damaged"):
                wheel.deserialize(damaged)

    def test_instances_in_two_threads_run_alternately(self) -> None:
        expected = advance(self.opened(), 0, 20)
        wheels, rows = [self.opened(), self.opened()], [[], []]
        threads = [threading.Thread(target=lambda i=i: rows[i].extend(advance(wheels[i], 0, 20)), daemon=True) for i in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join(60.0)
            self.assertFalse(thread.is_alive())
        self.assertEqual(rows, [expected, expected])

    def test_steps_on_a_continuum_repeat_from_a_state(self) -> None:
        wheel = self.opened(snow="1", here=str(SCRIPT.parent), step="2e-4")
        advance(wheel, 0, 3)
        state = wheel.get_state()
        rest = advance(wheel, 3, 5)
        wheel.set_state(state)
        self.assertEqual(advance(wheel, 3, 5), rest)
        self.assertGreater(float.fromhex(rest[-1][2]), 10.0)  # N: the wheel is in contact
        wheel.free_state(state)

    def test_script_without_begin_has_no_states(self) -> None:
        fmu = made(self.folder, Path(self.changed("variable        begin index", "variable begin string")))
        self.assertEqual(fmu.flags["canGetAndSetFMUstate"], "false")
        with self.assertRaisesRegex(FmuError, "GetFMUstate: the script has no variable 'begin' or 'from'"):
            self.instance(fmu).get_state()


class StatesOfGrains(Case):
    """The bed slides over its periodic boundary, so that grains are outside of it between new neighbour lists."""

    fmu: Fmu

    @classmethod
    def setUpClass(cls) -> None:
        super().setUpClass()
        os.environ["FURROW_CACHE"] = str(Case.folder / "cache")
        cls.fmu = made(Case.folder, SAND)

    def on_sand(self) -> Instance:
        wheel = self.instance(self.fmu)
        wheel.initialize({"variables.here": str(SAND.parent)})
        return wheel

    @staticmethod
    def press(wheel: Instance, begin: int, end: int) -> list[list[float]]:
        rows = []
        for k in range(begin, end):
            wheel.set({"position_z": 0.108 - 0.4 * (k * 1e-3), "velocity_z": -0.4, "spin_torque": 0.2})
            wheel.step(k * 1e-3, 1e-3)
            rows.append([wheel.get(name) for name in OUTPUTS])
        return rows

    def test_several_states_repeat_their_steps(self) -> None:
        alone = self.press(self.on_sand(), 0, 24)
        wheel = self.on_sand()
        states, rows = {0: wheel.get_state()}, self.press(wheel, 0, 9)
        self.assertEqual(rows, alone[:9])
        for k, end in ((9, 10), (10, 18), (18, 24)):
            states[k] = wheel.get_state()
            rows += self.press(wheel, k, end)
        self.assertGreater(rows[9][2], 8.0)
        # a state makes neighbour lists: afterwards, sums differ by rounding from those without states
        for row, expected in zip(rows[9:11], alone[9:11]):
            for value, of_alone in zip(row, expected):
                self.assertAlmostEqual(value, of_alone, delta=1e-6 * expected[2])
        for k, end in ((10, 18), (0, 9), (18, 24), (9, 10), (10, 18)):
            wheel.set_state(states[k])
            self.assertEqual(self.press(wheel, k, end), rows[k:end])
        other = self.on_sand()
        loaded = other.deserialize(wheel.serialize(states[18]))
        other.set_state(loaded)
        self.assertEqual([other.get(name) for name in OUTPUTS], rows[17])
        again = other.get_state()  # before a further step
        self.assertEqual(self.press(other, 18, 24), rows[18:])
        other.set_state(again)
        self.assertEqual(self.press(other, 18, 24), rows[18:])
        for state in (*states.values(), loaded, again):
            wheel.free_state(state)


class Refusals(Case):
    def refused(self, text: str, wheel: Instance, function: str, *arguments: object) -> None:
        self.assertRaisesRegex(FmuError, text, getattr(wheel, function), *arguments)

    def test_wrong_sequences_are_refused(self) -> None:
        wheel = self.instance()
        self.refused("DoStep: the call is not allowed before initialization", wheel, "step", 0.0, STEP)
        self.refused("GetReal: the call is not allowed before initialization", wheel, "get", "force_x")
        wheel.call("fmi2EnterInitializationMode")
        self.refused("DoStep: the call is not allowed in initialization mode", wheel, "step", 0.0, STEP)
        self.assertEqual(wheel.get("force_z"), 0.0)
        self.refused("parameter 'cell' is set after outputs were read", wheel, "set", {"variables.cell": "1"})
        wheel.call("fmi2ExitInitializationMode")
        self.refused("EnterInitializationMode: .* not allowed between steps", wheel, "call", "fmi2EnterInitializationMode")
        wheel.call("fmi2Terminate")
        self.refused("DoStep: the call is not allowed after Terminate", wheel, "step", 0.0, STEP)

    def test_wrong_values_are_refused(self) -> None:
        wheel = self.opened()
        self.refused("SetReal: force_x is an output; allowed: inputs", wheel, "set", {"force_x": 1.0})
        self.refused("communicationStepSize is 0.0015 s; allowed: multiples of .* time step of 0.001 s", wheel, "step", 0.0, 1.5e-3)
        self.refused("currentCommunicationPoint is 1 s; allowed: 0 s", wheel, "step", 1.0, STEP)
        wheel.set({"position_z": 0.0})
        self.refused("position_z is 0 in the first step, .* wheel at 0.351; .* give the place", wheel, "step", 0.0, STEP)
        wheel.set({"position_z": 0.351, "spin_torque": float("nan")})
        self.refused("spin_torque is not finite", wheel, "step", 0.0, STEP)
        wheel.set({"spin_torque": 1e30})
        self.refused("spin_torque is 1e\\+30 N m; allowed: .* check the unit", wheel, "step", 0.0, STEP)
        self.refused("communicationStepSize is inf s", wheel, "step", 0.0, float("inf"))
        by_load = self.instance()
        by_load.initialize({"script": "wheel.lig", "height_by_load": True, "variables.cell": "0.04", "variables.z": "0.351"})
        by_load.set({"load": 1e30})
        self.refused("load is 1e\\+30 N; allowed: ", by_load, "step", 0.0, STEP)
        unknown = (ctypes.c_uint * 1)(99)
        self.refused("value reference 99 is no Real", wheel, "call", "fmi2GetReal", unknown, 1, (ctypes.c_double * 1)())
        wheel.set({"spin_torque": 0.0})
        wheel.step(0.0, STEP)  # refusals have moved nothing

    def test_wrong_script_and_guid_are_refused(self) -> None:
        with self.assertRaisesRegex(FmuError, r"the GUID is '\{0\}'; allowed: '\{.*\}'; take modelDescription.xml"):
            Instance(self.fmu, guid="{0}")
        wheel = self.instance()
        wheel.set({"script": "absent.lig"})
        wheel.call("fmi2EnterInitializationMode")
        self.refused("script '.*absent.lig' cannot be read", wheel, "call", "fmi2ExitInitializationMode")
        rig = "fix rig all wheel/rig wheel wheel load_force 9 mode towed speed 1 settle_time 1 accelerate_time 1 ground_level 0"
        for old, new, text in (
            ("mass ${mass}", "mas ${mass}", "fix wheel/rigid.*'mas'(.|\n)*changed.lig, line"),
            ("fix             wheel all", "run 1 #", "has 0 wheels; allowed: one wheel or tyre"),
            ("# as long", rig + "\n#", "has a fix wheel/rig; allowed: a wheel without a rig"),
        ):
            wheel = self.instance()
            wheel.set({"script": self.changed(old, new)})
            wheel.call("fmi2EnterInitializationMode")
            self.refused(text, wheel, "call", "fmi2ExitInitializationMode")

    def test_end_of_the_script_discards_the_step(self) -> None:
        wheel = self.opened(self.changed("1000000000", "10"))
        advance(wheel, 0, 2)
        self.refused("the script ended at 0.01 s; give its command run more steps", wheel, "step", 2 * STEP, STEP)
        ended, time = ctypes.c_int(), ctypes.c_double()
        self.assertEqual(wheel.status("fmi2GetBooleanStatus", 3, ctypes.byref(ended)), OK)
        self.assertEqual(wheel.status("fmi2GetRealStatus", 2, ctypes.byref(time)), OK)
        self.assertEqual((ended.value, round(time.value, 9)), (1, 0.01))
        state = wheel.deserialize(wheel.serialize(wheel.get_state()))
        last = wheel.get("force_z")
        other = self.opened(self.changed("1000000000", "10"))
        other.set_state(state)
        self.assertEqual(other.get("force_z"), last)
        self.refused("DoStep: the call is not allowed at the end of the script", other, "step", 2 * STEP, STEP)
        wheel.call("fmi2Terminate")
        self.assertGreater(wheel.get("hub_z"), 0.3)

    def test_python_module_in_the_same_process_is_refused(self) -> None:
        self.opened()
        import furrow

        with self.assertRaisesRegex(furrow.Error, "another copy of Furrow's library runs in this process"):
            furrow.Simulation(SCRIPT)


if __name__ == "__main__":
    POST = sys.argv.pop(1)
    unittest.main(verbosity=2)
