# SPDX-License-Identifier: GPL-2.0-or-later
"""A shipped scene is killed at a random moment and continued: the results are those of a run in one.

    killed_scene.py <furrow> <scene> <steps between checkpoints> <ranks> [<name> <value>]...

The scene is changed as coupling/terrain/fix_terrain_continuum.md says: `restart` before the run; to
continue, `read_restart` in the place of the box and of whatever was done before, and `upto`. Every
number of history.h5 and terrain.h5 must be the same, bit for bit, but for the two files' own facts
(cost, audit of a part of a run, script).
"""

import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import h5py
import numpy as np

INPUTS = Path(__file__).resolve().parents[3] / "inputs"
COMPARED = ("history", "terrain", "rut", "surface", "grains")  # groups of the results files

furrow, scene, every, ranks, *variables = sys.argv[1:]
launch = ["mpirun", "-n", ranks] if int(ranks) > 1 else []


def whole_script() -> str:
    """The scene with absolute paths, that writes checkpoints in turn to ck.1 and ck.2."""
    text = Path(scene).read_text().replace("../", f"{INPUTS}/")
    text = re.sub(r"^atom_modify( map array)?.*$", r"atom_modify\1 sort 0 0", text, flags=re.M)
    head, run, tail = text.rpartition("\nrun ")
    return f"{head}\nrestart {every} ck.1 ck.2{run}{tail}"


def continued_script(checkpoint: Path) -> str:
    text = whole_script()
    text = re.sub(r"^region +box .*\ncreate_box .*$", f"read_restart {checkpoint}", text, flags=re.M)
    # Grains that were poured are in the checkpoint.
    text = re.sub(r"^# Grains: poured.*?^(fix +move .*?$).*?(^unfix +progress$)", r"\1", text,
                  flags=re.M | re.S)
    return re.sub(r"^(run +\$\{\w+\})( upto)?$", r"\1 upto", text, flags=re.M)


def start(folder: Path, script: str) -> subprocess.Popen:
    (folder / "results").mkdir(parents=True, exist_ok=True)  # as inputs/run does
    (folder / "scene.lig").write_text(script)
    words = [part for name, value in zip(variables[::2], variables[1::2])
             for part in ("-var", name, value)]
    return subprocess.Popen([*launch, furrow, "-in", "scene.lig", "-log", "none", "-var", "results",
                             "results", *words], cwd=folder, stdin=subprocess.DEVNULL,
                            stdout=open(folder / "screen.txt", "w"), stderr=subprocess.STDOUT,
                            start_new_session=True)


def finish(folder: Path, script: str) -> None:
    if start(folder, script).wait(timeout=900) != 0:
        sys.exit(f"{folder.name} stopped:\n" + (folder / "screen.txt").read_text()[-3000:])


def kill_after_checkpoint(folder: Path, script: str) -> Path:
    """@return a checkpoint that was whole when the run was killed"""
    began = time.monotonic()
    run = start(folder, script)
    files = [folder / "ck.1", folder / "ck.2"]
    while not all(file.exists() for file in files) and run.poll() is None:
        time.sleep(0.01)
    time.sleep(random.uniform(0.0, 0.3) * (time.monotonic() - began))  # well before the end
    if run.poll() is not None:
        sys.exit("the run ended before it was killed:\n" + (folder / "screen.txt").read_text()[-2000:])
    os.killpg(run.pid, signal.SIGKILL)
    run.wait()
    return min(files, key=lambda file: file.stat().st_mtime)  # the other may be half written


def numbers(folder: Path) -> dict[str, np.ndarray]:
    """All arrays of the results files, by name."""
    found: dict[str, np.ndarray] = {}
    for path in sorted((folder / "results").glob("*.h5")):
        with h5py.File(path) as content:
            def collect(name: str, item: object) -> None:
                if isinstance(item, h5py.Dataset) and name.split("/")[0] in COMPARED:
                    found[f"{path.name}/{name}"] = item[()]
            content.visititems(collect)
    return found


seed = int.from_bytes(os.urandom(4), "little")
random.seed(seed)
print("seed", seed)
with tempfile.TemporaryDirectory() as name:
    whole, killed = Path(name) / "whole", Path(name) / "killed"
    finish(whole, whole_script())
    checkpoint = kill_after_checkpoint(killed, whole_script())
    finish(killed, continued_script(checkpoint))
    expected, got = numbers(whole), numbers(killed)
    if not expected or expected.keys() != got.keys():
        sys.exit(f"results differ in kind: {sorted(expected.keys() ^ got.keys())}")
    for item, values in expected.items():
        if not np.array_equal(values, got[item], equal_nan=True):
            at = np.shape(values), np.shape(got[item])
            difference = "" if at[0] != at[1] else f", by {np.nanmax(np.abs(values - got[item])):.3g}"
            sys.exit(f"{item} is not the same{difference} (shapes {at[0]}, {at[1]})")
    said = (killed / "screen.txt").read_text()
    print(len(expected), "arrays are the same;", re.findall(r"Reading restart file.*|WARNING.*", said)[:3])
