# SPDX-License-Identifier: GPL-2.0-or-later
"""Every command of furrow-post, with each parameter missing, unknown, without a value, of another type
or outside of its range: one line that names the command, the parameter, the fault and the remedy."""

import unittest
from collections.abc import Iterator

import click

from cli.help_test import found
from furrow_post.cli.main import main
from furrow_post.cli.parameters import Type
from furrow_post.cli.tree import Entry, entries
from support.faults import Outcome, outcome

WRONG = ("", "nonsense", "-1e30", "1e999", "a\nb")  # for a type that refuses one of them


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
    def expect(self, entry: Entry, words: list[str], *texts: str) -> Outcome:
        """The command refuses the words in one line."""
        end = outcome(lambda: main([*entry.path.split(), *words]))
        with self.subTest(entry.path, words=words):
            self.assertEqual(end.status, 2, end.said)
            self.assertEqual(len(end.said.splitlines()), 1, end.said)
            self.assertTrue(end.said.startswith(f"furrow-post {entry.path}: "), end.said)
            self.assertNotIn("internal error", end.said)
            self.assertRegex(end.said, r"; .")  # what is wrong; what to do
            for text in texts:
                self.assertIn(text, end.said)
        return end

    def test_unknown_options(self) -> None:
        for entry in entries():
            if entry.path != "resistance":  # whose options are those of a program
                self.expect(entry, ["--no-such-option"], "there is no option '--no-such-option'", "--help'")

    def test_misspelt_options(self) -> None:
        for entry in entries():
            for option in options(found(entry)):
                name = max(option.opts, key=len)
                if name.startswith("--") and len(name) > 5:
                    self.expect(entry, [name[:-2] + name[-1]], "did you mean", name)

    def test_options_without_a_value(self) -> None:
        for entry in entries():
            for option in options(found(entry)):
                if not option.is_flag and not option.count:
                    self.expect(entry, [option.opts[0]], f"{option.opts[0]} needs ")

    def test_values_of_another_type_or_range(self) -> None:
        tested = 0
        for entry in entries():
            for option in options(found(entry)):
                if option.is_flag:
                    continue
                for text in refused_values(option):
                    values = [text] * option.nargs
                    self.expect(entry, [option.opts[0], *values], option.opts[0])
                    tested += 1
        self.assertGreater(tested, 100)

    def test_missing_arguments(self) -> None:
        for entry in entries():
            command = found(entry)
            for parameter in command.params:
                if parameter.required and entry.path != "resistance":
                    self.expect(entry, [], "is missing")
                    break

    def test_every_type_is_of_the_package(self) -> None:
        for entry in entries():
            for parameter in found(entry).params:
                if not getattr(parameter, "is_flag", False):
                    with self.subTest(entry.path, parameter=parameter.name):
                        kind = parameter.type
                        kinds = kind.types if isinstance(kind, click.Tuple) else [kind]
                        self.assertTrue(all(isinstance(each, (Type, click.Choice)) for each in kinds))


if __name__ == "__main__":
    unittest.main()
