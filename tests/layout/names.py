#!/usr/bin/env python3
"""Fails if a name means two things in src/cxx. usage: names.py SOURCE_FOLDER

No two files may have the same name, and no file may define a type with the name of a type from another file's header.
Nested types, and types that are local to source files, may share a name."""
import pathlib
import re
import sys

TYPE = re.compile(r"^(?:struct|class|union|enum(?: class)?) (?:\[\[.*?\]\] |alignas\(.*?\) )?(\w+)(?: final)?\s*(?:\{|:[^:])",
                  re.MULTILINE)


def main(root):
    files = sorted(file for file in (root / "src/cxx").rglob("*") if file.suffix in (".h", ".cpp"))
    by_name, by_type = {}, {}
    for file in files:
        by_name.setdefault(file.name, []).append(file)
        for name in set(TYPE.findall(file.read_text())):
            by_type.setdefault(name, []).append(file)

    def where(places):
        return ", ".join(str(file.relative_to(root)) for file in places)

    wrong = [f"{name}: two files of this name: {where(places)}" for name, places in by_name.items() if len(places) > 1]
    wrong += [f"{name}: two types of this name: {where(places)}" for name, places in sorted(by_type.items())
              if len(places) > 1 and any(file.suffix == ".h" for file in places)]
    print("\n".join(wrong) if wrong else f"{len(by_type)} types in {len(files)} files")
    return 1 if wrong or not by_type else 0


sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
