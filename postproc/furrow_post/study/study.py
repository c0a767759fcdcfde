# SPDX-License-Identifier: GPL-2.0-or-later
"""Lists, makes and evaluates the runs of a study."""

import fnmatch
import sys
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..errors import ResultsError
from ..run.case import Case
from ..run.executor import Executor
from ..run.tools import Tools
from .runs import Runs
from .study_files import Output

Evaluation = Callable[[Runs, Output], Sequence[str]]


@dataclass(frozen=True)
class Study:
    """Runs and what is made of them.

    evaluate writes tables and figures of the runs that are there, and returns what misses a limit,
    a sentence each; checked: names of the runs without which --check cannot pass, None: all.
    """

    folder: Path
    cases: Sequence[Case]
    evaluate: Evaluation
    checked: Collection[str] | None = None

    def selected(self, names: Sequence[str]) -> list[Case]:
        """Cases whose stage or name is among names, which may be patterns; all of no names.

        @raises ResultsError for a name that fits nothing
        """
        if not names:
            return list(self.cases)
        for name in names:
            if not any(_fits(case, name) for case in self.cases):
                stages = ", ".join(dict.fromkeys(case.stage for case in self.cases if case.stage))
                hint = f"; stages are {stages}" if stages else ""
                raise ResultsError(f"nothing is called '{name}'; --list shows all runs{hint}")
        return [case for case in self.cases if any(_fits(case, name) for name in names)]


def _fits(case: Case, name: str) -> bool:
    return name == case.stage or fnmatch.fnmatchcase(case.name, name)


def carry_out(study: Study, parsed: Any) -> int:
    """Makes the runs that are missing and evaluates them, or lists them; the exit status.

    parsed: options of furrow-post study
    """
    tools = Tools.of(study.folder, parsed.build)
    results = parsed.results or tools.root / "results" / study.folder.name
    executor = Executor(results, tools, parsed.jobs, again=parsed.again)
    chosen = study.selected(parsed.names)
    if parsed.check and not parsed.names and study.checked is not None:
        chosen = [case for case in chosen if case.name in study.checked]
    if parsed.list:
        for case in chosen:
            print(f"{executor.state(case).value:8} {case.name:40} {case.what}".rstrip())
        return 0
    if not parsed.evaluate:
        executor.run(chosen)
    elif sentence := executor.outdated(study.cases):
        print(f"WARNING: {sentence}. Without --evaluate they are repeated", file=sys.stderr)
    return _evaluate(study, executor, chosen, parsed.check, parsed.merge)


def _evaluate(study: Study, executor: Executor, chosen: Sequence[Case], check: bool, merge: bool) -> int:
    """Writes complete tables next to the driver, others into the results folder."""
    ended = {case.name: run for case in study.cases if (run := executor.ended(case))}
    done = [run for run in ended.values() if not run.error]
    complete = not study.cases or bool(done) and all(
        case.name in ended and (case.may_fail or not ended[case.name].error) for case in study.cases
    )
    merge = merge and not complete and not check
    beside = (complete or merge) and not check
    with Output(study.folder if beside else executor.results, page=beside, merge=merge) as output:
        missed = list(study.evaluate(Runs(study.cases, executor), output))
        output.publish([run.record for run in done], executor.tools.root)
    if not beside:
        print(f"{len(done)} of {len(study.cases)} runs are there; tables are in {output.folder}")
    failed = [ended[case.name] for case in chosen if case.name in ended and ended[case.name].error]
    absent = [case.name for case in chosen if case.name not in ended] if check else []
    lines = [
        *(f"FAILED: {run.name}: {run.error}" for run in failed),
        *(f"MISSED: {sentence}" for sentence in missed),
        *(f"MISSED: {name} was not run" for name in absent),
    ]
    for line in lines:
        print(line, file=sys.stderr)
    unexpected = any(not run.case.may_fail for run in failed)
    return 1 if unexpected or check and (missed or absent) else 0
