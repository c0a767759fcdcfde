# SPDX-License-Identifier: GPL-2.0-or-later
"""The ribbed tyre with other grooves."""

import re
from pathlib import Path

RIBBED = Path(__file__).resolve().parents[2] / "tyres" / "p235_75r15_ribbed.yaml"


def ribbed_tyre(grooves: str, **voids: str) -> str:
    """Text of the ribbed tyre's file with other grooves, without comments. Its last section is voids.

    grooves: addition to the title; voids: lists of the new section.
    """
    text = re.sub(r"(?m)^#.*\n|(?<=\S) +#.*$", "", RIBBED.read_text(encoding="utf-8"))
    head, _, _ = text.partition("voids:\n")
    rows = [f"  {f'{key}:':6} {values}\n" for key, values in voids.items()]
    return "".join([re.sub(r"(?m)^(title: .*)$", rf"\1, {grooves}", head), "voids:\n", *rows])
