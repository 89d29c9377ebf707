"""Runs each block of docs/python.md on its own. What it prints must be what the comments behind print say."""
import doctest
import importlib.util
import os
import re
import shutil
from pathlib import Path

import pytest

SOURCES = Path(os.environ["PSTRIPACK_SOURCES"])
PAGE = (SOURCES / "docs/python.md").read_text()
BLOCKS = [(PAGE[:block.start()].count("\n") + 2, block[1]) for block in re.finditer(r"(?ms)^```python\n(.*?)^```$", PAGE)]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """With stations.csv, which blocks read."""
    shutil.copy(SOURCES / "examples/stations/stations.csv", tmp_path)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "Agg")
    monkeypatch.setenv("MPLCONFIGDIR", str(tmp_path))


@pytest.mark.parametrize("line, block", BLOCKS, ids=[f"line {line}" for line, _ in BLOCKS])
def test_a_block_of_the_document_prints_what_it_says(line, block, folder, capsys):
    missing = [name for name in re.findall(r"(?m)^(?:import|from) (\w+)", block) if importlib.util.find_spec(name) is None]
    if not missing:
        try:
            exec(compile("\n" * (line - 1) + block, "python.md", "exec"), {})
        except ImportError as error:
            if type(error) is not ImportError or error.name is None:  # not of a package that a method needs
                raise
            missing.append(error.name)
    if missing:
        pytest.skip(f"the block of python.md in line {line} is not run: {', '.join(missing)} not found")
    said = re.findall(r"(?m)^ *print\(.*\) +# (.*)$", block)
    assert len(said) == len(re.findall(r"(?m)^ *print\(", block))
    printed = capsys.readouterr().out
    assert doctest.OutputChecker().check_output("".join(text + "\n" for text in said), printed, doctest.ELLIPSIS), printed


def test_the_document_has_blocks():
    assert len(BLOCKS) > 8
