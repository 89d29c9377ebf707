# A recipe for Spack; to use it in a copy of the sources:
#
#   spack repo create ~/pstripack-repo
#   mkdir -p ~/pstripack-repo/packages/pstripack
#   cp packaging/spack/package.py ~/pstripack-repo/packages/pstripack
#   spack repo add ~/pstripack-repo
#   spack dev-build pstripack@1.0.0
from spack.package import *


class Pstripack(CMakePackage):
    """Parallel, exact, drop-in replacement for STRIPACK (ACM Algorithm 772): Delaunay triangulation and
    Voronoi diagram of nodes on a sphere, behind the calls of STRIPACK."""

    license("BSD-3-Clause")

    version("1.0.0")

    variant("mpi", default=True, description="The libraries for MPI programs, and pstripack-run")
    variant("openmp", default=True, description="Threads")
    variant("shared", default=True, description="Dependents link the shared libraries; the archives are installed, too")
    variant("python", default=False, description="The Python package")
    variant("tools", default=False, description="The commands pstripack and stripack-compare")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("fortran", type="build")
    depends_on("cmake@3.20:", type="build")
    depends_on("boost@1.74:", type="build")
    depends_on("mpi", when="+mpi")
    depends_on("pkgconfig", type="build", when="+tools")
    depends_on("cli11", type="build", when="+tools")
    depends_on("nlohmann-json", type="build", when="+tools")
    depends_on("fmt", when="+tools")
    depends_on("netcdf-c", when="+tools")
    depends_on("py-pybind11@2.9:", type="build", when="+python")
    depends_on("py-numpy", type=("build", "run"), when="+python")

    extends("python@3.8:", when="+python")

    def cmake_args(self):
        args = [
            self.define_from_variant("PSTRIPACK_WITH_MPI", "mpi"),
            self.define_from_variant("PSTRIPACK_TOOLS", "tools"),
            self.define_from_variant("PSTRIPACK_PYTHON", "python"),
            self.define("CMAKE_DISABLE_FIND_PACKAGE_OpenMP", self.spec.satisfies("~openmp")),
            self.define("PSTRIPACK_TESTS", False),
            self.define("PSTRIPACK_EXAMPLES", False),
        ]
        if self.spec.satisfies("+python"):
            args.append(self.define("PSTRIPACK_PYTHON_DIR", python_platlib))
        return args
