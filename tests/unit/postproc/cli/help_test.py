# SPDX-License-Identifier: GPL-2.0-or-later
"""Help, examples and former names of all commands."""

import contextlib
import io
import shlex
import unittest

import click

from furrow_post.cli.main import main, root, soil
from furrow_post.cli.tree import COMMANDS, KEPT, Entry, entries, present_words
from support.faults import outcome


def found(entry: Entry) -> click.Command:
    """The command by its words, as the command line finds it."""
    command: click.Command = root
    context = click.Context(root)
    for word in entry.path.split():
        assert isinstance(command, click.Group)
        inner = command.get_command(context, word)
        assert inner
        command = inner
    return command


class HelpTest(unittest.TestCase):
    def test_examples_are_accepted_and_shown(self) -> None:
        for entry in entries():
            command = found(entry)
            context = click.Context(command, info_name=f"furrow-post {entry.path}")
            text = command.get_help(context)
            for example in entry.examples:
                with self.subTest(entry.path, example=example):
                    self.assertIn(f"  furrow-post {entry.path} {example}".rstrip() + "\n", text + "\n")
                    command.make_context(entry.path, shlex.split(example))

    def test_every_parameter_is_explained(self) -> None:
        for entry in entries():
            for parameter in found(entry).params:
                with self.subTest(entry.path, parameter=parameter.name):
                    self.assertTrue(getattr(parameter, "help", ""))

    def test_former_command_names_print_the_present_one(self) -> None:
        names = [name for entry in entries() for name in entry.former]
        self.assertIn("fit-law", names)
        for entry in entries():
            for name in entry.former:
                words = [*entry.path.split(), *([name] if name in KEPT else []), "x"]
                with contextlib.redirect_stderr(io.StringIO()):
                    self.assertEqual(present_words([name, "x"]), words)
                said = outcome(lambda: main([name, "--help"])).said
                self.assertEqual(said, f"furrow-post: '{name}' is now 'furrow-post {' '.join(words[:-1])}'\n")

    def test_program_of_soil_cards_is_a_group(self) -> None:
        for words, path in ((["make"], "material"), (["card"], "make"), (["table"], "table")):
            said = outcome(lambda: soil([*words, "--help"])).said
            self.assertEqual(said, f"furrow-soil: is now 'furrow-post card {path}'\n")

    def test_all_commands_are_listed_by_subject(self) -> None:
        text = root.get_help(click.Context(root, info_name="furrow-post"))
        for heading in COMMANDS:
            self.assertIn(f"\n{heading}:\n", text)
        for entry in entries():
            self.assertRegex(text, rf"\n  {entry.path}  ")


if __name__ == "__main__":
    unittest.main()
