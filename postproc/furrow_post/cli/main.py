# SPDX-License-Identifier: GPL-2.0-or-later
"""The command furrow-post."""

import os
import sys
from collections.abc import Sequence

import click

from .. import __version__
from ..program import run_program
from ..programs import CALLED
from .tree import Group

NAME = "furrow-post"
HELP = "Runs, steady values, plots, pictures and comparisons of Furrow."
FORMER_SOIL = {"make": "material", "card": "make", "export": "export", "table": "table"}  # of furrow-soil
WIDTH = 100  # characters of help texts

root = click.version_option(__version__, prog_name=NAME, message="%(prog)s %(version)s")(
    Group(help=HELP, context_settings={"max_content_width": WIDTH, "help_option_names": ["-h", "--help"]})
)


def message_of(error: click.ClickException) -> str:
    """Message of one line: parameter, fault and remedy."""
    text = error.format_message()
    if isinstance(error, click.MissingParameter) and error.param:
        kind = "option" if isinstance(error.param, click.Option) else "argument"
        text = f"the {kind} {_name(error.param)} is missing"
    elif isinstance(error, click.BadParameter) and error.param:
        text = f"{_name(error.param)}: {error.message}"
    elif isinstance(error, click.BadOptionUsage) and not isinstance(error, click.NoSuchOption) and error.ctx:
        known = [p for p in error.ctx.command.params if error.option_name in p.opts]
        text = f"{error.option_name} needs {known[0].metavar if known and known[0].metavar else 'a value'}"
    elif isinstance(error, click.NoSuchOption):
        near = f"; did you mean {' or '.join(error.possibilities)}?" if error.possibilities else ""
        text = f"there is no option '{error.option_name}'{near}"
    text = text.rstrip(".")
    context = error.ctx if isinstance(error, click.UsageError) else None
    remedy = f"; see '{context.command_path} --help'" if context and ";" not in text else ""
    return f"{text}{remedy}"


def _name(parameter: click.Parameter) -> str:
    if isinstance(parameter, click.Option):
        return "/".join(parameter.opts)
    return parameter.human_readable_name.strip("[].").lower()


def main(arguments: Sequence[str] | None = None, name: str = NAME) -> int:
    """Exit status of a command of furrow-post."""
    return start(root, name, arguments)


def start(command: click.Command, name: str, arguments: Sequence[str] | None = None) -> int:
    """Exit status of a program that is this command; name: as a user calls it."""
    given = list(sys.argv[1:] if arguments is None else arguments)

    def run() -> int | None:
        try:
            status = command.main(given, prog_name=name, standalone_mode=False)
        except click.ClickException as error:
            context = error.ctx if isinstance(error, click.UsageError) else None
            place = context.command_path if context else name
            if place == f"{NAME} run":
                place = os.environ.get(CALLED, place)
            click.echo(f"{place}: {message_of(error)}", err=True)
            return 2
        except click.Abort:
            raise KeyboardInterrupt from None
        return status if isinstance(status, int) else 0

    return run_program(name, run)


def soil(arguments: Sequence[str] | None = None) -> int:
    """Entry point of furrow-soil, with the commands of the group card."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    words = [FORMER_SOIL.get(given[0], given[0]), *given[1:]] if given else []
    click.echo(f"furrow-soil: is now 'furrow-post card {words[0] if words else ''}".rstrip() + "'", err=True)
    return main(["card", *words])
