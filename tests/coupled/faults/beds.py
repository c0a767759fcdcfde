# SPDX-License-Identifier: GPL-2.0-or-later
"""Beds that cannot be, beds that did not become one, and kept beds that are damaged.

    beds.py <furrow> <inputs/beds> [<mpirun -n>]
"""

import os
import re
import shutil
import signal
import sys
import time

from fault_table import WHEEL, Said, Table, run_script
from furrow_run import going, wait_until

SAND = {"length": "0.16", "width": "0.08", "depth": "0.03", "clearance_above": "0.05", "diameter": "0.014", "density": "2600",
        "young": "5e6", "poisson": "0.25", "restitution": "0.3", "friction": "0.6", "rolling": "0.15", "pour_friction": "0.3",
        "step": "1e-4", "seed": "86028121"}
SNOW = {"length": "0.3", "closed": "0", "width": "0.3", "depth": "0.1", "clearance_above": "0.1", "diameter": "0.03", "bulk": "165",
        "density": "700", "stiffness": "3.12e6", "strength": "5.55e3", "unloading": "3", "plasticity": "0.226",
        "adhesion": "0.5", "friction": "0.5", "rolling": "0.2", "restitution": "0.1", "step": "1e-5", "seed": "86028121"}
AFTER = ("fix m4 all property/global coefficientFriction peratomtypepair 2 0.6 0.5 0.5 0.5\nrun 0\n"
         'print "LEVEL ${bed_level}"\n')

# values that a parameter may not have, and the error; wording.py has those of another type and out of range
SAND_VALUES = [
    ("density", "inf", "keyword 'density' is inf; allowed: a number > 0"),
    ("seed", "20000", "prime number"),  # LIGGGHTS's own word
    ("diameter", "1", "keyword 'length' is 0.16 m; allowed: at least 2 grains of diameter 1 m"),
    ("depth", "0.004", "'depth' is 0.004 m; allowed: at least 2 grains"),
    ("width", "0.02", "'width' is 0.02 m; allowed: at least 2 grains"),
    ("diameter", "1e-5", "which this machine has free"),
    ("step", "5e-4", "of the Rayleigh time of the smallest grain"),
    ("step", "1", "of the Rayleigh time of the smallest grain"),
    ("from", "nofile", "checkpoint 'nofile' cannot be read"),
]


def line(script, parameters):
    return f"bed {script} " + " ".join(f"{name} {value}" for name, value in parameters.items())


def refused(furrow, table, beds):
    def bed(words):
        return run_script(furrow, table.folder, words + "\n" + AFTER, FURROW_CACHE="cache")

    sand, snow = beds + "/sand.lig", beds + "/snow.lig"
    for name, value, text in SAND_VALUES:
        table.check(f"{name} {value}", bed(line(sand, {**SAND, name: value})), 1, text, ", line 1: ")
    table.check("snow, step 1e-3", bed(line(snow, {**SNOW, "step": "1e-3"})), 1, "of half a period of a contact")
    for name in ("friction", "seed", "clearance_above"):
        rest = {key: value for key, value in SAND.items() if key != name}
        table.check(f"without {name}", bed(line(sand, rest)), 1, f"keyword '{name}' is missing", "it is: ")
    whole = line(sand, SAND)
    table.check("folder", bed("bed . depth 0.1"), 1, "cannot read")
    average = "\nvariable one equal 1\nfix curve all ave/time 1 10 10 v_one"
    table.check("average after the bed", bed(whole + average), 0, "LEVEL")
    misspelled = run_script(furrow, table.folder, whole + "\nfix soil all terrain/continum depth 1", FURROW_CACHE="new")
    table.check("no such style after the bed", misspelled, 1, "before the bed is made: fix style 'terrain/continum' does not exist")
    clay = os.path.join(beds, "..", "materials", "contact", "clay_soft.yaml")
    table.check("adhesion to grains", bed(f"{whole} contact {clay}"), 0, "WARNING: command bed, keyword 'contact': the shear_limit that",
                "has for rubber and steel has no effect on grains")
    for cache in ("/dev/null", "/proc/x"):
        said = run_script(furrow, table.folder, whole, FURROW_CACHE=cache)
        table.check(f"cache {cache}", said, 1, f"the folder for beds, '{cache}', cannot be used", "FURROW_CACHE")


