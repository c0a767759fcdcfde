# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs the small version of a scene or laboratory test, as a user would, and checks the result.

    scene_test.py scene <script> <ranks> <results>     bash inputs/run <script> --quick
    scene_test.py two_grounds <results>                bash inputs/run --quick: two scenes and their report
    scene_test.py laboratory <script> <results>        inputs/laboratory/run.py, for a test or a ground
    scene_test.py sweep <results>                      the page of sweeps, one of them killed and resumed
    scene_test.py until_steady <results>               a run that goes on until it is steady
    scene_test.py error <results>                      plans for an error and for a time, and what limits them
    scene_test.py material <results>                   a scene over the standard errors of its soil card, and a later run that takes them
    scene_test.py answer <results>                     a tyre on clay, from its size and a cone index
    scene_test.py converge <results>                   two sizes of a scene, and a later run that takes their error
    scene_test.py usage                                the list of scenes

The head of a script states what is run and what must come out, in SI units:

    # Quick:    -v cell 0.05 -v distance 0.6
    # Gives:    hub drop 0.15 to 0.17 m, resistance coefficient 0.16 to 0.20

A scene's quantities are those of summary.json (means over the cruise of a wheel; of a further
wheel, whose folder is within the first one's, with the name of the folder before), of its history
("<channel> at the end", underscores as spaces: the last twentieth), of curve.txt (a plate) and of
the continuum's history; those of a laboratory test are in laboratory.json. Every run must also keep
its energies and momenta.
"""

import json
import re
import shlex
import shutil
import sys
from pathlib import Path

import numpy as np

from head import Head
from quantities import check_pictures, continuum_quantities, plate_quantities, wheel_quantities

PROJECT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(PROJECT / "postproc"), *(str(PROJECT / "tests" / room / "support") for room in (".", "coupled"))]
from furrow_run import columns, going, wait_until
from furrow_run import run as start
from furrow_post.cli.main import main as post
from furrow_post.run.script import script_variables
from furrow_post.scene.catalogue import GROUPS, head_entry
from furrow_post.scene.restart import continuation

SCENES = PROJECT / "inputs" / "scenes"
LABORATORY = PROJECT / "inputs" / "laboratory"
BLANKS = "Lauf mit Größe"  # name of a results folder: LIGGGHTS splits lines at blanks


def run(command, status=0, folder=None, **environment):
    """Output of a command that ends with this status; else the test ends with it. folder: where it
    is started"""
    print("+", shlex.join(map(str, command)), flush=True)
    said = start(command, folder, None, **environment)
    assert said.status == status, f"{said.text}\nended with status {said.status} instead of {status}"
    return said.text


def inputs_run(*words, status=0, **environment):
    return run(["bash", PROJECT / "inputs" / "run", "--no-build", *words], status, **environment)


def empty(folder):
    shutil.rmtree(folder, ignore_errors=True)
    Path(folder).mkdir(parents=True)
    return Path(folder)


def check_scene(script, folder, drawn=True):
    found = continuum_quantities(folder)
    if (folder / "history.h5").is_file():
        found.update(wheel_quantities(folder))
        check_pictures(folder, drawn)
    if (folder / "curve.txt").is_file():
        found.update(plate_quantities(folder))
    Head(script).check(found)


# One scene is drawn of each kind of body and ground: drawing takes longer than most quick runs.
DRAWN = ("grains_on_continuum", "rover_wheel_mesh", "two_axles", "tyre_on_continuum", "tyre_on_plane",
         "wheel_climbs_slope", "wheel_on_sand", "wheel_on_scm", "wheel_on_washboard")


def scene(script, ranks, results):
    folder, drawn = empty(results), Path(script).stem in DRAWN
    # A separate cache: the bed is made, not read.
    said = inputs_run(script, "--quick", "-n", ranks, "-o", folder / BLANKS, *([] if drawn else ["--no-pictures"]),
                      FURROW_CACHE=str(folder / "cache"))
    check_scene(script, folder / BLANKS, drawn)
    if (folder / BLANKS / "history.h5").is_file():
        check_verdict(folder / BLANKS, said)


def check_verdict(folder, said):
    """One short line ends the screen, of inputs/run and of furrow; the summary has its values under their names."""
    verdict = json.loads((folder / "summary.json").read_text())["verdict"]
    summary = (folder / "summary.txt").read_text()
    screen = (folder / "screen.txt").read_text()
    for text in (said, screen):
        last = text.rstrip().splitlines()[-1]
        if not last.startswith("Verdict: ") or len(last) > 100:
            sys.exit(f"the last line is no verdict of at most 100 characters: '{last}'\n{text}")
    if f"\nVerdict: {verdict}\n" not in screen.rpartition("Loop time")[2]:  # of several wheels not the last one
        sys.exit(f"LIGGGHTS hides '{verdict}':\n{screen}")
    check_errors(folder, said)
    for name in re.findall(r", ([a-z ]+) -?\d", verdict.partition(";")[0]):
        assert f"\n  {name} " in summary, f"the verdict names '{name}', which the summary does not list:\n{summary}"


def check_errors(folder, said):
    """No error on the screen is smaller than the known parts that budget.json has of it."""
    if not (folder / "budget.json").is_file():  # a run without steady values
        return
    for name, quantity in json.loads((folder / "budget.json").read_text()).items():
        factor = {"m": 1e3, "": 100 if name == "slip" else 1}.get(quantity["unit"], 1)
        whole = factor * sum((part or 0) ** 2 for part in quantity["parts"].values()) ** 0.5
        for shown in re.findall(rf"^ +{name.replace('_', ' ')} +\S+ ± (\S+)", said, re.MULTILINE):
            if float(shown) < 0.8 * whole:  # rounding: 2 of 2.49
                sys.exit(f"{name} is shown with ± {shown}, and its known parts are {whole:.3g}:\n{said}")
    assert re.search(r"^  hub drop +\S+ ", said, re.MULTILINE), f"the screen has no hub drop with its error:\n{said}"


def two_grounds(results):
    folder = empty(results)
    comparison = inputs_run("--quick", "-o", folder / "run", FURROW_CACHE=str(folder / "cache"))
    check_scene(SCENES / "tyre_on_snow.lig", folder / "run" / "tyre")
    check_scene(SCENES / "wheel_on_snow.lig", folder / "run" / "continuum")
    check_scene(SCENES / "wheel_on_sintered_snow.lig", folder / "run" / "grains")
    for report, words in (("report.html", ("continuum", "grains", "hub drop")),
                          ("measured/report.html", ("fitted", "predicted", "measured", "NRMM"))):
        text = (folder / "run" / report).read_text()
        for word in words:
            for where, found in (("comparison", comparison), (report, text)):
                assert word in found, f"the {where} does not name '{word}':\n{found}"


def laboratory(script, results):
    head, folder = Head(script), empty(results)
    if head.script.parent == LABORATORY:
        words = [head.script.stem, *head.quick]
    else:
        words = [*head.quick, "--ground", head.script.stem]
    run([sys.executable, LABORATORY / "run.py", *words, "-o", folder / BLANKS], FURROW_CACHE=str(folder / "cache"))
    quantities = json.loads((folder / BLANKS / "laboratory.json").read_text())["quantities"]
    head.check({name.replace("_", " "): (quantity["value"], quantity["unit"]) for name, quantity in quantities.items()})


PAGE = PROJECT / "inputs" / "sweep" / "README.md"


def commands_of_page():
    """Commands of its code blocks as lists of words; paths below the project are absolute."""
    def word(text):
        return str(PROJECT / text) if text.startswith(("inputs/", "postproc/")) else text

    blocks = re.findall(r"```\n(.*?)```", PAGE.read_text(), re.DOTALL)
    lines = [block.replace("\\\n", " ").splitlines() for block in blocks]
    commands = [[shlex.split(line, comments=True) for line in block] for block in lines]
    return [[[word(text) for text in words] for words in block if words] for block in commands]


def records(folder):
    """Folder of each point that has ended -> when its run was started."""
    return {path.parent.name: json.loads(path.read_text())["started"] for path in folder.glob("*/run.json")}


def sweep(results):
    """The first block of the page is run, its first command killed in the middle and begun again;
    the commands of the others are checked."""
    folder = empty(results)
    blocks = commands_of_page()
    (first, *others), *checked = blocks
    out = folder / first[first.index("-o") + 1]
    first.insert(2, "--no-build")
    print("+", shlex.join(first), "(killed)", flush=True)
    # inputs/run becomes the driver, which is killed with no chance to clean up
    with going(first, folder) as begun:
        wait_until(lambda: records(out), begun, 120)
        assert records(out) and begun.poll() is None, f"no point of {out} has ended before the others"
    before = records(out)
    said = run(first, folder=folder)
    after = records(out)
    plan = json.loads((out / "sweep.json").read_text())
    if set(after) != {point["folder"] for point in plan["points"]} or not len(before) < len(after):
        sys.exit(f"{len(before)} points had ended before the kill, {len(after)} after the second start")
    changed = [name for name in before if before[name] != after[name]]
    assert not changed and f"{len(before)} of them are there" in said, f"made again after the kill: {changed}\n{said}"
    for words in others:
        run(words, folder=folder)
    for name in ("sweep.csv", "sweep.h5", "sweep.png", "report.html"):
        assert (out / name).stat().st_size, f"{out / name} is empty"
    found = columns(out / "sweep.h5", "/")
    pull, slip = found["net_traction_coefficient"], found["set_slip"]
    assert np.all(np.diff(pull[np.argsort(slip)]) > 0), f"the pull does not grow with the slip: {pull} at {slip}"
    (folder / "tests.csv").write_text("slip_percent,net_traction_coefficient\n10,0.2\n")
    for words in (words for block in checked for words in block):
        check_command(words, folder)


def check_command(words, folder):
    """A command of the page that takes too long to be run, in a copy of this process."""
    from copied import run_both  # imports matplotlib, which other tests here do not need

    program, *rest = words[1:] if words[0] == "bash" else words
    is_run = program == str(PROJECT / "inputs" / "run")  # which becomes furrow-post run
    given = ["run", "--no-build", *rest, "--check"] if is_run else rest
    print("+", shlex.join(given), flush=True)
    done = run_both(post, [PROJECT / "postproc" / "furrow-post", *given], folder)
    # the options of the others are right, the results are not there
    if done.returncode != (0 if is_run else 1) or not is_run and "is no folder" not in done.stderr:
        sys.exit(f"{PAGE}: '{shlex.join(words)}' says\n{done.stdout}{done.stderr}")


def until_steady(results):
    """A short roll is not steady; it goes on until it is, or says why it does not."""
    folder = empty(results)
    words = ["tyre_on_plane", "--quick", "-o", folder / BLANKS, "--no-pictures", "--until-steady"]
    said = inputs_run(*words, "20%", "--time-limit", "60")
    summary = json.loads((folder / BLANKS / "summary.json").read_text())
    values = [summary["quantities"][name] for name in ("hub_drop", "resistance_coefficient")]
    if not all(value["steady"] for value in values) or "are steady within 20 %" not in said:
        sys.exit(f"it did not go on until it was steady:\n{said}")
    said = inputs_run(*words, "0.01%", "--time-limit", "1")
    if "WARNING: run_until_steady: not steady within 0.01 %" not in said or "wall_time" not in said:
        sys.exit(f"it does not say why it is not steady:\n{said}")


def error(results):
    """A whole error that the model does not allow: the plan and the end print what limits it; a time is kept."""
    folder = empty(results)
    given = ["-v", "distance", "0.4", "-v", "vtk", "0", "--no-pictures", "-o", folder]
    said = inputs_run("wheel_on_snow", "--time", "1min", *given, "--dry-run")
    plan = re.search(r"Plan: (-v cell \S+|the sizes of the scene), about (\S+) (s|min) of one core; the pilot took ", said)
    if not plan or float(plan[2]) * (60 if plan[3] == "min" else 1) > 60 or (folder / "history.h5").exists():
        sys.exit(f"there is no plan of a minute alone:\n{said}")
    said = inputs_run("wheel_on_snow", "--error", "1%", "-v", "cell", "0.0667", *given)
    for text in ("Plan: the sizes of the scene", "1 % is not within reach: the part '", "hub drop: ", "above 1 %: the part '"):
        assert text in said, f"it does not say '{text}':\n{said}"
    if not (folder / "summary.json").is_file() or list(folder.glob("*.png")):
        sys.exit(f"there is no run, or it has pictures:\n{said}")


def converge(results):
    """Two sizes are stored next to the results of the scene; a later run takes the error of its cells from them."""
    folder = empty(results)
    given = ["-v", "distance", "0.6", "-v", "vtk", "0"]
    said = run([sys.executable, PROJECT / "postproc" / "furrow-post", "converge", "wheel_on_snow", "-v", "cell", "0.0667", *given,
                "--ratio", "1.25", "--sizes", "2", "-o", folder / "sizes"], folder=folder)
    stored = json.loads((folder / "wheel_on_snow.convergence.json").read_text())
    if [round(size, 3) for size in stored["sizes"]] != [0.067, 0.083] or "fewer than three sizes" not in said:
        sys.exit(f"two sizes give {stored}:\n{said}")
    said = inputs_run("wheel_on_snow", "-v", "cell", "0.0667", *given, "--no-pictures", "-o", folder / "later")
    later = json.loads((folder / "later" / "budget.json").read_text())["hub_drop"]
    (fine, noise), (coarse, _) = stored["quantities"]["hub_drop"]
    # Half of Roache's index of two sizes, with the noise of the finest
    bound = np.hypot(1.5 * abs(coarse - fine) / (stored["sizes"][1] / stored["sizes"][0] - 1), noise) * later["value"] / fine
    part = later["parts"]["size"]
    if abs(part / bound - 1) > 0.01 or "cells: wheel_on_snow.convergence.json: cells of 83.4, 66.7 mm" not in said:
        sys.exit(f"the later run has {part} m of cells, not {bound}:\n{said}")


def material(results):
    """Each parameter of a soil card by its standard error; a later run with this card takes the error of its soil from it."""
    folder = empty(results)
    given = ["-v", "use_card", "1", "-v", "card", "../soils/dry_sand_smooth.yaml", "-v", "distance", "0.5", "-v", "vtk", "0"]
    said = run([sys.executable, PROJECT / "postproc" / "furrow-post", "converge", "wheel_on_scm", *given, "--material", "-o", folder / "varied"],
               folder=folder)
    parts = json.loads((folder / "wheel_on_scm.material.json").read_text())["parts"]
    drop, pull = parts["hub_drop"], parts["net_traction_coefficient"]
    # Bekker: with n and the pressure held, z ~ k^(-1/n), so that k_c and k_phi deepen no rut where they grow; a larger phi pulls more
    if not drop["pressure_sinkage.k_phi"] < -0.02 < 0.05 < drop["pressure_sinkage.n"] or not 0.01 < pull["shear.phi"] < 0.05:
        sys.exit(f"the card changes {parts}:\n{said}")
    said = inputs_run("wheel_on_scm", *given, "-v", "cell", "0.016", "--no-pictures", "-o", folder / "later")
    later = json.loads((folder / "later" / "budget.json").read_text())["net_traction_coefficient"]
    whole = np.sqrt(sum(change**2 for change in pull.values()))
    if abs(later["parts"]["material"] / whole - 1) > 1e-6 or "material: wheel_on_scm.material.json: pressure_sinkage.k_c, " not in said:
        sys.exit(f"the later run has {later['parts']}, not {whole} of the card:\n{said}")


def answer(results):
    """The command makes tyre and soil, runs them, and compares each value with the band of the formulas."""
    folder = empty(results)
    call = f"furrow_post.answer('235/75R15', load=6227, pressure=179, soil='clay', cone_index=270, slip=0.2, quick=True, output='{folder}/answer')"
    said = run([sys.executable, "-c", f"import furrow_post; print({call}.value.net_traction_coefficient)"], folder=folder,
               PYTHONPATH=str(PROJECT / "postproc"))
    soil = (folder / "answer" / "soil.yaml").read_text()
    assert "su: 21600" in soil and "shear_limit: 19440" in soil, f"the clay is not that of the cone index:\n{soil}"
    summary = json.loads((folder / "answer" / "run" / "summary.json").read_text())["quantities"]
    if abs(summary["slip"]["mean"] - 0.2) > 1e-3 or abs(summary["force_z"]["mean"] / 6227 - 1) > 0.05:
        sys.exit(f"the tyre has another slip or load: {summary}")
    pull, error = summary["net_traction_coefficient"]["mean"], json.loads((folder / "answer" / "run" / "budget.json").read_text())[
        "net_traction_coefficient"]["error"]
    found = re.search(r"net traction coefficient (\S+) ± (\S+) \(\+ material unknown\); formulas (\S+) to (\S+): (inside|outside by|OUTSIDE by)", said)
    if not found or abs(float(found[1]) - pull) > 0.006 * abs(pull) or abs(float(found[2]) / error - 1) > 0.06:
        sys.exit(f"the pull {pull} ± {error} is not compared:\n{said}")
    assert abs(float(said.splitlines()[-1]) / pull - 1) <= 1e-9, f"the table has another pull than {pull}:\n{said}"
    if (found[5] == "inside") != (float(found[3]) <= pull <= float(found[4])):
        sys.exit(f"the place in the band is wrong: {found[0]}")


# Variables that a scene has -> what in its script asks for them; ground without weight has no gravity
COMMON = {"tyre": " tyre/", "material": "terrain/continuum", "gravity": "terrain/continuum"}


def check_common_variables(script):
    """Tyre, material and gravity are variables; a checkpoint can take the place of the box."""
    defaults, text = script_variables(script, {}).defaults, script.read_text()
    for name, style in COMMON.items():
        if style not in text or (name == "gravity" and " gravity 0 " in text):
            continue
        if name not in defaults or f"{name} ${{{name}}}" not in text.replace("file ${tyre}", "tyre ${tyre}"):
            sys.exit(f"{script}: '{name}' is no variable that its lines read")
        if name != "gravity" and not (script.parent / defaults[name]).is_file():
            sys.exit(f"{script}: the default of '{name}', {defaults[name]}, is no file")
        if "/variants/" in defaults[name]:
            sys.exit(f"{script}: the default of '{name}', {defaults[name]}, is a variant for studies")
    continuation(script, "checkpoint")


def usage():
    listed = inputs_run("--help")
    words = " ".join(listed.split())
    for script in SCENES.glob("*.lig"):
        name, title = Head(script).title.split(": ", 1)
        if name != script.stem or f"{name} {title}" not in words:
            sys.exit(f"{script.name} is not in the list of scenes under its name and title")
        check_common_variables(script)
        assert head_entry(script, "Group") in GROUPS, f"{script}: the group in its head is none of {', '.join(GROUPS)}"
    inputs_run("no_such_scene", status=2)


if __name__ == "__main__":
    tests = {"scene": scene, "two_grounds": two_grounds, "laboratory": laboratory, "usage": usage,
             "sweep": sweep, "until_steady": until_steady, "error": error, "converge": converge, "material": material, "answer": answer}
    tests[sys.argv[1]](*sys.argv[2:])
