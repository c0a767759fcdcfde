# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs test files one after the other: run_files.py FILE... Each runs in a copy of this process, which has
imported what most of them need."""

import sys
import time
from pathlib import Path

from copied import file_program, run_copy


def main(files: list[Path]) -> None:
    failed = []
    for file in files:
        began = time.monotonic()
        status = run_copy(file_program(file), [str(file)], None, (1, 2), {})
        print(f"{file.name}: {'FAILED' if status else 'ok'}, {time.monotonic() - began:.1f} s", flush=True)
        failed += [file.name] if status else []
    if failed:
        sys.exit(f"failed: {', '.join(failed)}")


if __name__ == "__main__":
    main([Path(word).resolve() for word in sys.argv[1:]])
