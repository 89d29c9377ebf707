#!/usr/bin/env python3
"""The metadata of `cmake --install` are those of pip, pip's are complete, and the checker of wheels reads a module.

  metadata.py SOURCE_DIR BUILD_DIR MODULE.so
"""
import importlib.metadata
import sys
from pathlib import Path

import wheel_tag

try:
    import tomllib
except ImportError:  # before Python 3.11
    sys.exit(0)

source, build, module = map(Path, sys.argv[1:])
project = tomllib.loads((source / "pyproject.toml").read_text())["project"]
[folder] = build.glob("*.dist-info")
installed = importlib.metadata.Distribution.at(folder).metadata
assert folder.name == f"pstripack-{installed['Version']}.dist-info"
assert installed["Name"] == project["name"] and installed["Summary"] == project["description"], installed.items()
assert installed["License"] == project["license"]["text"] and installed["Requires-Python"] == project["requires-python"]
extras = project["optional-dependencies"]
assert installed.get_all("Provides-Extra") == list(extras)
assert installed.get_all("Requires-Dist") == project["dependencies"] + [
    f'{package}; extra == "{extra}"' for extra, packages in extras.items() for package in packages]
assert project["urls"] and project["classifiers"] and project["keywords"] and project["authors"]

wheel_tag.main(module)
wanted = {"GLIBC": "2.17", "GLIBCXX": "3.4.19"}
assert wheel_tag.tag_of(wanted) == "manylinux_2_17"
assert wheel_tag.tag_of({**wanted, "GLIBC": "2.18"}) == wheel_tag.tag_of({**wanted, "GLIBCXX": "3.4.20"}) == "manylinux_2_28"
assert wheel_tag.tag_of({**wanted, "GLIBC": "2.99"}) is None
