# SPDX-License-Identifier: GPL-2.0-or-later
"""Every keyword of every style, law, bed and tyre file, missing, misspelt, twice, without a value, of another type,
or outside of its range: the message has the place, the keyword, what is allowed, and a remedy. Every keyword with a
usual range, with a value outside: one warning has the place, the keyword, the range and a hint of the unit. The
keywords come from the programs (furrow --keys, furrow-point laws --json) and from the heads of bed scripts.

    wording.py <folder of the programs>
"""

import json
import re
import subprocess
import sys
from pathlib import Path

import yaml

from fault_table import Table, run, run_script
from furrow_run import INPUTS

BOX = """units si
atom_style granular
atom_modify sort 0 0
region box block -1 1 -1 1 -1 1 units box
create_box 1 box
"""
# Lines that LIGGGHTS reads itself, or that the script must not have
OTHERS = {"fix ave/time", "fix furrow/expected_states", "fix furrow/system", "fix wall/gran/body", "model snow/bond",
          "command read_restart"}
BED = "command bed"
UNKNOWN = "nonsense"
SOIL = {"k_c": 15600, "k_phi": 2407400, "n": 1.1, "c": 250, "phi": 31.9, "K": 0.0114}
FIELD = "fix x all terrain/scm length 3 width 0.6 cell 0.02 "  # the style that has keys with usual ranges
OUTSIDE = 1e-3  # of the end of a range


def wrong_values(key, in_script=False):
    """Values that a key does not take, each as words, with what the message says of them.

    in_script: a list ends there with the first word that is no number
    """
    kind, count = key["kind"], key.get("count", 1)
    if kind == "text":
        return
    if kind in ("choice", "flag"):
        yield [UNKNOWN], f"is '{UNKNOWN}'"
        return
    count = count or 1
    if count == 1 and key.get("count") != 0:
        yield [UNKNOWN], "not a number"
    if not in_script or key.get("count") != 0:
        yield ["1e999"] * count, "too large for a number"
    for end, sign in ("lower", -1), ("upper", 1):
        if end in key:
            beyond = 0 if key.get(f"{end}_open") else sign * max(1, OUTSIDE * abs(key[end]))
            yield [f"{key[end] + beyond:.9g}"] * count, "is "
    if kind == "integer":
        yield ["1.5"] * count, "is 1.5"


def unusual_values(key):
    """Values outside of a key's usual range that it takes, each with what the warning says."""
    usual = key["usual"]
    unit = f" {usual['unit']}" if usual["unit"] else ""
    zero = ", or 0" if usual["zero"] else ""
    said = f"; usual is {usual['lower']:g} to {usual['upper']:g}{unit}{zero}; {'give SI units: ' if unit else ''}{usual['hint']}"
    for end, value in ("lower", usual["lower"] - OUTSIDE * abs(usual["lower"])), ("upper", usual["upper"] * (1 + OUTSIDE)):
        if end not in key or (key["lower"] < value if end == "lower" else value < key["upper"]):
            yield float(f"{value:.9g}"), f" is {value:g}{unit}{said}"


def unusual_soils(table, furrow, declared):
    """Lines of a height field with one unusual value each."""
    having = {subject for subject, keys in declared.items() if any("usual" in key for key in keys.values())}
    table.expect("styles", having == {"fix terrain/scm"}, f"usual ranges in {having}")
    for name, key in declared["fix terrain/scm"].items():
        for value, problem in unusual_values(key) if "usual" in key else ():
            line = FIELD + " ".join(f"{each} {number}" for each, number in {**SOIL, name: value}.items())
            said = run_script(furrow, table.folder, f"{BOX}{line}\n").text
            found = [row for row in said.splitlines() if "WARNING" in row and f"keyword '{name}'{problem}" in row]
            table.expect(line, len(found) == 1 and f"/script.lig, line {BOX.count(chr(10)) + 1}" in said, said)


def bed_keys(script):
    """Keywords of a bed, declared in the head of its script: name, unit, range, meaning."""
    head = script.read_text().partition("#: parameters\n")[2].partition("\n\n")[0]
    keys = {}
    for name, allowed in re.findall(r"^# (\w+) +\S+ +((?:integer )?(?:>=? [\d.e]+|\[[^]]*\]))", head, re.M):
        bounds = [float(number) for number in re.findall(r"[\d.e]+", allowed.removeprefix("integer"))]
        keys[name] = {"kind": "integer" if "integer" in allowed else "number", "required": True, "lower_open": "> " in allowed,
                      **dict(zip(("lower", "upper"), bounds))}
    return keys


