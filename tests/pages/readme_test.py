# SPDX-License-Identifier: GPL-2.0-or-later
"""Needs of a newcomer on the first page: readme_test.py <source>. Both commands with their time,
and a link to each of the pages that first users need."""

import re
import sys
from pathlib import Path

COMMANDS = ("bash inputs/run", "bash tests/run")
LINKS = {
    "tests": "tests/README.md",
    "gravity": "inputs/guide/howto/gravity.md",
    "slopes": "inputs/guide/howto/slopes_and_angles.md",
    "own wheel": "inputs/guide/howto/own_wheel.md",
    "own soil": "inputs/guide/tutorials/4_soil_from_tests.md",
    "How accurate is my answer?": "inputs/validation/README.md#how-accurate-is-my-answer",
}


def anchors(page: str) -> set[str]:
    """Anchors of the headings, as GitHub and the site write them."""
    heads = re.findall(r"^#+ (.*)$", page, re.M)
    return {re.sub(r"[^\w -]", "", head).strip().lower().replace(" ", "-") for head in heads}


def main(source: Path) -> None:
    page = (source / "README.md").read_text(encoding="utf-8")
    faults = []
    for command in COMMANDS:
        if not re.search(rf"^{command} +#.*\d+ minutes", page, re.M):
            faults.append(f"shows no '{command}' with its minutes")
    for words, target in LINKS.items():
        if not re.search(rf"\[[^\]]*{re.escape(words)}[^\]]*\]\({re.escape(target)}\)", page):
            faults.append(f"has no link '{words}' to {target}")
        file, _, anchor = target.partition("#")
        if anchor and anchor not in anchors((source / file).read_text(encoding="utf-8")):
            faults.append(f"links to {target}, whose page has no such heading")
    if faults:
        sys.exit("\n".join(f"README.md: {fault}" for fault in faults))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
