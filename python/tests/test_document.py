"""Runs each block of docs/python.md, and the examples of each docstring, on their own. What blocks print must be what the
comments behind print say."""
import doctest
import importlib
import importlib.util
import os
import pkgutil
import re
import shutil
from pathlib import Path

import pstripack
import pytest

SOURCES = Path(os.environ["PSTRIPACK_SOURCES"])
PAGE = (SOURCES / "docs/python.md").read_text()
BLOCKS = [(PAGE[:block.start()].count("\n") + 2, block[1]) for block in re.finditer(r"(?ms)^```python\n(.*?)^```$", PAGE)]
MODULES = [pstripack] + [importlib.import_module(f"pstripack.{each.name}") for each in pkgutil.iter_modules(pstripack.__path__)]
DOCSTRINGS = [found for module in MODULES for found in doctest.DocTestFinder().find(module) if found.examples]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """With stations.csv, which blocks read."""
    shutil.copy(SOURCES / "examples/stations/stations.csv", tmp_path)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "Agg")
    monkeypatch.setenv("MPLCONFIGDIR", str(tmp_path))


def not_found(block):
    """Packages that a block imports, and that are not installed."""
    return [name for name in re.findall(r"(?m)^(?:import|from) (\w+)", block) if importlib.util.find_spec(name) is None]


@pytest.mark.parametrize("line, block", BLOCKS, ids=[f"line {line}" for line, _ in BLOCKS])
def test_a_block_of_the_document_prints_what_it_says(line, block, folder, capsys):
    missing = not_found(block)
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


@pytest.mark.parametrize("found", DOCSTRINGS, ids=lambda found: found.name)
def test_the_examples_of_a_docstring_print_what_it_says(found, folder):
    missing = not_found("".join(example.source for example in found.examples))
    if missing:
        pytest.skip(f"the examples of {found.name} are not run: {', '.join(missing)} not found")
    found.globs = {}
    assert doctest.DocTestRunner(optionflags=doctest.ELLIPSIS).run(found).failed == 0


def test_the_document_and_the_docstrings_have_examples():
    assert len(BLOCKS) > 8
    assert len(DOCSTRINGS) > 20
