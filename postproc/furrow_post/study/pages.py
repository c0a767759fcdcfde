# SPDX-License-Identifier: GPL-2.0-or-later
"""Values in pages, by name: `<!-- value: study.value -->12.1 ± 0.2<!-- end value -->`.

The text between the marks is written by `furrow-post study --pages`, from the tables of the study.
After the name may come one of FORMS.
"""

import math
import re
from collections.abc import Iterator
from pathlib import Path

from ..errors import ResultsError
from .values import Registry, StudyValue, number

MARK = re.compile(r"(<!-- value: ([\w.+-]+)(?: (\w+))? -->)(.*?)(<!-- end value -->)", re.DOTALL)
FORMS = ("value", "error", "reference", "verdict")
LEFT_OUT = {"build", "results", ".git"}


def shown(value: StudyValue, form: str = "") -> str:
    """The text of a value: rounded to its error, with it; or one of its parts.

    @raises ResultsError where the value does not have that part
    """
    if form == "verdict":
        return value.verdict()
    computed, error = value.computed(), value.uncertainty()
    parts = {"": computed, "value": computed, "error": error, "reference": value.expected()}
    if form not in parts:
        raise ResultsError(f"'{form}' of value {value.id}: after the name may come {', '.join(FORMS)}")
    part = parts[form]
    if part is None:
        raise ResultsError(f"value {value.id} has no {form or 'number'}")
    if form == "reference":
        return number(part)
    if not error:
        return number(part)
    place = math.floor(math.log10(error))  # of the error's first digit; a first digit 1 keeps two
    digits = (1 if error < 2 * 10.0**place else 0) - place
    texts = [f"{round(x, digits):.{max(0, digits)}f}" for x in (part, error)]
    return texts[0] if form else f"{texts[0]} ± {texts[1]}"


def with_values(text: str, registry: Registry) -> str:
    """A page with its values as they are stored."""

    def write(mark: "re.Match[str]") -> str:
        return mark[1] + shown(registry[mark[2]], mark[3] or "") + mark[5]

    if text.count("<!-- value:") != len(MARK.findall(text)):
        raise ResultsError(
            "a mark '<!-- value: NAME -->' has no name of a value or no '<!-- end value -->' behind it"
        )
    return MARK.sub(write, text)


def pages(root: Path) -> Iterator[Path]:
    """Paths of all pages of a project."""
    for path in sorted(root.rglob("*.md")):
        if not LEFT_OUT & set(path.relative_to(root).parts):
            yield path


def stale_pages(root: Path, registry: Registry) -> dict[Path, str]:
    """Page -> correct text, for pages with other values than the stored ones."""
    found = {}
    for path in pages(root):
        text = path.read_text(encoding="utf-8")
        try:
            made = with_values(text, registry)
        except ResultsError as error:
            raise ResultsError(f"{path}: {error}") from error
        if made != text:
            found[path] = made
    return found
