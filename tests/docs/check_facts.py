#!/usr/bin/env python3
"""Fails unless facts that documents repeat are those of the sources: codes and their names, functions, environment
variables, the version.

  check_facts.py ROOT
"""
import json
import re
import sys
from pathlib import Path

ROOT = Path(sys.argv[1])
problems = []


def read(path):
    return (ROOT / path).read_text()


def compare(what, expected, found):
    for item in sorted(expected ^ found, key=str):
        problems.append(f"{what}: {item} is only in the {'sources' if item in expected else 'document'}")


def codes():
    """Compares (name, value) of each code in the header and the modules with docs/api/ier.md, and of options and reasons
    of centroidal tessellations with docs/scvt-interface.md."""
    header = read("src/cxx/capi/pstripack.h")
    declared = re.findall(r"(?:CODE\(|^  )(PSTRIPACK_\w+)(?: =|,) (-?\d+)", header, re.MULTILINE)
    for module in "pstripack", "pstripack_mpi":
        constants = re.findall(r"(?s)integer\(c_int32_t\), parameter :: .*?(?=\n\n)", read(f"src/fortran/{module}.f90"))
        declared += [(name.upper(), value) for text in constants
                     for name, value in re.findall(r"(pstripack_\w+) = (-?\d+)", text)]
    # A rank, and a second name of PSTRIPACK_COINCIDENT.
    declared = {pair for pair in declared if pair[0] not in ("PSTRIPACK_EVERY_RANK", "PSTRIPACK_SCVT_COINCIDENT")}
    of_scvt = {(name, value) for name, value in declared if name.startswith("PSTRIPACK_SCVT_") and int(value) >= 0}
    for document, expected in ("docs/api/ier.md", declared - of_scvt), ("docs/scvt-interface.md", of_scvt):
        tables = re.findall(r"(?m)^\| (-?\d+) \| (PSTRIPACK_\w+) \|", read(document))
        compare(document, expected, {(name, value) for value, name in tables})


def functions():
    """Compares the functions of the C headers with their man pages, except names that end in an underscore, for Fortran."""
    for name in "pstripack", "pstripack_mpi":
        declared = set(re.findall(r"(?m)^PSTRIPACK_API .*?(\w*[^_\W])\(", read(f"src/cxx/capi/{name}.h")))
        of_scvt = {function for function in declared if function.startswith("pstripack_scvt")}
        for page, expected in (name, declared - of_scvt), ("pstripack_scvt", of_scvt):
            if not expected:
                continue
            synopsis = re.search(r"(?s)\.SH SYNOPSIS\n.*?#include(.*?)\.SH", read(f"docs/man/man3/{page}.3"))[1]
            compare(f"docs/man/man3/{page}.3", expected, set(re.findall(r"\w+ \*?(pstripack_\w+)\(", synopsis)))


def fortran_calls():
    """Compares the procedures of type(pstripack_mesh) with its man page and docs/modes.md."""
    module = read("src/fortran/pstripack_mpi.f90")
    declared = set(re.findall(r"(?m)^    (?:procedure|generic), public :: (\w+)", module)) - {"assignment"}
    for document in "docs/man/man3/pstripack_mpi.3", "docs/modes.md":
        compare(document, declared, set(re.findall(r"mesh%(\w+)\(", read(document))))


def environment():
    """Compares the variables PSTRIPACK_* that the engine reads, except PSTRIPACK_POOL*, which is internal."""
    used = {name for path in (ROOT / "src").rglob("*.cpp")
            for name in re.findall(r'environment_variable\("(PSTRIPACK_(?!POOL)\w+)"\)', path.read_text())}
    named = {"docs/modes.md": used - {"PSTRIPACK_COMPARE"},
             "docs/man/man3/pstripack.3": used - {"PSTRIPACK_COMPARE", "PSTRIPACK_MPIRUN"},
             "docs/man/man1/pstripack-run.1": {"PSTRIPACK_MPIRUN", "PSTRIPACK_REPORT"}}
    for document, expected in named.items():
        compare(document, expected, set(re.findall(r"\bPSTRIPACK_[A-Z]+(?:_START)?\b", read(document))))


def version():
    number = "".join(re.search(pattern, read("CMakeLists.txt"))[1] for pattern in (r"project\(pstripack VERSION (\S+)",
                                                                                 r"set\(PSTRIPACK_CANDIDATE ?(\S*)\)"))
    for document, pattern in ("CITATION.cff", rf"(?m)^version: {number}$"), ("CHANGELOG.md", rf"(?m)^## {number}\b"):
        if not re.search(pattern, read(document)):
            problems.append(f"{document}: not version {number}")


def commands():
    """Checks that options and presets of CMake in the commands of all documents exist."""
    options = set(re.findall(r"(?m)^(?:option|set)\((\w*STRIPACK_\w+)", read("CMakeLists.txt")))
    presets = {one["name"] for kind, all_of in json.loads(read("CMakePresets.json")).items() if kind.endswith("Presets")
               for one in all_of}
    for path in ROOT.glob("*.md"), ROOT.glob("docs/**/*.md"):
        for page in path:
            text = page.read_text()
            for what, known, found in (("option", options, re.findall(r"-D(\w*STRIPACK_(?:WITH|TESTS|TOOLS|EXAMPLES|ORIGINAL)\w*)=", text)),
                                       ("preset", presets, re.findall(r"--preset ([\w-]+)", text))):
                problems.extend(f"{page.relative_to(ROOT)}: no {what} {name}" for name in set(found) - known)


for check in codes, functions, fortran_calls, environment, version, commands:
    check()
print("\n".join(problems) or "as in the sources")
sys.exit(1 if problems else 0)
