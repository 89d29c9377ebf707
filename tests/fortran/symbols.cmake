# cmake -DNM=nm -DLIBRARY=lib.so -DARCHIVE=lib.a -DEXPECTED="a_;b_" -P symbols.cmake
# EXPECTED: the library's part of src/fortran/symbols, which comes from the table of routines in docs/api.
# Fails unless the library exports exactly the expected symbols, and the archive defines exactly them, one
# an object, and needs nothing but functions of libpstripack, and of the Fortran run-time library to print.
list(SORT EXPECTED)

function(symbols_of file result)
  execute_process(COMMAND ${NM} ${ARGN} -P ${file} OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" lines "${output}")
  set(names)
  foreach(line IN LISTS lines)
    if(line MATCHES "^([^ ]+) [A-Za-z]")
      list(APPEND names ${CMAKE_MATCH_1})
    endif()
  endforeach()
  list(SORT names)
  set(${result} "${names}" PARENT_SCOPE)
endfunction()

symbols_of(${LIBRARY} exported -D --defined-only)
if(NOT exported STREQUAL EXPECTED)
  message(FATAL_ERROR "${LIBRARY} exports\n  ${exported}\nexpected\n  ${EXPECTED}")
endif()

symbols_of(${ARCHIVE} defined --defined-only --extern-only)
if(NOT defined STREQUAL EXPECTED)
  message(FATAL_ERROR "${ARCHIVE} defines\n  ${defined}\nexpected\n  ${EXPECTED}")
endif()
execute_process(COMMAND ${NM} -A --defined-only --extern-only ${ARCHIVE} OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
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
  if(NOT name MATCHES "^(pstripack_|_gfortran_(st_write|transfer_))" AND NOT name MATCHES "^_(GLOBAL|_asan|_ubsan|_gcov)")
    message(FATAL_ERROR "${ARCHIVE} needs ${name}")
  endif()
endforeach()
