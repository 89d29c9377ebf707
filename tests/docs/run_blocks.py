#!/usr/bin/env python3
"""Runs the blocks of a page, in order and in one folder, and compares what they print with the page.

  run_blocks.py SOURCE WORK_DIR PAGE [HEADING]

Blocks of sh and of python run; a block without a language behind one holds its output. There "..." stands for any text,
and a line "..." for any lines. HEADING: only the blocks of this section.
"""
import re
import shutil
import subprocess
import sys
from pathlib import Path


def matches(expected, printed):
    lines = [r"(.*\n)*" if line == "..." else re.escape(line).replace(r"\.\.\.", ".*") + "\n"
             for line in expected.splitlines()]
    return re.fullmatch("".join(lines), printed)


def main():
    source, work, page = (Path(argument) for argument in sys.argv[1:4])
    text = (source / page).read_text()
    if len(sys.argv) > 4:
        text = re.search(rf"^## {re.escape(sys.argv[4])}\n(.*?)(?=^## |\Z)", text, re.MULTILINE | re.DOTALL)[1]
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    (work / "examples").symlink_to(source.resolve() / "examples")
    count, printed = 0, ""
    for language, block in re.findall(r"^```(\w*)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
        if not language:
            assert matches(block, printed), f"{page} has\n{block}\nbut this is printed:\n{printed}"
            continue
        command = {"sh": ["sh", "-eu"], "python": [sys.executable]}[language]
        done = subprocess.run(command, input=block, cwd=work, capture_output=True, text=True, timeout=100)
        assert done.returncode == 0, f"{block}\n{done.stdout}{done.stderr}"
        count, printed = count + 1, done.stdout
    assert count, "no blocks"
    print(f"{count} blocks of {page} ran")


main()
