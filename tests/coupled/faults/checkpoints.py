# SPDX-License-Identifier: GPL-2.0-or-later
"""Checkpoints: written whole or not at all, and refused when they are not whole.

    checkpoints.py <furrow> <liggghts or nothing> [<mpirun -n>]
"""

import os
import random
import re
import shutil
import subprocess
import sys

from fault_table import CONTINUED, GRAINS, WHEEL, Table, run_script
from furrow_run import INPUTS, going, wait_until

WRITE = GRAINS + "run 10\nwrite_restart ck.10\n"
# Snow that settles under its weight: 1024 particles, whose place at the end is printed.
MATERIAL = INPUTS / "materials/fresh_snow.yaml"
SNOW_BOX = """units si
atom_style granular
atom_modify sort 0 0
newton off
communicate single vel yes
{box}
neighbor 0.05 bin
timestep 2e-4
"""
NEW_BOX = "processors 2 1 1\nregion box block -1 1 -1 1 -0.1 1 units box\ncreate_box 1 box"
SNOW = SNOW_BOX + (f"fix soil all terrain/continuum material {MATERIAL} length 0.4 width 0.2 depth 0.2 "
                   "surface 0.2 cell 0.05 initial_stress no\n")
END = 'variable left equal f_soil[1]\nvariable energy equal f_soil[3]\nprint "END ${left} ${energy}"\n'


def snow(furrow, table, tail, *, read=None, launcher=()):
    """Runs the snow from its start, or on from a checkpoint."""
    box = f"read_restart {read}" if read else NEW_BOX
    if not any("mpirun" in str(word) for word in launcher):
        box = box.replace("processors 2 1 1\n", "")
    return run_script(furrow, table.folder, SNOW.format(box=box) + tail, launcher=launcher)


def end_of(said):
    return re.findall(r"^END .*$", said.text, flags=re.M)


def particles(furrow, table, launcher=()):
    """The particles of terrain are in files of the ranks next to their restart file."""
    ranks = "two ranks" if launcher else "one rank"

    def check(name, said, status, *texts):
        table.check(f"particles, {ranks}: {name}", said, status, *texts)
        return said

    def continued(name, status, *texts, file="ck.snow"):
        return check(name, snow(furrow, table, "run 20 upto\n" + END, read=file, launcher=launcher), status, *texts)

    folder = table.folder / "ck.snow.particles"
    write = "run 10\nwrite_restart ck.snow\n"
    whole = end_of(check("without a break", snow(furrow, table, "run 20\n" + END, launcher=launcher), 0))
    check("written", snow(furrow, table, write, launcher=launcher), 0)
    first = sorted(folder.iterdir())
    table.expect(f"particles, {ranks}: a file for each rank", len(first) == (2 if launcher else 1), str(first))
    same = end_of(continued("continued", 0))
    table.expect(f"particles, {ranks}: continued bitwise", same == whole and whole, f"{same} is not {whole}")

    # A run that is killed before the restart file has its name leaves a part and files of another set.
    stale = [folder / "0123456789abcdef.soil.0", folder / "0123456789abcdef.soil.1.part"]
    for file in stale:
        file.write_bytes(b"cut short")
    same = end_of(continued("continued after a kill in the next checkpoint", 0))
    table.expect(f"particles, {ranks}: the former checkpoint survives a kill", same == whole, f"{same} is not {whole}")
    own = folder / "notes.txt"
    own.write_text("of the user")
    blocked = table.folder / "ck.blocked.particles"
    blocked.write_text("no folder")
    said = snow(furrow, table, "run 5\nwrite_restart ck.blocked\n", launcher=launcher)
    check("a file in the place of the folder", said, 1, ".soil.", "is not written", "ck.blocked.particles' cannot be made")
    table.expect(f"particles, {ranks}: no restart file without its particles", not (table.folder / "ck.blocked").exists(), "there is one")
    blocked.unlink()
    check("written again", snow(furrow, table, write, launcher=launcher), 0)
    left = set(folder.iterdir())
    table.expect(f"particles, {ranks}: files of other sets are removed",
                 len(left) == len(first) + 1 and own in left and not left & {*stale, *first}, str(left))

    files = sorted(left - {own})
    for file in files:
        bytes_of_file = file.read_bytes()
        file.unlink()
        continued(f"without file {file.name[-1]}", 1, "the checkpoint is incomplete", file.name, "No such file",
                  "keep the folder 'ck.snow.particles' next to the restart file")
        file.write_bytes(bytes_of_file[:5000] + bytes([bytes_of_file[5000] ^ 1]) + bytes_of_file[5001:])
        continued(f"a bit of file {file.name[-1]}", 1, "the checkpoint is incomplete", file.name, "is damaged")
        file.write_bytes(bytes_of_file)
    shutil.copy(table.folder / "ck.snow", table.folder / "ck.copy")
    continued("copied without its folder", 1, "the checkpoint is incomplete", "ck.copy.particles", file="ck.copy")
    shutil.copytree(folder, table.folder / "ck.copy.particles")
    continued("copied with its folder", 0, file="ck.copy")
    shutil.rmtree(table.folder / "ck.copy.particles")
    shutil.rmtree(folder)