def faulty_lines(subject, keys):
    """Arguments of a line with one fault each, and what the message says of it."""
    yield [UNKNOWN, "1"], f"{subject} has no keyword '{UNKNOWN}'"
    for name, key in keys.items():
        if len(name) > 4:
            yield [name[:-1], "1"], f"{subject} has no keyword '{name[:-1]}'", "did you mean"
        for values, problem in wrong_values(key, in_script=True):
            yield [name, *values], f"{subject}, keyword '{name}'", problem, "it is: "
    missing = [name for name, key in keys.items() if key["required"]]
    if missing:
        yield [], f"{subject}, keyword '{missing[0]}' is missing", "it is: "
    number = next((name for name, key in keys.items() if key["kind"] == "number"), None)
    if number:
        lower = keys[number].get("lower", 0)
        right = f"{0.5 * (lower + keys[number].get('upper', lower + 2)):.9g}"
        yield [number], f"{subject} has no value for '{number}'" if subject == BED else f"{subject}, keyword '{number}' has no value"
        yield [number, right, number, right], f"{subject}, keyword '{number}' is given twice"
        yield [number, "nan"], f"{subject}, keyword '{number}' is nan", "it is: "


def styles(table, furrow):
    """Lines of a script with one fault each."""
    declared = json.loads(run([furrow, "--keys"], table.folder).text)
    unusual_soils(table, furrow, declared)
    lines = [(subject, BOX, subject.replace("fix ", "fix x all ").removeprefix("command "), keys)
             for subject, keys in declared.items() if subject not in OTHERS | {BED} and keys]
    for script in sorted((INPUTS / "beds").glob("*.lig")):  # a bed stands before the box
        own = {name: key for name, key in declared[BED].items() if name == "depth" or name != "script" and script.stem == "sand"}
        lines.append((BED, "", f"bed {script}", {**own, **bed_keys(script)}))
    tested = 0
    for subject, head, start, keys in lines:
        for words, *texts in faulty_lines(subject, keys):
            line = " ".join([start, *words])
            said = run_script(furrow, table.folder, f"{head}{line}\n")
            table.check(line, said, 1, *texts, "; allowed: ", f"/script.lig, line {head.count(chr(10)) + 1}: {line}")
            tested += 1
    table.expect("styles", tested > 1000, f"{tested} lines only")