def reliefs(furrow, table, beds):
    """Surfaces that a bed cannot have, and those that its grains hardly show."""
    def bed(words, script="sand"):
        return run_script(furrow, table.folder, line(f"{beds}/{script}.lig", SAND) + words + "\n" + AFTER, FURROW_CACHE="cache")

    def refused(name, words, *texts, script="sand"):
        table.check(name, bed(words, script), 1, *texts, ", line 1: ")

    refused("deeper than the bed", " washboard 0.16 0.02", "keyword 'depth' is 0.03 m, and the relief goes down 0.0",
            "at least 2 grains of diameter 0.014 m below the relief: 0.0")
    refused("a washboard without amplitude", " washboard 0.16", "'washboard'", "every parameter of the bed needs a value")
    refused("an unknown class", " road_class K", "keyword 'road_class'", "A, B, C, D, E, F, G, H")
    refused("two densities", " road_class C roughness 1e-6", "keyword 'road_class' is given with 'roughness'")
    refused("no map", " heightmap nowhere.asc", "nowhere.asc", "does not exist")
    (table.folder / "small.asc").write_text("0 0 0\n0.1 0 0\n0 0.1 0\n0.1 0.1 0\n")
    refused("a small map", " heightmap small.asc", "does not cover x = -0.08, y = -0.04 m", "heightmap_origin")
    refused("a step at the period", " trapezoid 0.08 0.03 0.02 0.06", "closes on itself along x, where its relief has a step of 0.0",
            "within a grain of 0.014 m", script="sand_window")
    with open(beds + "/sand.lig") as file:
        text = file.read()
    (table.folder / "own.lig").write_text(text.replace("#: levelled\n", ""))
    said = run_script(furrow, table.folder, line("own.lig", SAND) + " washboard 0.08 0.001\n" + AFTER, FURROW_CACHE="cache")
    table.check("a script that levels", said, 1, "own.lig' levels the bed by itself", "${bed_highest}", "'#: levelled'", ", line 1: bed")
    fine = "of the relief's rms height is finer than a grain of 0.014 m (recommended: at most 10 %)"
    low = "the relief is 0.002 m high, 0.14 grains (recommended: at least 1)"
    steep = "grains (recommended: at most 1); steep parts have slumped"
    table.check("waves of one grain", bed(" washboard 0.014 0.001"), 0, f"WARNING: command bed: 100 % {fine}", f"WARNING: command bed: {low}")
    table.check("steep walls", bed(" trapezoid 0 0.08 0.05 0.0501"), 0, steep)


def own_scripts(furrow, table, beds):
    """Bed scripts of a user, whose parameters are those that they read."""
    with open(beds + "/sand.lig") as file:
        text = file.read()
    plain = re.sub(r"#: parameters\n(#.*\n)*", "", text)
    cases = [("without declarations, unknown", plain, " colour red", "has no keyword 'colour'"),
             ("without declarations, missing", plain.replace("${bed_seed}", "${bed_seed}${bed_other}"), "", "keyword 'other' is missing"),
             ("no section settle", plain.replace("#: settle", "# settle"), "", "finds no line '#: settle'"),
             ("a jump", plain.replace("pair_coeff", "jump SELF\npair_coeff"), "", "the command 'jump' in its section 'contact'"),
             ("a range", text.replace("> 0 ", "=> 0", 1), "", "the range '=> 0'"),
             ("a row", text.replace("# length ", "#length ", 1), "", "the line '#length"),
             # gravity upwards: the grains leave the bed's place, and nothing is kept
             ("explodes", plain.replace("vector 0 0 -1", "vector 0 0 1"), "", "ERROR")]
    for name, script, words, message in cases:
        (table.folder / "own.lig").write_text(script)
        said = run_script(furrow, table.folder, line("own.lig", SAND) + words + "\n" + AFTER, FURROW_CACHE="own")
        table.check(name, said, 1, message)
    kept = list((table.folder / "own").glob("bed-*"))
    table.expect("nothing is kept of them", not kept, kept)


def kept(furrow, table, beds):
    """A damaged kept bed is made again, with a warning; a whole one is read."""
    script = line(beds + "/sand.lig", SAND) + "\n" + AFTER

    def start(launcher=()):
        return run_script(furrow, table.folder, script, launcher=launcher, FURROW_CACHE="cache of beds")

    making, again = "Making the bed", "; it is made again"
    first = start()
    table.check("made", first, 0, making, "LEVEL", absent=[again])
    level = re.search("LEVEL .*", first.text).group()
    table.check("read", start(), 0, level, absent=[making])
    folder, = (table.folder / "cache of beds").glob("bed-*")
    table.expect("two files", sorted(path.name for path in folder.iterdir()) == ["bed.restart", "facts.txt"], list(folder.iterdir()))
    for name in ("bed.restart", "facts.txt"):
        file = folder / name
        whole = file.read_bytes()
        damages = {"empty": b"", "cut": whole[:-100], "bit": whole[:99] + bytes([whole[99] ^ 8]) + whole[100:]}
        for damage, content in damages.items():
            if name == "facts.txt" and damage == "empty":
                file.unlink()
            else:
                file.write_bytes(content)
            table.check(f"{name}, {damage}", start(), 0, f"{name}' ", again, making, level)
    table.check("read after all", start(), 0, level, absent=[making])

    def wheel(change, end=""):
        lines = (line(beds + "/sand.lig", {**SAND, **change}), AFTER.replace("run 0", "fix move all nve/sphere"), WHEEL, "run 5", end)
        return run_script(furrow, table.folder, "\n".join(lines), FURROW_CACHE="cache of beds")

    table.check("a run on it", wheel({}, "write_restart ck\n"), 0)
    table.check("continued", wheel({"from": "ck"}), 0, absent=[making])
    table.check("continued on another bed", wheel({"from": "ck", "friction": "0.5"}), 1, "the parameters of the bed", "friction 0.6")


