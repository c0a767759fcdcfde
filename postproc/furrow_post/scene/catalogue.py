# SPDX-License-Identifier: GPL-2.0-or-later
"""The shipped scenes, and what the head of a script states: title, group, small version."""

import difflib
import shlex
from pathlib import Path

from ..errors import ResultsError, content_of
from ..programs import inputs_folder

GROUPS = (
    "Tyres on soft ground",
    "Tyres on a road",
    "Rigid wheels on snow",
    "Rigid wheels on sand",
    "Grains on a continuum",
    "Plates",
)
QUICK_FORM = "write '# Quick: -v NAME VALUE -v NAME VALUE ...'"
INDENT = 24  # of the titles in the list of scenes

Variables = list[tuple[str, str]]  # name and value, as -v has them


def scenes_folder() -> Path | None:
    inputs = inputs_folder()
    return inputs / "scenes" if inputs else None


def scene_names() -> list[str]:
    folder = scenes_folder()
    return sorted(path.stem for path in folder.glob("*.lig")) if folder else []


def is_shipped(script: Path) -> bool:
    """True where a script is one of the scenes, whose paths do not depend on where they are started."""
    folder = scenes_folder()
    return folder is not None and script.resolve().parent == folder.resolve()


def script_of(scene: str) -> Path:
    """The file of a scene's name, or of the path of a script. @raises ResultsError"""
    folder = scenes_folder()
    if folder and (folder / f"{scene}.lig").is_file():
        return folder / f"{scene}.lig"
    if Path(scene).is_file():
        return Path(scene)
    near = difflib.get_close_matches(Path(scene).stem, scene_names(), n=3, cutoff=0.5)
    hint = f"Did you mean {' or '.join(near)}? " if near else ""
    raise ResultsError(
        f"there is no scene '{scene}'. {hint}Name a scene of --help, or the path of a script"
    )


def head_lines(script: Path) -> list[str]:
    """The comment lines at the top of a script, without "# ". @raises ResultsError, OSError"""
    with content_of(script, "name a LIGGGHTS script"):
        lines = script.read_text(encoding="utf-8").splitlines()
    found = []
    for line in lines:
        if not line.startswith("#"):
            break
        found.append(line[1:].removeprefix(" "))
    return found


def head_of(script: Path) -> tuple[str, dict[str, str]]:
    """Title, and what stands behind each "# Name:" with its indented lines. @raises ResultsError"""
    lines = head_lines(script)
    entries, last = dict[str, str](), ""
    for line in lines[1:]:
        name, colon, rest = line.partition(":")
        if colon and name[:1].isupper():
            last = name
            entries[last] = rest.strip()
        elif last and line.startswith(" "):
            entries[last] += f" {line.strip()}"
    return "".join(lines[:1]).partition(":")[2].strip(), entries


def head_entry(script: Path, name: str) -> str:
    """Text behind "# NAME:" in the head; empty where there is no such line."""
    return head_of(script)[1].get(name, "")


def quick_variables(script: Path) -> Variables:
    """The variables of a scene's small version. @raises ResultsError without them"""
    text = head_entry(script, "Quick")
    if not text:
        raise ResultsError(f"{script}: its head has no line '# Quick:'; {QUICK_FORM}")
    with content_of(script, QUICK_FORM):
        words = shlex.split(text)
    if len(words) % 3 or any(word != "-v" for word in words[::3]):
        raise ResultsError(f"{script}: its line '# Quick: {text}' misses a word; {QUICK_FORM}")
    return list(zip(words[1::3], words[2::3]))


def listing() -> str:
    """Names and titles of all scenes by group."""
    folder = scenes_folder()
    grouped: dict[str, list[str]] = {group: [] for group in GROUPS}
    for name in scene_names() if folder else ():
        assert folder
        script = folder / f"{name}.lig"
        title, entries = head_of(script)
        line = f"    {name:{INDENT}}{title}"
        grouped.setdefault(entries.get("Group", "Others"), []).append(line)
    return "\n".join("\n".join([f"  {name}:", *lines]) for name, lines in grouped.items() if lines)