class Answers:
    """furrow-point that stays open: the error of one file after the other."""

    def __init__(self, point, folder):
        self.folder = folder
        self.process = subprocess.Popen([point, "channels"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def error(self, content):
        """Error of a material; empty where it is accepted."""
        (self.folder / "made.yaml").write_text(yaml.safe_dump(content, sort_keys=False))
        path = "{type: confined, stress: [10], steps: 1}"
        (self.folder / "path.yaml").write_text(f"title: x\nmaterial: {self.folder}/made.yaml\npath: {path}\n")
        self.process.stdin.write(f"{self.folder}/path.yaml\n")
        self.process.stdin.flush()
        answer = self.process.stdout.readline()
        return answer.removeprefix("error: ").rstrip() if answer.startswith("error: ") else ""

    def close(self):
        self.process.communicate()


def examples(point, folder):
    """A material of each law: sections with effective values."""
    found = {}
    for file in sorted((INPUTS / "materials").rglob("*.yaml")):
        if file.parent.name == "contact":
            continue
        content = json.loads(run([point, "show", file, "--json"], folder).text)
        found.setdefault(content["law"], content["sections"])
    found.setdefault("drucker_prager", {
        "law": {"type": "drucker_prager", "density": 1800, "d": 5e3, "beta": 20, "psi": 0},
        "elasticity": {"type": "linear", "E": 1e7, "nu": 0.3},
    })
    found.setdefault("elastic", {
        "law": {"type": "elastic", "density": 1500}, "elasticity": {"type": "linear", "E": 1e7, "nu": 0.3},
    })
    return found


def laws(table, point):
    declared = json.loads(run([point, "laws", "--json"], table.folder).text)
    made = examples(point, table.folder)
    table.expect("laws", set(made) == set(declared), f"materials of {sorted(made)}, laws {sorted(declared)}")
    answers = Answers(point, table.folder)
    tested, warned = 0, set()

    def check(name, content, *texts):
        nonlocal tested
        tested += 1
        error = answers.error(content)
        place = f"{table.folder}/made.yaml"
        absent = [text for text in (place, "; allowed: ", *texts) if text not in error]
        table.expect(name, not absent, f"{absent} not in: {error}")

    for law, sections in made.items():
        for section, values in sections.items():
            keys = declared[law]["sections"][section][law if section == "law" else values.get("type", "")]
            for name, key in keys.items():
                for wrong, problem in wrong_values(key):
                    value = wrong if key["kind"] == "numbers" else wrong[0]
                    changed = {**sections, section: {**values, name: value}}
                    check(f"{law}, {section}, {name}: {wrong[0]}", changed, f"keyword '{name}'", problem, "it is: ", "line ")
                for value, problem in unusual_values(key) if "usual" in key else ():
                    listed = values.get(name)
                    changed = value if key["kind"] != "numbers" else [value, *listed[1:]] if value < listed[1] else [*listed[:-1], value]
                    file = table.folder / "made.yaml"
                    file.write_text(yaml.safe_dump({**sections, section: {**values, name: changed}}, sort_keys=False))
                    answer = run([point, "show", file, "--json"], table.folder)
                    if answer.status:  # sections that no longer belong together are an error
                        continue
                    said = json.loads(answer.text)["warnings"]
                    right = len(said) == 1 and said[0].startswith(f"{file}, line ") and f"keyword '{name}'{problem}" in said[0]
                    table.expect(f"{law}, {section}, {name}: {value:g}", right, said)
                    warned.add(name)
                if key["required"] and name in values:
                    rest = {other: value for other, value in values.items() if other != name}
                    check(f"{law}, {section} without {name}", {**sections, section: rest}, f"keyword '{name}' is missing", "it is: ")
            changed = {**sections, section: {**values, UNKNOWN: 1}}
            check(f"{law}, {section}: unknown key", changed, f"has no keyword '{UNKNOWN}'", "line ")
        check(f"{law}: unknown section", {**sections, UNKNOWN: {"a": 1}}, UNKNOWN, "line ")
    answers.close()
    table.expect("laws", tested > 200, f"{tested} files only")
    known = {name for law in declared.values() for choices in law["sections"].values() for keys in choices.values()
             for name, key in keys.items() if "usual" in key}
    table.expect("usual ranges", warned == known > {"density", "E"}, f"warnings of {sorted(warned)}, usual ranges of {sorted(known)}")


def tyres(table, tyre):
    """Each key of a tyre file of each kind, of another type or unknown."""
    tested = 0
    for name in ("p235_75r15", "p235_75r15_lugged"):
        content = yaml.safe_load((INPUTS / "tyres" / f"{name}.yaml").read_text())
        for section, values in content.items():
            if not isinstance(values, dict):
                continue
            changes = {key: {**values, key: UNKNOWN} for key, value in values.items() if isinstance(value, float)}
            changes[UNKNOWN] = {**values, UNKNOWN: 1}
            for key, changed in changes.items():
                file = table.folder / "tyre.yaml"
                text = yaml.safe_dump({**content, section: changed}, sort_keys=False)
                file.write_text(text.replace(": true\n", ": yes\n").replace(": false\n", ": no\n"))
                said = run([tyre, file, "--pressure", "241", "--load", "6000"], table.folder)
                problem = f"'{UNKNOWN}'" if key == UNKNOWN else f"keyword '{key}'"
                table.check(f"{name}, {section}, {key}", said, 1, str(file), problem, "; allowed: ", "line ")
                tested += 1
    table.expect("tyre files", tested > 10, f"{tested} files only")


def main(programs):
    table = Table()
    folder = Path(programs).resolve()
    laws(table, folder / "furrow-point")
    tyres(table, folder / "furrow-tyre")
    styles(table, folder / "furrow")
    table.end()


if __name__ == "__main__":
    main(sys.argv[1])
