#!/usr/bin/env python3
"""What auditwheel would say of a wheel or of one module: which libraries it would copy into the wheel, and the oldest
systems that have the symbol versions which the module needs, as the manylinux tag of their glibc. Reads the module by
objdump.

  wheel_tag.py WHEEL|MODULE.so
"""
import re
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

# Libraries that every system has, of those that auditwheel accepts.
OF_SYSTEMS = re.compile(r"(ld-linux.*|libc|libm|libdl|libpthread|librt|libgcc_s|libstdc\+\+)\.so\.\d+")
# glibc, and the newest versions of the symbols of the libstdc++ and libgcc_s beside it (in brackets: their GCC).
TAGS = {"manylinux_2_17": {"GLIBC": "2.17", "GLIBCXX": "3.4.19", "CXXABI": "1.3.7", "GCC": "4.8.0"},    # (4.8)
        "manylinux_2_28": {"GLIBC": "2.28", "GLIBCXX": "3.4.25", "CXXABI": "1.3.11", "GCC": "7.0.0"},   # (8)
        "manylinux_2_31": {"GLIBC": "2.31", "GLIBCXX": "3.4.28", "CXXABI": "1.3.12", "GCC": "9.0.0"},   # (9)
        "manylinux_2_34": {"GLIBC": "2.34", "GLIBCXX": "3.4.29", "CXXABI": "1.3.13", "GCC": "9.0.0"},   # (11)
        "manylinux_2_36": {"GLIBC": "2.36", "GLIBCXX": "3.4.30", "CXXABI": "1.3.13", "GCC": "12.0.0"}}  # (12)


def number(version):
    return tuple(int(part) for part in version.split("."))


def needs_of(module):
    """Its libraries, and for each kind of symbols the newest version."""
    text = subprocess.run(["objdump", "-p", module], check=True, text=True, stdout=subprocess.PIPE).stdout
    versions = {}
    for kind, version in re.findall(r"\b(GLIBC|GLIBCXX|CXXABI|GCC)_(\d[\d.]*)$", text.split("Version References:")[-1], re.M):
        versions[kind] = max(versions.get(kind, "0"), version, key=number)
    return re.findall(r"NEEDED +(\S+)", text), versions


def tag_of(versions):
    """The first tag whose systems have all; None: newer than the table."""
    return next((tag for tag, has in TAGS.items()
                 if all(kind in has and number(version) <= number(has[kind]) for kind, version in versions.items())), None)


def main(file):
    with tempfile.TemporaryDirectory() as folder:
        module = Path(file)
        if module.suffix == ".whl":
            with zipfile.ZipFile(module) as wheel:
                [name] = [name for name in wheel.namelist() if ".so" in name]
                module = Path(wheel.extract(name, folder))
        libraries, versions = needs_of(module)
    copied = [library for library in libraries if not OF_SYSTEMS.fullmatch(library)]
    print(f"{Path(file).name}: needs {', '.join(f'{kind}_{version}' for kind, version in sorted(versions.items()))}: "
          f"{tag_of(versions)}; to copy: {', '.join(copied) or 'nothing'}")
    return copied


if __name__ == "__main__":
    main(sys.argv[1])
