# SPDX-License-Identifier: GPL-2.0-or-later
"""Every subcommand has examples in its help, whose words it accepts."""

import contextlib
import io
import shlex
import unittest

from furrow_post.cli.examples import EXAMPLES
from furrow_post.cli.main import SUBCOMMANDS, parser


class HelpTest(unittest.TestCase):
    def test_every_subcommand_has_examples(self) -> None:
        self.assertEqual(set(EXAMPLES), {entry.name for entry in SUBCOMMANDS})

    def test_examples_are_accepted_and_shown(self) -> None:
        for name, examples in EXAMPLES.items():
            said = io.StringIO()
            with contextlib.redirect_stdout(said), self.assertRaises(SystemExit):
                parser(name).parse_args([name, "--help"])
            for words in examples:
                with self.subTest(name=name, words=words):
                    self.assertIn(f"furrow-post {name} {words}", said.getvalue())
                    given = [name, *(["--"] if name == "resistance" else []), *shlex.split(words)]
                    if "--help" not in given:
                        parser(name).parse_args(given)


if __name__ == "__main__":
    unittest.main()
