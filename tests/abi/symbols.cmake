# cmake -DNM=nm -DREADELF=readelf -DLIBRARY=lib.so -DARCHIVE=lib.a -DSONAME=lib.so.1 "-DNEEDS=^(libc|libm)$"
#       "-DEXPECTED=a_;b_" [-DEXPECTED_LIKE=^a_] [-DONE_SYMBOL_AN_OBJECT=ON] -P symbols.cmake
# Fails unless the library exports exactly the expected symbols (all like EXPECTED_LIKE, where the compiler adds some of
# its own), has that soname, needs no other libraries, and reads the environment by secure_getenv alone; and unless the
# archive brings no other name into a program but C++ names of our namespace. ONE_SYMBOL_AN_OBJECT, as STRIPACK's
# archive: one expected symbol an object, and nothing needed but functions of libpstripack, and of the Fortran run-time
# library to print.
list(SORT EXPECTED)
set(instrumented "^_(GLOBAL|_asan|_ubsan|_gcov)")
set(weak_of_flang "_Q(M[a-z_]*E|Qcl)")  # its descriptions of types, and constants

# symbols_of(file result nm's options...), those of the given types in TYPES
function(symbols_of file result)
  execute_process(COMMAND ${NM} ${ARGN} -P ${file} OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" lines "${output}")
  set(names)
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "^${weak_of_flang}" AND line MATCHES "^([^ ]+) [${TYPES}]")
      list(APPEND names ${CMAKE_MATCH_1})
    endif()
  endforeach()
  list(SORT names)
  set(${result} "${names}" PARENT_SCOPE)
endfunction()
set(TYPES A-Za-z)

symbols_of(${LIBRARY} exported -D --defined-only)
if(EXPECTED_LIKE)
  list(FILTER exported EXCLUDE REGEX "${EXPECTED_LIKE}")
endif()
if(NOT exported STREQUAL "${EXPECTED}")
  message(FATAL_ERROR "${LIBRARY} exports\n  ${exported}\nexpected\n  ${EXPECTED}")
endif()

execute_process(COMMAND ${READELF} -d ${LIBRARY} OUTPUT_VARIABLE dynamic COMMAND_ERROR_IS_FATAL ANY)
if(NOT dynamic MATCHES "SONAME[^[]*\\[([^]]*)\\]" OR NOT CMAKE_MATCH_1 STREQUAL SONAME)
  message(FATAL_ERROR "${LIBRARY} has the soname ${CMAKE_MATCH_1}, expected ${SONAME}")
endif()
string(REGEX MATCHALL "NEEDED[^\n]*" needed "${dynamic}")
foreach(line IN LISTS needed)
  if(NOT line MATCHES "\\[([^]]*)\\.so[^]]*\\]" OR NOT CMAKE_MATCH_1 MATCHES "${NEEDS}")
    message(FATAL_ERROR "${LIBRARY} needs ${line}, expected only ${NEEDS}")
  endif()
endforeach()

symbols_of(${LIBRARY} undefined -D --undefined-only)
if("${undefined}" MATCHES "(^|;)getenv")
  message(FATAL_ERROR "${LIBRARY} calls getenv: use environment_variable of base/environment.h")
endif()

if(NOT ONE_SYMBOL_AN_OBJECT)
  set(TYPES ABCDGRST)  # weak ones, as the C++ library's templates, clash with nothing
  symbols_of(${ARCHIVE} defined --defined-only --extern-only)
  list(REMOVE_ITEM defined ${EXPECTED})
  foreach(allowed "^_Z(T[VIS]|GV|Z)?NK?9pstripack" "${instrumented}" ${EXPECTED_LIKE})
    list(FILTER defined EXCLUDE REGEX "${allowed}")
  endforeach()
  if(defined)
    message(FATAL_ERROR "${ARCHIVE} defines\n  ${defined}")
  endif()
  return()
endif()

symbols_of(${ARCHIVE} defined --defined-only --extern-only)
if(NOT defined STREQUAL EXPECTED)
  message(FATAL_ERROR "${ARCHIVE} defines\n  ${defined}\nexpected\n  ${EXPECTED}")
endif()
execute_process(COMMAND ${NM} -A --defined-only --extern-only ${ARCHIVE} OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "[^\n]* ${weak_of_flang}[^\n]*" "" output "${output}")
string(REGEX MATCHALL "[^:\n]+\\.o:" objects "${output}")
list(LENGTH objects symbols)
list(REMOVE_DUPLICATES objects)
list(LENGTH objects different)
list(LENGTH EXPECTED count)
if(NOT symbols EQUAL count OR NOT different EQUAL count)
  message(FATAL_ERROR "${ARCHIVE}: ${symbols} symbols in ${different} objects, expected one symbol an object:\n${output}")
endif()

symbols_of(${ARCHIVE} needed --undefined-only)
foreach(name IN LISTS needed)
  if(NOT name MATCHES "^(pstripack_|_gfortran_(st_write|st_inquire|transfer_)|_FortranA(io|Character))" AND NOT name MATCHES "${instrumented}")
    message(FATAL_ERROR "${ARCHIVE} needs ${name}")
  endif()
endforeach()
