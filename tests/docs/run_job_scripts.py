#!/usr/bin/env python3
"""Tests the job scripts for Slurm and PBS in docs/modes.md, one each, with a last line for each mode. Each must be
correct bash and have its directives before the first command. With --run, each must do what its mode says: the model
runs once, or on every rank, with the threads of a rank. mpirun and pstripack-run are real; this program sets the
variables of the batch system.

  run_job_scripts.py MODES.MD WORK_DIR [--run]
"""
import os
import re
import subprocess
import sys
from pathlib import Path

RANKS, THREADS = 2, 1
MODEL = '#!/bin/sh\necho "rank ${OMPI_COMM_WORLD_RANK:-of a serial model}, $OMP_NUM_THREADS threads"\n'
SETTINGS = {"SBATCH": {"SLURM_NTASKS": str(RANKS), "SLURM_CPUS_PER_TASK": str(THREADS)},
            "PBS": {"PBS_O_WORKDIR": ".", "PBS_NODEFILE": "nodes", "OMP_NUM_THREADS": str(THREADS)}}


def check_directives(script, system):
    """Directives must come before the first command; the batch system ignores later ones."""
    first, *rest = script.split("\n")
    assert first == "#!/bin/bash", first
    directives = [line for line in rest if line.startswith(f"#{system} ")]
    assert len(directives) >= 2 and rest[:len(directives)] == directives, f"directives of {system} are not at the head"


def check_run(script, system, folder):
    done = subprocess.run(["bash", "job"], cwd=folder, env=os.environ | SETTINGS[system], capture_output=True, text=True,
                          timeout=60)
    assert done.returncode == 0, done.stderr
    ranks = range(RANKS) if "\nmpirun" in script else ["of a serial model"]
    expected = [f"rank {rank}, {THREADS} threads" for rank in ranks]
    assert sorted(done.stdout.split("\n"))[1:] == expected, done.stdout


def main():
    text, work, run = Path(sys.argv[1]).read_text(), Path(sys.argv[2]), sys.argv[3:] == ["--run"]
    section = re.search(r"^## Job scripts\n(.*)", text, re.MULTILINE | re.DOTALL)[1]
    scripts = re.findall(r"^```sh\n(#!.*?)^```", section, re.MULTILINE | re.DOTALL)
    assert len(scripts) == len(SETTINGS), f"{len(scripts)} job scripts"
    for system, whole in zip(SETTINGS, scripts):
        last_lines = re.findall(r"^(.*\S) +# (threads|pool|comm, distributed, own calls)\n", whole, re.MULTILINE)
        assert len(last_lines) == 3, f"{system}: {len(last_lines)} last lines"
        head = whole[:whole.index(last_lines[0][0])]
        for command, mode in last_lines:
            script = f"{head}{command}\n"
            folder = work / f"{mode[:4]}-{system}"
            folder.mkdir(parents=True, exist_ok=True)
            (folder / "job").write_text(script)
            (folder / "model").write_text(MODEL)
            (folder / "model").chmod(0o755)
            (folder / "nodes").write_text("localhost\n" * RANKS)
            try:
                subprocess.run(["bash", "-n", folder / "job"], check=True)
                check_directives(script, system)
                if run:
                    check_run(script, system, folder)
            except (AssertionError, subprocess.SubprocessError) as error:
                sys.exit(f"{mode}, {system}: {error}\n{script}")
            print(f"{mode}, {system}: right")


if __name__ == "__main__":
    main()
