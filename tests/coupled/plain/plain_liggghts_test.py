# SPDX-License-Identifier: GPL-2.0-or-later
"""A plain LIGGGHTS script must give the same numbers with furrow as with liggghts.

    plain_liggghts_test.py same <liggghts> <furrow> <script> [<launcher> ...]
        thermo lines and the final grains, every digit
    plain_liggghts_test.py clear <furrow>
        Furrow's styles after clear: as in a fresh process
    plain_liggghts_test.py silent <furrow>
        a script with a mesh without a screen, where liggghts itself breaks down
"""

import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from furrow_run import columns, output, words_of

HERE = Path(__file__).resolve().parent
PARTS = HERE.parent / "bad_input/parts"


def run(command, script, folder):
    text = Path(script).read_text()
    variables = {name: path for name, path in (("here", HERE), ("parts", PARTS)) if f"${{{name}}}" in text}
    return output([*command, "-in", script, "-log", "none", *words_of(variables)], folder, 300)


def is_numbers(line):
    try:
        return len([float(word) for word in line.split()]) > 0
    except ValueError:
        return False


def thermo(output):
    """One list of lines a run: header and numbers. The lines hold no times but simulated ones."""
    runs, inside = [], False
    for line in output.splitlines():
        if line.split()[:1] == ["Step"]:
            runs.append([])
            inside = True
        if line.startswith("Loop time"):
            inside = False
        if inside and (line.split()[:1] == ["Step"] or is_numbers(line)):
            runs[-1].append(line)
    assert runs and all(len(lines) > 1 for lines in runs), f"no thermo output in:\n{output}"
    return runs


def compare(first, second, what):
    for a, b in zip(first, second):
        if a != b:
            sys.exit(f"{what} differ:\n  {a}\n  {b}")
    if len(first) != len(second):
        sys.exit(f"{what}: {len(first)} and {len(second)} lines")
    print(f"{what}: {len(first)} lines agree in every digit")


def same(liggghts, furrow, script, *launcher):
    with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as other:
        outputs = [run([*launcher, program], script, folder) for program, folder in ((liggghts, one), (furrow, other))]
        compare(*(sum(thermo(output), []) for output in outputs), "thermo lines")
        compare(*((Path(folder) / "grains.txt").read_text().splitlines() for folder in (one, other)), "final grains")
        compare(*([line for line in output.splitlines() if "WARNING" in line] for output in outputs), "warnings")


def silent(furrow):
    with tempfile.TemporaryDirectory() as folder:
        output = run([furrow, "-screen", "none"], HERE / "moving_mesh.lig", folder)
        assert "Step" not in output, f"the run was not silent:\n{output}"
        assert (Path(folder) / "grains.txt").stat().st_size > 0


def clear(furrow):
    with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as other:
        run([furrow], HERE / "clear.lig", one)
        run([furrow], PARTS.parent / "sound.lig", other)
        after, alone = (columns(Path(folder) / "results/history.h5") for folder in (one, other))
        assert len(alone["time"]) > 0 and after.keys() == alone.keys()
        for name in alone:
            assert after[name].tobytes() == alone[name].tobytes(), f"the histories differ in {name}"
        print(f"{len(alone)} channels of the history agree in every bit")


if __name__ == "__main__":
    {"same": same, "clear": clear, "silent": silent}[sys.argv[1]](*sys.argv[2:])
