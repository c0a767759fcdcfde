# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests evaluated together: printed report, and laboratory.json in each folder."""

import json
import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from ..read.laboratory import LaboratoryTest, PointRun, read_oedometer_reference
from ..read.results import require_different
from .evaluation import Oedometer, evaluate, reference_error
from .quantity import LaboratoryQuantity
from .together import together


@dataclass
class LaboratoryReport:
    """Report on tests of one kind: references and results."""

    tests: list[LaboratoryTest]
    measured: Oedometer | None
    points: list[PointRun]
    report: str


def report_tests(
    folders: Sequence[Path | str], reference: Path | None = None, points: Sequence[str] = ()
) -> LaboratoryReport:
    """Evaluates results folders and writes laboratory.json into each.

    reference: of an oedometer; points: results folders of furrow-point. @raises ResultsError
    """
    require_different(folders)
    tests = [LaboratoryTest(folder) for folder in folders]
    measured = read_oedometer_reference(reference) if reference else None
    lines = []
    for test in tests:
        quantities = evaluate(test)
        if measured and test.kind == "oedometer":
            quantities += reference_error(test, measured)
        lines += [f"{test.kind}: {test.folder}", *(q.line() for q in quantities)]
        write_json(test, quantities)
    shared = together(tests)
    if shared:
        lines += ["all together", *(q.line() for q in shared)]
    return LaboratoryReport(tests, measured, [PointRun(p) for p in points], "\n".join(lines))


def write_json(test: LaboratoryTest, quantities: Sequence[LaboratoryQuantity]) -> None:
    """laboratory.json in the folder of the test; what is not known is null: NaN is no JSON."""

    def known(value: float | str) -> float | str | None:
        return value if isinstance(value, str) or math.isfinite(value) else None

    entries = {q.name: {key: known(value) for key, value in asdict(q).items()} for q in quantities}
    content = {name: {key: entry[key] for key in entry if key != "name"} for name, entry in entries.items()}
    text = json.dumps({"facts": test.facts, "quantities": content}, indent=1, allow_nan=False)
    (test.folder / "laboratory.json").write_text(text, encoding="utf-8")
