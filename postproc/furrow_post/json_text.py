# SPDX-License-Identifier: GPL-2.0-or-later
"""JSON as Furrow writes it: without NaN, which JSON does not have, and without endless nesting."""

import json
from typing import Any, NoReturn


def parse_json(text: str, **options: Any) -> Any:
    """options: of json.loads. @raises ValueError"""
    try:
        return json.loads(text, parse_constant=_refuse, **options)
    except RecursionError:
        raise ValueError("its brackets are nested too deeply") from None


def _refuse(word: str) -> NoReturn:
    raise ValueError(f"{word} is no number of JSON")
