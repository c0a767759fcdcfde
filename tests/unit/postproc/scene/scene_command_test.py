# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post run with a program that stands for furrow: folders, records, signals, messages."""

import json
import os
import re
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path
from unittest import mock

from furrow_post.scene.one import ranks_remark
from support.command import FURROW_POST, SOURCE, run_post
from support.fake import ANSWER
from support.folder import FolderTest

# Reports how it was started; waits for a file "go", and ends with a checkpoint when it gets a signal
PROGRAM = """#!{python}
{answer}
import pathlib, signal, time
words = sys.argv[1:]
v = dict(zip(*[iter(w for i, w in enumerate(words) if "-var" in words[max(i - 2, 0):i])] * 2))
def stop(number, frame):
    particles = pathlib.Path("restart_forced_liggghts_7.data.particles")
    particles.mkdir()
    (particles / str(os.getpid())).write_text("particles")
    pathlib.Path("restart_forced_liggghts_7.data").write_text("checkpoint")
    sys.exit(128 + number)
for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
    signal.signal(number, stop)
print("started with", words, "in", os.getcwd(), flush=True)
print("[run] begins", os.getpid(), flush=True)
if v.get("wait"):
    while True:
        time.sleep(0.05)
if v.get("fail"):
    print("ERROR: " + v["fail"])
    sys.exit(1)
"""
SCRIPT = """# mine: a script
# Quick:    -v speed 3
variable results index results/mine
variable speed index 1
variable wait index ""
variable fail index ""
print "${results} ${speed} ${wait} ${fail}"
"""


