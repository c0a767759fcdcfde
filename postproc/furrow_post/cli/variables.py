# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post variables: what -v may set in a script; with names and values, whether it may."""

import argparse
import sys
from pathlib import Path

from ..errors import ResultsError
from ..read.script import RESERVED, check_variables, script_variables


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("script", type=Path)
    parser.add_argument(
        "given", nargs="*", metavar="NAME VALUE", help="refuses a name that no line reads"
    )


def run(arguments: argparse.Namespace) -> None:
    script: Path = arguments.script
    given: list[str] = arguments.given
    if not given:
        known = script_variables(script, {})
        for name in known.settable:
            print(f"{name:20} {known.defaults.get(name, '(no default)')}")
        return
    if len(given) % 2:
        raise ResultsError(f"-v {given[-1]} has no value")
    for warning in check_variables(script, list(zip(given[::2], given[1::2])), RESERVED):
        print(f"WARNING: {warning}", file=sys.stderr)
