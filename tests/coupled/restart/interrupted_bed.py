# SPDX-License-Identifier: GPL-2.0-or-later
"""A termination signal while a bed is made: an error that names it, a status that is not zero, and
nothing kept for later runs.

    interrupted_bed.py <furrow> <bed script>

LIGGGHTS takes the signal as a request for a checkpoint, ends the current run and continues with the
script, so that without precautions the grains would be kept as they fell.
"""

import signal
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from furrow_run import going, wait_until

furrow, bed = sys.argv[1:]
with tempfile.TemporaryDirectory() as name:
    folder = Path(name)
    (folder / "bed.lig").write_text(
        f"processors 1 * 1\nbed {bed} length 0.4 width 0.2 depth 0.1 clearance_above 0.1 diameter 0.008 density 2600 young 5e6 poisson 0.25 restitution 0.3 "
        "friction 0.5 rolling 0.1 pour_friction 0.5 step 5e-5 seed 86028121\nrun 0\n")
    with going([furrow, "-in", "bed.lig", "-log", "none"], folder, FURROW_CACHE=str(folder / "cache")) as run:
        wait_until((folder / "cache").exists, run)
        time.sleep(1.0)  # into the pouring, which takes several seconds
        if run.poll() is not None:
            sys.exit("the bed was made before it could be interrupted:\n" + (folder / "said").read_text()[-2000:])
        run.send_signal(signal.SIGTERM)
        status = run.wait(timeout=120)
    said = (folder / "said").read_text()
    if "command bed was interrupted while it made the bed, which is not kept" not in said:
        sys.exit("no word of the interruption:\n" + said[-2000:])
    if status == 0:
        sys.exit("the status is 0")
    kept = [path.name for path in (folder / "cache").iterdir()]
    if kept:
        sys.exit(f"something was kept: {kept}")
