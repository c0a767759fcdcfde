# SPDX-License-Identifier: GPL-2.0-or-later
"""A sweep on a Slurm of one node, started here from Debian's slurmctld and slurmd for this test.

    slurm.py <results>

One point has a time that it does not keep, so that its task is lost; then the same sweep is ended
without Slurm, in the same folders. Status 77: Slurm is not installed.
"""

import json
import os
import shutil
import socket
import subprocess
import sys
import time
from pathlib import Path

from scene_test import PROJECT, empty, inputs_run, records, run

sys.path.insert(0, str(PROJECT / "tests" / "coupled" / "support"))
from furrow_run import going, wait_until

PROGRAMS = ("slurmctld", "slurmd", "sbatch", "squeue", "scancel", "sinfo")
CONFIGURATION = """ClusterName=furrow
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/none
CredType=cred/none
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
ReturnToService=2
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
NodeName={host} NodeAddr=127.0.0.1 CPUs={cores} State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def free_ports(number):
    sockets = [socket.create_server(("127.0.0.1", 0)) for _ in range(number)]
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Slurm:
    """One node, while it lives in a with statement."""

    def __init__(self, folder):
        self.folder, self.daemons = folder, []

    def __enter__(self):
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        text = CONFIGURATION.format(
            host=socket.gethostname().split(".")[0], ports=free_ports(2), folder=self.folder,
            user=subprocess.check_output(["id", "-un"], text=True).strip(),
            cores=os.cpu_count())
        path = self.folder / "slurm.conf"
        path.write_text(text)
        os.environ["SLURM_CONF"] = str(path)
        for words in (["slurmctld", "-D", "-i"], ["slurmd", "-D"]):
            log = open(self.folder / f"{words[0]}.log", "wb")
            self.daemons.append(subprocess.Popen(words, stdout=log, stderr=log))
        until = time.monotonic() + 60
        while "idle" not in subprocess.run(["sinfo", "-h", "-o", "%T"], capture_output=True, text=True).stdout:
            if time.monotonic() > until:
                logs = "".join(p.read_text() for p in self.folder.glob("*.log"))
                self.__exit__()
                sys.exit(f"Slurm does not start:\n{logs}")
            time.sleep(0.5)
        return self

    def __exit__(self, *problem):
        for daemon in reversed(self.daemons):
            daemon.terminate()
            daemon.wait()


def main(results):
    missing = [name for name in PROGRAMS if not shutil.which(name)]
    if missing:
        print(f"{', '.join(missing)}: not installed (Debian: slurmctld slurmd slurm-client)")
        sys.exit(77)
    folder = empty(Path(results).resolve())
    out = folder / "a sweep"
    words = ["tyre_on_plane", "--quick", "--sweep", "slip=0,0.02,0.05", "-o", out]
    (folder / "node").mkdir()
    with Slurm(folder / "node"):
        submit = ["bash", PROJECT / "inputs" / "run", "--no-build", *words, "--submit", "slurm", "--jobs", "1"]
        with going(submit, folder) as begun:
            wait_until(lambda: records(out), begun, 300)
            job = json.loads((out / "slurm" / "job.json").read_text())["number"]
            run(["scancel", f"{job}_2"])
            begun.wait(300)
        print(said := (folder / "said").read_text())
        if begun.returncode != 1 or "slip_0.05: its task ended without a result" not in said:
            sys.exit(f"the task that was cancelled is not told, status {begun.returncode}")
        made = records(out)
        assert sorted(made) == ["slip_0", "slip_0.02"], f"Slurm made {sorted(made)}"
        print(said := inputs_run(*words, "--submit", "slurm"))  # the one that is missing
    after = records(out)
    if len(after) != 3 or any(after[name] != made[name] for name in made):
        sys.exit(f"the second job made {sorted(after)}, or some again")
    # On from here without Slurm, in the same folders
    words[3] = "slip=0,0.02,0.05,0.08"
    print(said := inputs_run(*words))
    assert "3 of them are there" in said and len(records(out)) == 4, "the sweep did not go on without Slurm"


if __name__ == "__main__":
    main(sys.argv[1])
