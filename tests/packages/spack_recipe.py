#!/usr/bin/env python3
"""Runs the recipe for Spack with a stand-in for Spack. It must be correct Python, have the project's version, name existing
variants in conditions, pass existing options to CMake, depend on all that CMake looks for, and accept the package
installed in PREFIX.

  spack_recipe.py ROOT PREFIX WORK_DIR
"""
import contextlib
import os
import re
import subprocess
import sys
import types
from pathlib import Path

ROOT, PREFIX, WORK_DIR = map(Path, sys.argv[1:])
recipe = ROOT / "packaging/spack/package.py"
versions, variants, dependencies, conditions = [], {}, {}, []


class Spec:
    def satisfies(self, condition):
        assert condition[1:] in variants, condition
        return variants[condition[1:]] == (condition[0] == "+")


class Executable:
    def __init__(self, path):
        self.path = path

    def __call__(self, *arguments, output=None):
        return subprocess.run([self.path, *arguments], check=True, text=True, stdout=subprocess.PIPE).stdout


def find_libraries(names, root, shared, recursive):
    found = [list(root.rglob(name + (".so" if shared else ".a"))) for name in names]
    assert recursive and all(found), found
    return found


class CMakePackage:
    spec = Spec()
    prefix = types.SimpleNamespace(bin=types.SimpleNamespace(join=lambda name: PREFIX / "bin" / name), rglob=PREFIX.rglob)
    stage = types.SimpleNamespace(source_path=ROOT)
    compiler = types.SimpleNamespace(fc="gfortran")
    build_directory = WORK_DIR

    def define(self, name, value):
        return name, value

    def define_from_variant(self, name, variant):
        assert variant in variants, f"no variant {variant}"
        return name, variant


def variant(name, default, description):
    assert isinstance(default, bool) and description
    variants[name] = default


def depends_on(spec, type=("build", "link"), when=None):
    dependencies[re.split("[@+~]", spec)[0]] = spec
    conditions.append(when)


@contextlib.contextmanager
def working_dir(folder):
    folder.mkdir(parents=True, exist_ok=True)
    before = os.getcwd()
    os.chdir(folder)
    yield
    os.chdir(before)


names = {"CMakePackage": CMakePackage, "version": versions.append, "variant": variant, "depends_on": depends_on,
         "license": lambda name: None, "extends": depends_on, "Executable": Executable, "find_libraries": find_libraries,
         "run_after": lambda phase: lambda method: method, "on_package_attributes": lambda run_tests: lambda method: method,
         "join_path": os.path.join, "working_dir": working_dir, "InstallError": RuntimeError, "python_platlib": "platlib"}
spack, package = types.ModuleType("spack"), types.ModuleType("spack.package")
package.__dict__.update(names)
sys.modules.update({"spack": spack, "spack.package": package})
scope = {}
exec(compile(recipe.read_text(), recipe, "exec"), scope)

project = (ROOT / "CMakeLists.txt").read_text()
version = "".join(re.search(pattern, project)[1] for pattern in (r"project\(pstripack VERSION (\S+)",
                                                                 r"set\(PSTRIPACK_CANDIDATE ?(\S*)\)"))
assert versions == [version], versions
assert f"pstripack@{versions[0]}" in recipe.read_text(), "the command in the recipe has another version"
assert dependencies["cmake"] == f"cmake@{re.search(r'cmake_minimum_required.VERSION ([0-9]+.[0-9]+)', project)[1]}:"
for condition in filter(None, conditions):
    assert condition[0] in "+~" and condition[1:] in variants, condition

options = set(re.findall(r"(?m)^option\((\w+)", project)) | {"PSTRIPACK_PYTHON_DIR", "CMAKE_DISABLE_FIND_PACKAGE_OpenMP"}
pstripack = scope["Pstripack"]()
for name in variants:  # each variant on and off
    variants[name] = not variants[name]
    pstripack.cmake_args()
    pstripack.libs
    variants[name] = not variants[name]
variants["python"] = True
given = dict(pstripack.cmake_args())
variants["python"] = False
pstripack.check_install()
assert set(given) <= options, f"no such options: {set(given) - options}"
assert given["PSTRIPACK_WITH_MPI"] == "mpi" and given["PSTRIPACK_TOOLS"] == "tools", given

# What CMake looks for in the parts that the recipe builds.
spack_name = {"Boost": "boost", "MPI": "mpi", "CLI11": "cli11", "nlohmann_json": "nlohmann-json", "fmt": "fmt",
              "PkgConfig": "pkgconfig"}
parts = [ROOT / "CMakeLists.txt", ROOT / "src/cxx/CMakeLists.txt", ROOT / "tools/CMakeLists.txt",
         ROOT / "compare/CMakeLists.txt"]
wanted = {name for part in parts for name in re.findall(r"find_package\((\w+)", part.read_text())}
missing = {name for name in wanted - {"OpenMP", "Threads"} if spack_name.get(name) not in dependencies}
assert not missing, f"the recipe does not depend on {missing}"
print(f"{len(variants)} variants, {len(dependencies)} dependencies, {len(given)} options")
