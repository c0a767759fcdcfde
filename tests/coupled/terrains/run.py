# SPDX-License-Identifier: GPL-2.0-or-later
"""One script on a continuum and on a height field: the history, its former name, the checks and the end of the ground.

    run.py <furrow>
"""

import sys
import tempfile
from pathlib import Path

import h5py

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from furrow_run import columns, run, script_output, words_of
from same_results import compare_arrays

HERE = Path(__file__).resolve().parent
ROWS, FRAMES = 21, 5  # of the first 400 steps
# file, parts at its end, a channel that grows as the wheel sinks
GROUNDS = {0: ("terrain", {"terrain", "rut"}, "contact_work"), 1: ("scm", {"surface"}, "deepest")}


def roll(furrow, folder, field, **variables):
    """Screen of the script, whose results are in the folder `results`."""
    return script_output(furrow, HERE / "wheel.lig", folder, here=HERE, field=field, **variables)


def check_history(folder, name, parts, channel):
    rows = columns(folder / f"{name}.h5")
    assert len(rows["time"]) > ROWS and rows[channel][-1] > rows[channel][0], rows
    with h5py.File(folder / f"{name}.h5") as content:
        assert set(content) == parts | {"run", "history", "audit", "cost", "warnings"}, list(content)
        assert all(column.attrs["meaning"] for column in content["history"].values())
    assert len(list((folder / "vtk").glob(f"{name}_*.vtp"))) > FRAMES and (folder / "vtk" / f"{name}.pvd").is_file()


def main(furrow):
    with tempfile.TemporaryDirectory() as text:
        folder = Path(text)
        for field, (name, parts, channel) in GROUNDS.items():
            said = roll(furrow, folder / name, field)
            assert "WARNING: fix style" not in said, said
            assert "cells across 'wheel' and 3 in its radius (recommended: at least 4): forces will be coarse" in said, said
            assert "the ground ends ahead of the wheel; make it longer" in said, said
            check_history(folder / name / "results", name, parts, channel)

        said = roll(furrow, folder / "former", 1, history="scm/history")
        assert "fix style scm/history is now called terrain/history; write 'fix ground all terrain/history'" in said, said
        assert compare_arrays(folder / "scm", folder / "former", 0.0) > 10

        # one folder has a file for each kind of ground
        beside = ("fix snow all terrain/continuum material {}/../../../inputs/materials/fresh_snow_cam_clay.yaml "
                  "length 0.3 width 0.3 centre 1.5 0 depth 0.1 surface 0 cell 0.05").format(HERE)
        lines = (HERE / "wheel.lig").read_text().replace("run             400\nrun_until_steady error 1e-6\n", f"{beside}\nfix both all terrain/history terrain snow folder "
                                                         "${results} every 20\nrun 20\n")
        (folder / "both.lig").write_text(lines)
        script_output(furrow, folder / "both.lig", folder / "both", here=HERE, field=1)
        assert {"terrain.h5", "scm.h5"} <= {file.name for file in (folder / "both" / "results").iterdir()}
        (folder / "twice.lig").write_text(lines.replace("terrain/history terrain snow", "terrain/history terrain soil"))
        said = run([furrow, "-in", folder / "twice.lig", "-log", "none", *words_of({"here": HERE, "field": 1})], folder)
        assert said.status != 0 and "as fix 'ground' does already" in said.text, said.text


if __name__ == "__main__":
    main(*sys.argv[1:])
