# Debian packages: `cmake --workflow --preset packages` configures for /usr, builds and packs; `cpack -G DEB` packs any
# other build. One package per component of the install rules; finish-packages.cmake adds what Debian requires.
include(${CMAKE_CURRENT_LIST_DIR}/project-address.cmake)

set(CPACK_PACKAGE_NAME pstripack)
set(CPACK_PACKAGE_VERSION ${PSTRIPACK_DEBIAN_VERSION})
set(CPACK_PACKAGE_CONTACT ${PSTRIPACK_PUBLISHER})
set(CPACK_DEBIAN_PACKAGE_HOMEPAGE ${PSTRIPACK_HOMEPAGE})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own summary
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_GENERATOR DEB)
set(CPACK_STRIP_FILES ON)
set(CPACK_THREADS 0)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
                                                WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/finish-packages.cmake)
set(CPACK_PSTRIPACK_SOURCE_DIR ${PROJECT_SOURCE_DIR})
set(CPACK_PSTRIPACK_BINARY_DIR ${PROJECT_BINARY_DIR})

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 0upstream1)  # sorts before a release 1 of Debian, which would replace it
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/src/cxx/capi ${PROJECT_BINARY_DIR}/src/fortran)
set(CPACK_COMPONENTS_ALL "")

# debian_package(component NAME package SECTION section SUMMARY line DESCRIPTION text
#                [DEPENDS package...] [RECOMMENDS package...] [SUGGESTS package...] [LIBRARIES name...])
#
# LIBRARIES: the shared libraries in the package that other programs link. Relations to libpstripack packages require
# exactly this version.
macro(debian_package component)
  cmake_parse_arguments(arg "" "NAME;SECTION;SUMMARY;DESCRIPTION" "DEPENDS;RECOMMENDS;SUGGESTS;LIBRARIES" ${ARGN})
  string(TOUPPER ${component} COMPONENT)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME ${arg_NAME})
  set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_SECTION ${arg_SECTION})
  set(CPACK_COMPONENT_${COMPONENT}_DESCRIPTION "${arg_SUMMARY}\n${arg_DESCRIPTION}")
  foreach(relation DEPENDS RECOMMENDS SUGGESTS)
    list(TRANSFORM arg_${relation} REPLACE "^libpstripack.*$"
         "\\0 (= ${PSTRIPACK_DEBIAN_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
    list(JOIN arg_${relation} ", " CPACK_DEBIAN_${COMPONENT}_PACKAGE_${relation})
  endforeach()
  if(NOT arg_NAME MATCHES "-(dev|doc)$")  # cpack starts two programs for each file that may need a library
    set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_SHLIBDEPS ON)
  endif()
  if(arg_LIBRARIES)
    set(control ${PROJECT_BINARY_DIR}/packaging/${component})
    list(TRANSFORM arg_LIBRARIES REPLACE ".+" "\\0 ${PSTRIPACK_SOVERSION} ${arg_NAME} (>= ${PSTRIPACK_DEBIAN_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})\n")
    file(WRITE ${control}/shlibs ${arg_LIBRARIES})
    file(WRITE ${control}/triggers "activate-noawait ldconfig\n")
    set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_CONTROL_EXTRA ${control}/shlibs ${control}/triggers)
  endif()
endmacro()

