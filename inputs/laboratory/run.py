#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""One test of the virtual soil laboratory: grains, evaluation, figure, and a continuum law beside them.

  inputs/laboratory/run TEST [--ground NAME] [--confinement Pa,Pa,...] [--continuum MATERIAL.yaml] [-v NAME VALUE]... [-o FOLDER]
  inputs/laboratory/run --list

TEST is oedometer, triaxial, shear, plate, repose or collapse. Several confinements (plate: sizes in m; collapse: aspects) make several runs and
one evaluation. Variables of a scene or ground (its head and grounds/NAME.lig) are set with -v.
"""
import argparse, os, pathlib, subprocess, sys

here = pathlib.Path(__file__).resolve().parent
project = here.parents[1]
build = pathlib.Path(os.environ.get("FURROW_BUILD", project / "build"))
SERIES = {"oedometer": "seed", "triaxial": "confinement", "shear": "confinement", "plate": "size", "repose": "seed", "collapse": "aspect"}


def scene(test, folder, variables):
    folder.mkdir(parents=True, exist_ok=True)
    command = [str(build / "bin" / "furrow"), "-in", str(here / f"{test}.lig"), "-log", str(folder / "log.liggghts"), "-var", "results", str(folder), "-var", "here", str(here)]
    for name, value in variables:
        command += ["-var", name, value]
    for old in (*folder.glob("restart_forced*"), folder / "facts.txt", folder / "laboratory.json"):
        old.unlink(missing_ok=True)
    with open(folder / "screen.txt", "w") as screen:
        status = subprocess.run(command, cwd=folder, stdout=screen, stderr=subprocess.STDOUT).returncode
    if status:
        last = "\n".join((folder / "screen.txt").read_text().splitlines()[-5:])
        sys.exit(f"{folder} failed; the last lines of its screen.txt:\n{last}")
    # LIGGGHTS takes a termination signal as a wish for a checkpoint, ends the run, goes on with the script and exits with 0.
    if any(folder.glob("restart_forced*")):
        sys.exit(f"{folder} was interrupted; start it again")


def continuum(test, material, folder, confinement):
    """The same path through furrow-point."""
    paths = {"oedometer": "{type: confined, stress: [1e3, 1e4, 1e5, 4e5, 1e6], steps: 50}",
             "triaxial": f"{{type: triaxial, confinement: {confinement}, axial_strain: [0.25], steps: 400}}"}
    if test not in paths:
        sys.exit(f"--continuum is for {' and '.join(paths)}; other tests have no path of a single point")
    folder.mkdir(parents=True, exist_ok=True)
    what = f", {float(confinement) / 1e3:g} kPa" if test == "triaxial" else ""
    (folder / "path.yaml").write_text(f"title: {material.stem}{what}\nmaterial: {material.resolve()}\n"
                                      f"path: {paths[test]}\n")
    subprocess.run([str(build / "bin" / "furrow-point"), "run", str(folder / "path.yaml"), "-o", str(folder), "--no-plot"], check=True,
                   stdout=subprocess.DEVNULL)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("test", nargs="?", choices=sorted(SERIES))
    parser.add_argument("--list", action="store_true", help="tests and grounds")
    parser.add_argument("--ground", default="sand_dry")
    parser.add_argument("--series", "--confinement", dest="series", help="values, with commas: " +
                        ", ".join(f"{test}: {name}" for test, name in SERIES.items()))
    parser.add_argument("--continuum", type=pathlib.Path, action="append", default=[])
    parser.add_argument("--reference", type=pathlib.Path)
    parser.add_argument("-v", nargs=2, action="append", default=[], metavar=("NAME", "VALUE"), dest="variables")
    parser.add_argument("-o", "--output", type=pathlib.Path)
    arguments = parser.parse_args()
    grounds = sorted(path.stem for path in (here / "grounds").glob("*.lig"))
    if arguments.list or not arguments.test:
        print("tests:", ", ".join(sorted(SERIES)), "\ngrounds:", ", ".join(grounds))
        return
    if arguments.ground not in grounds:
        parser.error(f"there is no ground {arguments.ground}; there are {', '.join(grounds)}")
    if not (build / "bin" / "furrow").exists():
        parser.error(f"there is no program {build / 'bin' / 'furrow'}; build it with 'bash inputs/run --help' once, or set FURROW_BUILD")
    test = arguments.test
    output = (arguments.output or project / "results" / "laboratory" / f"{test}_{arguments.ground}").resolve()
    values = arguments.series.split(",") if arguments.series else [None]
    folders, points = [], []
    for value in values:
        folder = output / f"{SERIES[test]}_{value}" if value else output
        given = [("ground", arguments.ground)] + ([(SERIES[test], value)] if value else []) + [tuple(v) for v in arguments.variables]
        scene(test, folder, given)
        folders.append(str(folder))
    for material in arguments.continuum:
        for value in values if test == "triaxial" else [None]:
            points.append(output / f"point_{material.stem}_{value or ''}")
            continuum(test, material, points[-1], value or "2e4")
    command = [str(project / "postproc" / "furrow-post"), "laboratory", *folders, "-o", str(output / "laboratory.png")]
    command += [word for point in points for word in ("--point", str(point))]
    if arguments.reference:
        command += ["--reference", str(arguments.reference)]
    sys.exit(subprocess.run(command).returncode)


if __name__ == "__main__":
    main()
