# SPDX-License-Identifier: GPL-2.0-or-later
"""An array job by programs that stand for sbatch and squeue; a real Slurm: study.slurm."""

import os
import sys
import unittest
from unittest import mock

from furrow_post.errors import ResultsError
from furrow_post.run.case import Case
from furrow_post.run.executor import Executor, State
from furrow_post.run import slurm
from support.fake import FakeTree
from support.folder import FolderTest

# Starts every task at once and leaves them; the queue is empty when no task is left
SBATCH = """#!/bin/bash
[ -z "$REFUSES" ] || { echo "sbatch: error: $REFUSES" >&2; exit 1; }
script=${!#}
last=$(sed -n 's/^#SBATCH --array=0-\\([0-9]*\\).*/\\1/p' "$script")
for ((k = 0; k <= last; ++k)); do
  SLURM_ARRAY_TASK_ID=$k bash "$script" >"$(dirname "$script")/$k.txt" 2>&1 &
  echo $! >>"$(dirname "$0")/tasks"
done
echo 7
"""
SQUEUE = """#!/bin/bash
[ "$3" = 7 ] || { echo "slurm_load_jobs error: Invalid job id specified" >&2; exit 1; }
while read -r task; do ! kill -0 "$task" 2>/dev/null || echo RUNNING; done <"$(dirname "$0")/tasks"
"""


class SlurmTest(FolderTest):
    def setUp(self) -> None:
        super().setUp()
        programs = self.folder / "programs"
        programs.mkdir()
        for name, text in (("sbatch", SBATCH), ("squeue", SQUEUE)):
            (programs / name).write_text(text)
            (programs / name).chmod(0o755)
        self.path = {"PATH": f"{programs}:{os.environ['PATH']}"}
        self.tree = FakeTree(self.folder)
        self.results = self.folder / "results with blanks 100%"
        self.executor = Executor(self.results, self.tree.tools)
        for name, length in (("SETTLING", 0.2), ("LOOK_EVERY", 0.1)):
            patch = mock.patch.object(slurm, name, length)
            patch.start()
            self.addCleanup(patch.stop)

    def submitted(self, cases: list[Case], lost: str = "") -> slurm.ArrayJob:
        """A job whose tasks make the runs but that of this name."""
        task = self.folder / "task.py"
        lines = [
            "import sys",
            f"sys.path[:0] = {sys.path!r}",
            "from pathlib import Path",
            "from furrow_post.run.case import script_case",
            "from furrow_post.run.executor import Executor",
            "from furrow_post.run.tools import Tools",
            f"tools = Tools(Path({str(self.tree.build)!r}), Path({str(self.tree.root)!r}))",
            "name = sys.argv[-1]",
            f"if name == {lost!r}: sys.exit('the node went down')",
            "words = {'fail': 'it broke'} if name == 'bad' else {}",
            f"case = script_case(name, Path({str(self.tree.script)!r}), words)",
            f"Executor(Path({str(self.results)!r}), tools).run([case])",
        ]
        task.write_text("\n".join(lines))
        names = [case.name for case in cases]
        command = [sys.executable, str(task)]
        text = slurm.batch_text(self.results, names, command, {"FURROW_BUILD": "a b"}, 2, 3)
        return slurm.submit(self.results / slurm.FOLDER, text, names)

    def test_points_are_collected_as_they_end(self) -> None:
        cases = [self.tree.case("good"), self.tree.case("bad", fail="it broke")]
        with mock.patch.dict(os.environ, self.path):
            job = self.submitted(cases)
            slurm.gather(job, self.executor, cases)
        self.assertEqual([self.executor.state(c) for c in cases], [State.DONE, State.FAILED])
        self.assertEqual(slurm.lost(job, self.executor, cases), [])
        self.assertEqual(slurm.read_job(self.results / slurm.FOLDER), job)

    def test_task_without_results_is_reported_with_its_last_output(self) -> None:
        cases = [self.tree.case("a"), self.tree.case("b")]
        with mock.patch.dict(os.environ, self.path):
            job = self.submitted(cases, lost="b")
            slurm.gather(job, self.executor, cases)
        (sentence,) = slurm.lost(job, self.executor, cases)
        self.assertIn("b: its task ended without a result: the node went down (", sentence)

    def test_batch_script_has_the_command(self) -> None:
        text = slurm.batch_text(self.results, ["a", "b"], ["run", "-o", "x y"], {"F": "1 2"}, 2, 3)
        for line in (
            "#SBATCH --array=0-1%3",
            "#SBATCH --ntasks=2",
            f'#SBATCH --output="{self.folder}/results with blanks 100%%/slurm/%a.txt"',
            "export F='1 2'",
            "exec run -o 'x y' --point \"${points[$SLURM_ARRAY_TASK_ID]}\"",
        ):
            self.assertIn(line + "\n", text)
        alone = slurm.batch_text(self.results, ["a"], ["run"], {}, 1, None)
        self.assertIn("#SBATCH --array=0-0\n", alone)

    def test_name_of_a_folder_cannot_become_a_command(self) -> None:
        for name in ("a\ntouch pwned #", "a\rb", "a\u2028b"):
            with self.assertRaisesRegex(ResultsError, "has a line break or another control"):
                slurm.batch_text(self.folder / name, ["a"], ["run"], {}, 1, None)

    def test_faults_are_refused(self) -> None:
        with mock.patch.dict(os.environ, {**self.path, "REFUSES": "Invalid account"}):
            with self.assertRaisesRegex(ResultsError, "sbatch refuses .*Invalid account"):
                self.submitted([self.tree.case("a")])
        with mock.patch.dict(os.environ, {"PATH": str(self.tree.build)}):
            with self.assertRaisesRegex(ResultsError, "there is no sbatch on this machine"):
                self.submitted([self.tree.case("a")])

    def test_job_missing_in_the_queue_has_ended(self) -> None:
        with mock.patch.dict(os.environ, self.path):
            self.assertFalse(slurm.is_queued(slurm.ArrayJob("12", ("a",))))


if __name__ == "__main__":
    unittest.main()