set(about "PSTRIPACK computes Delaunay triangulations and Voronoi diagrams on the
sphere, exactly and in parallel, behind the calls of STRIPACK (ACM
Algorithm 772).
.
")
set(soversion ${PSTRIPACK_SOVERSION})
debian_package(runtime NAME libpstripack${soversion} SECTION libs
  LIBRARIES libpstripack libpstripack_fortran libstripack libstripack_r4 libstripack_8arg libstripack_i8
  SUMMARY "Delaunay triangulation on the sphere: drop-in replacement of STRIPACK"
  DESCRIPTION "${about}This package has the shared libraries, and links by which a program that is
linked with another libstripack.so runs with them.")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_REPLACES libpstripack0)  # of 1.0.0-rc1: these links are at the same paths
debian_package(development NAME libpstripack-dev SECTION libdevel
  DEPENDS libpstripack${soversion} RECOMMENDS gfortran pkg-config SUGGESTS libpstripack-mpi-dev g++
  SUMMARY "Delaunay triangulation on the sphere: to link programs"
  DESCRIPTION "${about}This package has the headers, Fortran modules, static libraries, man
pages, pkg-config files, the CMake package and pstripack-config.")
if(PSTRIPACK_WITH_MPI)
  if("${MPI_C_LIBRARIES}" MATCHES mpich)
    set(mpi_packages mpich libmpich-dev)
  else()
    set(mpi_packages openmpi-bin libopenmpi-dev)
  endif()
  list(POP_FRONT mpi_packages mpirun_package mpi_dev_package)
  debian_package(mpi NAME libpstripack-mpi${soversion} SECTION libs LIBRARIES libpstripack_mpi libpstripack_mpi_fortran
    DEPENDS libpstripack${soversion}
    SUMMARY "Delaunay triangulation on the sphere: libraries for MPI programs"
    DESCRIPTION "${about}This package has the shared libraries for programs that use MPI
themselves.")
  debian_package(mpi_development NAME libpstripack-mpi-dev SECTION libdevel
    DEPENDS libpstripack-mpi${soversion} libpstripack-dev ${mpi_dev_package}
    SUMMARY "Delaunay triangulation on the sphere: to link MPI programs"
    DESCRIPTION "${about}This package has the header, Fortran module, static libraries and man
page for programs that use MPI themselves.")
  debian_package(mpi_tools NAME pstripack-mpi SECTION science
    DEPENDS libpstripack${soversion} ${mpirun_package}
    SUMMARY "Delaunay triangulation on the sphere: MPI ranks for serial programs"
    DESCRIPTION "${about}This package has pstripack-run, which starts an unchanged serial program
with MPI ranks behind its calls, and what the command pstripack becomes under
mpirun.")
endif()
if(PSTRIPACK_TOOLS)
  debian_package(tools NAME pstripack SECTION science
    DEPENDS libpstripack${soversion} SUGGESTS pstripack-mpi libmagics++-data librsvg2-bin
    SUMMARY "Delaunay triangulation on the sphere: commands"
    DESCRIPTION "${about}This package has pstripack, which makes meshes of files of nodes, and
stripack-compare, which runs an original STRIPACK beside this one and
explains every difference.")
endif()
if(TARGET pstripack_python)
  string(REGEX MATCH "^([0-9]+)\\.([0-9]+)" this_python ${PSTRIPACK_PYTHON_VERSION})
  math(EXPR next_minor "${CMAKE_MATCH_2} + 1")
  debian_package(python NAME python3-pstripack SECTION python
    DEPENDS libpstripack${soversion} "python3 (>= ${this_python})"
            "python3 (<< ${CMAKE_MATCH_1}.${next_minor})" python3-numpy
    SUGGESTS python3-scipy python3-pandas python3-xarray python3-geopandas python3-matplotlib
    SUMMARY "Delaunay triangulation on the sphere: Python package"
    DESCRIPTION "${about}This package has the Python package pstripack: triangulations, Voronoi
diagrams, searches and interpolation of NumPy arrays.")
  # Debian compiles the Python files when the package is installed.
  file(WRITE ${PROJECT_BINARY_DIR}/packaging/postinst "#!/bin/sh\nset -e\n"
    "if command -v py3compile >/dev/null; then py3compile -p python3-pstripack; fi\n")
  file(WRITE ${PROJECT_BINARY_DIR}/packaging/prerm "#!/bin/sh\nset -e\n"
    "if command -v py3clean >/dev/null; then py3clean -p python3-pstripack; fi\n")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/packaging/postinst
                                                ${PROJECT_BINARY_DIR}/packaging/prerm)
endif()
debian_package(documents NAME pstripack-doc SECTION doc
  SUMMARY "Delaunay triangulation on the sphere: documents and examples"
  DESCRIPTION "${about}This package has the documents, among them how to relink a program, and
examples in several languages.")
set(CPACK_DEBIAN_DOCUMENTS_PACKAGE_ARCHITECTURE all)

include(CPack)
