# SPDX-License-Identifier: GPL-2.0-or-later
"""Record of a run next to its results: run.json when it came to its end, else failed.json."""

import hashlib
import json
import shutil
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any

FINISHED, FAILED = "run.json", "failed.json"


@lru_cache(maxsize=None)
def _digest(path: Path, modified: int) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()[:12]


def digest(path: Path) -> str:
    """First digits of a file's SHA-256."""
    return _digest(path, path.stat().st_mtime_ns)


def digests(paths: Iterable[Path]) -> dict[str, str]:
    """File name -> digest. Later files of the same name have a number."""
    found: dict[str, str] = {}
    for path in paths:
        name, count = path.name, 1
        while name in found:
            count += 1
            name = f"{path.name} {count}"
        found[name] = digest(path)
    return found


@dataclass(frozen=True)
class Record:
    """One run as it was made."""

    job: Mapping[str, object]  # Case.identity
    program: str  # digest of the executable
    inputs: Mapping[str, str]  # file name -> digest, of Case.input_files
    commit: str  # of the source tree; "+" behind it: with changes; empty: none
    started: str  # UTC, ISO 8601
    wall_time: float  # [s]
    cpu_time: float  # user time [s]
    system_time: float  # [s]
    facts: Mapping[str, float] = field(
        default_factory=dict
    )  # of the last line FACTS name value ...
    changes: Mapping[str, str] = field(default_factory=dict)  # variables of the second attempt
    stopped: tuple[str, ...] = ()  # errors of attempts before
    error: str = ""  # of a failed run
    status: int = 0  # of the program
    ranks: int = 1
    words: str = ""  # the scene and its options, as a user types them
    continued: bool = False  # from a checkpoint: the times are those of the last part

    @property
    def name_of_program(self) -> str:
        return str(self.job.get("program", ""))

    def variable(self, name: str) -> str:
        """As the last attempt had it. @raises KeyError"""
        variables = self.job["variables"]
        assert isinstance(variables, Mapping)
        return str({**variables, **self.changes}[name])

    def write(self, folder: Path) -> None:
        """Writes run.json, or failed.json for a run with an error."""
        text = json.dumps(asdict(self), indent=1)
        (folder / (FAILED if self.error else FINISHED)).write_text(text + "\n", encoding="utf-8")


def read_record(path: Path) -> Record | None:
    """None where there is no such file, or it is no record."""
    try:
        content: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
        content["stopped"] = tuple(content["stopped"])
        return Record(**content)
    except (OSError, ValueError, KeyError, TypeError):
        return None


def forget(folder: Path, checkpoints: bool) -> None:
    """Removes by what an earlier run in the folder could be taken for finished, and its checkpoints."""
    for name in (FINISHED, FAILED, "facts.txt", "laboratory.json"):
        (folder / name).unlink(missing_ok=True)
    for checkpoint in folder.glob("restart_forced*") if checkpoints else ():
        if checkpoint.is_dir() and not checkpoint.is_symlink():
            shutil.rmtree(checkpoint)
        else:
            checkpoint.unlink()
