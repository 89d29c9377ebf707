"""Builds the Python module, with the library inside, by the project's CMake: `pip install ./python` in a checkout, or
`pip wheel`. `python3 -m build python` makes a source distribution, which holds what that needs, and a wheel of it. Needs
CMake 3.20, a C++ compiler and Boost's headers (Debian: cmake g++ libboost-dev); CMAKE_ARGS has more options of CMake."""
import ast
import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pybind11
from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.command.sdist import sdist

HERE = Path(__file__).resolve().parent
# In a source distribution the parts of the project are in a folder.
PROJECT = HERE / "project" if (HERE / "project").is_dir() else HERE.parent
PARTS = ("CMakeLists.txt", "LICENSE", "cmake", "docs/CMakeLists.txt", "packaging", "python/CMakeLists.txt",
         "python/pyproject.toml", "python/core", "python/src", "src/cxx", "tools/files", "tools/globe.cmake", "tools/methods", "tools/pictures",
         "tools/point_sets")
OFF = ("TESTS", "TOOLS", "EXAMPLES", "WITH_MPI", "WITH_FORTRAN", "SHARED")
NEEDS = ("pstripack: to build it, CMake 3.20 (pip install cmake), a C++ compiler and Boost's headers, version 1.74 or later, are needed "
         "(Debian: apt-get install cmake g++ libboost-dev)")


def configure(command):
    if shutil.which(command[0]) is None or subprocess.run(command).returncode != 0:
        sys.exit(NEEDS)


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        build = Path(self.build_temp).resolve()
        built = build / "python" / "pstripack" / Path(self.get_ext_filename("_core")).name
        configure(["cmake", "-S", PROJECT, "-B", build, "-DCMAKE_BUILD_TYPE=Release", "-DPSTRIPACK_PYTHON=ON",
                   "-DPSTRIPACK_PYTHON_LINKS=pstripack_archive", f"-DPSTRIPACK_PYTHON_EXECUTABLE={sys.executable}",
                   f"-Dpybind11_DIR={pybind11.get_cmake_dir()}", *(f"-DPSTRIPACK_{part}=OFF" for part in OFF),
                   *shlex.split(os.environ.get("CMAKE_ARGS", ""))])
        subprocess.check_call(["cmake", "--build", build, "--parallel", *([str(self.parallel)] if self.parallel else []),
                               "--target", "pstripack_python"])
        target = Path(self.get_ext_fullpath(extension.name)).resolve()
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(built), str(target))


class SourcesOfProject(sdist):
    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, files)
        for part in PARTS:
            source, target = PROJECT / part, Path(base_dir) / "project" / part
            if source.is_dir():
                shutil.copytree(source, target, ignore=shutil.ignore_patterns("__pycache__", "*.egg-info", "build"))
            else:
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(source, target)


project = (PROJECT / "CMakeLists.txt").read_text()
version = "".join(re.search(pattern, project)[1] for pattern in (r"project\(pstripack VERSION (\S+)",
                                                                 r"set\(PSTRIPACK_CANDIDATE ?-?(\S*)\)"))
description = ast.get_docstring(ast.parse((HERE / "src/pstripack/__init__.py").read_text()))
setup(version=version, long_description=description, long_description_content_type="text/x-rst",
      ext_modules=[Extension("pstripack._core", sources=[])],
      cmdclass={"build_ext": CMakeBuild, "sdist": SourcesOfProject})
