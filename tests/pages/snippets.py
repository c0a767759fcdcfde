# SPDX-License-Identifier: GPL-2.0-or-later
"""The first example of each style's page runs: snippets.py <source> <build> <scratch>.

It is the first code block of the section Examples, saved next to the scenes and run from there. A run
ends after STEPS at the latest, when the wheels stand on their ground.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

SECONDS = 120  # of one script
STEPS = 1000


def shortened(script: str) -> str:
    """Scripts with "upto" go on to a step that they need."""
    script = re.sub(r"^(run +)(\d+)$", lambda run: f"{run[1]}{min(int(run[2]), STEPS)}", script, flags=re.M)
    return re.sub(r"\bwall_time \d+", "wall_time 1", script)


def snippet(page: Path) -> str:
    text = page.read_text(encoding="utf-8")
    _, found, examples = text.partition("\n## Examples\n")
    block = re.search(r"^```\n(.*?)^```", examples, re.M | re.S)
    assert found and block is not None, f"{page}: has no script in its section Examples"
    return block[1]


def main(source: Path, build: Path, scratch: Path) -> None:
    shutil.rmtree(scratch, ignore_errors=True)
    scenes = scratch / "inputs" / "scenes"
    scenes.mkdir(parents=True)
    for name in ("beds", "materials", "meshes", "tyres"):
        (scratch / "inputs" / name).symlink_to(source / "inputs" / name)
    pages = sorted(p for p in (source / "coupling").rglob("*.md") if p.name != "README.md")
    assert len(pages) >= 20, f"only {len(pages)} pages were found"
    for page in pages:
        style = re.sub(r"^(fix|command|model)_", "", page.stem).replace("_", "[/_]")
        script = snippet(page)
        if not re.search(rf"\b{style}\b", script) and "restart" not in page.stem:
            sys.exit(f"{page}: its script has no line of the style")
        path = scenes / f"{page.stem}.lig"
        path.write_text(shortened(script), encoding="utf-8")
        print(f"+ {page.stem}", flush=True)
        done = subprocess.run(
            [build / "bin" / "furrow", "-in", path.name, "-log", "none"],
            cwd=scenes,
            env={**os.environ, "FURROW_CACHE": str(scratch / "cache")},
            text=True,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            timeout=SECONDS,
        )
        if done.returncode or "ERROR" in done.stdout:
            sys.exit(f"{done.stdout}\n{page}: its script ended with status {done.returncode}")


if __name__ == "__main__":
    main(*(Path(word).resolve() for word in sys.argv[1:4]))
