# What differs between compilers. docs/compilers.md says which were tried, and what the manuals of the others say.
#
#   PSTRIPACK_CXX_FLAGS, PSTRIPACK_FORTRAN_FLAGS   options that give IEEE arithmetic, whatever CMAKE_<LANG>_FLAGS hold
#   PSTRIPACK_FORTRAN_LINKER   language of the compiler that links the Fortran libraries
#   fortran_runtime            for C++ programs that link them
#   PSTRIPACK_FORTRAN_LIBS     options of a linker for programs of C or of another Fortran compiler that link them;
#   PSTRIPACK_FORTRAN_ARCHIVE_LIBS   also needed for archives

# In Clang -fno-fast-math switches contraction on, so it stands first.
set(PSTRIPACK_CXX_FLAGS -Wall -Wextra -fno-fast-math -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL IntelLLVM)  # its default is -fp-model=fast
  set(PSTRIPACK_CXX_FLAGS -Wall -Wextra -fp-model=precise -fno-fast-math -ffp-contract=off)
elseif(CMAKE_CXX_COMPILER_ID STREQUAL NVHPC)
  set(PSTRIPACK_CXX_FLAGS -Kieee -Mnofma)
elseif(CMAKE_CXX_COMPILER_ID MATCHES Clang)  # `&` of two comparisons is on purpose: it has no branch
  list(APPEND PSTRIPACK_CXX_FLAGS -Wno-bitwise-instead-of-logical)
endif()

set(PSTRIPACK_FORTRAN_FLAGS -fno-fast-math -ffp-contract=off)
if(CMAKE_Fortran_COMPILER_ID STREQUAL GNU)
  list(PREPEND PSTRIPACK_FORTRAN_FLAGS -Wall)
elseif(CMAKE_Fortran_COMPILER_ID MATCHES Intel)  # noold_unit_star: WRITE(*) writes to unit 6, as elsewhere
  set(PSTRIPACK_FORTRAN_FLAGS -fp-model precise -no-fma -assume noold_unit_star)
elseif(CMAKE_Fortran_COMPILER_ID STREQUAL NVHPC)
  set(PSTRIPACK_FORTRAN_FLAGS -Kieee -Mnofma)
endif()

# LLVM's Fortran run-time library is an archive. A copy of it in libstripack would not know the units that a program has
# opened, so TRPRNT could not write to them. The C++ compiler links without it; the program has it.
set(PSTRIPACK_FORTRAN_LINKER Fortran)
add_library(fortran_runtime INTERFACE)
if(CMAKE_Fortran_COMPILER_ID STREQUAL LLVMFlang)
  set(PSTRIPACK_FORTRAN_LINKER CXX)
  foreach(library FortranRuntime FortranDecimal)
    find_library(PSTRIPACK_${library} ${library} PATHS ${CMAKE_Fortran_IMPLICIT_LINK_DIRECTORIES} REQUIRED)
    mark_as_advanced(PSTRIPACK_${library})
    target_link_libraries(fortran_runtime INTERFACE ${PSTRIPACK_${library}})
    string(APPEND PSTRIPACK_FORTRAN_LIBS " ${PSTRIPACK_${library}}")
  endforeach()
  string(APPEND PSTRIPACK_FORTRAN_LIBS " -lm")
elseif(CMAKE_Fortran_COMPILER_ID STREQUAL GNU)
  target_link_libraries(fortran_runtime INTERFACE gfortran)
  set(PSTRIPACK_FORTRAN_ARCHIVE_LIBS " -lgfortran")
endif()

# What is assumed of the target and of the Fortran compiler. Nothing is run, so that this works for other processors.
# check_assumption(result source... MESSAGE text...)
function(check_assumption result)
  cmake_parse_arguments(arg "" "" "MESSAGE" ${ARGN})
  list(TRANSFORM arg_UNPARSED_ARGUMENTS PREPEND ${PROJECT_SOURCE_DIR}/cmake/checks/)
  # The Fortran compiler links without the libraries of sanitizers that only C is compiled with.
  string(REGEX REPLACE "-fsanitize=[^ ]*" "" CMAKE_C_FLAGS "${CMAKE_C_FLAGS}")
  if(NOT ${result})
    try_compile(${result} ${PROJECT_BINARY_DIR}/checks SOURCES ${arg_UNPARSED_ARGUMENTS} OUTPUT_VARIABLE output
                CXX_STANDARD 17)
  endif()
  if(NOT ${result})
    file(WRITE ${PROJECT_BINARY_DIR}/checks/log "${output}")
    message(FATAL_ERROR ${arg_MESSAGE} ": see docs/compilers.md and ${PROJECT_BINARY_DIR}/checks/log")
  endif()
endfunction()
check_assumption(PSTRIPACK_ARITHMETIC arithmetic.cpp
  MESSAGE "PSTRIPACK needs a 64-bit target and IEEE arithmetic without excess precision, as 32-bit x86 and x87 have it")
if(PSTRIPACK_WITH_FORTRAN)
  check_assumption(PSTRIPACK_FORTRAN_CALLS fortran.f90 calls.c
    MESSAGE "PSTRIPACK's calls between Fortran and C do not fit this Fortran compiler with CMAKE_Fortran_FLAGS")
endif()