def continued(furrow, table, file, launcher=(), mode=""):
    return run_script(furrow, table.folder, CONTINUED.format(file=f"{file} {mode}") + "run 5\n", launcher=launcher)


def damaged(furrow, table):
    whole = (table.folder / "ck.10").read_bytes()
    file = table.folder / "damaged"
    lengths = [0, 1, 8, 50, 68, 69, 100, 300, 1000, len(whole) // 2, len(whole) - 70, len(whole) - 69, len(whole) - 1]
    for length in lengths:
        file.write_bytes(whole[:length])
        table.check(f"cut to {length}", continued(furrow, table, "damaged"), 1, "checkpoint 'damaged'", "line 3: read_restart")
    for length in lengths[:-3]:  # no hang where LIGGGHTS's own reader is left alone
        file.write_bytes(whole[:length])
        table.check(f"cut to {length}, unchecked", continued(furrow, table, "damaged", mode="unchecked"), 1, "ERROR: ")
    for place in (0, 5, 30, 200, 700, len(whole) // 2, len(whole) - 100, len(whole) - 5):
        file.write_bytes(whole[:place] + bytes([whole[place] ^ 4]) + whole[place + 1:])
        table.check(f"bit of byte {place}", continued(furrow, table, "damaged"), 1, "checkpoint 'damaged'")
    file.write_bytes(random.Random(1).randbytes(5000))
    table.check("random bytes", continued(furrow, table, "damaged"), 1, "is no restart file")
    file.write_bytes(whole + whole)
    table.check("twice in one file", continued(furrow, table, "damaged"), 1, "checkpoint 'damaged'")


def belongs_together(furrow, table):
    """The states of a checkpoint find the lines that they belong to."""
    folder, renamed = table.folder, WHEEL.replace("fix wheel ", "fix other ")
    mesh = ("fix skin all mesh/body body wheel type 1\n"
            "fix tread all wall/gran/body model hertz tangential history mesh n_meshes 1 meshes skin\n")
    friction = "coefficientFriction peratomtypepair 1 0.5"
    restitution = "coefficientRestitution peratomtypepair 1 0.3"
    states = "the checkpoint has states of Furrow's fixes"
    table.check("with a wheel", run_script(furrow, folder, GRAINS + WHEEL + "run 10\nwrite_restart ck\n"), 0)
    for name, lines, status, texts in (
            ("continued", WHEEL + "run 5\n", 0, []),
            ("without the wheel", "run 5\n", 1, [states]),
            ("a run before the wheel", "run 0\n" + WHEEL + "run 5\n", 1, [states]),
            ("the wheel renamed", renamed + "run 5\n", 1, ["has the state of fix wheel/rigid 'wheel'"]),
            ("another wheel", WHEEL.replace("0.04", "0.05") + "run 5\n", 1, ["keyword 'diameter' is '0.05', and was '0.04'"])):
        script = CONTINUED.format(file="ck") + lines
        table.check(f"with a wheel: {name}", run_script(furrow, folder, script), status, *texts)
    table.check("with a mesh", run_script(furrow, folder, GRAINS + WHEEL + mesh + "run 10\nwrite_restart ck.mesh\n"), 0)
    whole = CONTINUED.format(file="ck.mesh") + WHEEL + mesh + "run 5\n"
    changed = "and was 0.5 when the checkpoint was written"
    for name, script, status, texts, absent in (
            ("continued", whole, 0, [], ["other grains"]),
            ("the mesh renamed", whole.replace("skin", "tyre"), 1, ["has the state of fix mesh/body 'skin'"], []),
            ("another friction", whole.replace(friction, friction[:-3] + "0.9"), 0,
             [f"WARNING: fix property/global 'm4' is 0.9, {changed}"], ["'m3'"]),
            ("another restitution", whole.replace(restitution, restitution[:-3] + "0.4"), 0,
             ["WARNING: fix property/global 'm3' is 0.4, and was 0.3"], ["'m4'"])):
        table.check(f"with a mesh: {name}", run_script(furrow, folder, script), status, *texts, absent=absent)
    rig = "fix rig all wheel/rig wheel wheel load_force 5 speed 0.1 mode towed ground_level 0.12 settle_time 1 accelerate_time 1\n"
    table.check("with a rig", run_script(furrow, folder, GRAINS + WHEEL + rig + "run 10\nwrite_restart ck.rig\n"), 0)
    whole = CONTINUED.format(file="ck.rig") + WHEEL + rig + "run 5\n"
    for name, script, texts, absent in (
            ("continued", whole, [], ["checkpoint was written"]),
            ("another load", whole.replace("load_force 5", "load_force 6"),
             ["WARNING: fix wheel/rig 'rig', keyword 'load_force' is 6, and was 5 when the checkpoint was written"],
             ["'speed'"]),
            ("no line", whole.replace(rig, ""),
             ["WARNING: the run of the checkpoint had fix wheel/rig 'rig', and the script that continues has no"], [])):
        table.check(f"with a rig: {name}", run_script(furrow, folder, script), 0, *texts, absent=absent)
    targets = table.folder / "targets.csv"
    targets.write_text("time,slip\n0,0\n1,0.2\n")
    by_table = rig.replace("mode towed", "mode slip table targets.csv")
    table.check("with targets", run_script(furrow, folder, GRAINS + WHEEL + by_table + "run 10\nwrite_restart ck.targets\n"), 0)
    whole = CONTINUED.format(file="ck.targets") + WHEEL + by_table + "run 5\n"
    table.check("with targets: continued", run_script(furrow, folder, whole), 0, absent=["checkpoint was written"])
    targets.write_text("time,slip\n0,0\n1,0.3\n")
    table.check("with targets: another table", run_script(furrow, folder, whole), 0,
                "WARNING: fix wheel/rig 'rig', keyword 'table' is targets.csv with checksum", "and was targets.csv with checksum")
    grains = CONTINUED.format(file="ck unchecked") + "run 5\n"
    table.check("with a wheel: grains alone", run_script(furrow, folder, grains), 0)


def full_disk(furrow, table, mpirun):
    """On a small disk, where the system lets a user mount one."""

    def disk(size, *, twice=False):
        """@param twice  the second time must fail; then the file left.txt lists what is on the disk"""
        mount = f"mount -t tmpfs -o size={size} none small"
        if twice:
            mount += (' && "$@" > /dev/null && cp small/ck former; "$@"; status=$?; '
                      "cmp small/ck former && (cd small; find . -type f) > left.txt; exit $status")
        else:
            mount += ' && exec "$@"'
        return ["unshare", "--user", "--map-root-user", "--mount", "sh", "-c", mount, "sh"]

    (table.folder / "small").mkdir()
    left = table.folder / "left.txt"
    if subprocess.run([*disk("64k"), "true"], cwd=table.folder, stderr=subprocess.DEVNULL, check=False).returncode != 0:
        print("left out: no disk can be mounted here")
        return
    room = GRAINS + WHEEL + "restart 100 {0}/ck.1 {0}/ck.2\nrun 10\n"
    for name, launcher in (("one rank", []), ("two ranks", [*mpirun, 2])):
        said = run_script(furrow, table.folder, room.format("small"), launcher=[*disk("64k"), *launcher])
        table.check(f"no room for checkpoints, {name}", said, 1, "restart writes checkpoints of", "GB on the disk, and",
                    "name files on another disk than that of 'small/ck.1'")
    table.check("room for checkpoints", run_script(furrow, table.folder, room.format(".")), 0)
    said = run_script(furrow, table.folder, GRAINS + "run 10\nwrite_restart small/ck\n", launcher=disk("120k", twice=True))
    table.check("a full disk", said, 1, "'small/ck' is not written", "No space left on device", "write_restart small/ck")
    table.expect("a full disk: the former checkpoint stays alone", left.read_text() == "./ck\n", left.read_text())
    left.unlink()
    for name, launcher in (("one rank", []), ("two ranks", [*mpirun, 2])):
        said = snow(furrow, table, "run 5\nwrite_restart small/ck\n", launcher=[*disk("700k", twice=True), *launcher])
        table.check(f"a full disk, particles, {name}", said, 1, ".soil.", "is not written", "No space left on device")
        files = left.read_text().split()
        table.expect(f"a full disk, particles, {name}: the former checkpoint stays alone",
                     len(files) == (3 if launcher else 2), str(files))
        left.unlink()


def one_run_for_a_name(furrow, table):
    """A second run that would replace the checkpoints of one that goes on."""
    script = GRAINS + WHEEL + "restart 50 {0}.1 {0}.2\nrun {1}\n"
    (table.folder / "first.lig").write_text(script.format("same", 100000000))
    with going([furrow, "-in", "first.lig", "-log", "none"], table.folder) as first:
        wait_until((table.folder / "same.2").exists, first)
        second = run_script(furrow, table.folder, script.format("same", 200))
        table.check("a name of another run", second, 1, "restart names 'same.",
                    "', to which another run writes its checkpoints", "name other files, or wait until that run has ended")
        table.check("another name beside it", run_script(furrow, table.folder, script.format("other", 200)), 0)
        check = continued(furrow, table, "same.1", mode="unchecked")
        table.check("checkpoint of a run that goes on is read", check, 0)
    table.check("the name of a run that was killed", run_script(furrow, table.folder, script.format("same", 200)), 0)


def main(furrow, liggghts, *mpirun):
    table = Table()
    table.check("written", run_script(furrow, table.folder, WRITE), 0)
    table.check("continued", continued(furrow, table, "ck.10"), 0)
    table.check("continued, latest", continued(furrow, table, "ck.*"), 0)
    table.check("continued on two ranks", continued(furrow, table, "ck.10", [*mpirun, 2]), 0)
    table.check("missing", continued(furrow, table, "nofile"), 1, "'nofile' cannot be read: No such file")
    table.check("missing, two ranks", continued(furrow, table, "nofile", [*mpirun, 2]), 1, "'nofile' cannot be read")
    table.check("no match", continued(furrow, table, "no.*"), 1, "'no.*' matches no file")
    table.check("folder", continued(furrow, table, "/tmp"), 1, "is a folder")
    table.check("device", continued(furrow, table, "/dev/zero"), 1, "is no regular file")
    table.check("script", continued(furrow, table, "script.lig"), 1, "is no restart file")
    table.check("unknown word", continued(furrow, table, "ck.10", mode="fast"), 1, "checked, unchecked")
    table.check("after the box", run_script(furrow, table.folder, GRAINS + "read_restart ck.10\n"), 1,
                "comes after the simulation box was made")
    damaged(furrow, table)
    belongs_together(furrow, table)
    particles(furrow, table)
    particles(furrow, table, [*mpirun, 2])
    if os.path.exists(liggghts):
        folder = table.folder
        stock = run_script(liggghts, folder, WRITE.replace("ck.10", "stock"))
        table.check("stock LIGGGHTS writes", stock, 0)
        table.check("stock file", continued(furrow, table, "stock"), 1, "stock LIGGGHTS", "'read_restart stock unchecked'")
        table.check("stock file, unchecked", continued(furrow, table, "stock", mode="unchecked"), 0)
        table.check("stock LIGGGHTS reads", continued(liggghts, table, "ck.10"), 0)

    # a checkpoint that cannot be written leaves the last good file
    def write(name, prepare=lambda: None):
        prepare()
        return run_script(furrow, table.folder, GRAINS + f"run 10\nwrite_restart {name}\n")

    good = (table.folder / "ck.10").read_bytes()
    part = table.folder / "ck.10.part"
    part.write_bytes(b"left by a kill")
    table.check("a part that a kill has left", write("ck.10"), 0)
    table.expect("a part that a kill has left: is replaced", (table.folder / "ck.10").read_bytes() == good and not part.exists(), "it stays")
    notes = table.folder / "notes"
    notes.write_text("of the user")
    table.check("a link in the place of the part", write("ck.10", lambda: part.symlink_to("notes")), 0)
    table.expect("a link in the place of the part: not followed", notes.read_text() == "of the user", "it was")
    frame = table.folder / "frame.20"
    frame.symlink_to("/dev/full")
    table.check("disk full, a dump with a file for each step",
                run_script(furrow, table.folder, GRAINS + "dump d all custom 20 frame.* id x\nrun 100\n"), 1,
                "dump 'd', file frame.*: No space left on device")
    full_disk(furrow, table, mpirun)
    one_run_for_a_name(furrow, table)
    table.check("folder in its place", write(".", lambda: None), 1, "is a folder; allowed: a file")
    table.check("folder cannot be made", write("/proc/no/ck"), 1, "its folder '/proc/no' cannot be made")
    table.check("file for each rank", write("ck.%"), 1, "one file per rank")
    table.check("new folder", write("new/deep/ck"), 0)
    table.expect("new folder: the file is there", (table.folder / "new/deep/ck").exists(), "missing")
    table.end()


if __name__ == "__main__":
    main(*sys.argv[1:])
