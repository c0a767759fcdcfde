# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables for people: aligned text, and Markdown."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from ..csv_table import column_names


def aligned(rows: Sequence[Mapping[str, Any]]) -> str:
    """Rows under the names of their columns, numbers with six digits; empty where one is not."""

    def text(value: Any) -> str:
        return f"{value:.6g}" if isinstance(value, float) else str(value)

    names = column_names(rows)
    cells = [[text(row.get(name, "")) for name in names] for row in rows]
    return "\n".join(in_columns([names, *cells]))


def in_columns(rows: Sequence[Sequence[str]]) -> list[str]:
    """Lines of cells, each column as wide as its widest cell."""
    widths = [max(map(len, column)) for column in zip(*rows)]
    return ["  ".join(cell.rjust(width) for cell, width in zip(row, widths)) for row in rows]


def markdown(head: Sequence[str], rows: Iterable[Sequence[str]]) -> list[str]:
    """Lines of a table."""

    def line(cells: Sequence[str]) -> str:
        return "| " + " | ".join(cells) + " |"

    return [line(head), "|---" * len(head) + "|", *(line(row) for row in rows)]
