# A recipe for Spack; to use it in a copy of the sources:
#
#   spack repo create ~/pstripack-repo
#   mkdir -p ~/pstripack-repo/packages/pstripack
#   cp packaging/spack/package.py ~/pstripack-repo/packages/pstripack
#   spack repo add ~/pstripack-repo
#   spack dev-build pstripack@0.1.0
from spack.package import *


class Pstripack(CMakePackage):
    """Parallel, exact, drop-in replacement for STRIPACK (ACM Algorithm 772): Delaunay triangulation and
    Voronoi diagram of nodes on a sphere, behind the calls of STRIPACK."""

    license("BSD-3-Clause")

    version("0.1.0")

    variant("mpi", default=True, description="The libraries for MPI programs, and pstripack-run")
    variant("tools", default=False, description="The commands pstripack and stripack-compare")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("fortran", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("boost@1.74:", type="build")
    depends_on("mpi", when="+mpi")
    depends_on("pkgconfig", type="build", when="+tools")
    depends_on("cli11", type="build", when="+tools")
    depends_on("nlohmann-json", type="build", when="+tools")
    depends_on("fmt", when="+tools")
    depends_on("netcdf-c", when="+tools")

    def cmake_args(self):
        return [
            self.define_from_variant("PSTRIPACK_WITH_MPI", "mpi"),
            self.define_from_variant("PSTRIPACK_TOOLS", "tools"),
            self.define("PSTRIPACK_TESTS", False),
            self.define("PSTRIPACK_EXAMPLES", False),
            self.define("PSTRIPACK_PYTHON", False),
        ]
