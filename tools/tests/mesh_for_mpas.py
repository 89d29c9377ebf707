"""Does what docs/mesh-for-mpas.md says: writes its Python files, whose first line is their name, and runs its commands.
Without METIS the partition is left out.

mesh_for_mpas.py PSTRIPACK PAGE FOLDER
"""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

PROGRAM, PAGE, FOLDER = (Path(argument).resolve() for argument in sys.argv[1:])
shutil.rmtree(FOLDER, ignore_errors=True)
(FOLDER / "bin").mkdir(parents=True)
(FOLDER / "bin/pstripack").symlink_to(PROGRAM)
(FOLDER / "bin/python3").symlink_to(sys.executable)
environment = os.environ | {"PATH": f"{FOLDER}/bin:{os.environ['PATH']}", "PYTHONDONTWRITEBYTECODE": "1"}

told = ""
for language, block in re.findall(r"(?ms)^```(\w+)\n(.*?)^```$", PAGE.read_text()):
    if language == "python":
        (FOLDER / re.match(r"# (\w+\.py)\n", block)[1]).write_text(block)
    elif not block.startswith("gpmetis") or shutil.which("gpmetis"):
        done = subprocess.run(["sh", "-eu", "-c", block], cwd=FOLDER, env=environment, capture_output=True, text=True)
        assert done.returncode == 0, block + done.stderr
        told += done.stdout + done.stderr

for line in ("the widths give [0-9]+ cells", "converged to 0.0003",
             "cells by sides: .*; all triangles hold their circumcentre",
             r"distance of neighbours over width asked for: (1\.00|0\.99)\d \+- 0\.0[0-6]",
             r"area over 4 pi: (1\.0{12}|0\.9{12}); obtuse triangles: 0"):
    assert re.search(line, told), line + " is not in\n" + told
assert "limited" not in told, told
for file in ("asked.svg", "got.svg", "ratio.svg", "mesh.graph.info"):
    assert (FOLDER / file).stat().st_size > 1000, file
