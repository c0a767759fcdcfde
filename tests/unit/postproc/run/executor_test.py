# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs by a fake program: made once, failures kept apart, interruptions forgotten."""

import fcntl
import json
import os
import signal
import threading
import time
import unittest
from dataclasses import replace
from pathlib import Path
from unittest import mock

from furrow_post.errors import ResultsError
from furrow_post.run.case import FOLDER, Case
from furrow_post.run.record import CLAIM, Record, claimed
from furrow_post.errors import Interrupted
from furrow_post.run import executor as module
from furrow_post.run.executor import Executor, Failed, State
from support.fake import FakeTree
from support.folder import FolderTest


class ExecutorTest(FolderTest):
    def setUp(self) -> None:
        super().setUp()
        self.tree = FakeTree(self.folder)
        self.results = self.folder / "results"
        self.executor = Executor(self.results, self.tree.tools)

    def record(self, case: Case) -> Record:
        run = self.executor.ended(case)
        assert run
        return run.record

    def test_finished_run_is_not_repeated(self) -> None:
        cases = [self.tree.case("a", value=2), self.tree.case("b/c")]
        self.executor.run(cases)
        self.executor.run(cases)
        self.assertEqual(sorted(self.tree.starts()), ["a", "c"])
        record = self.record(cases[0])
        self.assertEqual(record.facts, {"steps": 10.0, "value": 2.0})  # of the last line FACTS
        self.assertEqual(record.error, "")
        self.assertGreater(record.wall_time, 0.0)
        self.assertTrue((self.results / "b/c" / "run.json").is_file())

    def test_another_variable_is_another_run(self) -> None:
        self.executor.run([self.tree.case("a", value=2)])
        changed = self.tree.case("a", value=3)
        self.assertEqual(self.executor.state(changed), State.MISSING)
        self.executor.run([changed])
        record = self.record(changed)
        self.assertEqual(record.facts["value"], 3.0)

    def test_folder_in_use_is_refused(self) -> None:
        case = self.tree.case("a")
        self.executor.folder(case).mkdir(parents=True)
        handle = os.open(self.executor.folder(case), os.O_RDONLY)
        fcntl.flock(handle, fcntl.LOCK_EX)
        with mock.patch.object(module, "PATIENCE", 0.1):
            with self.assertRaisesRegex(ResultsError, "results/a: another run is writing to it"):
                self.executor.run([case])
        leaves = threading.Timer(0.5, os.close, [handle])  # one that is being stopped
        leaves.start()
        self.executor.run([case])
        self.assertEqual(self.executor.state(case), State.DONE)

    def test_two_executors_share_one_folder(self) -> None:
        """Each run is made once: the second executor waits for it and takes it."""
        cases = [self.tree.case(name, sleep=0.3) for name in ("a", "b", "c")]
        other = Executor(self.results, self.tree.tools, jobs=2)
        errors: list[BaseException] = []

        def run(executor: Executor) -> None:
            try:
                executor.run(cases)
            except BaseException as error:
                errors.append(error)

        threads = [threading.Thread(target=run, args=(r,)) for r in (self.executor, other)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(errors, [])
        self.assertEqual(sorted(self.tree.starts()), ["a", "b", "c"])
        self.assertEqual({self.executor.state(case) for case in cases}, {State.DONE})

    def test_waiting_executor_can_be_stopped(self) -> None:
        folder, stop = self.results / "a", threading.Event()
        with claimed(folder, stop):
            stop.set()
            with self.assertRaisesRegex(Interrupted, "results/a: another program is making"):
                with claimed(folder, stop):
                    self.fail("was claimed twice")
        with claimed(folder, stop):  # free again
            pass

    def test_link_at_the_name_of_the_claim_is_not_followed(self) -> None:
        folder, elsewhere = self.results / "a", self.results / "elsewhere"
        folder.mkdir(parents=True)
        (folder / CLAIM).symlink_to(elsewhere)
        with self.assertRaisesRegex(ResultsError, "a/claim: cannot be opened .*; remove it"):
            with claimed(folder, threading.Event()):
                self.fail("was claimed through a link")
        self.assertFalse(elsewhere.exists())

    def test_moved_tree_keeps_its_runs(self) -> None:
        """Paths below the project count relative to it."""
        first = self.tree.case("a", material=self.tree.root / "inputs" / "snow.yaml")
        identity = first.identity(self.tree.root)
        self.assertIn("inputs/snow.yaml", json.dumps(identity))
        self.assertNotIn(str(self.tree.root), json.dumps(identity))

    def test_failure_is_recorded_and_other_runs_continue(self) -> None:
        cases = [self.tree.case("bad", fail="it broke"), self.tree.case("good")]
        self.executor.run(cases)
        self.assertEqual([self.executor.state(c) for c in cases], [State.FAILED, State.DONE])
        failure = self.record(cases[0])
        self.assertEqual(failure.error, "ERROR: it broke (made.cpp:1)")
        self.assertFalse((self.results / "bad" / "run.json").exists())

    def test_failed_run_is_repeated_on_request_alone(self) -> None:
        case = self.tree.case("bad", fail="it broke")
        self.executor.run([case])
        self.executor.run([case])
        self.assertEqual(len(self.tree.starts()), 1)
        Executor(self.results, self.tree.tools, again=True).run([case])
        self.assertEqual(len(self.tree.starts()), 2)

    def test_run_that_succeeds_forgets_its_failure(self) -> None:
        self.executor.run([self.tree.case("a", fail="it broke")])
        self.executor.run([self.tree.case("a")])
        self.assertFalse((self.results / "a" / "failed.json").exists())
        self.assertTrue((self.results / "a" / "run.json").exists())

    def test_message_on_stderr_is_the_error_of_other_programs(self) -> None:
        case = self.tree.case("a", status=3)
        self.executor.run([case])
        failure = self.record(case)
        self.assertEqual(failure.error, f"furrow: {self.results / 'a'} is bad")

    def test_complete_list_ends_with_its_first_failure(self) -> None:
        cases = [self.tree.case("good"), self.tree.case("bad", status=3), self.tree.case("other")]
        with self.assertRaisesRegex(Failed, "results/bad failed: .*is bad; its output is in") as end:
            self.executor.completed(cases)
        self.assertEqual((self.tree.starts(), end.exception.status), (["good", "bad"], 3))
        runs = self.executor.completed([cases[0], replace(cases[1], may_fail=True)])
        self.assertEqual([bool(run.error) for run in runs], [False, True])

    def test_repeat_starts_all_runs(self) -> None:
        cases = [self.tree.case("a"), self.tree.case("b")]
        ended: list[str] = []
        for _ in range(2):
            self.executor.repeat(cases, lambda case: ended.append(case.name))
        self.assertEqual((self.tree.starts(), ended), (["a", "b"] * 2, ["a", "b"] * 2))

    def test_second_attempt_has_other_variables(self) -> None:
        """The record keeps what stopped the first attempt."""
        case = replace(self.tree.case("a", status=1), fallback={"status": 0})
        self.executor.run([case])
        record = self.record(case)
        self.assertEqual(record.stopped, (f"furrow: {self.results / 'a'} is bad",))
        self.assertEqual(record.variable("status"), "0")

    def test_failure_of_the_second_attempt_is_recorded(self) -> None:
        case = replace(self.tree.case("a", fail="it broke"), fallback={"fail": "again"})
        self.executor.run([case])
        failure = self.record(case)
        self.assertEqual(failure.stopped, ("ERROR: it broke (made.cpp:1)",))
        self.assertEqual(failure.error, "ERROR: again (made.cpp:1)")
        self.assertEqual(len(self.tree.starts()), 2)

    def test_time_limit_stops_a_run(self) -> None:
        case = replace(self.tree.case("a", sleep=30), time_limit=2.0, fallback={"sleep": 0})
        self.executor.run([case])
        failure = self.record(case)
        self.assertEqual(failure.error, "time limit of 2 s")
        self.assertEqual(len(self.tree.starts()), 1)  # no second attempt: it would take as long

    def test_interrupted_run_leaves_no_folder(self) -> None:
        for variables in ({"signal": int(signal.SIGTERM)}, {"checkpoint": 1, "status": 1}):
            case = self.tree.case("a", **variables)
            with self.assertRaisesRegex(Interrupted, "was interrupted; start again"):
                self.executor.run([case])
            self.assertEqual(self.executor.state(case), State.MISSING)
        after = self.tree.case("a")
        self.executor.run([after])  # an old checkpoint is no interruption
        self.assertEqual(self.executor.state(after), State.DONE)

    def test_finished_run_with_a_late_checkpoint_is_complete(self) -> None:
        """A run that was killed before may write its checkpoint while the next one runs."""
        case = self.tree.case("a", checkpoint=1)
        self.executor.run([case])
        self.assertEqual(self.executor.state(case), State.DONE)

    def test_crash_is_a_failure(self) -> None:
        case = self.tree.case("a", signal=int(signal.SIGSEGV))
        self.executor.run([case])
        failure = self.record(case)
        self.assertEqual(failure.error, "stopped with status -11")

    def test_shared_input_is_made_once(self) -> None:
        cases = [
            replace(self.tree.case(name), shares=key)
            for name, key in (("a1", "a"), ("a2", "a"), ("b1", "b"), ("b2", "b"))
        ]
        Executor(self.results, self.tree.tools, jobs=2).run(cases)
        starts = self.tree.starts()
        self.assertEqual((sorted(starts[:2]), sorted(starts[2:])), (["a1", "b1"], ["a2", "b2"]))

    def test_stored_run_is_valid_while_its_inputs_are_unchanged(self) -> None:
        """Each change repeats the run once: script, bed, material, base, contact, layer, mesh, and program."""
        study = self.tree.study
        texts = {
            "made.lig": "include part.lig\nvariable d index bed\nvariable m index other.yaml\nbed ${d}.lig seed 1\nrun 1\n",
            "part.lig": "fix t all terrain/continuum material ../soil.yaml\n",
            "bed.lig": "fix m all mesh/surface file wall.stl\n",
            "wall.stl": "solid\n",
            "snow.yaml": "{base: base.yaml}\n",
            "base.yaml": "{law: {density: 300}, contact: steel.yaml}\n",
            "steel.yaml": "{friction: 0.1}\n",
            "../soil.yaml": "{law: {density: 1500}}\n",
            "layer.yaml": "{law: {density: 400}}\n",
            "other.yaml": "{law: {density: 500}}\n",  # default that is replaced
        }
        for name, text in texts.items():
            (study / name).write_text(text)
        case = self.tree.case("a", m="snow.yaml:0.1,layer.yaml")
        self.executor.run([case])
        for count, (name, text) in enumerate(texts.items(), 1):
            self.assertEqual((self.executor.state(case), self.executor.outdated([case])), (State.DONE, ""), name)
            (study / name).write_text(text + "# changed\n")
            if name == "other.yaml":
                break
            self.assertEqual(self.executor.state(case), State.MISSING, name)
            self.assertRegex(self.executor.outdated([case]), f"^1 runs in .*because {Path(name).name} changed since")
            self.executor.run([case])
            self.assertEqual(len(self.tree.starts()), count + 1)
        self.assertEqual(self.executor.state(case), State.DONE)
        self.tree.install("another build")
        self.assertIn("because furrow changed since", self.executor.outdated([case]))
        self.executor.run([case])
        self.assertEqual((self.executor.state(case), len(self.tree.starts())), (State.DONE, len(texts) + 1))

    def test_run_with_inputs_changed_meanwhile_is_invalid(self) -> None:
        """The record has the files as they were when the program started."""
        case = self.tree.case("a", sleep=0.5)

        def change() -> None:
            while not self.tree.starts():
                time.sleep(0.02)
            self.tree.script.write_text("run 2\n")

        changes = threading.Thread(target=change)
        changes.start()
        self.executor.run([case])
        changes.join()
        self.assertEqual(self.executor.state(case), State.MISSING)

    def test_files_are_written_with_the_folder_of_the_run(self) -> None:
        files = {"path.yaml": f"output: {FOLDER}/x\n"}
        case = replace(self.tree.case("a"), files=files)
        self.executor.run([case])
        text = (self.results / "a" / "path.yaml").read_text()
        self.assertEqual(text, f"output: {self.results / 'a'}/x\n")

    def test_missing_program_is_reported_with_the_remedy(self) -> None:
        self.tree.program.unlink()
        with self.assertRaisesRegex(ResultsError, "there is no program .*--build"):
            self.executor.run([self.tree.case("a")])

    def test_old_evaluation_is_not_reused(self) -> None:
        folder = self.results / "a"
        folder.mkdir(parents=True)
        (folder / "facts.txt").write_text("test triaxial")
        self.executor.run([self.tree.case("a")])
        self.assertFalse((folder / "facts.txt").exists())


if __name__ == "__main__":
    unittest.main()
