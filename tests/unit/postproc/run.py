# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs test files one after the other: run.py FILE... Each runs in a copy of this process, which has
imported what most of them need."""

import runpy
import sys
import time
from pathlib import Path

from copied import run_copy


def main(files: list[Path]) -> None:
    failed = []
    for file in files:
        began = time.monotonic()

        def program(file: Path = file) -> None:
            sys.path.insert(0, str(file.parent))
            runpy.run_path(str(file), run_name="__main__")

        status = run_copy(program, [str(file)], None, (1, 2), {})
        print(f"{file.name}: {'FAILED' if status else 'ok'}, {time.monotonic() - began:.1f} s", flush=True)
        failed += [file.name] if status else []
    if failed:
        sys.exit(f"failed: {', '.join(failed)}")


if __name__ == "__main__":
    main([Path(word).resolve() for word in sys.argv[1:]])
