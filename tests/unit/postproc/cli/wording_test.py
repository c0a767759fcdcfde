# SPDX-License-Identifier: GPL-2.0-or-later
"""Every command of furrow-post and of the laboratory, with each parameter missing, unknown, without a value, of another type
or outside of its range: one line that names the command, the parameter, the fault and the remedy."""

import importlib
import sys
import unittest
from collections.abc import Callable, Iterator
from functools import partial
from typing import NamedTuple

import click

from cli.help_test import found
from furrow_post.cli.main import main, start
from furrow_post.cli.parameters import Type
from furrow_post.cli.tree import entries
from support.command import SOURCE
from support.faults import Outcome, outcome

sys.path.insert(0, str(SOURCE / "inputs" / "laboratory"))

WRONG = ("", "nonsense", "-1e30", "1e999", "a\nb")  # for a type that refuses one of them


class Program(NamedTuple):
    """A command, its name in messages, and how it is called."""

    name: str
    command: click.Command
    call: Callable[[list[str]], int]


def programs() -> Iterator[Program]:
    for entry in entries():
        yield Program(f"furrow-post {entry.path}", found(entry), partial(_post, entry.path.split()))
    for module, names in LABORATORY.items():
        for name in names:
            command = getattr(importlib.import_module(module), name)
            yield Program(f"{module}.py", command, partial(start, command, f"{module}.py"))


def _post(command: list[str], words: list[str]) -> int:
    return main([*command, *words])


LABORATORY = {
    "run": ["laboratory"],
    "calibrate": ["calibration"],
    "identify": ["identify"],
    "snow_strength": ["strength"],
    "identify_snow": ["record", "fit_law", "compare"],
}
WHOLE = "furrow-post resistance"  # whose options are those of a program


def options(command: click.Command) -> Iterator[click.Option]:
    for parameter in command.params:
        if isinstance(parameter, click.Option) and not parameter.hidden:
            yield parameter


def refused_values(parameter: click.Parameter) -> list[str]:
    """Texts that the type of a parameter does not take."""
    kind = parameter.type
    if isinstance(kind, click.Tuple):
        kind = kind.types[0]
    refused = []
    for text in WRONG:
        try:
            kind.convert(text, parameter, None)
        except click.BadParameter:
            refused.append(text)
    return refused


class WordingTest(unittest.TestCase):
    def expect(self, program: Program, words: list[str], *texts: str) -> Outcome:
        """The command refuses the words in one line."""
        end = outcome(lambda: program.call(words))
        with self.subTest(program.name, words=words):
            self.assertEqual(end.status, 2, end.said)
            self.assertEqual(len(end.said.splitlines()), 1, end.said)
            self.assertTrue(end.said.startswith(f"{program.name}: "), end.said)
            self.assertNotIn("internal error", end.said)
            self.assertRegex(end.said, r"; .")  # what is wrong; what to do
            for text in texts:
                self.assertIn(text, end.said)
        return end

    def test_unknown_options_are_refused(self) -> None:
        for program in programs():
            if program.name != WHOLE:
                self.expect(program, ["--no-such-option"], "there is no option '--no-such-option'", "--help'")

    def test_misspelt_options_get_a_suggestion(self) -> None:
        for program in programs():
            for option in options(program.command):
                name = max(option.opts, key=len)
                if name.startswith("--") and len(name) > 5:
                    self.expect(program, [name[:-2] + name[-1]], "did you mean", name)

    def test_options_without_a_value_are_refused(self) -> None:
        for program in programs():
            for option in options(program.command):
                if not option.is_flag and not option.count:
                    self.expect(program, [option.opts[0]], f"{option.opts[0]} needs ")

    def test_values_of_wrong_type_or_range_are_refused(self) -> None:
        tested = 0
        for program in programs():
            for option in options(program.command):
                if option.is_flag:
                    continue
                for text in refused_values(option):
                    values = [text] * option.nargs
                    self.expect(program, [option.opts[0], *values], option.opts[0])
                    tested += 1
        self.assertGreater(tested, 100)

    def test_missing_arguments_are_refused(self) -> None:
        for program in programs():
            for parameter in program.command.params:
                if parameter.required and program.name != WHOLE:
                    self.expect(program, [], "is missing")
                    break

    def test_parameter_types_are_those_of_the_package(self) -> None:
        for program in programs():
            for parameter in program.command.params:
                if not getattr(parameter, "is_flag", False):
                    with self.subTest(program.name, parameter=parameter.name):
                        kind = parameter.type
                        kinds = kind.types if isinstance(kind, click.Tuple) else [kind]
                        self.assertTrue(all(isinstance(each, (Type, click.Choice)) for each in kinds))


if __name__ == "__main__":
    unittest.main()
