#!/usr/bin/env python3
"""Runs the recipe for Spack with a stand-in for Spack. It must be correct Python, have the project's version, name existing
variants in conditions, pass existing options to CMake, and depend on all that CMake looks for.

  spack_recipe.py ROOT
"""
import re
import sys
import types
from pathlib import Path

ROOT = Path(sys.argv[1])
recipe = ROOT / "packaging/spack/package.py"
versions, variants, dependencies, conditions = [], {}, {}, []


class CMakePackage:
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


names = {"CMakePackage": CMakePackage, "version": versions.append, "variant": variant, "depends_on": depends_on,
         "license": lambda name: None}
spack, package = types.ModuleType("spack"), types.ModuleType("spack.package")
package.__dict__.update(names)
sys.modules.update({"spack": spack, "spack.package": package})
scope = {}
exec(compile(recipe.read_text(), recipe, "exec"), scope)

project = (ROOT / "CMakeLists.txt").read_text()
assert versions == [re.search(r"project\(pstripack VERSION (\S+)", project)[1]], versions
assert f"pstripack@{versions[0]}" in recipe.read_text(), "the command in the recipe has another version"
assert dependencies["cmake"] == f"cmake@{re.search(r'cmake_minimum_required.VERSION ([0-9.]+)', project)[1]}:"
for condition in filter(None, conditions):
    assert condition[0] in "+~" and condition[1:] in variants, condition

options = set(re.findall(r"(?m)^option\((\w+)", project))
given = dict(scope["Pstripack"]().cmake_args())
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
