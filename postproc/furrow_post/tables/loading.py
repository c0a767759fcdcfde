# SPDX-License-Identifier: GPL-2.0-or-later
"""A study with its runs and its evaluation: the tables of study.yaml, or evaluate(runs, output) of evaluate.py."""

from pathlib import Path

from ..study.definition import cases_of, evaluation_of
from ..study.study import Study
from ..study.values import DEFINITION, load_yaml
from .engine import Engine


def load_study(folder: Path) -> Study:
    """@raises ResultsError"""
    folder = folder.resolve()
    content = load_yaml(folder / DEFINITION)
    module = evaluation_of(folder)
    cases = tuple(module.cases()) if module and hasattr(module, "cases") else cases_of(folder, content)
    evaluate = getattr(module, "evaluate", None) or Engine(folder, content, module).evaluate
    return Study(folder, cases, evaluate, content.get("checked"))
