# What systems and their linkers do in different ways; src/cxx/base/system.h has the same for C++.
#   PSTRIPACK_WITH_POOL     pstripack-run: needs Linux
#   PSTRIPACK_ORIGIN        in a run path: the folder of the file that has it
#   finish_shared_library, hide_archives, install_library: see below
# PSTRIPACK_ONLY_POSIX makes all checks fail. The case posix of tests/systems/systems.sh builds and tests that.
include(CheckCXXSourceCompiles)
include(CheckLinkerFlag)

option(PSTRIPACK_ONLY_POSIX "Do without what POSIX lacks, on any system: a test of what others get" OFF)
mark_as_advanced(PSTRIPACK_ONLY_POSIX)
if(PSTRIPACK_ONLY_POSIX)
  add_compile_definitions(PSTRIPACK_ONLY_POSIX)
  set(PSTRIPACK_HAS_POOL FALSE)
  set(PSTRIPACK_HAS_VERSION_SCRIPTS FALSE)
  set(PSTRIPACK_HAS_NODELETE FALSE)
  set(PSTRIPACK_HAS_EXCLUDE_LIBS FALSE)
else()
  check_cxx_source_compiles("
    #include <sys/mman.h>
    #include <sys/prctl.h>
    #include <sys/random.h>
    #include <sys/socket.h>
    ucred peer;
    int main() {
      return SO_PEERCRED + SOCK_SEQPACKET + memfd_create(\"\", MFD_CLOEXEC) + prctl(PR_SET_PDEATHSIG, 9) +
             accept4(0, nullptr, nullptr, SOCK_CLOEXEC);
    }" PSTRIPACK_HAS_POOL)
  file(WRITE ${CMAKE_BINARY_DIR}/CMakeFiles/check.map "{ global: main; local: *; };\n")
  check_linker_flag(CXX LINKER:--version-script=${CMAKE_BINARY_DIR}/CMakeFiles/check.map PSTRIPACK_HAS_VERSION_SCRIPTS)
  check_linker_flag(CXX LINKER:-z,nodelete PSTRIPACK_HAS_NODELETE)
  check_linker_flag(CXX LINKER:--exclude-libs,ALL PSTRIPACK_HAS_EXCLUDE_LIBS)
endif()
option(PSTRIPACK_WITH_POOL "Serve unchanged serial programs by MPI ranks (pstripack-run)" ${PSTRIPACK_HAS_POOL})
if(PSTRIPACK_WITH_POOL AND NOT PSTRIPACK_HAS_POOL)
  message(FATAL_ERROR "PSTRIPACK_WITH_POOL: this system lacks memfd_create, SO_PEERCRED, prctl or accept4, which "
                      "the pool needs; configure with -DPSTRIPACK_WITH_POOL=OFF")
endif()

set(PSTRIPACK_ORIGIN $ORIGIN)
if(APPLE)
  set(PSTRIPACK_ORIGIN @loader_path)
endif()

# finish_shared_library(target [KEEP_LOADED] EXPORTS symbol...): only these symbols, which may end in *, are visible from
# outside. Where linkers have no lists of symbols, visibility in the sources must do: all Fortran procedures are visible.
# KEEP_LOADED: dlclose does not unload it.
function(finish_shared_library target)
  cmake_parse_arguments(arg "KEEP_LOADED" "" "EXPORTS" ${ARGN})
  set(list ${CMAKE_CURRENT_BINARY_DIR}/${target}.exports)
  if(APPLE AND NOT PSTRIPACK_ONLY_POSIX)
    list(TRANSFORM arg_EXPORTS PREPEND _)
    list(JOIN arg_EXPORTS "\n" text)
    set(option -exported_symbols_list,${list})
  elseif(PSTRIPACK_HAS_VERSION_SCRIPTS)
    list(JOIN arg_EXPORTS "; " text)
    set(text "{ global: ${text}; local: *; };")
    set(option --version-script=${list})
  endif()
  if(option)
    file(CONFIGURE OUTPUT ${list} CONTENT "${text}\n" @ONLY)
    target_link_options(${target} PRIVATE LINKER:${option})
    set_target_properties(${target} PROPERTIES LINK_DEPENDS ${list})
  endif()
  if(arg_KEEP_LOADED AND PSTRIPACK_HAS_NODELETE)
    target_link_options(${target} PRIVATE LINKER:-z,nodelete)
  endif()
endfunction()

# hide_archives(target): symbols of archives that this shared library or module is linked with are not visible from outside.
function(hide_archives target)
  if(PSTRIPACK_HAS_EXCLUDE_LIBS)
    target_link_options(${target} PRIVATE LINKER:--exclude-libs,ALL)
  endif()
endfunction()

# install_library(target EXPORT set RUNTIME component DEVELOPMENT component): with PSTRIPACK_SHARED=OFF a shared library is
# neither installed nor built, unless a program of the build needs it.
function(install_library target)
  cmake_parse_arguments(arg "" "EXPORT;RUNTIME;DEVELOPMENT" "" ${ARGN})
  get_target_property(type ${target} TYPE)
  if(type STREQUAL SHARED_LIBRARY AND NOT PSTRIPACK_SHARED)
    set_target_properties(${target} PROPERTIES EXCLUDE_FROM_ALL ON)
    return()
  endif()
  install(TARGETS ${target} EXPORT ${arg_EXPORT} LIBRARY COMPONENT ${arg_RUNTIME} NAMELINK_COMPONENT ${arg_DEVELOPMENT}
          ARCHIVE COMPONENT ${arg_DEVELOPMENT})
endfunction()

# For programs that link our archives: the run-time libraries of C++ and OpenMP, as options of a linker.
set(PSTRIPACK_RUNTIME_LIBS -lstdc++)
if("c++" IN_LIST CMAKE_CXX_IMPLICIT_LINK_LIBRARIES)
  set(PSTRIPACK_RUNTIME_LIBS -lc++)
endif()
find_package(OpenMP COMPONENTS CXX)
foreach(library IN LISTS OpenMP_CXX_LIB_NAMES)
  if(library STREQUAL "gomp")
    string(APPEND PSTRIPACK_RUNTIME_LIBS " -lgomp")
  elseif(NOT library STREQUAL "pthread")  # LLVM's is in a folder that other compilers do not search; it links pthread
    string(APPEND PSTRIPACK_RUNTIME_LIBS " ${OpenMP_${library}_LIBRARY}")
  endif()
endforeach()
string(APPEND PSTRIPACK_RUNTIME_LIBS " -lm")
if(NOT APPLE)  # a static program: else gfortran's own library crashes at the end of any OpenMP program
  string(APPEND PSTRIPACK_RUNTIME_LIBS " -Wl,-u,pthread_mutex_destroy")
endif()