class CommandTest(FolderTest):
    def setUp(self) -> None:
        super().setUp()
        program = self.folder / "build" / "bin" / "furrow"
        program.parent.mkdir(parents=True)
        program.write_text(PROGRAM.format(python=sys.executable, answer=ANSWER))
        program.chmod(0o755)
        self.environment = {**os.environ, "FURROW_BUILD": str(self.folder / "build")}
        self.script("mine.lig", SCRIPT)

    def script(self, name: str, text: str) -> None:
        (self.folder / name).write_text(text)

    def command(self, *words: str) -> list[str]:
        return [sys.executable, str(FURROW_POST), "run", *words]

    def run_it(self, *words: str) -> "subprocess.CompletedProcess[str]":
        with mock.patch.dict(os.environ, self.environment):
            return run_post("run", *words, folder=self.folder)

    def started(self, results: str = "out") -> str:
        return (self.folder / results / "screen.txt").read_text().splitlines()[0]

    def test_run_is_recorded_with_its_cost(self) -> None:
        done = self.run_it("mine.lig", "-o", "out", "-v", "speed", "2")
        self.assertEqual(done.returncode, 0, done.stderr)
        record = json.loads((self.folder / "out" / "run.json").read_text())
        self.assertEqual((record["ranks"], record["words"]), (1, "mine.lig -v speed 2"))
        self.assertGreater(record["wall_time"], 0)
        self.assertIn("'speed', '2'", self.started())
        self.assertIn(f"in {self.folder.resolve()}", self.started())
        self.assertIn("[run] begins", done.stdout)
        self.assertNotIn("started with", done.stdout)

    def test_script_name_with_a_backslash_is_run(self) -> None:
        self.script("a\\b.lig", SCRIPT)
        done = self.run_it("a\\b.lig", "-o", "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        record = json.loads((self.folder / "out" / "run.json").read_text())
        self.assertEqual(record["words"], "'a\\b.lig'")

    def test_folder_with_blanks_is_the_place_of_the_run(self) -> None:
        done = self.run_it("mine.lig", "-o", "a folder")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("'results', '.'", self.started("a folder"))

    def test_command_line_has_priority_over_quick(self) -> None:
        self.run_it("mine.lig", "--quick", "-o", "out")
        self.assertIn("'speed', '3'", self.started())
        self.run_it("mine.lig", "--quick", "-o", "out", "-v", "speed", "5")
        self.assertIn("'speed', '5'", self.started())
        self.assertNotIn("'speed', '3'", self.started())

    def test_incomplete_quick_lines_are_refused(self) -> None:
        for line in ("-v speed", "-v", "speed 3", "-v speed 3 -v", "-v speed 3 4", "-x speed 3", ""):
            with self.subTest(line=line):
                self.script("bad.lig", SCRIPT.replace("-v speed 3", line))
                done = self.run_it("bad.lig", "--quick", "-o", "out")
                self.assertEqual(done.returncode, 2)
                self.assertIn("write '# Quick: -v NAME VALUE", done.stderr)

    def test_failed_run_shows_its_error_and_status(self) -> None:
        done = self.run_it("mine.lig", "-o", "out", "-v", "fail", "broken")
        self.assertEqual(done.returncode, 1)
        self.assertIn("ERROR: broken", done.stderr)
        self.assertFalse((self.folder / "out" / "run.json").exists())

    def test_programs_of_the_project_are_built(self) -> None:
        listed = (SOURCE / "src" / "programs" / "CMakeLists.txt").read_text(encoding="utf-8")
        targets = re.findall(r"^furrow_program\((\w+) ", listed, re.MULTILINE)
        self.assertGreater(len(targets), 3)
        built = re.search(r"build_furrow OFF (.*)", (SOURCE / "inputs" / "run").read_text(encoding="utf-8"))
        assert built
        self.assertEqual(set(built[1].split()), {"furrow_executable", *targets})

    def test_signals_end_the_run_with_a_checkpoint_and_a_status(self) -> None:
        for number, status in ((signal.SIGTERM, 143), (signal.SIGINT, 130), (signal.SIGHUP, 129)):
            with self.subTest(signal=number):
                begun, furrow = self.begin()
                begun.send_signal(number)
                said, errors = begun.communicate(timeout=20)
                self.assertEqual(begun.returncode, status, errors)
                self.assertIn(f"{number.name} stopped the run", errors)
                self.assertFalse(is_alive(furrow))
                checkpoint = self.folder / "out" / "checkpoint.data"
                self.assertEqual(checkpoint.read_text(), "checkpoint")
                self.assertIn("give --continue", errors)
                checkpoint.unlink()

    def test_run_continues_with_its_variables(self) -> None:
        self.script("mine.lig", SCRIPT + 'variable begin index "create_box 1 box"\n${begin}\n')
        begun, _ = self.begin()
        begun.terminate()
        begun.communicate(timeout=20)
        done = self.run_it("mine.lig", "-o", "out", "--continue", "-v", "wait", "")
        self.assertEqual(done.returncode, 0, done.stderr)
        place = self.folder.resolve() / "out" / "checkpoint.data"
        self.assertIn(f"'begin', 'read_restart {place}'", self.started())
        self.assertIn("'speed', '4'", self.started())
        self.assertTrue(json.loads((self.folder / "out" / "run.json").read_text())["continued"])

    def test_particles_stay_with_their_checkpoint(self) -> None:
        self.script("mine.lig", SCRIPT + 'variable begin index "create_box 1 box"\n${begin}\n')
        particles = self.folder / "out" / "checkpoint.data.particles"
        starts: list[list[str]] = [[], ["--continue"]]
        for words in starts:
            begun, furrow = self.begin(*words)
            begun.terminate()
            begun.communicate(timeout=20)
            self.assertEqual([file.name for file in particles.iterdir()], [str(furrow)])
        self.assertFalse(list(self.folder.glob("restart_forced*")))
        self.run_it("mine.lig", "-o", "out")
        self.assertFalse(particles.exists())

    def test_runs_that_cannot_be_continued_are_refused(self) -> None:
        self.script("other.lig", SCRIPT)
        for name, message in (("mine.lig", "has no variable 'from'"), ("other.lig", "has the results of")):
            begun, _ = self.begin()
            begun.terminate()
            begun.communicate(timeout=20)
            done = self.run_it(name, "-o", "out", "--continue")
            self.assertEqual(done.returncode, 2)
            self.assertIn(message, done.stderr)

    def test_run_that_was_killed_before_its_first_checkpoint_starts_again(self) -> None:
        begun, _ = self.begin()
        begun.terminate()
        begun.communicate(timeout=20)
        (self.folder / "out" / "checkpoint.data").unlink()
        done = self.run_it("mine.lig", "-o", "out", "--continue", "-v", "wait", "")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("stopped before its first checkpoint; it starts again", done.stdout)
        self.assertIn("'speed', '4'", self.started())
        starts = self.started()
        done = self.run_it("mine.lig", "-o", "out", "--continue")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("nothing is left to continue", done.stdout)
        self.assertEqual(self.started(), starts)

    def test_results_folder_of_a_script_without_the_variable_is_refused(self) -> None:
        self.script("fixed.lig", "# fixed: a script\nvariable speed index 1\n")
        done = self.run_it("fixed.lig", "-o", "out")
        self.assertEqual(done.returncode, 2)
        self.assertIn("has no variable 'results', so -o cannot choose the folder", done.stderr)
        self.assertFalse((self.folder / "out").exists())
        self.assertIn("results in the folder that the script names", self.run_it("fixed.lig").stdout)

    def test_too_many_ranks_give_a_remark(self) -> None:
        with mock.patch("os.sched_getaffinity", return_value={0, 1}):
            for load, words in ((0.1, "continua of more than 30,000 particles"), (1.5, "expect no gain")):
                with mock.patch("os.getloadavg", return_value=(load, 0, 0)):
                    self.assertIn(words, ranks_remark(2))
        self.assertIn("expect no gain", ranks_remark(10_000))

    def test_killed_command_leaves_no_program_behind(self) -> None:
        begun, furrow = self.begin()
        begun.kill()
        begun.communicate(timeout=20)
        until = time.monotonic() + 20
        while is_alive(furrow) and time.monotonic() < until:
            time.sleep(0.05)
        self.assertFalse(is_alive(furrow))
        self.assertTrue((self.folder / "restart_forced_liggghts_7.data").exists())

    def begin(self, *words: str) -> "tuple[subprocess.Popen[str], int]":
        """A run that waits, and the process of the program."""
        begun = subprocess.Popen(
            self.command("mine.lig", "-o", "out", "-v", "wait", "yes", "-v", "speed", "4", *words),
            cwd=self.folder,
            env=self.environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        assert begun.stdout
        for line in begun.stdout:
            if "begins" in line:
                return begun, int(line.split()[-1])
        self.fail("the run did not begin")


def is_alive(process: int) -> bool:
    try:
        state = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return False
    return state != "Z"


if __name__ == "__main__":
    unittest.main()
