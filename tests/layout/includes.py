#!/usr/bin/env python3
"""Fails on an #include against the direction of the layers. usage: includes.py SOURCE_FOLDER"""
import pathlib
import re
import sys

# The table of src/README.md: what each folder may include directly; it may also include what these folders may include.
MAP = (pathlib.Path(__file__).resolve().parents[2] / "src/README.md").read_text()
ALLOWED = {folder: re.findall(r"`(\w+)`", may) for folder, may in re.findall(r"(?m)^\| `(\w+)` \|.*\|([^|]*)\|$", MAP)}
OUTSIDE = ("tools", "legacy_stripack", "compare", "python")  # the others are folders of src/cxx
ENGINE = [folder for folder in ALLOWED if folder not in OUTSIDE]
# In the engine only src/cxx/mpi and the public header pstripack_mpi.h may use MPI.
WITH_MPI = {"src/cxx/mpi", "src/cxx/capi", "tools", "compare"}


def below(layer, found=None):
    found = set() if found is None else found
    for other in ALLOWED[layer]:
        if other not in found:
            found.add(other)
            below(other, found)
    return found


def main(root):
    wrong = []
    sources = {}  # file -> layer
    for folder in sorted((root / "src/cxx").iterdir()):
        if folder.is_dir() and folder.name not in ENGINE:
            wrong.append(f"src/cxx/{folder.name}: no such layer; src/README.md has the map")
        elif folder.is_dir():
            sources.update({file: folder.name for file in folder.rglob("*") if file.suffix in (".h", ".cpp")})
    for name in OUTSIDE:
        sources.update({file: name for file in (root / name).rglob("*") if file.suffix in (".h", ".cpp")
                        and "tests" not in file.relative_to(root / name).parts})
    by_name = {}  # last part of a path -> files
    for file in sources:
        by_name.setdefault(file.name, []).append(file)

    for file, layer in sorted(sources.items()):
        where = file.relative_to(root)
        may = below(layer) | {layer}
        with_mpi = any(str(where).startswith(folder + "/") for folder in WITH_MPI)
        for number, line in enumerate(file.read_text().splitlines(), 1):
            if re.search(r"\bMPI_\w+\s*\(", line.split("//")[0]) and not with_mpi:
                wrong.append(f"{where}:{number}: calls MPI")
            include = re.match(r'\s*#\s*include\s*(?:"([^"]+)"|<mpi\.h>)', line)
            if not include:
                continue
            if include[1] == "capi/pstripack.h":  # the codes, which every layer returns; it includes nothing of ours
                continue
            if include[1] is None:
                if not with_mpi:
                    wrong.append(f"{where}:{number}: mpi.h")
                continue
            found = {sources[other] for other in by_name.get(pathlib.PurePath(include[1]).name, [])
                     if ("/" + str(other)).endswith("/" + include[1])}
            if found and layer not in found and not found & may:
                wrong.append(f"{where}:{number}: {layer} must not include {include[1]} of {', '.join(sorted(found))}")
    # Two folders that include each other would be one layer.
    for layer in ALLOWED:
        if layer in below(layer):
            wrong.append(f"{layer} lies below itself")
    print("\n".join(wrong) if wrong else f"{len(sources)} files keep to the layers")
    return 1 if wrong else 0


sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
