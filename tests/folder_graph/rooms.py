#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""No folder of the code has more than 25 files, and every file name of src and coupling occurs once.

    rooms.py <root of the project>
"""
import sys
from collections import Counter, defaultdict
from pathlib import Path

LARGEST = 25  # files of one folder
TREES = ("src", "coupling", "postproc", "tests")
DATA = {"tests/coupled/bad_input"}  # one script for each wrong input
GENERATED = {"__pycache__", ".mypy_cache", ".ruff_cache"}


def main():
    root = Path(sys.argv[1])
    sizes, places = Counter(), defaultdict(list)
    for tree in TREES:
        for path in sorted((root / tree).rglob("*")):
            relative = path.relative_to(root)
            if not path.is_file() or GENERATED & set(relative.parts):
                continue
            sizes[relative.parent.as_posix()] += 1
            if tree in ("src", "coupling") and path.suffix in (".h", ".cpp"):
                places[path.name].append(relative.parent.as_posix())
    errors = [
        f"{folder} has {count} files; allowed: {LARGEST}; divide it by what a reader looks for"
        for folder, count in sizes.items()
        if count > LARGEST and folder not in DATA
    ]
    errors += [f"{name} occurs in {', '.join(found)}" for name, found in places.items() if len(found) > 1]
    if not places:
        errors.append(f"no sources found below {root}")
    print("\n".join(errors) or f"{len(sizes)} folders of at most {LARGEST} files, {len(places)} names of sources")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
