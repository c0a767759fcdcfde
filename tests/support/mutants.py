#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Finds how many faulty lines of src and coupling the short tests notice (mutation testing).

    python3 tests/support/mutants.py COPY [--count 40] [--seed 1] [--report mutants.csv]

COPY is a copy of this repository that may be spoilt, with a configured build folder. The program
changes COUNT random lines there, each guarded by a number, and builds once. FURROW_MUTANT=7 then
switches the seventh fault on. Each fault has one run of the short tests, which ends at the first
failure; a test that exceeds its time has failed. Tests of the folder of the line come first.

Candidates are statements of one line: conditions, assignments, returns and calls. The change is an
operator, a number, a sign, a negated condition or a deleted statement. Lines that are not changed:
statements of several lines, tables of outputs and keywords, and the kernels of SIMD, whose
conditions are vectors.
"""

import argparse
import csv
import os
import random
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

GUARD = """#pragma once
#include <cstdlib>
/// Number of the fault that is switched on, from the environment.
inline bool furrow_mutant(int number) {
  static const char* chosen = std::getenv("FURROW_MUTANT");
  static const int value = chosen ? std::atoi(chosen) : 0;
  return value == number;
}
"""
SPARE = 1.5  # planted per wanted fault: some do not compile
SECONDS = 300  # of a test
SKIPPED = re.compile(r"_kernel\.h$|^src/simd/|kernel_law\.h$")
# replacements of operators and names
SWAPS = {" + ": " - ", " - ": " + ", " * ": " / ", " / ": " * ", " < ": " <= ", " <= ": " < ", " > ": " >= ", " >= ": " > ",
         " == ": " != ", " != ": " == ", " && ": " || ", " || ": " && ", "true": "false", "false": "true",
         "std::min": "std::max", "std::max": "std::min", "std::sin": "std::cos", "std::cos": "std::sin",
         "begin()": "end()", "++": "--", ".front()": ".back()", ".back()": ".front()"}
TOKEN = re.compile("|".join(rf"\b{re.escape(s)}\b" if s[0].isalpha() and s[-1].isalpha() else re.escape(s) for s in SWAPS)
                   + r"|(?<![\w.])\d+\.?\d*(?:e[-+]?\d+)?(?![\w.])")
NO_STATEMENT = re.compile(r"\s*(//|#|}|case\b|default\b|using\b|namespace\b|template\b|class\b|struct\b|enum\b|friend\b|static\b"
                          r"|constexpr\b|public|private|protected|extern\b|typedef\b|virtual\b|explicit\b|else\b|do\b|for\b|while\b)")
CONDITION = re.compile(r"(\s*(?:} else )?if \()(.*)(\)(?: \{)?(?: (?:return|continue|break|throw)\b.*)?)$")
RETURN = re.compile(r"(\s*return )(.+)(;)$")
ASSIGNMENT = re.compile(r"(\s*(?:const )?[\w:<>&*,. \[\]()\->]*?[\w\])] = )([^=].*)(;)$")
# operation or call for its effect
EFFECT = re.compile(r"\s*[\w:.\[\]()\->*]+ (?:[-+*/]|\|)?= .+;$|\s*[\w:.\[\]()\->]+\(.*\);$")


@dataclass
class Mutant:
    file: str
    line: int  # from 1
    before: str
    change: str  # in words
    guarded: str  # the line with {n} for the number
    number: int = 0


def balanced(text: str) -> bool:
    depth = 0
    for c in re.sub(r'"(?:\\.|[^"\\])*"', '""', text):
        depth += (c in "([{") - (c in ")]}")
        if depth < 0:
            return False
    return depth == 0


def listed(text: str) -> bool:
    """Finds a comma outside of brackets."""
    return any(balanced(text[:m.start()]) for m in re.finditer(",", text))


def changed(expression: str, rng: random.Random) -> str | None:
    """The expression with one operator, number or name changed."""
    strings = [m.span() for m in re.finditer(r'"(?:\\.|[^"\\])*"', expression)]
    places = [m for m in TOKEN.finditer(expression) if not any(a <= m.start() < b for a, b in strings)]
    if not places:
        return None
    place = rng.choice(places)
    token = place[0]
    if token in SWAPS:
        new = SWAPS[token]
    elif re.fullmatch(r"\d+", token):
        new = str(int(token) + 1)
    else:
        new = repr(2.0 * float(token)) if float(token) else "1.0"
    return expression[:place.start()] + new + expression[place.end():]


def mutate(file: str, number: int, line: str, rng: random.Random) -> Mutant | None:
    """A fault in this line, or nothing if the line is no statement of its kinds."""
    code = line.split("  //")[0].rstrip()
    if NO_STATEMENT.match(code) or not code.strip():
        return None
    if (found := CONDITION.fullmatch(code)) and balanced(found[2]) and not re.search(r";|(?<![=!<>])=(?!=)", found[2]):
        new = changed(found[2], rng) if rng.random() < 0.5 else None
        what = f"{found[2]} -> {new}" if new else f"not ({found[2]})"
        inner = f"(furrow_mutant({{n}}) ? ({new}) : ({found[2]}))" if new else f"furrow_mutant({{n}}) != static_cast<bool>({found[2]})"
        return Mutant(file, number, code, what, escaped(found[1]) + escaped(inner) + escaped(found[3]))
    for kind in (RETURN, ASSIGNMENT):
        found = kind.fullmatch(code)
        if found and balanced(found[1]) and balanced(found[2]) and not found[2].startswith(("{", "[")) and not listed(found[2]):
            new = changed(found[2], rng)
            if new:
                return Mutant(file, number, code, f"{found[2]} -> {new}",
                              escaped(found[1]) + escaped(f"furrow_mutant({{n}}) ? ({new}) : ({found[2]})") + ";")
    if EFFECT.fullmatch(code) and balanced(code) and "override" not in code:
        return Mutant(file, number, code, "deleted", escaped(f"if (!furrow_mutant({{n}})) {{ {code.strip()} }}"))
    return None


def escaped(text: str) -> str:
    """Braces doubled for str.format, but for {n}."""
    return text.replace("{", "{{").replace("}", "}}").replace("{{n}}", "{n}")


def git(copy: Path, *words: str) -> str:
    return subprocess.run(["git", "-C", copy, *words], check=True, capture_output=True, text=True).stdout


def candidates(copy: Path, rng: random.Random) -> list[Mutant]:
    """All lines that can be changed, in random order."""
    files = git(copy, "ls-files", "src", "coupling").split()
    found = []
    for file in files:
        if Path(file).suffix not in (".cpp", ".h") or SKIPPED.search(file):
            continue
        lines = git(copy, "show", f"HEAD:{file}").splitlines()
        for i, line in enumerate(lines):
            # The line before has ended, and a declaration of a class has no effect.
            begins = i == 0 or re.search(r"([;{}:]|\*/|^)$|^\s*//|  // ", lines[i - 1])
            one = mutate(file, i + 1, line, rng) if begins and line.startswith("  ") else None
            if one and (file.endswith(".cpp") or not re.match(r"^  \w[\w:<>, *&]* \w+_? = .*;$", line)):  # no member's default
                found.append(one)
    rng.shuffle(found)
    return found


def plant(copy: Path, chosen: list[Mutant]) -> None:
    """Writes the faults into the copy, whose files are those of its commit otherwise."""
    if not (guard := copy / "src" / "core" / "mutant.h").exists():
        guard.write_text(GUARD)
    by_file: dict[str, list[Mutant]] = {}
    for one in chosen:
        by_file.setdefault(one.file, []).append(one)
    for file, faults in by_file.items():
        lines = git(copy, "show", f"HEAD:{file}").splitlines()
        for one in faults:
            lines[one.line - 1] = one.guarded.format(n=one.number)
        # In the first line, a comment, so that errors name the lines of the original
        first = '#include "furrow/core/mutant.h"' if file.endswith(".cpp") else '#pragma once\n#include "furrow/core/mutant.h"\n#line 1'
        text = "\n".join([f"{first}\n#line 1", *lines]) + "\n"
        if not (copy / file).exists() or (copy / file).read_text() != text:
            (copy / file).write_text(text)


def build(copy: Path, folder: Path, chosen: list[Mutant], jobs: str) -> list[Mutant]:
    """Builds all; faults that do not compile are left out. @return those that remain"""
    left_out: list[Mutant] = []
    while True:
        plant(copy, chosen)
        for file in {one.file for one in left_out} - {one.file for one in chosen}:
            git(copy, "checkout", "-q", "HEAD", file)
        done = subprocess.run(["cmake", "--build", folder, "-j", jobs, "--", "-k", "0"], capture_output=True, text=True)
        if done.returncode == 0:
            return chosen
        said = done.stdout.replace("build/include/furrow/", "src/")
        errors = {(m[1], int(m[2])) for m in re.finditer(r"((?:src|coupling)/[\w/.]+):(\d+):\d+: error", said)}
        bad = [one for one in chosen if (one.file, one.line) in errors]
        if not bad:
            sys.exit(done.stdout[-6000:])
        print("do not compile:", *[f"{one.file}:{one.line}" for one in bad], flush=True)
        left_out += bad
        chosen = [one for one in chosen if one not in bad]


def first_failure(folder: Path, selection: list[str], number: int, cache: str, jobs: str) -> str:
    """@return name of the first test that fails, or nothing"""
    done = subprocess.run(["ctest", "--test-dir", folder, "--stop-on-failure", "--timeout", str(SECONDS), "-j", jobs, *selection],
                          capture_output=True, text=True, env={**os.environ, "FURROW_MUTANT": str(number), "FURROW_CACHE": cache})
    if done.returncode == 0:
        return ""
    failed = re.search(r"Test +#\d+: (.+?) \.*\**(?:Failed|\*\*\*|Timeout|Exception|Subprocess)", done.stdout)
    failed = failed or re.search(r"\t *\d+ - (.+?) \(", done.stdout)
    if not failed:
        sys.exit(done.stdout[-3000:] + done.stderr)
    return failed[1].strip()


def find(folder: Path, one: Mutant, unfit: set[str], jobs: str) -> str:
    """@return the test that finds the fault, or nothing; a test that fails without the fault becomes unfit"""
    rooms = {"shell": "tyre|shell", "solid": "tyre|solid", "programs": "programs|point"}
    room = Path(one.file).parts[1]
    near = f"^(unit|verification)_({rooms.get(room, room)})" if one.file.startswith("src") else "^coupled\\.[a-z_]*_test"
    short = ["-LE", "study|long"]
    with tempfile.TemporaryDirectory() as cache:
        for selection, done in ((["-R", near, *short], "^$"), (short, near)):
            while test := first_failure(folder, [*selection, "-E", f"{any_of(unfit)}|{done}"], one.number, cache, jobs):
                with tempfile.TemporaryDirectory() as other:
                    if not first_failure(folder, ["-R", any_of({test})], 0, other, jobs):
                        return test
                unfit.add(test)
                print(f"{test} fails without a fault too", flush=True)
    return ""


def any_of(names: set[str]) -> str:
    """Regular expression of these test names."""
    return "^(" + "|".join(re.sub(r"([^\w ])", r"\\\1", name.partition("  #")[0]) for name in sorted(names)) + ")( .*)?$"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("copy", type=Path)
    parser.add_argument("--build", type=Path, help="build folder (COPY/build)")
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", default="2")
    parser.add_argument("--report", type=Path, default=Path("mutants.csv"))
    given = parser.parse_args()
    copy, folder = given.copy.resolve(), (given.build or given.copy / "build").resolve()
    chosen = candidates(copy, random.Random(given.seed))
    print(len(chosen), "lines can be changed", flush=True)
    chosen = chosen[:round(SPARE * given.count)]
    for number, one in enumerate(chosen, 1):
        one.number = number
    chosen = build(copy, folder, chosen, given.jobs)[:given.count]
    found, unfit = 0, {"none"}
    with given.report.open("w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(["line", "before", "fault", "found by"])
        for one in chosen:
            test = find(folder, one, unfit, given.jobs)
            found += bool(test)
            rows.writerow([f"{one.file}:{one.line}", one.before.strip(), one.change, test or "nothing"])
            file.flush()
            print(f"{one.number}: {one.file}:{one.line}: {one.change}: {test or 'NOT FOUND'}", flush=True)
    print(f"{found} of {len(chosen)} faults were found", flush=True)


if __name__ == "__main__":
    main()
