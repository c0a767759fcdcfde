# SPDX-License-Identifier: GPL-2.0-or-later
"""Commands of click with arguments by this package's types, and parameters that several share."""

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any, TypeVar

import click
from click.parser import OptionParser, ParsingState

from ..arguments import WrongText, assignment, at_least, fraction, has_control_characters, is_number, path, seconds, words
from ..errors import ResultsError

Decorated = TypeVar("Decorated", bound=Callable[..., Any])
Decorator = Callable[[Decorated], Decorated]
Parse = Callable[[str], Any]
FORMATS = ("png", "svg", "pdf")  # of figures


# Names that help gives to the values of a type; others are numbers
TYPE_NAMES: dict[Parse, str] = {path: "path", Path: "path", words: "text", str: "text", seconds: "time", fraction: "percent"}


class Given(SimpleNamespace):
    """Values of the parameters by name."""


class Type(click.ParamType):
    """Type of a parameter by a function of its text, which raises WrongText with the message."""

    def __init__(self, parse: Parse) -> None:
        self.parse, self.name = parse, TYPE_NAMES.get(parse, "number")

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        if not isinstance(value, str):
            return value
        if has_control_characters(value):
            self.fail(f"{value!r} has a line break or another control character; leave it out", param, ctx)
        try:
            return self.parse(value)
        except WrongText as error:
            self.fail(str(error), param, ctx)


class _Argument(click.Argument):
    """An argument with a help text."""

    def __init__(self, *names: Any, help: str = "", **more: Any) -> None:
        super().__init__(*names, **more)
        self.help = help


class _Option(click.Option):
    """An option; once: it may be given once; several: it takes all values up to the next option."""

    def __init__(self, *names: Any, once: bool = False, several: bool = False, **more: Any) -> None:
        super().__init__(*names, **more)
        self.once, self.several = once, several

    def add_to_parser(self, parser: OptionParser, ctx: click.Context) -> None:
        super().add_to_parser(parser, ctx)
        known = parser._long_opt | parser._short_opt
        option = known[self.opts[0]]
        process, count = option.process, 0

        def take(value: Any, state: ParsingState) -> None:
            nonlocal count
            count += 1
            if self.once and count > 1:
                raise click.BadParameter("is given twice; give it once", ctx, self)
            process(value, state)
            while self.several and state.rargs and not _is_option(state.rargs[0]):
                process(state.rargs.pop(0), state)

        option.process = take  # type: ignore[assignment]


def _is_option(word: str) -> bool:
    return word.startswith("-") and len(word) > 1 and not is_number(word)


class Command(click.Command):
    """A command whose help has its arguments and ends with examples."""

    function = ""  # name of the function, without underscores at its ends
    examples: Sequence[str] = ()
    description = ""  # in the place of the line that lists of commands have
    closing: Callable[[], str] = staticmethod(lambda: "")

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        try:
            return super().parse_args(ctx, args)
        except click.UsageError as error:  # the parser of options does not know the command
            error.ctx = error.ctx or ctx
            raise

    def format_help_text(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        formatter.write("\n")
        formatter.write_text(self.description or self.help or "")

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        rows = [
            (param.make_metavar(), param.help)
            for param in self.get_params(ctx)
            if isinstance(param, _Argument) and param.help
        ]
        if rows:
            with formatter.section("Arguments"):
                formatter.write_dl(rows)
        super().format_options(ctx, formatter)

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        super().format_epilog(ctx, formatter)
        if self.examples:
            formatter.write("\nExamples:\n")
            for example in self.examples:
                formatter.write(f"  {ctx.command_path} {example}".rstrip() + "\n")
        if text := self.closing():
            formatter.write(f"\n{text}\n")


def command(
    *decorators: Decorator[Any],
    description: str = "",
    closing: Callable[[], str] | None = None,
    **settings: Any,
) -> Callable[[Callable[[Given], int | None]], Command]:
    """A command with these parameters; the function takes their values and returns the exit status.

    description: for its help; closing: makes the text at the end of its help
    """

    def made(function: Callable[[Given], int | None]) -> Command:
        def callback(**values: Any) -> int | None:
            return function(Given(**values))

        decorated: Any = callback
        for decorator in reversed(decorators):
            decorated = decorator(decorated)
        result: Command = click.command(cls=Command, **settings)(decorated)  # type: ignore[no-untyped-call]
        result.function = function.__name__.strip("_")
        result.description = description
        if closing:
            result.closing = closing
        return result

    return made


def argument(
    name: str, help: str, parse: Parse = words, choices: Iterable[str] | None = None, **more: Any
) -> Decorator[Any]:
    return click.argument(name, cls=_Argument, type=_kind(parse, choices), help=help, **more)


def option(
    *names: str, help: str, parse: Parse = words, choices: Iterable[str] | None = None, **more: Any
) -> Decorator[Any]:
    return click.option(*names, cls=_Option, type=_kind(parse, choices), help=help, **more)


def _kind(parse: Parse, choices: Iterable[str] | None) -> click.ParamType:
    return click.Choice(list(choices)) if choices else Type(parse)


def flag(*names: str, help: str, **more: Any) -> Decorator[Any]:
    return click.option(*names, cls=_Option, is_flag=True, help=help, **more)


def repeated(*names: str, help: str, parse: Parse = words, **more: Any) -> Decorator[Any]:
    """An option that may be given several times, or once with several values."""
    return option(*names, help=help, parse=parse, multiple=True, several=True, **more)


# ---- parameters that several commands share


def results_argument() -> Decorator[Any]:
    return argument("results", "results folder of a run, or its history.h5")


def output_options(text: str = "file to write (default: in the results folder)") -> list[Decorator[Any]]:
    return [
        option("-o", "--output", parse=path, help=text),
        option("--format", choices=FORMATS, help="default: that of --output, or png"),
    ]


def target_option(text: str, required: bool = False) -> Decorator[Any]:
    """-o of commands that write other files than figures, or several."""
    return option("-o", "--output", parse=path, required=required, help=text)


def assignments(name: str, help: str) -> Decorator[Any]:
    return repeated(name, parse=assignment, metavar="NAME=NUMBER", help=help)


def pixels_option() -> Decorator[Any]:
    help = "width of the view from behind"
    return option("--pixels", parse=at_least(100), default=1000, show_default=True, help=help)


def target(given: Given, folder: Path, name: str) -> Path:
    """The file to write: as asked for, or of this name in a folder. @raises ResultsError"""
    asked: Path | None = given.output
    wanted: str | None = given.format
    if asked is None:
        return folder / f"{name}.{wanted or FORMATS[0]}"
    require_file(asked, *FORMATS)
    if wanted and asked.suffix != f".{wanted}":
        raise ResultsError(f"-o {asked}: is no {wanted}; leave out --format, or change the name")
    return asked


def require_file(file: Path, *endings: str, make_folder: bool = False) -> None:
    """endings: "html", ... @raises ResultsError for another name, a folder, or where its folder is missing"""
    if file.is_dir():
        raise ResultsError(f"{file}: is a folder; name a file in it")
    if file.suffix[1:] not in endings:
        raise ResultsError(f"{file}: its name must end in .{' or .'.join(endings)}")
    if make_folder:
        file.parent.mkdir(parents=True, exist_ok=True)
    elif not file.parent.is_dir():
        raise ResultsError(f"{file}: there is no folder {file.parent}; make it first")