def gravity(furrow, table, beds):
    """Another gravity is another bed. Bed, fix gravity and rig have the same one."""
    moon = "unfix weight\nfix weight all gravity 1.62 vector 0 0 -1\n"
    towed = (WHEEL + "fix rig all wheel/rig wheel wheel load_mass 1 gravity 1.62 speed 0.1 mode towed settle_time 0.1 "
             "accelerate_time 0.1 ground_level 0.03\n")

    def start(words, lines=""):
        after = AFTER.replace("run 0", lines + "fix move all nve/sphere\nrun 1")
        return run_script(furrow, table.folder, line(beds + "/sand.lig", SAND) + words + "\n" + after, FURROW_CACHE="planets")

    making, both = "Making the bed", "{} is 1.62 m/s^2, and command bed, keyword 'gravity' is 9.807 m/s^2"
    table.check("Earth", start(""), 0, making)
    table.check("Earth, written", start(" gravity 9.80665"), 0, absent=[making])
    table.check("Moon", start(" gravity 1.62"), 0, making)
    table.check("Moon, kept, with its weight", start(" gravity 1.62", moon), 0, absent=[making])
    table.check("Moon, with a rig", start(" gravity 1.62", towed), 0)
    table.check("weight of the Moon on a bed of the Earth", start("", WHEEL + moon), 1, both.format("fix gravity 'weight'"))
    table.check("rig of the Moon on a bed of the Earth", start("", towed), 1, both.format("fix wheel/rig, keyword 'gravity'"))


def foreign(furrow, table, beds):
    """A kept bed that another user may have changed is refused."""
    script = line(beds + "/sand.lig", SAND) + "\n" + AFTER

    def start():
        return run_script(furrow, table.folder, script, FURROW_CACHE="foreign")

    def refused(name, reason, path):
        table.check(name, start(), 1, f"command bed: '{path.relative_to(table.folder)}' {reason}", "FURROW_CACHE")

    table.check("own", start(), 0)
    cache = table.folder / "foreign"
    folder, = cache.glob("bed-*")
    for path in (cache, folder, folder / "bed.restart", folder / "facts.txt"):
        mode = path.stat().st_mode
        path.chmod(mode | 0o002)
        refused(f"{path.name}, written by all", "may be written by all users", path)
        path.chmod(mode)
        if os.geteuid() == 0:
            os.chown(path, 12345, -1)
            refused(f"{path.name}, of another user", "belongs to the user with number 12345", path)
            os.chown(path, 0, -1)
    for path in (folder, folder / "bed.restart"):
        moved = table.folder / "moved"
        path.rename(moved)
        path.symlink_to(moved)
        refused(f"{path.name}, a link", "is a link", path)
        path.unlink()
        moved.rename(path)
    table.check("own again", start(), 0, absent=["Making the bed"])
    shutil.rmtree(folder)
    elsewhere = table.folder / "elsewhere"
    elsewhere.mkdir()
    link = f'ln -s "{elsewhere}" "{folder}.part$$"; exec "$@"'  # the name under which it is made
    table.check("part, a link", run_script(furrow, table.folder, script, launcher=["bash", "-c", link, "bash"], FURROW_CACHE="foreign"), 0)
    table.expect("nothing is written through it", not list(elsewhere.iterdir()), list(elsewhere.iterdir()))


def interrupted(furrow, table, beds):
    """LIGGGHTS takes a signal as a request for a checkpoint and continues with the script, so that without precautions
    the grains would be kept as they fell."""
    large = {**SAND, "length": "0.4", "width": "0.2", "depth": "0.1", "diameter": "0.008", "step": "5e-5"}
    (table.folder / "script.lig").write_text(f"processors 1 * 1\n{line(beds + '/sand.lig', large)}\nrun 0\n")
    cache = table.folder / "interrupted"
    with going([furrow, "-in", "script.lig", "-log", "none"], table.folder, FURROW_CACHE=str(cache)) as run:
        wait_until(cache.exists, run)
        time.sleep(1.0)  # into the pouring, which takes several seconds
        table.expect("the bed is not made before the signal", run.poll() is None, run.poll())
        run.send_signal(signal.SIGTERM)
        said = Said(run.wait(120), (table.folder / "said").read_text())
    table.check("a signal while a bed is made", said, 143, "command bed was interrupted while it made the bed, which is not kept")
    table.expect("nothing is kept of it", not list(cache.iterdir()), list(cache.iterdir()))


def main(furrow, beds, *mpirun):
    table = Table()
    interrupted(furrow, table, beds)
    gravity(furrow, table, beds)
    foreign(furrow, table, beds)
    refused(furrow, table, beds)
    reliefs(furrow, table, beds)
    own_scripts(furrow, table, beds)
    kept(furrow, table, beds)
    table.end()


if __name__ == "__main__":
    main(*sys.argv[1:])
