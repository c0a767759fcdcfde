#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Rigid wheel on dry sand: grains calibrated on plates, then the wheel, against CMU's measurements. See README.md.

Runs whatever is not in the results folder yet, then writes results.csv, calibration.csv and comparison.png beside this file.

  run [stage ...]      stages: calibrate wheel checks report (default: all four, in this order)
  --jobs N             runs at a time, one rank each (default 2)
  --results FOLDER     where runs are kept (default results/cmu_sand in the project)
  --furrow PROGRAM     default: $FURROW_BUILD/bin/furrow or build/bin/furrow in the project; made by 'bash inputs/run'.
                       furrow-resistance must stand beside it
  --only PATTERN       only runs whose name matches, such as 'smooth_*'
  --check              tables and picture go to the results folder; exit status 1 when a limit of study.REACHED is missed
"""
import argparse, concurrent.futures, fnmatch, json, os, pathlib, subprocess, sys, time

import report
import study

here = pathlib.Path(__file__).resolve().parent
project = here.parents[2]


def launch(furrow, folder, job):
    """One run, unless its folder holds the same run finished. Killed runs leave no 'done.json' and are made again."""
    done = folder / "done.json"
    if done.exists() and json.loads(done.read_text())["job"] == job:
        return
    folder.mkdir(parents=True, exist_ok=True)
    done.unlink(missing_ok=True)
    command = [str(furrow), "-in", str(here / f"{job['scene']}.lig"), "-log", str(folder / "log")]
    command += ["-var", "results", str(folder)]
    for name, value in job["variables"].items():
        command += ["-var", name, str(value)]
    started = time.time()
    with open(folder / "screen.txt", "w") as screen:
        process = subprocess.Popen(command, stdout=screen, stderr=subprocess.STDOUT, cwd=folder)
        _, status, usage = os.wait4(process.pid, 0)
    text = (folder / "screen.txt").read_text()
    if status != 0:
        last = "\n".join(text.splitlines()[-4:])
        raise SystemExit(f"{folder.name} failed; the last lines of {folder / 'screen.txt'}:\n{last}")
    facts = [line.split()[1:] for line in text.splitlines() if line.startswith("FACTS")][-1]
    facts = {name: float(value) for name, value in zip(facts[::2], facts[1::2])}
    cost = {"wall_s": round(time.time() - started, 1), "cpu_s": round(usage.ru_utime + usage.ru_stime, 1),
            "bed_made": "Making the bed" in text}
    done.write_text(json.dumps({"job": job, "facts": facts, "cost": cost}, indent=1))
    print(f"{time.strftime('%H:%M:%S')}  {folder.name:34} {cost['wall_s']:7.1f} s wall {cost['cpu_s']:7.1f} s cpu", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("stages", nargs="*", default=["calibrate", "wheel", "checks", "report"], metavar="stage")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--results", type=pathlib.Path, default=project / "results" / "cmu_sand")
    build = pathlib.Path(os.environ.get("FURROW_BUILD", project / "build"))
    parser.add_argument("--furrow", type=pathlib.Path, default=build / "bin" / "furrow")
    parser.add_argument("--only", default="*")
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    arguments.results, arguments.furrow = arguments.results.resolve(), arguments.furrow.resolve()
    unknown = set(arguments.stages) - {"calibrate", "wheel", "checks", "report"}
    if unknown:
        parser.error(f"unknown stage {', '.join(unknown)}")
    if not arguments.furrow.exists():
        parser.error(f"there is no program {arguments.furrow}; build it with 'bash inputs/run' or name it with --furrow")

    for stage in arguments.stages:
        if stage == "report":
            continue
        jobs = {name: job for name, job in study.jobs(stage).items() if fnmatch.fnmatch(name, arguments.only)}
        # The first run on a bed makes it; others that want the same bed wait.
        first = {}
        for name, job in jobs.items():
            first.setdefault(study.bed_key(job), name)
        for names in (sorted(first.values(), key=list(jobs).index), [n for n in jobs if n not in first.values()]):
            with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
                list(pool.map(lambda n: launch(arguments.furrow, arguments.results / n, jobs[n]), names))
    if "report" in arguments.stages:
        tables = arguments.results if arguments.check else here
        missed = report.report(arguments.results, tables, arguments.furrow.with_name("furrow-resistance"))
        if arguments.check and missed:
            sys.exit("Missed: " + "; ".join(missed))


if __name__ == "__main__":
    main()
