"""pip install ./python in a checkout: builds the module, with the library inside, by the project's CMake. Needs CMake 3.25,
g++, gfortran and Boost's headers (Debian: cmake g++ gfortran libboost-dev)."""
import re
import subprocess
import sys
from pathlib import Path

import pybind11
from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

PROJECT = Path(__file__).resolve().parents[1]
OFF = ("TESTS", "TOOLS", "EXAMPLES", "WITH_MPI")


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        build = Path(self.build_temp).resolve()
        built = build / "python" / "pstripack" / Path(self.get_ext_filename("_core")).name
        run = subprocess.check_call
        run(["cmake", "-S", PROJECT, "-B", build, "-DCMAKE_BUILD_TYPE=Release", "-DPSTRIPACK_PYTHON=ON",
             "-DPSTRIPACK_PYTHON_LINKS=pstripack_archive", f"-DPSTRIPACK_PYTHON_EXECUTABLE={sys.executable}",
             f"-Dpybind11_DIR={pybind11.get_cmake_dir()}", *(f"-DPSTRIPACK_{part}=OFF" for part in OFF)])
        run(["cmake", "--build", build, "--parallel", *([str(self.parallel)] if self.parallel else []),
             "--target", "pstripack_python"])
        target = Path(self.get_ext_fullpath(extension.name)).resolve()
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(built), str(target))


version = re.search(r"project\(pstripack VERSION (\S+)", (PROJECT / "CMakeLists.txt").read_text())[1]
setup(version=version, ext_modules=[Extension("pstripack._core", sources=[])], cmdclass={"build_ext": CMakeBuild})
