#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Rigid wheel on fresh snow, continuum: predicted from the oedometer, by laws identified on one depth and density, and the error of both. See README.md.

Runs whatever is not in the results folder yet, one run at a time, then writes the tables and pictures beside this file.

  run [stage ...]      stages: predict rows error report (default: all, in this order); the laws are identified by identify.py
  --results FOLDER     where runs are kept (default results/snow_wheel in the project)
  --furrow PROGRAM     default: $FURROW_BUILD/bin/furrow or build/bin/furrow in the project; made by 'bash inputs/run'
  --only PATTERN       only runs whose name matches, such as 'row_220*'
"""
import argparse, fnmatch, json, os, pathlib, subprocess, time

import study

here = pathlib.Path(__file__).resolve().parent
project = here.parents[2]
TIME_LIMIT = 580  # s, of one run


def launch(furrow, folder, job):
    """One run, unless its folder holds the same run finished. A run that an error stops is repeated with half the steps in a cycle, and what stopped
    it is kept; if that stops too, the message is the result."""
    done = folder / "done.json"
    if done.exists() and json.loads(done.read_text())["job"] == job:
        return
    folder.mkdir(parents=True, exist_ok=True)
    done.unlink(missing_ok=True)
    material = study.materials / f"{job['material']}.yaml"
    if job["sections"]:
        material = folder / "material.yaml"
        material.write_text(study.material_text(job["sections"], f"snow of {folder.name}"))
    variables, stopped = dict(job["variables"], results=folder, material=material), []
    record = once(furrow, folder, variables)
    if record["error"] and variables["cycle"] > 1 and "time limit" not in record["error"]:
        stopped.append(record["error"])
        variables["cycle"] //= 2
        record = once(furrow, folder, variables)
    done.write_text(json.dumps({"job": job, **record, "stopped": stopped, "cycle": variables["cycle"]}, indent=1))


def once(furrow, folder, variables):
    command = ["nice", "-n", "10", str(furrow), "-in", str(here / "wheel.lig"), "-log", "none"]
    for name, value in variables.items():
        command += ["-var", name, str(value)]
    before, started = os.times(), time.time()
    with open(folder / "screen.txt", "w") as screen:
        try:
            status = subprocess.run(command, stdout=screen, stderr=subprocess.STDOUT, cwd=folder, timeout=TIME_LIMIT).returncode
        except subprocess.TimeoutExpired:
            status = "time limit"
    text = (folder / "screen.txt").read_text()
    cost = {"wall_s": round(time.time() - started, 1), "user_s": round(os.times().children_user - before.children_user, 1)}
    error = next((line for line in text.splitlines() if "ERROR" in line), f"stopped: {status}") if status != 0 else ""
    facts = next((line.split()[1:] for line in text.splitlines() if line.startswith("FACTS")), [])
    print(f"{time.strftime('%H:%M:%S')}  {folder.name:28} {cost['wall_s']:7.1f} s wall {cost['user_s']:7.1f} s user  {error}", flush=True)
    return {"facts": {name: float(value) for name, value in zip(facts[::2], facts[1::2])}, "cost": cost, "error": error}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("stages", nargs="*", metavar="stage")
    parser.add_argument("--results", type=pathlib.Path, default=project / "results" / "snow_wheel")
    build = pathlib.Path(os.environ.get("FURROW_BUILD", project / "build"))
    parser.add_argument("--furrow", type=pathlib.Path, default=build / "bin" / "furrow")
    parser.add_argument("--only", default="*")
    arguments = parser.parse_args()
    stages = arguments.stages or [*study.STAGES, "report"]
    unknown = set(stages) - {*study.STAGES, "report"}
    if unknown:
        parser.error(f"unknown stage {', '.join(sorted(unknown))}")
    results, furrow = arguments.results.resolve(), arguments.furrow.resolve()
    if stages != ["report"] and not furrow.exists():
        parser.error(f"there is no program {furrow}; build it with 'bash inputs/run' or name it with --furrow")
    for stage in stages:
        if stage == "report":
            import report
            report.report(results, here)
            continue
        for name, job in study.STAGES[stage]().items():
            if fnmatch.fnmatch(name, arguments.only):
                launch(furrow, results / name, job)


if __name__ == "__main__":
    main()
